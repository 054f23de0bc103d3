#include "trace/tracer.h"

#include <array>
#include <cassert>
#include <cmath>

#include "trace/bound.h"
#include "trace/build.h"
#include "trace/kernel.h"
#include "trace/thread_pool.h"
#include "trace/workspace.h"

namespace strahl {
namespace {

constexpr int tile_size = 16;

/// Pixels of a tile along a Z curve: packs are blocks of 4x4 or 4x2 pixels, whose rays have more in common than a
/// row's.
struct Spot {
    std::uint8_t x, y;
};
constexpr std::array<Spot, tile_size* tile_size> z_curve = [] {
    std::array<Spot, tile_size * tile_size> spots{};
    for (std::size_t i = 0; i < spots.size(); ++i)
        for (int bit = 0; bit < 4; ++bit) {
            spots[i].x |= (i >> 2 * bit & 1) << bit;
            spots[i].y |= (i >> (2 * bit + 1) & 1) << bit;
        }
    return spots;
}();

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

/// One thread's way through a tile: as many pixels at once as fit.
template <class T>
void trace_tile(const World<T>& world, const Kernel<T>& kernel, const Eye<T>& eye, const Limits<T>& limits,
                const Lattice& tile, Workspace<T>& workspace, Counts& counts) {
    const int pixels = tile.columns * tile.rows;
    std::fill(workspace.sums.begin(), workspace.sums.end(), PixelSum<T>{});
    std::fill(workspace.past.begin(), workspace.past.end(), T(0));
    int filled = 0;
    for (const auto [x, y] : z_curve) {
        if (x >= tile.columns || y >= tile.rows) continue;
        workspace.pixels_x[filled] = static_cast<T>(tile.x + x * tile.step_x);
        workspace.pixels_y[filled] = static_cast<T>(tile.y + y * tile.step_y);
        workspace.order[y * tile.columns + x] = filled++;
    }
    for (int done = 0; done < pixels;) {
        const int count = std::min(workspace.batch, pixels - done);
        const PixelBatch<T> batch{workspace.pixels_x.data() + done, workspace.pixels_y.data() + done,
                                  workspace.sums.data() + done, workspace.past.data() + done, count};
        if (kernel.trace(world, eye, limits, batch, workspace, counts)) {
            done += count;
            workspace.batch = std::min(batch_pixels, 2 * workspace.batch);
        } else {
            std::fill_n(batch.sums, count, PixelSum<T>{});
            std::fill_n(batch.past, count, T(0));
            workspace.batch = std::max(1, count / 2);
        }
    }
    for (int i = 0; i < pixels; ++i) {
        counts.dropped = std::max(counts.dropped, double(workspace.sums[i].pruned));
        counts.past = std::max(counts.past, double(workspace.past[i]));
    }
}

template <class T>
void deliver(const Workspace<T>& workspace, const Lattice& tile, const Sink& sink) {
    using Out = std::conditional_t<std::is_same_v<T, float>, float, double>;
    static_assert(tile_size * tile_size <= batch_pixels);
    constexpr auto most = static_cast<T>(std::numeric_limits<Out>::max());
    Out values[3 * tile_size * tile_size + 1];
    const int pixels = tile.columns * tile.rows;
    static_assert(sizeof(PixelSum<T>) == 4 * sizeof(T));
    const T* const sums = workspace.sums[0].rgb;
    for (int i = 0; i < pixels; ++i)
        for (int c = 0; c < 4; ++c)  // four at once are faster than three; the next pixel covers the last
            values[3 * i + c] = static_cast<Out>(std::min(sums[4 * workspace.order[i] + c], most));
    sink({tile, std::span<const Out>(values, 3 * pixels)});
}

/// A tracer of one precision.
struct AnyTracer {
    explicit AnyTracer(Scene&& own) : scene(std::move(own)) {}
    virtual ~AnyTracer() = default;
    virtual void prepare(const Camera&, ThreadPool&) = 0;
    virtual Counts trace(const View&, const Lattice&, ThreadPool&, const Sink&, const std::atomic<bool>*) = 0;
    const Scene scene;
};

template <class T>
class TracerOf : public AnyTracer {
  public:
    TracerOf(Scene&& own, Simd simd)
        : AnyTracer(std::move(own)), extent(extent_of(scene)), kernel(kernel_for<T>(simd)) {}

    void prepare(const Camera& camera, ThreadPool& pool) override {
        const Placement wanted = placement(extent, camera.position);
        if (built && wanted == placed) return;
        built.reset();
        built = std::make_unique<BuiltWorld<T>>(scene, wanted, pool);
        placed = wanted;
    }

