// The sample that a camera ray brings back, and how cells between such samples are interpolated.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace strahl {

struct CellSample {
    double rgb[4];            // linear, unclamped, and alpha where cells are to look at it
    std::uint32_t signature;  // equal ones: see Sight
    float glint;
    // Values of the surface seen:
    float distance;  // in the scene's units; infinite for the background
    std::int32_t surface;
    std::uint32_t lit;               // bit i: light i reaches it; the last bit is for all lights from most_lit on
    float reflected[3], reflection;  // direction and weight of the reflected ray
    float further;                   // the longest way that rays went from there
    bool uneven;                     // see Sight
    bool filtered;                   // does it show means of patterns? If so,
    float color[3];                  // its light is multiplied by this colour,
    float loose;  // this says how loose the filter is, from 0 to 1, or below 0 if nothing varies around,
    float doubt;  // whose error has this standard deviation
    bool detailed() const { return filtered && loose >= 0; }
};

/// Takes four corners and perhaps a middle, filtered samples of one signature. Returns their values as if the pattern
/// had one colour, that of the middle or else the mean of all: the part of the differences that colours explain, by
/// least squares, is taken out.
std::array<std::array<double, 4>, 5> without_pattern(std::span<const CellSample* const> samples);

/// The largest difference of highlights between samples of a cell in which none lies, times the cell's share of a
/// pixel.
inline constexpr double most_glint = .1;

/// Returns the largest difference of blunt highlights between corners.
double glint_range(const std::array<const CellSample*, 4>& corners);

/// Returns the largest difference of one of so many channels between the middle and the mean of the corners.
double middle_off(const std::array<const CellSample*, 4>& corners, const CellSample& middle, int channels = 3);

/// Returns the largest standard deviation of a channel among all five samples.
double deviation_of(const std::array<const CellSample*, 4>& corners, const CellSample& middle);

/// Interpolates between the corners of a square of n x n pixels, which are in order around it from the top left one on.
/// Pixels lie `shift` pixels right of and below the square's corners. Writes the first `columns` of its first `rows`,
/// 3 numbers each; rows are `stride` numbers apart.
template <class T>
void interpolate(const std::array<const CellSample*, 4>& corners, int n, int columns, int rows, T shift, T* first,
                 std::size_t stride) {
    const auto of = [&](int k, int c) { return static_cast<T>(corners[k]->rgb[c]); };
    for (int y = 0; y < rows; ++y) {
        const T v = (static_cast<T>(y) + shift) / static_cast<T>(n);
        T from[3], step[3];
        for (int c = 0; c < 3; ++c) {
            from[c] = of(0, c) + v * (of(3, c) - of(0, c));
            step[c] = (of(1, c) + v * (of(2, c) - of(1, c)) - from[c]) / static_cast<T>(n);
        }
        T* to = first + y * stride;
        for (int x = 0; x < columns; ++x)
            for (int c = 0; c < 3; ++c) *to++ = from[c] + (static_cast<T>(x) + shift) * step[c];
    }
}

/// Returns whether a cell of a pixel or more may be filled between its corners: if all five samples saw the same, no
/// highlight seems to lie between them, and the middle is off by no more than half the contrast.
bool looks_smooth(const std::array<const CellSample*, 4>& corners, const CellSample& middle, double contrast,
                  int channels = 3);

}  // namespace strahl
