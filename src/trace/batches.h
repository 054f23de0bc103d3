// Traces the tiles of one thread: pixels on a lattice, regular grids in each pixel, and cells.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "trace/cells/cells.h"
#include "trace/cells/lattice_cells.h"
#include "trace/cells/lens_pixels.h"
#include "trace/cells/z_curve.h"
#include "trace/kernel/kernel.h"
#include "trace/kernel/workspace.h"
#include "trace/proof/proving_kernel.h"
#include "trace/tracer.h"
#include "trace/world/build_world.h"
#include "trace/world/extended_numbers.h"

namespace strahl {

/// Traces one picture's tiles in one thread.
template <class T>
class Batches {
  public:
    using Out = std::conditional_t<std::is_same_v<T, float>, float, double>;

    Batches(const World<T>& own_world, const Kernel<T>& own_kernel, const Eye<T>& own_eye, const Limits<T>& own_limits,
            Workspace<T>& own_workspace, bool with_bounds, bool with_footprints, double side,
            const Placement& own_placement, LayerTile* own_layers = nullptr)
        : layers(own_layers),
          world(own_world),
          kernel(own_kernel),
          eye(own_eye),
          limits(own_limits),
          workspace(own_workspace),
          prove(with_bounds),
          filters(with_footprints),
          placement(own_placement) {
        if (prove) workspace.hold_extra(), bounds.resize(scattered_pixels);
        if (filters && side > 0)
            workspace.hold_cones(), std::ranges::fill(workspace.sides, static_cast<T>(side));
        else if (filters)
            workspace.hold_differentials();
        if (world.finishes.carries) workspace.hold_carried();
        if (!layers) return;
        layer_values.resize(std::size_t(layers->length()) * scattered_pixels);
        lit.resize(std::size_t(3) * (layers->tables().lights.size() + 1) * widest_pack);
        rows = {layer_values.data(), layers->length(), static_cast<T>(layers->opacity()), lit.data()};
    }

    LayerTile* const layers;     // null if there are none
    std::span<Batches> moments;  // of the same thread: at the moments of a shutter, and last at the time of the view
    EyeHalves halves;            // of the picture
    Counts counts;               // of this thread alone: threads that share a line of the cache wait for each other

    /// Traces a tile of pixels, one ray each; a tile that was stopped is not handed on.
    void trace_tile(const Lattice& tile, const Sink& sink) {
        trace_spots(tile, 0, 0);
        if (limits.stopped()) return;
        Out values[3 * lattice_tile * lattice_tile + 1];
        const int pixels = tile.columns * tile.rows;
        static_assert(sizeof(PixelSum<T>) == 4 * sizeof(T));
        const T* const sums = workspace.sums[0].rgb;
        const int* const numbers = order.numbers.data();
        for (int i = 0; i < pixels; ++i) {
            std::array<Out, 4> pixel;  // four at once are faster than three; the next pixel covers the last
            for (int c = 0; c < 4; ++c) pixel[c] = finite<Out>(sums[4 * numbers[i] + c]);
            std::memcpy(values + 3 * i, pixel.data(), sizeof pixel);
        }
        if (layers) {
            layers->begin(pixels), average_spots(pixels);
            return hand_on(tile, std::span<const Out>(values, 3 * pixels), sink);
        }
        double most[lattice_tile * lattice_tile];
        if (prove)
            for (int i = 0; i < pixels; ++i) most[i] = bound_of(order.numbers[i]);
        sink({tile, std::span<const Out>(values, 3 * pixels), std::span<const double>(most, prove ? pixels : 0)});
    }

    /// Traces at most `scattered_pixels` points. Those of a batch that was stopped get no values.
    template <class To>
    void trace_list(std::span<const PicturePoint> points, To* rgb) {
        const int count = static_cast<int>(points.size());
        for (int i = 0; i < count; ++i)
            workspace.pixels_x[i] = static_cast<T>(points[i].x), workspace.pixels_y[i] = static_cast<T>(points[i].y);
        trace_batches(count, nullptr);
        if (limits.stopped()) return;
        for (int i = 0; i < count; ++i)
            for (int c = 0; c < 3; ++c) rgb[3 * i + c] = finite<To>(workspace.sums[i].rgb[c]);
    }

