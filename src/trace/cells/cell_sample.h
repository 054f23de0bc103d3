// What a camera ray brought back, and whether a cell between such rays is smooth.
#pragma once
#include <array>
#include <cstdint>
#include <span>

namespace strahl {

struct CellSample {
    double rgb[3];            // linear, unclamped
    std::uint32_t signature;  // equal ones: see Sight
    float glint;
    // Of the surface seen:
    float distance;  // in the scene's units; infinite for the background
    std::int32_t surface;
    std::uint32_t lit;               // bit i: light i reaches it; the last one counts for all lights from most_lit on
    float reflected[3], reflection;  // direction and weight of the reflected ray
    float further;                   // the longest way that rays went from there
    bool uneven;                     // see Sight
    bool filtered;   // it has the colour of an image that is not seen magnified; then
    float color[3];  // is what its light is multiplied by
};

/// What filtered samples of one signature, four corners and perhaps a middle, would have brought back if the image had
/// one colour: the middle's, or else the mean of all. What colours explain of the differences, by least squares, is
/// taken out.
std::array<std::array<double, 3>, 5> without_image(std::span<const CellSample* const> samples);

/// The largest difference of highlights between samples of a cell in which none lies, times the cell's share of a
/// pixel.
inline constexpr double most_glint = .1;

/// The largest difference of blunt highlights between corners.
double glint_range(const std::array<const CellSample*, 4>& corners);

/// By how much a channel of the middle is off the mean of the corners, at most.
double middle_off(const std::array<const CellSample*, 4>& corners, const CellSample& middle);

/// May a cell of a pixel or more be filled between its corners? If all five saw the same, no highlight seems to lie
/// between them, and the middle is not off by more than half the contrast.
bool looks_smooth(const std::array<const CellSample*, 4>& corners, const CellSample& middle, double contrast);

}  // namespace strahl
