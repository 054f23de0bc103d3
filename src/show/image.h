// Pictures for the screen, and storing of traced values in them.
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

    /// Of doubles, by the function itself: some lie between a float and the next code's least one.
    std::uint32_t operator()(double v) const;

  private:
    bool linear;
    static constexpr int bins = 4096;
    std::array<float, 257> least;              // the least value with this code
    std::array<std::uint8_t, bins + 1> start;  // the code at the lower end of each bin
};

/// The pixels of a tile as 8-bit colours, row by row.
void encode(const Tile& tile, const TransferTable& table, std::uint32_t* rgba);

/// Stores a tile in the coarse image of a level: pixel (x, y) goes to column x / steps.x, row y / steps.y.
void store(const Tile& tile, const TransferTable& table, Steps steps, Image& level);

/// Stores a tile's pixels in the whole picture as blocks, each as large as the steps of the tile's level. A block
/// covers only pixels of later passes.
void store_blocks(const Lattice& tile, const std::uint32_t* rgba, Steps steps, Image& whole);

/// Enlarges the coarse image of a level to the whole picture: known pixels are exact, those between are interpolated.
void expand(const Image& level, Steps steps, Image& whole);

}  // namespace strahl
