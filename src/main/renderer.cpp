#include "main/renderer.h"

#include <atomic>
#include <iostream>
#include <utility>

#include "image/transfer.h"
#include "main/progress.h"
#include "text/utf8.h"
#include "trace/cell_picture.h"

namespace strahl {

Renderer::Renderer(const RenderOptions& o, Scene scene, const Shot& first, const Lattice& own_part,
                   FileFormat own_format, Stats& sums)
    : options(o),
      format(own_format),
      part(own_part),
      stats(sums),
      pool(o.threads),
      accuracy(choose(scene, first)),
      tracer(std::move(scene), accuracy.precision, o.simd) {
    stats.accuracy = accuracy;
    stats.threads = pool.size();
    stats.simd = tracer.simd();
    stats.lanes = lanes(tracer.precision(), tracer.simd());
    stats.build_seconds = watch.lap();
}

bool Renderer::render(const Shot& shot, const std::string& path, const std::string& ending, const std::string& label) {
    PictureWriter writer(part.columns, part.rows, 3, ending, format);
    watch.lap();
    tracer.prepare(view(shot, accuracy.depth, accuracy.dropped), pool);
    stats.build_seconds += watch.lap();
    const std::uint64_t done = trace(shot, writer, label);
    stats.trace_seconds += watch.lap();
    if (done == 0) {
        std::cerr << "strahl: interrupted before anything of '" << printable(path) << "' was finished\n";
        return false;
    }
    const bool whole = done == pixels();
    const std::string file = whole || path == "-" ? path : before_ending(path, ".part");
    writer.write(file);
    stats.write_seconds += watch.lap();
    stats.frames += whole;
    if (!whole)
        std::cerr << "strahl: interrupted; the finished part (" << 100 * done / pixels() << " %) is in "
                  << (file == "-" ? "standard output" : std::string("'").append(printable(file)).append("'")) << '\n';
    return whole;
}

/// Without --error only light that the file can't show is pruned, and depth and precision are the defaults.
Accuracy Renderer::choose(const Scene& scene, const Shot& shot) {
    const double unseen = half_step(format);
    // The curve that encodes linear light enlarges errors where it is steep.
    const double steepest = format.linear && format.bits != 32 ? steepest_srgb : 1;
    if (!options.error) {
        stats.error = unseen * steepest;
        return {.precision = options.precision.value_or(Precision::float64),
                .depth = options.depth.value_or(scene.settings.max_trace_level),
                .dropped = unseen};
    }
    stats.error = *options.error;
    return choose_accuracy(scene, view(shot, 1, 0), *options.error / steepest, options.precision, options.depth, pool,
                           options.simd);
}

View Renderer::view(const Shot& shot, int depth, double dropped) const {
    return {.camera = shot.camera,
            .width = options.size.width,
            .height = options.size.height,
            .depth = depth,
            .error = dropped,
            .time = shot.time};
}

/// Returns the number of finished pixels.
std::uint64_t Renderer::trace(const Shot& shot, PictureWriter& writer, const std::string& label) {
    Progress progress(options.quiet, label);
    std::atomic<std::uint64_t> done = 0;
    const auto keep = [&](const Tile& tile) {
        const Lattice& own = tile.lattice;
        std::visit([&](auto rgb) { writer.put(own.x - part.x, own.y - part.y, own.columns, own.rows, rgb.data()); },
                   tile.rgb);
        const std::uint64_t size = std::uint64_t(own.columns) * own.rows;
        progress.advance(done.fetch_add(size) + size, pixels());
    };
    const View seen = view(shot, accuracy.depth, accuracy.dropped);
    if (stats.sampling.grid > 0) {
        stats.rays += tracer.trace(seen, stats.sampling, part, pool, keep, interrupt.flag());
    } else {
        CellPicture cells(tracer.scene(), seen, part, stats.sampling.error);
        stats.rays += tracer.trace(seen, cells, 0, pool, keep, interrupt.flag());
        stats.sampled += cells.sampled();
    }
    return done;
}

}  // namespace strahl