    /// Traces rays of a lens. Those of a batch that was stopped get no values. With `layered`, the tile that the rays
    /// belong to, fills its layers as well.
    void trace_lens(std::span<const LensRay> rays, std::span<LensLight> light, const Lattice* layered) {
        workspace.lens_x.resize(scattered_pixels), workspace.lens_y.resize(scattered_pixels);
        for (std::size_t done = 0; done < rays.size() && !limits.stopped(); done += scattered_pixels) {
            const int count = static_cast<int>(std::min<std::size_t>(scattered_pixels, rays.size() - done));
            for (int i = 0; i < count; ++i) {
                const LensRay& ray = rays[done + i];
                workspace.pixels_x[i] = static_cast<T>(ray.x), workspace.pixels_y[i] = static_cast<T>(ray.y);
                workspace.lens_x[i] = static_cast<T>(ray.across), workspace.lens_y[i] = static_cast<T>(ray.below);
            }
            trace_batches(count, nullptr);
            for (int i = 0; i < count; ++i)
                for (int c = 0; c < 3; ++c) light[done + i][c] = finite<double>(workspace.sums[i].rgb[c]);
            if (!layered || limits.stopped()) continue;
            layers->forget_samples();
            keep_layers(count);
            for (int i = 0; i < count; ++i) {
                const auto place = [](double at) { return static_cast<int>(std::floor(at + .5)); };
                const int column = place(rays[done + i].x) - layered->x, row = place(rays[done + i].y) - layered->y;
                layers->average(row * layered->columns + column, i, rays[done + i].weight);
                if (layers->layers().alpha) light[done + i][3] = layers->alpha(i);
            }
        }
        workspace.lens_x.clear(), workspace.lens_y.clear();
    }

    /// Traces rays of nets, see TraceLensRays, of a tile.
    void trace_nets(int moment, std::span<const LensRay> rays, std::span<LensLight> light, bool check,
                    const Lattice& tile) {
        Batches& own = moments.empty() ? *this : moments[moment];
        const Counts before = own.counts;
        own.trace_lens(rays, light, check || !layers ? nullptr : &tile);
        if (check) own.counts = before;
    }

    /// Traces a tile of pixels with rays all over a lens, or a shutter's moments: in each as many as a grid has.
    void trace_net_grid(const Lattice& tile, int grid, const Camera& camera, const Sink& sink) {
        LensPixels pixels;
        pixels.begin(tile.x, tile.y, tile.columns, tile.rows, 1, camera,
                     std::max(static_cast<int>(moments.size()) - 1, 0));
        if (layers) layers->begin(tile.columns * tile.rows);
        pixels.take(grid * grid, [&](int moment, std::span<const LensRay> rays, std::span<LensLight> light,
                                     bool check) { trace_nets(moment, rays, light, check, tile); });
        if (!limits.stopped()) hand_on(tile, pixels.values(), sink);
    }

    /// Traces a tile of pixels with a grid of rays in each.
    void trace_grid(const Lattice& tile, const Sampling& sampling, const Sink& sink) {
        const int n = sampling.grid, pixels = tile.columns * tile.rows;
        double sums[3 * lattice_tile * lattice_tile] = {};
        if (layers) layers->begin(pixels);
        const auto add = [&](double x, double y) {
            trace_spots(tile, x, y);
            if (layers) average_spots(pixels);
            for (int i = 0; i < pixels; ++i)
                for (int c = 0; c < 3; ++c) sums[3 * i + c] += finite<double>(workspace.sums[order.numbers[i]].rgb[c]);
        };
        for (int j = 0; j < n && !limits.stopped(); ++j)
            for (int i = 0; i < n && !limits.stopped(); ++i) add((i + .5) / n - .5, (j + .5) / n - .5);
        if (sampling.centre) add(0, 0);
        if (limits.stopped()) return;
        for (int i = 0; i < 3 * pixels; ++i) sums[i] /= n * n + sampling.centre;
        hand_on(tile, std::span<const double>(sums, 3 * pixels), sink);
    }

    /// Traces points of a tile whose top left corner is (x, y), in pixels. Footprints have this side; 0 for side_of().
    void trace_points(int x, int y, double scale, std::span<const Point> points, double side, CellSample* samples) {
        for (std::size_t done = 0; done < points.size(); done += scattered_pixels) {
            const int count = static_cast<int>(std::min<std::size_t>(scattered_pixels, points.size() - done));
            for (int i = 0; i < count; ++i) {
                // Pixel 0 of the camera's lattice is the middle of the first pixel.
                workspace.pixels_x[i] = in_half(x, halves.column, x - .5 + points[done + i].x / double(Point::unit));
                workspace.pixels_y[i] = in_half(y, halves.row, y - .5 + points[done + i].y / double(Point::unit));
                if (filters) workspace.sides[i] = static_cast<T>(side > 0 ? side : side_of(points[done + i]));
            }
            look(count, scale, samples + done);
            if (layers && side == 0) keep_alpha(count, samples + done);
            for (int i = 0; i < count && filters; ++i) {
                CellSample& sample = samples[done + i];
                const SeenPatterns<T>& seen = workspace.seen[i];
                for (int c = 0; c < 3; ++c) sample.color[c] = static_cast<float>(seen.color[c]);
                sample.filtered = sample.color[0] >= 0;
                sample.loose = static_cast<float>(seen.loose), sample.doubt = static_cast<float>(seen.doubt);
            }
        }
    }

