// Pictures as the screen takes them, and the ways values get into them.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "show/progressive.h"

namespace strahl {

/// 8 bits each of red, green, blue and (always full) opacity, from the low bits up; row by row from the top.
struct Image {
    int width = 0, height = 0;
    std::vector<std::uint32_t> rgba;
    void resize(int new_width, int new_height) {
        width = new_width, height = new_height;
        rgba.resize(std::size_t(width) * height);
    }
};

/// The transfer curve for single precision, tabulated: gives for every float exactly what quantise(v, linear, 255)
/// gives, without the power function.
class Codes {
  public:
    explicit Codes(bool linear);
    std::uint32_t operator()(float v) const {
        if (!(v > 0)) return 0;
        if (v >= 1) return 255;
        std::uint32_t code = start[static_cast<int>(v * bins)];
        while (v >= least[code + 1]) ++code;
        return code;
    }

  private:
    static constexpr int bins = 4096;
    std::array<float, 257> least;              // the least value with this code
    std::array<std::uint8_t, bins + 1> start;  // the code at the lower end of each bin
};

/// The pixels of a tile (of single precision), row by row, ready for the screen.
void encode(const Tile& tile, const Codes& codes, std::uint32_t* rgba);

/// Puts a tile into the coarse image of a level: pixel (x, y) goes to column x / steps.x, row y / steps.y.
void store(const Tile& tile, const Codes& codes, Steps steps, Image& level);

/// Puts a tile's pixels into the whole picture as blocks that hold only pixels of later passes: each is as large as
/// the steps of the tile's level.
void store_blocks(const Lattice& tile, const std::uint32_t* rgba, Steps steps, Image& whole);

/// The coarse image of a level made as large as the picture: known pixels exactly, between them a smooth transition.
void expand(const Image& level, Steps steps, Image& whole);

}  // namespace strahl
