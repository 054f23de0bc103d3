// Pictures for the screen, and functions that store traced values in them.
#pragma once
#include <cstdint>
#include <vector>

#include "image/transfer_table.h"
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

/// Returns the pixels of a tile as 8-bit colours, row by row.
std::vector<std::uint32_t> encoded(const Tile& tile, const TransferTable& table);

/// Stores 8-bit pixels, row by row, in the image of a level: pixel (x, y) goes to column x / steps.x, row y / steps.y.
void store(const Lattice& pixels, const std::uint32_t* rgba, Steps steps, ScreenImage& level);

/// Fills the image of a finer level, whose steps are smaller by `ratio`, from that of a level: known pixels stay exact,
/// those between them are interpolated.
void expand(const ScreenImage& level, Steps ratio, ScreenImage& finer);

}  // namespace strahl
