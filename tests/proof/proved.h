// Pictures with bounds.
#pragma once
#include <cstdlib>
#include <vector>

#include "num/thread_pool.h"
#include "scene/scene.h"
#include "trace/tracer.h"

namespace strahl::proof {

/// A picture with a bound for each pixel.
struct Proved {
    std::vector<double> rgb, bounds;
    double pruned = 0;  // the most that is left out of a pixel
};
inline Proved prove(const Scene& scene, View view, Precision precision = Precision::float64) {
    view.prove = true;
    Proved proved{std::vector<double>(3 * std::size_t(view.width) * view.height),
                  std::vector<double>(std::size_t(view.width) * view.height)};
    ThreadPool pool(1);
    Tracer tracer(scene, precision, std::getenv("PROOF_SCALAR") ? Simd::scalar : Simd::automatic);
    const Lattice whole{.columns = view.width, .rows = view.height};
    const auto keep = [&](const Tile& tile) {
        place(tile, whole, proved.rgb);
        const Lattice& own = tile.lattice;
        for (int i = 0; i < own.columns * own.rows; ++i)
            proved.bounds[std::size_t(own.y + i / own.columns) * view.width + own.x + i % own.columns] = tile.bounds[i];
    };
    const Counts counts = tracer.trace({view, pool, keep}, whole);
    proved.pruned = counts.dropped;
    return proved;
}
inline View view_of(const Scene& scene, int width, int height) {
    return {.camera = scene.camera, .width = width, .height = height, .depth = scene.settings.max_trace_level};
}

}  // namespace strahl::proof