    /// Traces a tile of pixels, one ray each where cells are not smooth.
    void trace_filled(const Lattice& tile, const FilledLattice& filled, const ThinBodies& thin, double scale,
                      LatticeCells& cells) {
        using TilePixels = std::span<const LatticeCells::TilePixel>;
        const auto each_batch = [&](TilePixels spots, const auto& trace) {
            for (std::size_t done = 0; done < spots.size(); done += scattered_pixels) {
                const int count = static_cast<int>(std::min<std::size_t>(scattered_pixels, spots.size() - done));
                for (int i = 0; i < count; ++i) aim(tile, spots[done + i].x, spots[done + i].y, i);
                trace(count, done);
            }
        };
        const auto seen = [&](TilePixels spots, CellSample* samples) {
            each_batch(spots, [&](int count, std::size_t done) { look(count, scale, samples + done); });
        };
        const auto plain = [&](TilePixels spots, std::uint32_t* colors) {
            each_batch(spots, [&](int count, std::size_t done) {
                trace_batches(count, nullptr);
                for (int i = 0; i < count; ++i) colors[done + i] = color_of(i, filled);
            });
        };
        cells.trace(tile, filled, thin, seen, plain);
    }

  private:
    /// Returns a coordinate of a point in a tile, which may be on its edge, in the half of the eye that sees the tile.
    static T in_half(int tile, int half, double at) {
        const T own = static_cast<T>(at);
        return tile < half ? std::min(own, std::nextafter(static_cast<T>(half - .5), T(0))) : own;
    }
    /// Returns a bound on the error of pixel i of the batch: of its rays, of those not traced, and of the rounding of
    /// fog's sums, which the bounds of hits do not contain.
    double bound_of(int i) const {
        const PixelSum<T>& sum = workspace.sums[i];
        const T most = std::max({sum.rgb[0], sum.rgb[1], sum.rgb[2]});
        // A pixel of long double becomes one of double, as this bound does.
        constexpr T rounding = std::numeric_limits<T>::epsilon() +
                               (std::is_same_v<T, long double> ? std::numeric_limits<double>::epsilon() : 0);
        const T bound = T(1.001) * (bounds[i] + sum.pruned) + rounding * most;
        return bound >= 0 ? static_cast<double>(bound) : std::numeric_limits<double>::infinity();
    }
    template <class To, class From>
    static To finite(From value) {
        return static_cast<To>(std::min(value, static_cast<From>(std::numeric_limits<To>::max())));
    }

    /// Returns the largest of `count` numbers that are `step` apart, or 0. Four maxima grow side by side, since each
    /// waits for the one before.
    static T largest(const T* numbers, int count, int step) {
        T most[4] = {};
        int i = 0;
        for (; i + 4 <= count; i += 4)
            for (int k = 0; k < 4; ++k) most[k] = std::max(most[k], numbers[(i + k) * step]);
        for (; i < count; ++i) most[0] = std::max(most[0], numbers[i * step]);
        return std::max({most[0], most[1], most[2], most[3]});
    }

    /// Gives the layers the samples that were just traced.
    void keep_layers(int count) {
        using Rows = LayerRows<T>;
        for (int i = 0; i < count; ++i) {
            const T* const from = rows.values + std::size_t(i) * rows.length;
            float* const to = layers->add_sample();
            std::transform(from, from + rows.length, to, finite<float, T>);
            if (rows.length <= Rows::distance) continue;
            to[Rows::distance] = static_cast<float>(static_cast<double>(from[Rows::distance]) / placement.scale);
            for (int c = 0; c < 3; ++c)
                to[Rows::position + c] = static_cast<float>(
                    placement.origin[c] + static_cast<double>(from[Rows::position + c]) / placement.scale);
        }
    }
    void keep_alpha(int count, CellSample* samples) {
        const int first = layers->samples();
        keep_layers(count);
        for (int i = 0; i < count; ++i) samples[i].rgb[3] = layers->alpha(first + i);
    }
    /// Adds the pixels that trace_spots() traced to layers.
    void average_spots(int pixels) {
        if (limits.stopped()) return;
        layers->forget_samples();
        keep_layers(pixels);
        for (int i = 0; i < pixels; ++i) layers->average(i, order.numbers[i], 1);
    }
    template <class To>
    void hand_on(const Lattice& tile, std::span<const To> rgb, const Sink& sink) const {
        const std::vector<float> all = layers ? layers->values(rgb) : std::vector<float>();
        sink({tile, rgb, {}, all});
    }

