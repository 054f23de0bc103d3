// Keeps an averaged picture between passes: its tiles, which are in cells or made by a lens or a shutter, and what they
// know.
#pragma once
#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "trace/cells/cells.h"
#include "trace/cells/lens_pixels.h"
#include "trace/world/view.h"

namespace strahl {

/// An averaged picture, which is refined tile by tile.
class CellPicture {
  public:
    CellPicture() = default;
    /// Begins a part of the view, with steps of 1; a pixel of it is the same as in the whole view. Cells of more than
    /// `largest_filled` pixels are always divided: stills want 2 or less, or shadows and reflections of a few pixels
    /// are lost between the samples.
    CellPicture(const Scene& scene, const View& view, const Lattice& region, double error, int largest_filled = 2) {
        begin(scene, view, region, error, largest_filled);
    }
    /// Begins another picture in the memory of the one before.
    void begin(const Scene& scene, const View& view, const Lattice& region, double error, int largest_filled);

    /// Returns how finished tiles were sampled.
    const Sampled& sampled() const { return sum; }
    /// Returns whether all tiles are finished.
    bool finished() const { return done == tiles(); }

    int tiles() const { return static_cast<int>(places.size()); }
    /// Returns whether nets of rays make all of it. Of other pictures with a shutter they make what changes meanwhile.
    bool by_nets() const { return !thin; }
    double contrast() const { return most_contrast; }
    /// Measures the error as well, see measured_error(): about `pixels` pixels are checked for each sample that pixels
    /// take on average. By default this takes at most half as many rays as the picture.
    void check(double pixels) { checked = pixels; }
    void check() { check(std::min(96., double(region.columns) * region.rows / 256)); }
    /// Traces points of the tile whose corner is (x, y). Footprints have this side, in pixels; 0 for side_of() each.
    using TraceAt = std::function<void(int x, int y, std::span<const Point>, double side, CellSample*)>;
    /// Refines tile i and hands it to the job's sink, unless the job is stopped: then the tile cannot go on. The second
    /// function traces the rays of nets, some of which are aimed at `spots`. Tiles with layers are finished at once,
    /// with `finest` 0; both functions add their samples to `layers`.
    void refine(int i, int finest, const Job& job, const TraceAt& trace, const TraceLensRays& trace_lens,
                const BrightSpots& spots, LayerTile* layers = nullptr);
    /// Returns the rectangle of tile i in the view.
    Lattice place_of(int i) const {
        return {.x = places[i].x, .y = places[i].y, .columns = places[i].columns, .rows = places[i].rows};
    }

  private:
    struct TilePlace {
        int x, y, columns, rows;
    };
    struct InWork {
        Cells cells;
        LensPixels nets;
        bool by_nets = false;  // cells have done their part
    };

    std::unique_ptr<InWork> make();

    Lattice region;
    double most_contrast = 0;
    int largest_filled = 0;
    double checked = 0;
    std::vector<TilePlace> places;
    std::vector<std::unique_ptr<InWork>> made, spare;  // tiles in work; memory of finished tiles, to reuse
    std::vector<char> begun;
    double error = 0;
    Camera camera;
    int moments = 0;                 // of a shutter
    std::optional<ThinBodies> thin;  // for pictures in cells
    std::mutex mutex;                // of spare and sum
    Sampled sum;
    std::atomic<int> done = 0;
};

}  // namespace strahl
