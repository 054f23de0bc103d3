#include "povref/compare/verdict.h"

#include <algorithm>
#include <cmath>

#include "image/transfer.h"
#include "num/thread_pool.h"
#include "povref/compare/run_povray.h"
#include "trace/measure/edge_pixels.h"

namespace strahl {
namespace {

int steps_apart(double ours, double theirs) {
    return std::abs(int(quantise(ours, false, 65535)) - int(quantise(theirs, false, 65535)));
}

}  // namespace

Verdict judge(Tracer& tracer, const View& view, const Frame& ours, const Picture& theirs,
              const std::atomic<bool>* stop) {
    if (theirs.width != ours.width || theirs.height != ours.height || theirs.channels < 3)
        throw FileError("POV-Ray's picture has another size");
    ThreadPool alone(1);
    Verdict verdict{.pixels = std::size_t(ours.width) * ours.height};
    for (std::size_t i = 0; i < verdict.pixels; ++i) {
        int apart = 0;
        for (int c = 0; c < 3; ++c)
            apart = std::max(apart, steps_apart(ours.rgb[3 * i + c], theirs.values[theirs.channels * i + c]));
        const int x = int(i % ours.width), y = int(i / ours.width);
        const bool decided = verdict.beyond_off_edges * 50 >= verdict.pixels;
        if (apart > 1 && !decided && on_edge(tracer, view, alone, x, y, edge_radius, 1. / 65535, stop)) {
            ++verdict.beyond_on_edges;
            continue;
        }
        if (stop && *stop) throw Stopped{};
        if (apart > 1) {
            ++verdict.beyond_off_edges;
            verdict.places.push_back({x, y});
            if (decided) continue;
            if (apart > verdict.worst_off_edges) verdict.x = x, verdict.y = y;
        }
        verdict.worst_off_edges = std::max(verdict.worst_off_edges, apart);
    }
    return verdict;
}

}  // namespace strahl
