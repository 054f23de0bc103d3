// From traced values to pixels of the screen.
#include "show/image.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "image/transfer.h"

namespace strahl {
namespace {

/// a + (b - a) * weight / 2^shift in all four bytes at once.
std::uint32_t blend(std::uint32_t a, std::uint32_t b, std::uint32_t weight, int shift) {
    constexpr std::uint32_t odd = 0x00ff00ff;
    const std::uint32_t rest = (1u << shift) - weight;
    const std::uint32_t low = ((a & odd) * rest + (b & odd) * weight) >> shift & odd;
    const std::uint32_t high = ((a >> 8 & odd) * rest + (b >> 8 & odd) * weight) >> shift & odd;
    return low | high << 8;
}

/// Widens one row of a level to the width of the picture.
void widen(const std::uint32_t* row, int columns, int step, std::vector<std::uint32_t>& wide) {
    const int shift = std::countr_zero(static_cast<unsigned>(step));
    for (int x = 0; x < static_cast<int>(wide.size()); ++x) {
        const int i = x >> shift;
        wide[x] = blend(row[i], row[std::min(i + 1, columns - 1)], x & (step - 1), shift);
    }
}

}  // namespace

TransferTable::TransferTable(bool is_linear) : linear(is_linear) {
    least[0] = 0;
    for (int code = 1; code < 256; ++code) {
        // Positive floats are ordered as their bits are.
        std::uint32_t low = 0, high = std::bit_cast<std::uint32_t>(1.f);  // quantised below `code`, and not below
        while (high - low > 1) {
            const std::uint32_t middle = low + (high - low) / 2;
            (quantise(std::bit_cast<float>(middle), linear, 255) < code ? low : high) = middle;
        }
        least[code] = std::bit_cast<float>(high);
    }
    least[256] = 2;  // never reached
    for (int i = 0, code = 0; i <= bins; ++i) {
        while (static_cast<float>(i) / bins >= least[code + 1]) ++code;
        start[i] = static_cast<std::uint8_t>(code);
    }
}

std::uint32_t TransferTable::operator()(double v) const { return quantise(v, linear, 255); }

void encode(const Tile& tile, const TransferTable& table, std::uint32_t* rgba) {
    const auto encode_all = [&](const auto& values) {
        const auto code = [&](std::size_t i) { return table(values[i]); };
        for (std::size_t i = 0; i < values.size(); i += 3)
            *rgba++ = code(i) | code(i + 1) << 8 | code(i + 2) << 16 | 0xff000000u;
    };
    std::visit(encode_all, tile.rgb);
}

void store(const Tile& tile, const TransferTable& table, Steps steps, Image& level) {
    const Lattice& part = tile.lattice;
    const auto values = std::get<std::span<const float>>(tile.rgb);
    for (int row = 0; row < part.rows; ++row) {
        const Tile line{{.columns = part.columns, .rows = 1},
                        values.subspan(std::size_t(3) * row * part.columns, std::size_t(3) * part.columns)};
        encode(line, table, &level.rgba[std::size_t(part.y / steps.y + row) * level.width + part.x / steps.x]);
    }
}

void store_blocks(const Lattice& tile, const std::uint32_t* rgba, Steps steps, Image& whole) {
    for (int row = 0; row < tile.rows; ++row)
        for (int column = 0; column < tile.columns; ++column) {
            const int x = tile.x + column * tile.step_x, y = tile.y + row * tile.step_y;
            const int right = std::min(x + steps.x, whole.width), bottom = std::min(y + steps.y, whole.height);
            const std::uint32_t color = *rgba++;
            for (int to = y; to < bottom; ++to)
                std::fill_n(&whole.rgba[std::size_t(to) * whole.width + x], right - x, color);
        }
}

void expand(const Image& level, Steps steps, Image& whole) {
    assert(level.width == (whole.width + steps.x - 1) / steps.x);
    const int shift = std::countr_zero(static_cast<unsigned>(steps.y));
    std::vector<std::uint32_t> above(whole.width), below(whole.width);
    for (int row = 0; row < level.height; ++row) {
        const int next = std::min(row + 1, level.height - 1);
        if (row == 0) widen(level.rgba.data(), level.width, steps.x, below);
        above.swap(below);
        widen(&level.rgba[std::size_t(next) * level.width], level.width, steps.x, below);
        for (int y = row * steps.y; y < std::min((row + 1) * steps.y, whole.height); ++y)
            for (int x = 0; x < whole.width; ++x)
                whole.rgba[std::size_t(y) * whole.width + x] = blend(above[x], below[x], y & (steps.y - 1), shift);
    }
}

}  // namespace strahl
