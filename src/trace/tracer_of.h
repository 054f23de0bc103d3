// A tracer of one precision.
#pragma once
#include <atomic>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "num/thread_pool.h"
#include "scene/split_unions.h"
#include "trace/batches.h"
#include "trace/cells/cell_picture.h"
#include "trace/hierarchy/moving_hierarchy.h"
#include "trace/lights/light_buffer.h"
#include "trace/proof/slack.h"
#include "trace/world/light_bound.h"
#include "trace/world/mip_maps.h"
#include "trace/world/scene_in_time.h"
#include "trace/world/world_arrays.h"

namespace strahl {

struct AnyTracer {
    explicit AnyTracer(Scene&& own) : stage(with_split_unions(std::move(own))) {}
    virtual ~AnyTracer() = default;
    virtual void prepare(const View&, ThreadPool&) = 0;
    virtual Counts trace(const View&, const Lattice&, ThreadPool&, const Sink&, const std::atomic<bool>*) = 0;
    virtual Counts trace_pixels(const View&, std::span<const Pixel>, ThreadPool&, const Sink&,
                                const std::atomic<bool>*) = 0;
    virtual Counts trace_filled(const View&, const Lattice&, double, ThreadPool&, const Sink&,
                                const std::atomic<bool>*) = 0;
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

template <class T, class Purpose>
Kernel<T> kernel_for(Simd simd) {
    if constexpr (!std::is_same_v<T, long double>) {
#if defined(STRAHL_KERNEL_v2)
        if (simd == Simd::v2) return v2::kernel<T, Purpose>();
#endif
#if defined(STRAHL_KERNEL_v3)
        if (simd == Simd::v3) return v3::kernel<T, Purpose>();
#endif
#if defined(STRAHL_KERNEL_v4)
        if (simd == Simd::v4) return v4::kernel<T, Purpose>();
#endif
#if defined(STRAHL_KERNEL_neon)
        if (simd == Simd::neon) return neon::kernel<T, Purpose>();
#endif
    }
    return scalar::kernel<T, Purpose>();
}

template <class T>
class TracerOf : public AnyTracer {
    using Out = typename Batches<T>::Out;

  public:
    TracerOf(Scene&& own, Simd simd)
        : AnyTracer(std::move(own)), extent(extent_of(scene())), kernel(kernel_for<T, ForPictures>(simd)) {
        if constexpr (!std::is_same_v<T, float>) proving = kernel_for<T, ForProofs>(simd);
    }

    void prepare(const View& view, ThreadPool& pool) override {
        const bool moved = stage.set(view.time, view.tracks, pool);
        if (moved) extent = extent_of(scene());
        const Placement wanted = placement(extent, view.camera.position);
        if (built && wanted == placed && !moved && (proves == view.prove || std::is_same_v<T, float>)) return;
        light_buffers.reset(), pixels = 0;
        if (moved) thin_bodies.reset();
        built.reset(), slack.reset();
        built = std::make_unique<BuiltWorld<T>>(scene(), wanted, pool, stage.moves() ? &moving : nullptr, images,
                                                view.prove);
        placed = wanted, proves = view.prove;
    }

    Counts trace(const View& view, const Lattice& lattice, ThreadPool& pool, const Sink& sink,
                 const std::atomic<bool>* stop) override {
        return each_tile(view, lattice, lattice_tile, 0, pool, stop,
                         [&](Batches<T>& batches, const Lattice& tile, int) { batches.trace_tile(tile, sink); });
    }

    Counts trace_pixels(const View& view, std::span<const Pixel> pixels, ThreadPool& pool, const Sink& sink,
                        const std::atomic<bool>* stop) override {
        return each(view, static_cast<int>(pixels.size()), 0, pool, stop, [&](Batches<T>& batches, int i, int) {
            batches.trace_tile({pixels[i].x, pixels[i].y, 1, 1}, sink);
        });
    }

    Counts trace_filled(const View& view, const Lattice& lattice, double contrast, ThreadPool& pool, const Sink& sink,
                        const std::atomic<bool>* stop) override {
        prepare(view, pool);
        // To learn what is thin takes longer than cells save.
        constexpr std::size_t many = 10000, many_moving = 1000;
        if (scene().primitives.size() > (stage.moves() ? many_moving : many))
            return trace(view, lattice, pool, sink, stop);
        if (!thin_bodies) thin_bodies = std::make_shared<const ThinBodies>(scene());
        const Thin thin(scene(), view, thin_bodies);
        lattice_cells.resize(std::max<std::size_t>(lattice_cells.size(), pool.size()));
        int side = LatticeCells<Out>::side;  // smaller where threads would wait for the last ones; pixels are the same
        const double few = 8. * pool.size(), all = double(lattice.columns) * lattice.rows;
        while (side > lattice_tile && all < few * side * side) side /= 2;
        return each_tile(view, lattice, side, contrast, pool, stop,
                         [&](Batches<T>& batches, const Lattice& tile, int thread) {
                             batches.trace_filled(tile, contrast, thin, placed.scale, lattice_cells[thread], sink);
                         });
    }

