#include "trace/tracer.h"

#include <cassert>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <new>
#include <optional>
#include <utility>

#include "files/os/memory.h"
#include "num/thread_pool.h"
#include "num/vec_math.h"
#include "scene/leave_faces.h"
#include "trace/batches.h"
#include "trace/built_kernels.h"
#include "trace/cells/cell_picture.h"
#include "trace/hierarchy/moving_hierarchy.h"
#include "trace/kernel/camera_rays.h"
#include "trace/lights/light_buffer.h"
#include "trace/proof/slack.h"
#include "trace/scene_in_time.h"
#include "trace/world/build_world.h"
#include "trace/world/light_bound.h"
#include "trace/world/mip_maps.h"
#include "trace/world/split_unions.h"

namespace strahl {

void check_capacity(const Scene& scene, Precision precision) {
    if (precision == Precision::float32) check_capacity<float>(surfaces_of(scene));
}

Counts& Counts::operator+=(const Counts& other) {
    camera += other.camera, reflected += other.reflected, refracted += other.refracted, shadow += other.shadow;
    depth = std::max(depth, other.depth), split += other.split;
    dropped = std::max(dropped, other.dropped), past = std::max(past, other.past);
    return *this;
}

class AnyTracer {
  public:
    AnyTracer(Scene&& own, Precision of, Simd level)
        : in_time(with_split_unions(std::move(own), &declared)), precision(of), simd(level) {}
    virtual ~AnyTracer() = default;
    virtual void prepare(const View& view, ThreadPool& pool) = 0;
    virtual Counts trace(const Job& job, const TracedPixels& pixels) = 0;
    const Scene& scene() const { return in_time.scene(); }
    /// With more bodies it takes longer to find the thin ones than filled cells save.
    bool many_bodies() const { return scene().primitives.size() > (in_time.moves() ? 1000 : 10000); }

    DeclaredAs declared;  // before `in_time`, which is made with it
    SceneInTime in_time;
    const Precision precision;
    const Simd simd;
};

namespace {

/// Converts a bound to T; it becomes infinite before it could overflow when multiplied.
template <class T>
T upper(double value) {
    return value < 1e18 ? static_cast<T>(value) : std::numeric_limits<T>::infinity();
}

/// A tracer of one precision.
template <class T>
class TracerOf : public AnyTracer {
    using Out = typename Batches<T>::Out;

  public:
    TracerOf(Scene&& own, Precision precision, Simd simd)
        : AnyTracer(std::move(own), precision, simd),
          extent(extent_of(scene())),
          kernel(kernel_for<T, ForPictures>(simd)) {
        if constexpr (!std::is_same_v<T, float>) proving = kernel_for<T, ForProofs>(simd);
    }

    void prepare(const View& view, ThreadPool& pool) override {
        const bool moved = in_time.set(view.time, view.tracks, pool);
        if (moved) extent = extent_of(scene()), capsules.reset();
        const Placement wanted = placement(extent, view.camera.position);
        const bool serves = kept && (kept->proves == view.prove || std::is_same_v<T, float>);
        if (serves && wanted == kept->placed && !moved) return;
        kept.reset();  // frees its memory before the next world takes some
        kept.emplace(wanted, view.prove, build(wanted, view.prove, pool, &moving, nullptr));
    }

    Counts trace(const Job& job, const TracedPixels& pixels) override {
        prepare(job.view, job.pool);
        return std::visit([&](const auto& some) { return traced(job, some); }, pixels);
    }

  private:
    /// The camera that was last asked for, where it is a hair off the faces that it lies on (leave_faces.h), and the
    /// transparent bodies that it is inside.
    struct KnownEye {
        Camera camera;
        DVec3 eye;
        std::vector<int> bodies;
    };

    /// A view of a world as kernels read it. It stays in its place, as parts of it point at others.
    struct ReadyView {
        View view;
        std::shared_ptr<const BuiltWorld<T>> built;
        std::vector<int> bodies;   // transparent ones that the eye is in
        std::vector<T> brightest;  // see Limits
        World<T> world;
        Eye<T> eye;
        std::optional<CameraRays<T>> rays;
        ProvingLimits<T> limits;
    };

