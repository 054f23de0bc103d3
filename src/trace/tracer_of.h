// A tracer of one precision.
#pragma once
#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include "scene/split_unions.h"
#include "trace/batches.h"
#include "trace/bound.h"
#include "trace/cell_picture.h"
#include "trace/light_buffer.h"
#include "trace/moving_hierarchy.h"
#include "trace/stage.h"
#include "trace/thread_pool.h"

namespace strahl {

struct AnyTracer {
    explicit AnyTracer(Scene&& own) : stage(with_split_unions(std::move(own))) {}
    virtual ~AnyTracer() = default;
    virtual void prepare(const View&, ThreadPool&) = 0;
    virtual Counts trace(const View&, const Lattice&, ThreadPool&, const Sink&, const std::atomic<bool>*) = 0;
    virtual Counts trace_grids(const View&, const Sampling&, const Lattice&, ThreadPool&, const Sink&,
                               const std::atomic<bool>*) = 0;
    virtual Counts trace_cells(const View&, CellPicture&, int, ThreadPool&, const Sink&, const std::atomic<bool>*) = 0;
    const Scene& scene() const { return stage.scene(); }
    Stage stage;
};

/// A bound in T; infinite before it could overflow when multiplied.
template <class T>
T upper(double value) {
    return value < 1e18 ? static_cast<T>(value) : std::numeric_limits<T>::infinity();
}

template <class T>
Kernel<T> kernel_for(Simd simd) {
    if constexpr (!std::is_same_v<T, long double>) {
#if defined(STRAHL_KERNEL_v2)
        if (simd == Simd::v2) return v2::kernel<T>();
#endif
#if defined(STRAHL_KERNEL_v3)
        if (simd == Simd::v3) return v3::kernel<T>();
#endif
#if defined(STRAHL_KERNEL_v4)
        if (simd == Simd::v4) return v4::kernel<T>();
#endif
#if defined(STRAHL_KERNEL_neon)
        if (simd == Simd::neon) return neon::kernel<T>();
#endif
    }
    return scalar::kernel<T>();
}

template <class T>
class TracerOf : public AnyTracer {
  public:
    TracerOf(Scene&& own, Simd simd)
        : AnyTracer(std::move(own)), extent(extent_of(scene())), kernel(kernel_for<T>(simd)) {}

    void prepare(const View& view, ThreadPool& pool) override {
        const bool moved = stage.set(view.time, view.tracks, pool);
        if (moved) extent = extent_of(scene());
        const Placement wanted = placement(extent, view.camera.position);
        if (built && wanted == placed && !moved) return;
        light_buffers.reset(), pixels = 0;
        built.reset();
        built = std::make_unique<BuiltWorld<T>>(scene(), wanted, pool, stage.moves() ? &moving : nullptr);
        placed = wanted;
    }

    Counts trace(const View& view, const Lattice& lattice, ThreadPool& pool, const Sink& sink,
                 const std::atomic<bool>* stop) override {
        return each_tile(view, lattice, pool, stop,
                         [&](Batches<T>& batches, const Lattice& tile) { batches.trace_tile(tile, sink); });
    }

    Counts trace_grids(const View& view, const Sampling& sampling, const Lattice& region, ThreadPool& pool,
                       const Sink& sink, const std::atomic<bool>* stop) override {
        return each_tile(view, region, pool, stop,
                         [&](Batches<T>& batches, const Lattice& tile) { batches.trace_grid(tile, sampling, sink); });
    }

    Counts trace_cells(const View& view, CellPicture& picture, int finest, ThreadPool& pool, const Sink& sink,
                       const std::atomic<bool>* stop) override {
        const auto refine = [&](Batches<T>& batches, int i) {
            picture.refine(i, finest, sink, stop, [&](int x, int y, std::span<const Point> points, CellSample* samples) {
                batches.trace_points(x, y, placed.scale, points, samples);
            });
        };
        return each(view, picture.tiles(), picture.contrast(), pool, stop, refine);
    }

  private:
    /// Calls work(batches, tile) for the tiles of a lattice, on all threads.
    template <class Work>
    Counts each_tile(const View& view, const Lattice& lattice, ThreadPool& pool, const std::atomic<bool>* stop,
                     const Work& work) {
        const int columns = (lattice.columns + lattice_tile - 1) / lattice_tile;
        const int tiles = columns * ((lattice.rows + lattice_tile - 1) / lattice_tile);
        return each(view, tiles, 0, pool, stop, [&](Batches<T>& batches, int i) {
            const int x = i % columns * lattice_tile, y = i / columns * lattice_tile;
            work(batches, Lattice{lattice.x + x * lattice.step_x, lattice.y + y * lattice.step_y,
                                  std::min(lattice_tile, lattice.columns - x), std::min(lattice_tile, lattice.rows - y),
                                  lattice.step_x, lattice.step_y});
        });
    }

    /// Calls work(batches, i) for 0 <= i < tiles, on all threads.
    template <class Work>
    Counts each(const View& view, int tiles, double noticed, ThreadPool& pool, const std::atomic<bool>* stop,
                const Work& work) {
        prepare(view, pool);
        while (static_cast<int>(workspaces.size()) < pool.size())
            workspaces.push_back(std::make_unique<Workspace<T>>());

        const Bound bound = bound_for(scene(), view.depth);
        std::vector<T> brightest;
        for (const double most : bound.brightest) brightest.push_back(upper<T>(most));
        const Eye<T> eye = eye_of<T>(view, placed);
        World<T> world = built->world();
        world.eye = eye.position;
        pixels += std::int64_t(tiles) * lattice_tile * lattice_tile;
        if (!light_buffers && LightBuffers<T>::pay(world, pixels))
            light_buffers = std::make_unique<LightBuffers<T>>(world, pool);
        if (light_buffers) world.light_buffers = light_buffers->buffers();
        const Limits<T> limits{.depth = view.depth,
                               .error = static_cast<T>(view.error),
                               .brightest = brightest.data(),
                               .noticed = static_cast<T>(noticed),
                               .brightest_limit = upper<T>(bound.limit),
                               .stop = stop};
        const std::vector<int> around = built->bodies_around(view.camera.position);
        std::atomic<int> next{0};
        std::vector<Counts> counts(pool.size());
        const auto take = [&](int thread) {
            Workspace<T>& workspace = *workspaces[thread];
            Eye<T> own = eye;
            int list = 0;
            for (const int body : around) list = push(workspace.mediums, list, body);
            own.medium = static_cast<T>(list);
            Batches<T> batches(world, kernel, own, limits, workspace);
            for (int i; !limits.stopped() && (i = next++) < tiles;) work(batches, i);
            counts[thread] = batches.counts;
        };
        pool.run([&](int thread) {
            try {
                take(thread);
            } catch (...) {
                next = tiles;  // the other threads need not go on
                throw;
            }
        });
        Counts sum;
        for (const Counts& c : counts) sum += c;
        return sum;
    }

    Extent extent;
    MovingHierarchy moving;
    Kernel<T> kernel;
    Placement placed;
    std::unique_ptr<BuiltWorld<T>> built;
    std::unique_ptr<LightBuffers<T>> light_buffers;  // once they pay
    std::int64_t pixels = 0;                         // traced in this world
    std::vector<std::unique_ptr<Workspace<T>>> workspaces;
};

}  // namespace strahl
