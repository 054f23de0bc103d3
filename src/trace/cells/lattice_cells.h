// Traces a tile of a lattice in cells of 8 and of 4 of its pixels, and fills those that are known to be smooth.
//
// In motion there is time for some of the pixels only, and where the picture is smooth a few tell all. Cells have their
// corners on pixels. A cell whose corners and middle saw the same is filled between its corners, and where that is a
// pattern that varies only if the middles of its sides agree as well; one of 8 pixels that saw two or three things is
// divided; of what is left all pixels are traced, by blocks, so that packs are those of a
// plain lattice. Where much is seen, as in flakes, that is most of the picture. Pixels that are traced have the values
// that they have in a plain lattice.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

#include "trace/cells/cell_sample.h"
#include "trace/cells/thin_bodies.h"
#include "trace/world/view.h"

namespace strahl {

template <class Out>
class LatticeCells {
  public:
    static constexpr int side = 64;  // of a tile, at most

    /// A pixel of the lattice, from the tile's first one. Corners of cells may be beyond the tile.
    struct TilePixel {
        std::uint8_t x, y;
    };
    /// Traces pixels, and writes what they saw and brought back.
    using Look = std::function<void(std::span<const TilePixel>, CellSample*)>;
    /// Traces pixels, and writes only what they brought back: 3 numbers each.
    using Trace = std::function<void(std::span<const TilePixel>, Out*)>;

    /// Traces a tile. A filled pixel is assumed to be off by half of `contrast` at most.
    void trace(const Lattice& tile, double contrast, const ThinBodies& thin, const Look& look, const Trace& trace);

    /// Returns red, green, blue of the tile's pixels, row by row.
    std::span<const Out> values() const { return rgb; }

  private:
    struct LatticeCell {
        int x, y, size;
        bool sides = false;  // the middles of its sides are known as well
    };
    using Corners = std::array<const CellSample*, 4>;

    static constexpr int across = side + 1;

    int& sample_at(int x, int y) { return known[y * across + x]; }
    bool within(int x, int y) const { return x < tile.columns && y < tile.rows; }
    void ask(std::initializer_list<std::pair<int, int>> pixels);
    void ask(const LatticeCell& cell);
    void look(const Look& look);
    Corners corners_of(const LatticeCell& cell);
    const CellSample& middle_of(const LatticeCell& cell);
    bool smooth(const LatticeCell& cell, const Corners& corners, double contrast, const ThinBodies& thin);
    bool even_sides(const LatticeCell& cell, const Corners& corners, double contrast);
    void fill(const LatticeCell& cell, const Corners& corners);
    void leave(const LatticeCell& cell);
    void advance(const LatticeCell& cell, double contrast, const ThinBodies& thin);

    Lattice tile;
    std::vector<Out> rgb, traced;
    std::array<int, across * across> known;  // samples by place, -1 where there are none
    std::vector<CellSample> samples;
    std::vector<TilePixel> places;  // of the samples
    std::vector<TilePixel> rest;    // pixels of cells that are neither smooth nor divided
    std::vector<LatticeCell> cells, parts, filled;
};

}  // namespace strahl
