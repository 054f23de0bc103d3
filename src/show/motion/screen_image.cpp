// Converts traced values to pixels of the screen.
#include "show/motion/screen_image.h"

#include <algorithm>
#include <cassert>

namespace strahl {
namespace {

/// Computes a + (b - a) * part / whole in all four bytes at once, with 256ths.
std::uint32_t blend(std::uint32_t a, std::uint32_t b, int part, int whole) {
    constexpr std::uint32_t odd = 0x00ff00ff;
    const std::uint32_t weight = static_cast<unsigned>((256 * part + whole / 2) / whole), rest = 256 - weight;
    const std::uint32_t low = ((a & odd) * rest + (b & odd) * weight) >> 8 & odd;
    const std::uint32_t high = ((a >> 8 & odd) * rest + (b >> 8 & odd) * weight) >> 8 & odd;
    return low | high << 8;
}

/// Widens one row of a level to the width of the picture.
void widen(const std::uint32_t* row, int columns, int step, std::vector<std::uint32_t>& wide) {
    for (int x = 0; x < static_cast<int>(wide.size()); ++x) {
        const int i = x / step;
        wide[x] = blend(row[i], row[std::min(i + 1, columns - 1)], x % step, step);
    }
}

}  // namespace

std::vector<std::uint32_t> encoded(const Tile& tile, const TransferTable& table) {
    std::vector<std::uint32_t> rgba(std::size_t(tile.lattice.columns) * tile.lattice.rows);
    const auto encode = [&](const auto& values) {
        for (std::size_t i = 0; i < rgba.size(); ++i) rgba[i] = table.pixel(&values[3 * i]);
    };
    std::visit(encode, tile.rgb);
    return rgba;
}

void store(const Lattice& pixels, const std::uint32_t* rgba, Steps steps, ScreenImage& level) {
    for (int row = 0; row < pixels.rows; ++row)
        for (int column = 0; column < pixels.columns; ++column) {
            const int x = (pixels.x + column * pixels.step_x) / steps.x;
            const int y = (pixels.y + row * pixels.step_y) / steps.y;
            level.rgba[std::size_t(y) * level.width + x] = *rgba++;
        }
}

void expand(const ScreenImage& level, Steps ratio, ScreenImage& finer) {
    assert(level.width == (finer.width + ratio.x - 1) / ratio.x);
    std::vector<std::uint32_t> above(finer.width), below(finer.width);
    for (int row = 0; row < level.height; ++row) {
        const int next = std::min(row + 1, level.height - 1);
        if (row == 0) widen(level.rgba.data(), level.width, ratio.x, below);
        above.swap(below);
        widen(&level.rgba[std::size_t(next) * level.width], level.width, ratio.x, below);
        for (int y = row * ratio.y; y < std::min((row + 1) * ratio.y, finer.height); ++y)
            for (int x = 0; x < finer.width; ++x)
                finer.rgba[std::size_t(y) * finer.width + x] = blend(above[x], below[x], y % ratio.y, ratio.y);
    }
}

}  // namespace strahl
