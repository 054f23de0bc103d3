// How one thread traces its tiles: pixels on a lattice, regular grids in each pixel, and cells.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <type_traits>
#include <vector>

#include "trace/build.h"
#include "trace/cells.h"
#include "trace/kernel.h"
#include "trace/tracer.h"
#include "trace/workspace.h"

namespace strahl {

inline constexpr int lattice_tile = 16;

/// Pixels of a tile along a Z curve: packs are blocks of 4x4 or 4x2 pixels, whose rays have more in common than a
/// row's.
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

template <class T>
Eye<T> eye_of(const View& view, const Placement& placement) {
    const CameraFrame frame = frame_of(view.camera, static_cast<double>(view.width) / view.height);
    return {.position = cast<T>((view.camera.position - placement.origin) * placement.scale),
            .forward = cast<T>(frame.forward),
            .right = cast<T>(frame.right * frame.tan_x),
            .down = cast<T>(frame.down * frame.tan_y),
            .scale_x = static_cast<T>(2. / view.width),
            .scale_y = static_cast<T>(2. / view.height),
            .bias_x = static_cast<T>((1 + 2 * view.shift_x) / view.width - 1),
            .bias_y = static_cast<T>((1 + 2 * view.shift_y) / view.height - 1)};
}

/// One thread's tracing of one picture.
template <class T>
class Batches {
  public:
    using Out = std::conditional_t<std::is_same_v<T, float>, float, double>;

    Batches(const World<T>& own_world, const Kernel<T>& own_kernel, const Eye<T>& own_eye, const Limits<T>& own_limits,
            Workspace<T>& own_workspace)
        : world(own_world), kernel(own_kernel), eye(own_eye), limits(own_limits), workspace(own_workspace) {}

    Counts counts;  // its own memory: threads that count beside each other wait for each other

    /// A tile of pixels, one ray each; a tile that was stopped is not handed on.
    void trace_tile(const Lattice& tile, const Sink& sink) {
        trace_spots(tile, 0, 0);
        if (limits.stopped()) return;
        Out values[3 * lattice_tile * lattice_tile + 1];
        const int pixels = tile.columns * tile.rows;
        static_assert(sizeof(PixelSum<T>) == 4 * sizeof(T));
        const T* const sums = workspace.sums[0].rgb;
        for (int i = 0; i < pixels; ++i)
            for (int c = 0; c < 4; ++c)  // four at once are faster than three; the next pixel covers the last
                values[3 * i + c] = finite<Out>(sums[4 * workspace.order[i] + c]);
        sink({tile, std::span<const Out>(values, 3 * pixels)});
    }

    /// A tile of pixels with a grid of rays in each.
    void trace_grid(const Lattice& tile, const Sampling& sampling, const Sink& sink) {
        const int n = sampling.grid, pixels = tile.columns * tile.rows;
        double sums[3 * lattice_tile * lattice_tile] = {};
        const auto add = [&](double x, double y) {
            trace_spots(tile, x, y);
            for (int i = 0; i < pixels; ++i)
                for (int c = 0; c < 3; ++c) sums[3 * i + c] += finite<double>(workspace.sums[workspace.order[i]].rgb[c]);
        };
        for (int j = 0; j < n && !limits.stopped(); ++j)
            for (int i = 0; i < n && !limits.stopped(); ++i) add((i + .5) / n - .5, (j + .5) / n - .5);
        if (sampling.centre) add(0, 0);
        if (limits.stopped()) return;
        for (int i = 0; i < 3 * pixels; ++i) sums[i] /= n * n + sampling.centre;
        sink({tile, std::span<const double>(sums, 3 * pixels)});
    }

    /// Points of a tile whose top left corner is (x, y), in pixels.
    void trace_points(int x, int y, double scale, std::span<const Point> points, CellSample* samples) {
        for (std::size_t done = 0; done < points.size(); done += batch_pixels) {
            const int count = static_cast<int>(std::min<std::size_t>(batch_pixels, points.size() - done));
            for (int i = 0; i < count; ++i) {
                // Pixel 0 of the camera's lattice is the middle of the first pixel.
                workspace.pixels_x[i] = static_cast<T>(x - .5 + points[done + i].x / double(Point::unit));
                workspace.pixels_y[i] = static_cast<T>(y - .5 + points[done + i].y / double(Point::unit));
            }
            std::fill_n(workspace.sights.begin(), count, Sight<T>{});
            trace_batches(count, workspace.sights.data());
            for (int i = 0; i < count; ++i) {
                CellSample& sample = *samples++;
                for (int c = 0; c < 3; ++c) sample.rgb[c] = finite<double>(workspace.sums[i].rgb[c]);
                const Sight<T>& sight = workspace.sights[i];
                sample.signature = sight.signature;
                sample.glint = static_cast<float>(sight.glint);
                sample.surface = sight.surface, sample.lit = sight.lit;
                for (int c = 0; c < 3; ++c) sample.reflected[c] = static_cast<float>(sight.reflected[c]);
                sample.reflection = static_cast<float>(sight.reflection);
                sample.further = static_cast<float>(static_cast<double>(sight.further) / scale);
                sample.distance = static_cast<float>(static_cast<double>(sight.distance) / scale);
            }
        }
    }

  private:
    template <class To>
    static To finite(T value) {
        return static_cast<To>(std::min(value, static_cast<T>(std::numeric_limits<To>::max())));
    }

    void trace_spots(const Lattice& tile, double shift_x, double shift_y) {
        int filled = 0;
        for (const auto [x, y] : z_curve) {
            if (x >= tile.columns || y >= tile.rows) continue;
            workspace.pixels_x[filled] = static_cast<T>(tile.x + x * tile.step_x + shift_x);
            workspace.pixels_y[filled] = static_cast<T>(tile.y + y * tile.step_y + shift_y);
            workspace.order[y * tile.columns + x] = filled++;
        }
        trace_batches(filled, nullptr);
    }

    /// The first pixels of the workspace, as many at once as fit.
    void trace_batches(int pixels, Sight<T>* sights) {
        std::fill(workspace.sums.begin(), workspace.sums.end(), PixelSum<T>{});
        std::fill(workspace.past.begin(), workspace.past.end(), T(0));
        for (int done = 0; done < pixels;) {
            const int count = std::min(workspace.batch, pixels - done);
            const PixelBatch<T> batch{workspace.pixels_x.data() + done,
                                      workspace.pixels_y.data() + done,
                                      workspace.sums.data() + done,
                                      workspace.past.data() + done,
                                      count,
                                      sights ? sights + done : nullptr};
            if (kernel.trace(world, eye, limits, batch, workspace, counts)) {
                done += count;
                workspace.batch = std::min(batch_pixels, 2 * workspace.batch);
            } else {
                std::fill_n(batch.sums, count, PixelSum<T>{});
                std::fill_n(batch.past, count, T(0));
                if (sights) std::fill_n(batch.sights, count, Sight<T>{});
                workspace.batch = std::max(1, count / 2);
            }
        }
        for (int i = 0; i < pixels; ++i) {
            counts.dropped = std::max(counts.dropped, double(workspace.sums[i].pruned));
            counts.past = std::max(counts.past, double(workspace.past[i]));
        }
    }

    const World<T>& world;
    const Kernel<T>& kernel;
    const Eye<T>& eye;
    const Limits<T>& limits;
    Workspace<T>& workspace;
};

}  // namespace strahl
