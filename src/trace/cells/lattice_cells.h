// Traces a tile of a lattice in cells of 8 to 2 of its pixels, and fills those that are known to be smooth.
//
// In motion there is time for some of the pixels only, and where the picture is smooth a few tell all. Cells have their
// corners on pixels. A cell whose corners and middle saw the same is filled between its corners, and where that is a
// pattern that varies only if the middles of its sides agree as well. Others are divided. In those of 4 pixels, and in
// cells that saw more than three things, all pixels are traced, by blocks, so that packs are those of a plain lattice.
// Pixels that are traced have the values that they have in one.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

#include "trace/cells/cell_sample.h"
#include "trace/cells/filled_lattice.h"
#include "trace/cells/thin_bodies.h"

namespace strahl {

class LatticeCells {
  public:
    static constexpr int side = 64;  // of a tile, at most

    /// A pixel of the lattice, from the tile's first one. Corners of cells may be beyond the tile.
    struct TilePixel {
        std::uint8_t x, y;
    };
    /// Traces pixels, and writes what they saw and brought back.
    using Look = std::function<void(std::span<const TilePixel>, CellSample*)>;
    /// Traces pixels, and writes only their colours.
    using Trace = std::function<void(std::span<const TilePixel>, std::uint32_t*)>;

    /// Writes the colours of a tile, whose pixels are some of `filled`.
    void trace(const Lattice& tile, const FilledLattice& filled, const ThinBodies& thin, const Look& look,
               const Trace& trace);

  private:
    struct LatticeCell {
        int x, y, size;
        bool sides = false;  // the middles of its sides are known as well
    };
    using Corners = std::array<const CellSample*, 4>;

    static constexpr int across = side + 1;

    int& sample_at(int x, int y) { return known[std::size_t(y) * across + x]; }
    bool within(int x, int y) const { return x < tile.columns && y < tile.rows; }
    std::uint32_t* color_at(int x, int y) { return first + std::ptrdiff_t(y) * lattice->lattice.columns + x; }
    void ask(std::initializer_list<std::pair<int, int>> pixels);
    void ask(const LatticeCell& cell);
    void look(const Look& look);
    std::array<int, 5> samples_of(const LatticeCell& cell);
    std::array<std::uint32_t, 5> colors_of(const std::array<int, 5>& own) const;
    bool hides(const LatticeCell& cell, const Corners& corners) const;
    bool even_sides(const LatticeCell& cell, const Corners& corners);
    void fill(const LatticeCell& cell);
    void fill(int x, int y, int size, const std::array<std::uint32_t, 4>& corners);
    void leave(const LatticeCell& cell);
    void advance(const LatticeCell& cell);

    Lattice tile;
    const FilledLattice* lattice = nullptr;
    const ThinBodies* thin = nullptr;
    std::uint32_t* first = nullptr;          // the tile's first pixel
    std::array<int, across * across> known;  // samples by place, -1 where there are none
    std::vector<CellSample> samples;
    std::vector<std::uint32_t> colors;  // of the samples
    std::vector<TilePixel> places;      // of the samples
    std::vector<TilePixel> rest;        // pixels that are traced for their colours alone
    std::vector<std::uint32_t> traced;  // the traced colours of `rest`
    std::vector<LatticeCell> cells, parts, filled;
};

}  // namespace strahl