    Counts trace_grids(const View& view, const Sampling& sampling, const Lattice& region, ThreadPool& pool,
                       const Sink& sink, const std::atomic<bool>* stop) override {
        return each_tile(view, region, lattice_tile, 0, pool, stop, [&](Batches<T>& batches, const Lattice& tile, int) {
            batches.trace_grid(tile, sampling, sink);
        });
    }

    Counts trace_cells(const View& view, CellPicture& picture, int finest, ThreadPool& pool, const Sink& sink,
                       const std::atomic<bool>* stop) override {
        const auto refine = [&](Batches<T>& batches, int i, int) {
            picture.refine(i, finest, sink, stop,
                           [&](int x, int y, std::span<const Point> points, CellSample* samples) {
                               batches.trace_points(x, y, placed.scale, points, samples);
                           });
        };
        return each(view, picture.tiles(), picture.contrast(), pool, stop, refine, true);
    }

  private:
    /// Calls work(batches, tile, thread) for the tiles of a lattice, on all threads.
    template <class Work>
    Counts each_tile(const View& view, const Lattice& lattice, int side, double noticed, ThreadPool& pool,
                     const std::atomic<bool>* stop, const Work& work) {
        const int columns = (lattice.columns + side - 1) / side;
        const int tiles = columns * ((lattice.rows + side - 1) / side);
        return each(view, tiles, noticed, pool, stop, [&](Batches<T>& batches, int i, int thread) {
            const int x = i % columns * side, y = i / columns * side;
            work(batches,
                 Lattice{lattice.x + x * lattice.step_x, lattice.y + y * lattice.step_y,
                         std::min(side, lattice.columns - x), std::min(side, lattice.rows - y), lattice.step_x,
                         lattice.step_y},
                 thread);
        });
    }

    /// Calls work(batches, i, thread) for 0 <= i < tiles, on all threads.
    template <class Work>
    Counts each(const View& view, int tiles, double noticed, ThreadPool& pool, const std::atomic<bool>* stop,
                const Work& work, bool filters_images = false) {
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
        if (!light_buffers && LightBuffers<T>::pay(world, pixels, view.prove))
            light_buffers = std::make_unique<LightBuffers<T>>(world, pool, view.prove);
        if (light_buffers) world.light_buffers = light_buffers->buffers();
        if (filters_images) world.mip_maps = images->mip_maps();
        const ProvingLimits<T> limits{{.depth = view.depth,
                                       .error = static_cast<T>(view.error),
                                       .brightest = brightest.data(),
                                       .noticed = static_cast<T>(noticed),
                                       .brightest_limit = upper<T>(bound.limit),
                                       .stop = stop},
                                      view.prove ? slack_for(view, world, bound.gain) : Slack<T>{}};
        const std::vector<int> around = built->bodies_around(view.camera.position);
        std::atomic<int> next{0};
        std::vector<Counts> counts(pool.size());
        const auto take = [&](int thread) {
            Workspace<T>& workspace = *workspaces[thread];
            Eye<T> own = eye;
            int list = 0;
            for (const int body : around) list = push(workspace.mediums, list, body);
            own.medium = static_cast<T>(list);
            Batches<T> batches(world, view.prove ? proving : kernel, own, limits, workspace, view.prove);
            for (int i; !limits.stopped() && (i = next++) < tiles;) work(batches, i, thread);
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

    Slack<T> slack_for(const View& view, const World<T>& world, double gain) {
        Slack<T> all;
        if constexpr (!std::is_same_v<T, float>) {
            if (!slack) {
                slack = slack_of<T>(scene(), placed);
                if (lacks_items(world)) slack->share = slack->turn = slack->plane = slack->culled = HUGE_VAL;
            }
            all = *slack;
            add_eye(all, view, placed);
        }
        all.medium = !world.nested || knows_medium(scene(), view.camera.position);
        all.gain = static_cast<T>(gain);
        all.reach = world.rounding / static_cast<T>(WorldArrays<T>::rounding(1));
        return all;
    }

    /// Were bodies left out whose numbers in T are those of another? That they are the same in the scene is not known.
    bool lacks_items(const World<T>& world) const {
        ItemCounts declared;
        for (const Primitive& primitive : scene().primitives) count_items<T>(primitive, declared);
        int form = 0;
        bool lacks = false;
        world.groups.each([&](const auto& group) { lacks |= group.count != declared.items[form++]; });
        return lacks;
    }

    Extent extent;
    MovingHierarchy moving;
    const std::shared_ptr<Images> images = std::make_shared<Images>();
    Kernel<T> kernel, proving;      // none of float proves
    std::optional<Slack<T>> slack;  // of the world's bodies, once proofs want it
    Placement placed;
    bool proves = false;  // is the world one for proofs?
    std::unique_ptr<BuiltWorld<T>> built;
    std::unique_ptr<LightBuffers<T>> light_buffers;  // once they pay
    std::int64_t pixels = 0;                         // traced in this world
    std::shared_ptr<const ThinBodies> thin_bodies;   // once they are asked for
    std::vector<std::unique_ptr<Workspace<T>>> workspaces;
    std::vector<LatticeCells<Out>> lattice_cells;  // one for each thread
};

}  // namespace strahl
