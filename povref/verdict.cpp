#include "povref/verdict.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "image/transfer.h"
#include "trace/thread_pool.h"

namespace strahl {
namespace {

using Sample = std::array<double, 3>;

/// What the picture shows at the pixel's sampling point, moved by (dx, dy) pixels.
Sample sample(Tracer& tracer, View view, ThreadPool& pool, int x, int y, double dx, double dy) {
    view.shift_x += dx;
    view.shift_y += dy;
    Sample value{};
    tracer.trace(view, {.x = x, .y = y, .columns = 1, .rows = 1}, pool, [&](const Tile& tile) {
        std::visit([&](const auto& rgb) { std::copy_n(rgb.begin(), 3, value.begin()); }, tile.rgb);
    });
    for (double& v : value) v = std::clamp(v, 0., 1.);
    return value;
}

int steps_apart(double ours, double theirs) {
    return std::abs(int(quantise(ours, false, 65535)) - int(quantise(theirs, false, 65535)));
}

}  // namespace

bool on_edge(Tracer& tracer, const View& view, ThreadPool& pool, int x, int y) {
    constexpr double ring = 0.01, diagonal = ring * 0.70710678118654752, least_jump = 1. / 65535;
    const Sample middle = sample(tracer, view, pool, x, y, 0, 0);
    const std::array<std::array<double, 2>, 4> directions{
        {{ring, 0}, {0, ring}, {diagonal, diagonal}, {diagonal, -diagonal}}};
    for (const auto& [dx, dy] : directions) {
        const Sample there = sample(tracer, view, pool, x, y, dx, dy);
        const Sample opposite = sample(tracer, view, pool, x, y, -dx, -dy);
        for (int c = 0; c < 3; ++c)
            if (std::fabs(there[c] + opposite[c] - 2 * middle[c]) > least_jump) return true;
    }
    return false;
}

Verdict judge(Tracer& tracer, const View& view, const Frame& ours, const Picture& theirs) {
    if (theirs.width != ours.width || theirs.height != ours.height || theirs.channels < 3)
        throw FileError("POV-Ray's picture has another size");
    ThreadPool alone(1);
    Verdict verdict{.pixels = std::size_t(ours.width) * ours.height};
    for (std::size_t i = 0; i < verdict.pixels; ++i) {
        int apart = 0;
        for (int c = 0; c < 3; ++c)
            apart = std::max(apart, steps_apart(ours.rgb[3 * i + c], theirs.values[theirs.channels * i + c]));
        const int x = int(i % ours.width), y = int(i / ours.width);
        if (apart > 1 && on_edge(tracer, view, alone, x, y)) {
            ++verdict.beyond_on_edges;
            continue;
        }
        if (apart > 1) {
            ++verdict.beyond_off_edges;
            if (apart > verdict.worst_off_edges) verdict.x = x, verdict.y = y;
        }
        verdict.worst_off_edges = std::max(verdict.worst_off_edges, apart);
    }
    return verdict;
}

}  // namespace strahl
