// Pictures for the screen, and functions that store traced values in them.
#pragma once
#include <cstdint>
#include <vector>

#include "image/transfer_table.h"
#include "show/session/progressive.h"

namespace strahl {

class ThreadPool;

/// Pixels of a TransferTable, row by row from the top.
struct ScreenImage {
    int width = 0, height = 0;
    std::vector<std::uint32_t> pixels;
    void resize(int new_width, int new_height) {
        width = new_width, height = new_height;
        pixels.resize(std::size_t(width) * height);
    }
};

/// Returns the pixels of a tile as 8-bit colours, row by row.
std::vector<std::uint32_t> encoded(const Tile& tile, const TransferTable& table);

/// Stores the pixels of a part, row by row.
void store(const Lattice& part, const std::uint32_t* colors, ScreenImage& image);

/// Fills an image with all pixels from that of a level with these steps: known pixels stay exact, those between them
/// are interpolated.
void expand(const ScreenImage& level, Steps steps, ScreenImage& whole, ThreadPool& pool);

}  // namespace strahl
