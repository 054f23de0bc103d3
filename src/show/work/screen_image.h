// Pictures for the screen, and functions that store traced values in them.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "show/session/progressive.h"

namespace strahl {

/// 8 bits each of red, green, blue and (always full) opacity, from the low bits up; row by row from the top.
struct ScreenImage {
    int width = 0, height = 0;
    std::vector<std::uint32_t> rgba;
    void resize(int new_width, int new_height) {
        width = new_width, height = new_height;
        rgba.resize(std::size_t(width) * height);
    }
};

/// The transfer curve as a table: gives exactly quantise(v, linear, 255) for every float, without the power function.
class TransferTable {
  public:
    explicit TransferTable(bool linear);
    std::uint32_t operator()(float v) const {
        if (!(v > 0)) return 0;
        if (v >= 1) return 255;
        std::uint32_t code = start[static_cast<int>(v * bins)];
        while (v >= least[code + 1]) ++code;
        return code;
    }

    /// Converts doubles without the table: some lie between a float and the least one of the next code.
    std::uint32_t operator()(double v) const;
    /// Returns the pixel of a red, green and blue value.
    template <class T>
    std::uint32_t pixel(const T* rgb) const {
        return (*this)(rgb[0]) | (*this)(rgb[1]) << 8 | (*this)(rgb[2]) << 16 | 0xff000000u;
    }
    /// The same for doubles that are floats.
    std::uint32_t float_pixel(const double* rgb) const {
        const float values[]{static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
        return pixel(values);
    }

  private:
    bool linear;
    static constexpr int bins = 4096;
    std::array<float, 257> least;              // the least value with this code
    std::array<std::uint8_t, bins + 1> start;  // the code at the lower end of each bin
};

/// Returns the pixels of a tile as 8-bit colours, row by row.
std::vector<std::uint32_t> encoded(const Tile& tile, const TransferTable& table);

/// Stores 8-bit pixels, row by row, in the image of a level: pixel (x, y) goes to column x / steps.x, row y / steps.y.
void store(const Lattice& pixels, const std::uint32_t* rgba, Steps steps, ScreenImage& level);

/// Fills the image of a finer level, whose steps are smaller by `ratio`, from that of a level: known pixels stay exact,
/// those between them are interpolated.
void expand(const ScreenImage& level, Steps ratio, ScreenImage& finer);

}  // namespace strahl
