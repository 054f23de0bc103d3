// Converts traced values to pixels of the screen.
#include "show/motion/screen_image.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "num/thread_pool.h"

namespace strahl {
namespace {

/// Computes a + (b - a) * weight / 256 in each of so many bytes. Compilers make SIMD code of it, as all fits 16 bits.
void blend(const std::uint8_t* a, const std::uint8_t* b, int weight, std::uint8_t* out, std::ptrdiff_t bytes) {
    const auto own = static_cast<std::uint16_t>(256 - weight), other = static_cast<std::uint16_t>(weight);
    for (std::ptrdiff_t i = 0; i < bytes; ++i)
        out[i] = static_cast<std::uint8_t>(static_cast<std::uint16_t>(a[i] * own + b[i] * other + 128) >> 8);
}

void blend(const std::uint32_t* a, const std::uint32_t* b, int weight, std::uint32_t* out, int pixels) {
    const auto bytes = [](const std::uint32_t* row) { return reinterpret_cast<const std::uint8_t*>(row); };
    blend(bytes(a), bytes(b), weight, reinterpret_cast<std::uint8_t*>(out), 4 * std::ptrdiff_t(pixels));
}

/// Returns the weight of the next pixel in 256ths, `part` of `whole` pixels after a known one.
int weight_of(int part, int whole) { return (256 * part + whole / 2) / whole; }

/// Widens one row of a level to the width of the picture.
void widen(const std::uint32_t* row, int columns, int step, std::vector<std::uint32_t>& wide) {
    if (step == 1) return static_cast<void>(std::copy_n(row, columns, wide.begin()));
    std::vector<std::uint32_t> next(row + 1, row + columns), between(columns);
    next.push_back(row[columns - 1]);
    for (int part = 0; part < step; ++part) {
        blend(row, next.data(), weight_of(part, step), between.data(), columns);
        for (std::size_t x = part, i = 0; x < wide.size(); x += step, ++i) wide[x] = between[i];
    }
}

/// Fills the rows of the picture from these rows of a level on to the next ones.
void expand(const ScreenImage& level, Steps steps, ScreenImage& whole, int first, int last) {
    std::vector<std::uint32_t> above(whole.width), below(whole.width);
    const auto wide = [&](int row, std::vector<std::uint32_t>& to) {
        widen(&level.pixels[std::size_t(std::min(row, level.height - 1)) * level.width], level.width, steps.x, to);
    };
    wide(first, below);
    for (int row = first; row < last; ++row) {
        above.swap(below);
        wide(row + 1, below);
        for (int y = row * steps.y; y < std::min((row + 1) * steps.y, whole.height); ++y)
            blend(above.data(), below.data(), weight_of(y % steps.y, steps.y),
                  &whole.pixels[std::size_t(y) * whole.width], whole.width);
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

void store(const Lattice& part, const std::uint32_t* colors, ScreenImage& image) {
    for (int row = 0; row < part.rows; ++row, colors += part.columns)
        std::copy_n(colors, part.columns, &image.pixels[std::size_t(part.y + row) * image.width + part.x]);
}

void expand(const ScreenImage& level, Steps steps, ScreenImage& whole, ThreadPool& pool) {
    assert(level.width == (whole.width + steps.x - 1) / steps.x);
    constexpr int rows = 16;  // for one thread at a time
    share_out(pool, level.height, rows, [&](int first, int last) { expand(level, steps, whole, first, last); });
}

}  // namespace strahl
