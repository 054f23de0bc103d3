// Orders pixels along a Z curve, on which neighbours stay near each other.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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

/// The pixels of a tile of some size in the order of the Z curve.
struct TileOrder {
    std::vector<int> numbers;  // of the tile's pixels, row by row, in that order

    /// Returns the places of the pixels, and sets their numbers; both are kept for the next tile of this size.
    std::span<const TileSpot> of(int columns, int rows) {
        if (columns == known_columns && rows == known_rows) return spots;
        known_columns = columns, known_rows = rows;
        numbers.resize(std::size_t(columns) * unsigned(rows)), spots.clear();
        for (const TileSpot& spot : z_curve)
            if (spot.x < columns && spot.y < rows) {
                numbers[unsigned(spot.y * columns + spot.x)] = static_cast<int>(spots.size());
                spots.push_back(spot);
            }
        return spots;
    }

  private:
    int known_columns = 0, known_rows = 0;
    std::vector<TileSpot> spots;
};

}  // namespace strahl
