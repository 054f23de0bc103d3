#include "trace/tracer.h"

#include <cassert>

#include "trace/cells/cell_picture.h"
#include "trace/tracer_of.h"

namespace strahl {

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
const Scene& Tracer::scene() const { return implementation->tracer->scene(); }
void Tracer::prepare(const View& view, ThreadPool& pool) { implementation->tracer->prepare(view, pool); }
Precision Tracer::precision() const { return implementation->precision; }
Simd Tracer::simd() const { return implementation->simd; }

Counts Tracer::trace(const View& view, const Lattice& lattice, ThreadPool& pool, const Sink& sink,
                     const std::atomic<bool>* stop) {
    assert(view.depth >= 1 && view.width > 0 && view.height > 0);
    return implementation->tracer->trace(view, lattice, pool, sink, stop);
}

Counts Tracer::trace(const View& view, std::span<const Pixel> pixels, ThreadPool& pool, const Sink& sink,
                     const std::atomic<bool>* stop) {
    return implementation->tracer->trace_pixels(view, pixels, pool, sink, stop);
}

Counts Tracer::trace_filled(const View& view, const Lattice& lattice, double contrast, ThreadPool& pool,
                            const Sink& sink, const std::atomic<bool>* stop) {
    return implementation->tracer->trace_filled(view, lattice, contrast, pool, sink, stop);
}

Counts Tracer::trace(const View& view, const Sampling& sampling, const Lattice& region, ThreadPool& pool,
                     const Sink& sink, const std::atomic<bool>* stop) {
    if (sampling.grid == 1 && !sampling.centre) return trace(view, region, pool, sink, stop);
    if (sampling.grid > 0) return implementation->tracer->trace_grids(view, sampling, region, pool, sink, stop);
    prepare(view, pool);
    CellPicture picture(scene(), view, region, sampling.error);
    return trace(view, picture, 0, pool, sink, stop);
}

Counts Tracer::trace(const View& view, CellPicture& picture, int finest, ThreadPool& pool, const Sink& sink,
                     const std::atomic<bool>* stop) {
    return implementation->tracer->trace_cells(view, picture, finest, pool, sink, stop);
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
