// Orders pixels along a Z curve, on which neighbours stay near each other.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace strahl {

/// The side of a tile of a plain lattice, in pixels.
inline constexpr int lattice_tile = 16;

/// Pixels of a tile along a Z curve: packs are blocks of 4x4 or 4x2 pixels, whose rays have more in common than a
/// row's. The first 4, 16, 64 are a square as well.
struct TileSpot {
    std::uint8_t x, y;
};
inline constexpr std::array<TileSpot, lattice_tile* lattice_tile> z_curve = [] {
    std::array<TileSpot, lattice_tile * lattice_tile> spots{};
    for (std::size_t i = 0; i < spots.size(); ++i)
        for (int bit = 0; bit < 4; ++bit) {
            spots[i].x |= (i >> 2 * bit & 1) << bit;
            spots[i].y |= (i >> (2 * bit + 1) & 1) << bit;
        }
    return spots;
}();

}  // namespace strahl