    /// Returns the colour of pixel i of the batch.
    std::uint32_t color_of(int i, const FilledLattice& filled) const {
        double rgb[3];
        for (int c = 0; c < 3; ++c) rgb[c] = finite<double>(workspace.sums[i].rgb[c]);
        return filled.encode(rgb);
    }

    /// Makes a pixel of a lattice pixel i of the next batch.
    void aim(const Lattice& tile, int x, int y, int i) {
        workspace.pixels_x[i] = static_cast<T>(tile.x + x * tile.step_x);
        workspace.pixels_y[i] = static_cast<T>(tile.y + y * tile.step_y);
    }

    /// Traces the first pixels of the workspace, and writes what they saw.
    void look(int count, double scale, CellSample* samples) {
        trace_batches(count, workspace.sights.data());
        for (int i = 0; i < count; ++i) {
            CellSample& sample = samples[i];
            for (int c = 0; c < 3; ++c) sample.rgb[c] = finite<double>(workspace.sums[i].rgb[c]);
            const Sight<T>& sight = workspace.sights[i];
            sample.signature = sight.signature;
            sample.glint = static_cast<float>(sight.glint), sample.uneven = sight.uneven;
            sample.surface = sight.surface, sample.lit = sight.lit;
            for (int c = 0; c < 3; ++c) sample.reflected[c] = static_cast<float>(sight.reflected[c]);
            sample.reflection = static_cast<float>(sight.reflection);
            sample.further = static_cast<float>(static_cast<double>(sight.further) / scale);
            sample.distance = static_cast<float>(static_cast<double>(sight.distance) / scale);
        }
    }

    void trace_spots(const Lattice& tile, double shift_x, double shift_y) {
        T x_at[lattice_tile], y_at[lattice_tile];
        for (int i = 0; i < lattice_tile; ++i)
            x_at[i] = static_cast<T>(tile.x + i * tile.step_x + shift_x),
            y_at[i] = static_cast<T>(tile.y + i * tile.step_y + shift_y);
        const std::span<const TileSpot> spots = order.of(tile.columns, tile.rows);
        T *const pixels_x = workspace.pixels_x.data(), *const pixels_y = workspace.pixels_y.data();
        for (std::size_t i = 0; i < spots.size(); ++i) pixels_x[i] = x_at[spots[i].x], pixels_y[i] = y_at[spots[i].y];
        trace_batches(static_cast<int>(spots.size()), nullptr);
    }

    /// Traces the first pixels of the workspace, as many at once as fit.
    void trace_batches(int pixels, Sight<T>* sights) {
        const bool lens = !workspace.lens_x.empty();
        LayerRows<T> own_rows = rows;
        for (int done = 0; done < pixels;) {
            const int count = std::min(workspace.batch, pixels - done);
            const Footprints<T> footprints{eye.forward,
                                           eye.scale_x * eye.right,
                                           eye.scale_y * eye.down,
                                           workspace.sides.data() + done,
                                           workspace.seen.data() + done,
                                           eye.rays != nullptr};
            if (layers) own_rows.values = rows.values + std::size_t(done) * rows.length;
            const ProvingBatch<T> batch{
                {workspace.pixels_x.data() + done, workspace.pixels_y.data() + done, workspace.sums.data() + done,
                 workspace.past.data() + done, count, sights ? sights + done : nullptr, filters ? &footprints : nullptr,
                 lens ? workspace.lens_x.data() + done : nullptr, lens ? workspace.lens_y.data() + done : nullptr,
                 layers ? &own_rows : nullptr},
                prove ? bounds.data() + done : nullptr};
            if (kernel.trace(world, eye, limits, batch, workspace, counts)) {
                done += count;
                workspace.batch = std::min(scattered_pixels, 2 * workspace.batch);
            } else {
                ++counts.split;
                workspace.batch = std::max(1, count / 2);
            }
        }
        counts.dropped = std::max(counts.dropped, double(largest(&workspace.sums[0].pruned, pixels, 4)));
        counts.past = std::max(counts.past, double(largest(workspace.past.data(), pixels, 1)));
    }

    const World<T>& world;
    const Kernel<T>& kernel;
    const Eye<T>& eye;
    const Limits<T>& limits;
    Workspace<T>& workspace;
    const bool prove;    // the kernel is a proving one
    const bool filters;  // do samples have footprints?
    const Placement& placement;
    TileOrder order;
    LayerRows<T> rows{};
    std::vector<T> layer_values, lit;  // of the rows
    std::vector<T> bounds;             // of the pixels, by proving kernels
};

}  // namespace strahl