    /// A world, and what was made for it when that was first needed.
    struct KeptWorld {
        KeptWorld(const Placement& placed, bool proves, std::shared_ptr<const BuiltWorld<T>> built)
            : placed(placed), proves(proves), built(std::move(built)) {}
        const Placement placed;
        const bool proves;  // is it one for proofs?
        const std::shared_ptr<const BuiltWorld<T>> built;
        std::optional<Slack<T>> slack;  // of its bodies
        std::optional<KnownEye> known;
        std::optional<Bound> bound;     // of the scene's light, for as many generations as were last asked for
        std::deque<ReadyView> moments;  // of a shutter and, last, the time of the view
        View moments_of;                // the view whose moments these are
        std::unique_ptr<LightBuffers<T>> light_buffers;  // made when they are worth it
        std::int64_t traced_pixels = 0;
    };

    /// Traces a piece of a picture in the thread whose number is given.
    template <class Piece>
    using Work = std::function<void(Batches<T>&, const Piece&, int)>;
    /// Says which rays a piece of a picture gets: those through single places, of cells and nets, or of nets alone.
    enum class RayPlaces { single, cells, nets };

    Counts traced(const Job& job, const Lattice& lattice) { return each_pixel(job, lattice, 0); }
    Counts each_pixel(const Job& job, const Lattice& lattice, double footprint) {
        const auto trace = [&](Batches<T>& batches, const Lattice& tile, int) { batches.trace_tile(tile, job.sink); };
        return each_tile(job, lattice, lattice_tile, 0, trace, footprint);
    }

    Counts traced(const Job& job, std::span<const Pixel> pixels) {
        return each(job, static_cast<int>(pixels.size()), 0, [&](Batches<T>& batches, int i, int) {
            batches.trace_tile({pixels[i].x, pixels[i].y, 1, 1}, job.sink);
        });
    }

    Counts traced(const Job& job, const PointList& list) {
        const auto count = static_cast<int>(list.points.size());
        const auto trace = [&](Batches<T>& batches, int i, int) {
            const int first = i * scattered_pixels;
            const auto points = list.points.subspan(first, std::min(scattered_pixels, count - first));
            std::visit([&](auto* rgb) { batches.trace_list(points, rgb + 3 * std::ptrdiff_t(first)); }, list.rgb);
        };
        return each(job, (count + scattered_pixels - 1) / scattered_pixels, 0, trace, list.side);
    }

    Counts traced(const Job& job, const FilledLattice& filled) {
        const Lattice& lattice = filled.lattice;
        if (many_bodies()) return all_traced(job, filled);
        if (!capsules) capsules = std::make_shared<const CapsuleTree>(scene(), false);
        const ThinBodies thin(scene(), job.view, capsules);
        lattice_cells.resize(std::max<std::size_t>(lattice_cells.size(), job.pool.size()));
        int side = LatticeCells::side;  // smaller where threads would wait for the last ones; pixels are the same
        const double few = 8. * job.pool.size(), all = double(lattice.columns) * lattice.rows;
        while (side > lattice_tile && all < few * side * side) side /= 2;
        const auto trace = [&](Batches<T>& batches, const Lattice& tile, int thread) {
            batches.trace_filled(tile, filled, thin, kept->placed.scale, lattice_cells[thread]);
        };
        return each_tile(job, lattice, side, filled.contrast, trace, filled.side);
    }

