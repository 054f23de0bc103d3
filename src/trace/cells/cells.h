// A tile of the picture in cells, from 8x8 pixels down to 1/32 of a pixel: small where the picture changes.
//
// Cells have their corners between pixels, so that the picture's value in a pixel is the sum over the cells in it. A
// cell whose corners, and middle, have one signature is smooth: it is filled. Where an edge crosses a cell of a pixel
// or less its ends are searched on the cell's sides, and it is taken for straight (compare J. Genetti and D. Gordon,
// "Ray Tracing With Adaptive Supersampling in Object Space", Graphics Interface 1993). Where a thin body of flat sides
// crosses it alone, what the body takes of it is computed, and samples there say what it looks like. Everything else is
// divided.
#pragma once
#include <array>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

#include "trace/cells/cell_sample.h"
#include "trace/cells/chord.h"
#include "trace/cells/layer_tile.h"
#include "trace/cells/pixel_sampling.h"
#include "trace/cells/thin_bodies.h"

namespace strahl {

/// A point of a tile, in units from its top left corner.
struct Point {
    std::int32_t x, y;
    static constexpr std::int32_t unit = 4096;  // number of units in a pixel
    bool operator==(const Point&) const = default;
};

/// Returns the side of a sample's footprint in pixels: of the square that it stands for where cells have no edges. The
/// middle of a cell stands for all of it; other points are corners that large and small cells share.
double side_of(Point point);

/// Traces points of a tile, and writes their samples in the same order.
using TracePoints = std::function<void(std::span<const Point>, CellSample*)>;

inline constexpr int tile_pixels = 64;   // the side of a tile: enough samples at once to fill packs
inline constexpr int coarsest_cell = 8;  // pixels; tiles begin at multiples of it

/// A tile of columns x rows pixels, at (x, y) in the view; one after the other in the same memory. What a cell does
/// depends on its own samples and `thin` alone, so that a pixel's value does not depend on how much of the picture is
/// asked for.
class Cells {
  public:
    /// `contrast` is the difference of colour that a pixel may have, see contrast_for(). Cells of more than
    /// `largest_filled` pixels are always divided. Layers, if any, are averaged with the samples' light; they must be
    /// given all samples as they are traced.
    void begin(int x, int y, int columns, int rows, double contrast, int largest_filled, const ThinBodies& thin,
               LayerTile* layers = nullptr);

    /// Divides cells until no unfinished one is larger than `pixels`, or with 0 until all are finished.
    void refine(int pixels, const TracePoints& trace);
    bool finished() const { return waiting.empty(); }

    /// Returns the average over each pixel's square, row by row. Unfinished cells count as interpolated between
    /// corners.
    std::span<const double> values() const { return sums; }

    /// Returns how many samples each pixel took, row by row. Samples on a border count for the pixel to the right or
    /// below.
    std::vector<std::uint32_t> counts() const;

  private:
    static constexpr std::int32_t unit = Point::unit;

    enum class Stage : std::uint8_t { corners, middle, ends, beside, part };
    struct Cell {
        std::int32_t x, y, size;     // in units of Point
        std::array<int, 4> corners;  // samples, around the cell
        int middle = -1;
        int search = -1;  // number of the search for an edge's ends or for a flat part
        Stage stage = Stage::corners;
    };
    struct Search {
        std::array<Crossing, 2> crossings;
        std::array<int, 2> probes;  // samples asked for
    };
    struct PartSearch {
        FlatPart part;
        std::array<int, 3> probes{};
        std::uint32_t beside = 0;  // signature of what the cell shows beside the part
    };

    std::size_t pixel_of(const Cell& cell) const { return 3 * (std::size_t(cell.y / unit) * columns + cell.x / unit); }
    int sample_at(Point point);
    bool within(std::int32_t x, std::int32_t y) const;
    void divide(const Cell& cell);
    void advance(Cell& cell, int finest);
    void look_at_large(const Cell& cell);
    void look_at_corners(Cell& cell, int finest);
    void look_at_middle(Cell& cell);
    std::array<const CellSample*, 4> corners_of(const Cell& cell) const;
    void ask_middle(Cell& cell);
    void go_on(Cell& cell);
    bool begin_search(Cell& cell);
    void search(Cell& cell);
    void look_beside(Cell& cell);
    bool hides_something(const Cell& cell, std::optional<FlatPart>* part = nullptr) const;
    bool begin_part(Cell& cell, const FlatPart& part);
    void look_at_part(Cell& cell);
    double contrast_in(const Cell& cell) const;
    bool equal_signatures(const Cell& cell) const;
    bool shows_pattern(const Cell& cell) const;
    template <class Use>
    auto with_values(const Cell& cell, const Use& use) const;
    double spread(const Cell& cell) const;
    std::array<double, 3> mean(const Cell& cell) const;
    double off_corners(const Cell& cell) const;
    void fill(const Cell& cell);
    void finish(const Cell& cell, const std::array<double, 3>& color);
    void finish_smooth(const Cell& cell);
    void average_layers(const Cell& cell);
    void average_part(const Cell& cell, std::span<const int> part, double share);
    void fill_layers(const Cell& cell);

    int left = 0, top = 0, columns = 0, rows = 0;
    std::int32_t largest = 0;
    double contrast = 0;
    const ThinBodies* thin = nullptr;
    LayerTile* layers = nullptr;
    int channels = 3;  // of samples that cells look at: light, and alpha where it is asked for
    std::vector<CellSample> samples;
    std::vector<Point> points;                       // of the samples
    std::vector<int> lattice;                        // samples at corners of pixels, -1 where there is none yet
    std::unordered_map<std::uint64_t, int> between;  // all others
    std::vector<Cell> active, waiting;
    std::vector<Search> searches;
    std::vector<PartSearch> part_searches;
    std::vector<double> sums;  // 3 for each pixel
};

/// Returns the contrast that leads to an RMS error, found by experiment: tests/bench/sampling.md.
double contrast_for(double error);

}  // namespace strahl