    Counts trace(const View& view, const Lattice& lattice, ThreadPool& pool, const Sink& sink,
                 const std::atomic<bool>* stop) override {
        prepare(view.camera, pool);
        while (static_cast<int>(workspaces.size()) < pool.size())
            workspaces.push_back(std::make_unique<Workspace<T>>());

        const Bound bound = bound_for(scene, view.depth);
        std::vector<T> brightest;
        for (const double most : bound.brightest) brightest.push_back(upper<T>(most));
        const Eye<T> eye = eye_of<T>(view, placed);
        World<T> world = built->world();
        world.eye = eye.position;
        const Limits<T> limits{.depth = view.depth,
                               .error = static_cast<T>(view.error),
                               .brightest = brightest.data(),
                               .brightest_limit = upper<T>(bound.limit),
                               .stop = stop};
        const std::vector<int> around = built->bodies_around(view.camera.position);
        const int columns = (lattice.columns + tile_size - 1) / tile_size;
        const int tiles = columns * ((lattice.rows + tile_size - 1) / tile_size);
        std::atomic<int> next{0};
        std::vector<Counts> counts(pool.size());
        const auto work = [&](int thread) {
            Workspace<T>& workspace = *workspaces[thread];
            Eye<T> own = eye;
            Counts counted;  // its own memory: threads that count beside each other wait for each other
            int list = 0;
            for (const int body : around) list = push(workspace.mediums, list, body);
            own.medium = static_cast<T>(list);
            for (int i; !limits.stopped() && (i = next++) < tiles;) {
                const int x = i % columns * tile_size, y = i / columns * tile_size;
                const Lattice tile{lattice.x + x * lattice.step_x,
                                   lattice.y + y * lattice.step_y,
                                   std::min(tile_size, lattice.columns - x),
                                   std::min(tile_size, lattice.rows - y),
                                   lattice.step_x,
                                   lattice.step_y};
                trace_tile(world, kernel, own, limits, tile, workspace, counted);
                if (!limits.stopped()) deliver(workspace, tile, sink);
            }
            counts[thread] = counted;
        };
        pool.run([&](int thread) {
            try {
                work(thread);
            } catch (...) {
                next = tiles;  // the other threads need not go on
                throw;
            }
        });
        Counts sum;
        for (const Counts& c : counts) sum += c;
        return sum;
    }

  private:
    Extent extent;
    Kernel<T> kernel;
    Placement placed;
    std::unique_ptr<BuiltWorld<T>> built;
    std::vector<std::unique_ptr<Workspace<T>>> workspaces;
};

}  // namespace

void check_capacity(const Scene& scene, Precision precision) {
    if (precision == Precision::float32) check_capacity<float>(surfaces_of(scene));
}

struct Tracer::Implementation {
    Precision precision;
    Simd simd;
    std::unique_ptr<AnyTracer> tracer;
};

Tracer::Tracer(Scene scene, Precision precision, Simd simd) {
    if (simd == Simd::automatic) simd = best_simd();
    if (precision == Precision::extended) simd = Simd::scalar;
    assert(supported(simd));
    std::unique_ptr<AnyTracer> tracer;
    switch (precision) {
        case Precision::float32:
            tracer = std::make_unique<TracerOf<float>>(std::move(scene), simd);
            break;
        case Precision::float64:
            tracer = std::make_unique<TracerOf<double>>(std::move(scene), simd);
            break;
        case Precision::extended:
            tracer = std::make_unique<TracerOf<long double>>(std::move(scene), simd);
            break;
    }
    implementation = std::make_unique<Implementation>(Implementation{precision, simd, std::move(tracer)});
}
Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;
const Scene& Tracer::scene() const { return implementation->tracer->scene; }
void Tracer::prepare(const Camera& camera, ThreadPool& pool) { implementation->tracer->prepare(camera, pool); }
Precision Tracer::precision() const { return implementation->precision; }
Simd Tracer::simd() const { return implementation->simd; }

Counts Tracer::trace(const View& view, const Lattice& lattice, ThreadPool& pool, const Sink& sink,
                     const std::atomic<bool>* stop) {
    assert(view.depth >= 1 && view.width > 0 && view.height > 0);
    return implementation->tracer->trace(view, lattice, pool, sink, stop);
}

Counts& Counts::operator+=(const Counts& other) {
    camera += other.camera, reflected += other.reflected, refracted += other.refracted, shadow += other.shadow;
    depth = std::max(depth, other.depth);
    dropped = std::max(dropped, other.dropped), past = std::max(past, other.past);
    return *this;
}

Frame render(const Scene& scene, const View& view, Precision precision, int threads, Simd simd) {
    Frame frame{view.width, view.height, std::vector<double>(3 * std::size_t(view.width) * view.height)};
    ThreadPool pool(threads);
    Tracer tracer(scene, precision, simd);
    const Lattice whole{.columns = view.width, .rows = view.height};
    tracer.trace(view, whole, pool, [&](const Tile& tile) { place(tile, whole, frame.rgb); });
    return frame;
}

}  // namespace strahl