    /// Traces a ray in each pixel of the lattice.
    Counts all_traced(const Job& job, const FilledLattice& filled) {
        const Lattice& all = filled.lattice;
        const auto encode = [&](const Lattice& part, const auto& values) {
            auto value = values.begin();
            for (int row = 0; row < part.rows; ++row) {
                const std::ptrdiff_t y = (part.y - all.y) / all.step_y + row;
                std::uint32_t* color = filled.colors + y * all.columns + (part.x - all.x) / all.step_x;
                for (int column = 0; column < part.columns; ++column, value += 3) {
                    const double rgb[]{value[0], value[1], value[2]};
                    *color++ = filled.encode(rgb);
                }
            }
        };
        const auto keep = [&](const Tile& tile) {
            std::visit([&](const auto& values) { encode(tile.lattice, values); }, tile.rgb);
        };
        return each_pixel({job.view, job.pool, keep, job.stop}, all, filled.side);
    }

    Counts traced(const Job& job, const SampledRegion& sampled) {
        const auto& [region, sampling] = sampled;
        if (sampling.grid == 1 && !sampling.centre) return traced(job, region);
        if (sampling.grid > 0 && (has_lens(job.view.camera) || job.view.moments))
            return each_tile(
                job, region, lattice_tile, 0,
                [&](Batches<T>& batches, const Lattice& tile, int) {
                    batches.trace_net_grid(tile, sampled.sampling.grid, job.view.camera, job.sink);
                },
                0, RayPlaces::nets);
        if (sampling.grid > 0)
            return each_tile(job, region, lattice_tile, 0, [&](Batches<T>& batches, const Lattice& tile, int) {
                batches.trace_grid(tile, sampled.sampling, job.sink);
            });
        CellPicture picture(scene(), job.view, region, sampling.error);
        return traced(job, CellPass{picture, 0});
    }

    Counts traced(const Job& job, const CellPass& pass) {
        if (has_lens(job.view.camera) && !job.view.moments && spots_of != job.view) {
            spots.begin(1), spots.add(scene(), job.view);
            spots_of = job.view;
        }
        const auto refine = [&](Batches<T>& batches, int i, int) {
            const Lattice place = pass.picture.place_of(i);
            pass.picture.refine(
                i, pass.finest, job,
                [&](int x, int y, std::span<const Point> points, double side, CellSample* samples) {
                    const Counts before = batches.counts;
                    batches.trace_points(x, y, kept->placed.scale, points, side, samples);
                    if (side > 0) batches.counts = before;  // a check is no part of the picture
                },
                [&](int moment, std::span<const LensRay> rays, std::span<LensLight> light, bool check) {
                    batches.trace_nets(moment, rays, light, check, place);
                },
                spots, batches.layers);
        };
        const auto way = pass.picture.by_nets() ? RayPlaces::nets : RayPlaces::cells;
        return each(job, pass.picture.tiles(), pass.picture.contrast(), refine, 0, way);
    }

    /// Calls work(batches, tile, thread) for the tiles of a lattice, on all threads. Footprints have this side.
    Counts each_tile(const Job& job, const Lattice& lattice, int side, double noticed, const Work<Lattice>& work,
                     double footprint = 0, RayPlaces way = RayPlaces::single) {
        const int columns = (lattice.columns + side - 1) / side;
        const int tiles = columns * ((lattice.rows + side - 1) / side);
        const auto each_of = [&](Batches<T>& batches, int i, int thread) {
            const int x = i % columns * side, y = i / columns * side;
            work(batches,
                 Lattice{lattice.x + x * lattice.step_x, lattice.y + y * lattice.step_y,
                         std::min(side, lattice.columns - x), std::min(side, lattice.rows - y), lattice.step_x,
                         lattice.step_y},
                 thread);
        };
        return each(job, tiles, noticed, each_of, footprint, way);
    }

