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
    std::vector<Pixel> beyond;
    std::vector<int> differences;  // of these
    for (std::size_t i = 0; i < verdict.pixels; ++i) {
        int apart = 0;
        for (int c = 0; c < 3; ++c)
            apart = std::max(apart, steps_apart(ours.rgb[3 * i + c], theirs.values[theirs.channels * i + c]));
        if (apart > 1)
            beyond.push_back({int(i % ours.width), int(i / ours.width)}), differences.push_back(apart);
        else
            verdict.worst_off_edges = std::max(verdict.worst_off_edges, apart);
    }
    const auto decided = [&] { return verdict.beyond_off_edges * 50 >= verdict.pixels; };
    constexpr std::size_t together = 128;
    std::vector<bool> edges;
    for (std::size_t i = 0; i < beyond.size(); ++i) {
        if (i % together == 0 && !decided()) {
            const auto some = std::span(beyond).subspan(i, std::min(together, beyond.size() - i));
            edges = on_edges(tracer, view, alone, some, edge_radius, 1. / 65535, stop);
            if (stop && *stop) throw Stopped{};
        }
        if (!decided() && edges[i % together]) {
            ++verdict.beyond_on_edges;
            continue;
        }
        if (!decided() && differences[i] > verdict.worst_off_edges)
            verdict.worst_off_edges = differences[i], verdict.x = beyond[i].x, verdict.y = beyond[i].y;
        ++verdict.beyond_off_edges;
        verdict.places.push_back({beyond[i].x, beyond[i].y});
    }
    return verdict;
}

}  // namespace strahl