    /// Calls work(batches, i, thread) for 0 <= i < tiles, on all threads. If footprints have a side, patterns are
    /// averaged over them roughly; for cells as well as is known, over footprints with sides of their own.
    Counts each(const Job& job, int tiles, double noticed, const Work<int>& work, double side = 0,
                RayPlaces way = RayPlaces::single) {
        const bool means = way == RayPlaces::cells;
        ThreadPool& pool = job.pool;
        while (static_cast<int>(workspaces.size()) < pool.size())
            workspaces.push_back(std::make_unique<Workspace<T>>());

        // Kept with the world: to look at thousands of materials takes longer than to trace some pixels.
        KeptWorld& own = *kept;
        if (!own.bound || own.bound->depth != job.view.depth) own.bound = bound_for(scene(), job.view.depth);
        if (!own.known || own.known->camera != job.view.camera) own.known = eye_of_camera(job.view.camera, *own.built);
        ReadyView now;
        make_ready(now, job.view, own.built, *own.known, *own.bound, way == RayPlaces::nets);
        World<T>& world = now.world;
        own.traced_pixels += std::int64_t(tiles) * lattice_tile * lattice_tile;
        if (!own.light_buffers && LightBuffers<T>::pay(world, own.traced_pixels, job.view.prove))
            own.light_buffers = std::make_unique<LightBuffers<T>>(world, pool, job.view.prove);
        if (own.light_buffers) world.light_buffers = own.light_buffers->buffers();
        if (means) world.patterns.mip_maps = images->mip_maps();
        world.patterns.quick = side > 0;
        const bool filters =
            side > 0 ? world.patterns.has_quick_means : means && (world.patterns.list || world.patterns.sky);
        now.limits.noticed = static_cast<T>(noticed);
        if (job.view.prove) now.limits.slack = slack_for(now.view, world, own.bound->gain);
        const bool in_time_too = way != RayPlaces::single && job.view.moments;
        if (in_time_too) prepare_moments(job);
        const auto set_limits = [&](ReadyView& ready) {
            ready.limits.queue = std::min(job.queue, batch_rays), ready.limits.stop = job.stop;
        };
        set_limits(now);
        std::ranges::for_each(own.moments, set_limits);
        const std::shared_ptr<const LayerTables> tables = job.view.layers.any() ? layer_tables() : nullptr;
        std::atomic<int> next{0};
        std::vector<Counts> counts(pool.size());
        const auto take = [&](int thread) {
            Workspace<T>& workspace = *workspaces[thread];
            const auto eye_in = [&](const ReadyView& ready) {
                Eye<T> eye = ready.eye;
                int list = 0;
                for (const int body : ready.bodies) list = push(workspace.mediums, list, body);
                eye.medium = static_cast<T>(list);
                return eye;
            };
            const Eye<T> eye = eye_in(now);
            const bool prove = job.view.prove;
            std::optional<LayerTile> layered;
            if (tables) layered.emplace(job.view.layers, tables);
            LayerTile* const layers = layered ? &*layered : nullptr;
            Batches<T> batches(world, prove ? proving : kernel, eye, now.limits, workspace, prove, filters, side,
                               own.placed, layers);
            std::vector<Eye<T>> eyes;
            std::vector<Batches<T>> others;
            eyes.reserve(own.moments.size()), others.reserve(own.moments.size());
            if (in_time_too)
                for (const ReadyView& ready : own.moments) {
                    eyes.push_back(eye_in(ready));
                    others.emplace_back(ready.world, kernel, eyes.back(), ready.limits, workspace, false, false, 0,
                                        own.placed, layers);
                }
            batches.moments = others;
            batches.halves = halves_of(job.view);
            for (int i; !now.limits.stopped() && (i = next++) < tiles;) work(batches, i, thread);
            counts[thread] = batches.counts;
            for (const Batches<T>& other : others) counts[thread] += other.counts;
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

    std::shared_ptr<BuiltWorld<T>> build(const Placement& placed, bool proves, ThreadPool& pool,
                                         MovingHierarchy* hierarchy, const SharedMeshes<T>* shared) {
        return std::make_shared<BuiltWorld<T>>(scene(), placed, pool, in_time.moves() ? hierarchy : nullptr, images,
                                               proves, kernel.lanes, shared);
    }

    /// Makes a view of the scene as it is now ready, if there are nets with rays all over a lens.
    void make_ready(ReadyView& ready, const View& view, std::shared_ptr<const BuiltWorld<T>> world, const KnownEye& eye,
                    const Bound& light, bool nets) {
        ready.view = view, ready.view.camera.position = eye.eye;
        ready.built = std::move(world), ready.bodies = eye.bodies;
        for (const double most : light.brightest) ready.brightest.push_back(upper<T>(most));
        ready.eye = eye_of<T>(ready.view, kept->placed);
        if ((nets && has_lens(view.camera)) || !in_perspective(view.camera))
            ready.rays.emplace(scene(), ready.view, *ready.built, kept->placed);
        if (ready.rays) ready.eye.rays = &*ready.rays;
        ready.world = ready.built->world(), ready.world.eye = ready.eye.position;
        ready.limits = {{.depth = view.depth,
                         .generations = static_cast<int>(light.brightest.size()) - 1,
                         .error = static_cast<T>(view.error),
                         .brightest = ready.brightest.data(),
                         .brightest_limit = upper<T>(light.limit)}};
    }

    /// Makes the moments of a view ready, and behind them its time, unless they are. What does not change from one to
    /// the next is shared.
    void prepare_moments(const Job& job) {
        const View& view = job.view;
        if (!kept->moments.empty() && kept->moments_of == view) return;
        kept->moments.clear(), spots.begin(view.moments->size());
        // The system may promise more than it has, and end the program when the worlds fill it.
        constexpr double bytes_of_surface = 220;  // in a world: of a triangle, measured
        const double bytes_of_world = in_time.moves() ? bytes_of_surface * double(surfaces_apart(scene())) : 0;
        std::shared_ptr<const BuiltWorld<T>> world = kept->built;
        Bound light = *kept->bound;
        const auto add = [&](const Shot& moment) {
            using Changed = SceneInTime::Changed;
            const Changed changed = in_time.change(moment.time, view.tracks, job.pool);
            if (changed == Changed::places_of_lights)
                world = std::make_shared<const BuiltWorld<T>>(world, scene(), kept->placed);
            if (changed == Changed::more) {
                if (bytes_of_world > os::available_memory()) throw std::bad_alloc();
                meshes.add(scene(), job.pool, kernel.lanes);
                const auto own = build(kept->placed, kept->proves, job.pool, &moving_moments, &meshes);
                own->share(*world);
                world = own;
            }
            if (changed != Changed::nothing) light = bound_for(scene(), view.depth);
            View own = view;
            own.camera = moment.camera, own.time = moment.time;
            make_ready(kept->moments.emplace_back(), own, world, eye_of_camera(own.camera, *world), light, true);
            spots.add(scene(), own);
        };
        for (const Shot& moment : *view.moments)
            if (!job.stopped()) add(moment);
        in_time.set(view.time, view.tracks, job.pool);
        if (job.stopped()) return kept->moments.clear();
        make_ready(kept->moments.emplace_back(), view, kept->built, *kept->known, *kept->bound, true);
        kept->moments_of = spots_of = view;
    }

    KnownEye eye_of_camera(const Camera& camera, const BuiltWorld<T>& world) const {
        constexpr std::size_t most = 1000;  // bodies; among more it would take too long for each picture of a film
        const bool looks = scene().primitives.size() <= most;
        // The distance is a share of the camera's own coordinates, so that it fits any unit of length.
        const double reach = 1e-12 * length(camera.position) + 1e-16 * length(camera.look_at - camera.position);
        constexpr double rounding = 16. * std::numeric_limits<T>::epsilon();
        const DVec3 eye = looks ? off_faces(scene(), camera, reach, rounding) : camera.position;
        return {camera, eye, world.bodies_around(eye)};
    }

    Slack<T> slack_for(const View& view, const World<T>& world, double gain) {
        Slack<T> all;
        if constexpr (!std::is_same_v<T, float>) {
            std::optional<Slack<T>>& slack = kept->slack;
            if (!slack) {
                slack = slack_of<T>(scene(), kept->placed);
                if (kept->built->lacks_items(scene()))
                    slack->share = slack->turn = slack->plane = slack->culled = HUGE_VAL;
            }
            all = *slack;
            add_eye(all, view, kept->placed);
        }
        all.medium = !world.nested || knows_medium(scene(), view.camera.position);
        all.gain = static_cast<T>(gain);
        all.reach = static_cast<T>(kept->built->reach());
        return all;
    }

    std::shared_ptr<const LayerTables> layer_tables() const {
        auto tables = std::make_shared<LayerTables>();
        const auto declared_as = [](const std::vector<int>& all, std::size_t i) {
            return i < all.size() ? all[i] : static_cast<int>(i);
        };
        for (const int primitive : primitives_of_surfaces(scene()))
            tables->bodies.push_back(declared_as(declared.bodies, static_cast<std::size_t>(primitive)));
        for (const int material : kept->built->materials())
            tables->materials.push_back(declared_as(declared.materials, static_cast<std::size_t>(material)));
        for (std::size_t i = 0; i < scene().lights.size(); ++i)
            tables->lights.insert(tables->lights.end(), points_of(scene().lights[i]), static_cast<int>(i));
        return tables;
    }

    Extent extent;                                // of the scene as it is now
    std::shared_ptr<const CapsuleTree> capsules;  // of it, made when first needed
    std::optional<KeptWorld> kept;
    MovingHierarchy moving, moving_moments;
    SharedMeshes<T> meshes;  // which the worlds of a shutter's moments share
    const std::shared_ptr<Images> images = std::make_shared<Images>();
    Kernel<T> kernel, proving;  // none of float proves
    BrightSpots spots;          // of the moments of a shutter, or through a lens
    View spots_of;
    std::vector<std::unique_ptr<Workspace<T>>> workspaces;
    std::vector<LatticeCells> lattice_cells;  // one for each thread
};

std::unique_ptr<AnyTracer> tracer_of(Scene&& scene, Precision precision, Simd simd) {
    switch (precision) {
        case Precision::float32:
            return std::make_unique<TracerOf<float>>(std::move(scene), precision, simd);
        case Precision::float64:
            return std::make_unique<TracerOf<double>>(std::move(scene), precision, simd);
        default:
            return std::make_unique<TracerOf<long double>>(std::move(scene), precision, simd);
    }
}

}  // namespace

Tracer::Tracer(Scene scene, Precision precision, Simd simd) {
    if (simd == Simd::automatic) simd = best_simd();
    if (precision == Precision::extended) simd = Simd::scalar;
    assert(supported(simd));
    own = tracer_of(std::move(scene), precision, simd);
}
Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;
const Scene& Tracer::scene() const { return own->scene(); }
const Scene& Tracer::declared() const { return own->in_time.declared(); }
Precision Tracer::precision() const { return own->precision; }
Simd Tracer::simd() const { return own->simd; }
void Tracer::prepare(const View& view, ThreadPool& pool) { own->prepare(view, pool); }

Counts Tracer::trace(const Job& job, const TracedPixels& pixels) {
    assert(job.view.depth >= 1 && job.view.width > 0 && job.view.height > 0);
    return own->trace(job, pixels);
}

std::vector<double> values_of(Tracer& tracer, const View& view, const Lattice& lattice, ThreadPool& pool,
                              const Sampling& sampling, const std::atomic<bool>* stop) {
    std::vector<double> values(std::size_t(3) * lattice.columns * lattice.rows);
    const auto keep = [&](const Tile& tile) { place(tile, lattice, values); };
    tracer.trace({view, pool, keep, stop}, SampledRegion{lattice, sampling});
    return values;
}

Frame render(const Scene& scene, const View& view, Precision precision, int threads, Simd simd) {
    ThreadPool pool(threads);
    Tracer tracer(scene, precision, simd);
    return {view.width, view.height, values_of(tracer, view, {.columns = view.width, .rows = view.height}, pool)};
}

}  // namespace strahl
