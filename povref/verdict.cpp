#include "povref/verdict.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "image/transfer.h"
#include "trace/thread_pool.h"

namespace strahl {
namespace {

using Sample = std::array<double, 3>;
constexpr double step = 1. / 65535;

double apart(const Sample& a, const Sample& b) {
    return std::max({std::fabs(a[0] - b[0]), std::fabs(a[1] - b[1]), std::fabs(a[2] - b[2])});
}

/// The picture along a line through a pixel's sampling point; positions in pixels.
struct Line {
    Tracer& tracer;
    const View& view;
    ThreadPool& pool;
    int x, y;
    double dx, dy;

    Sample at(double t) const {
        View moved = view;
        moved.shift_x += t * dx;
        moved.shift_y += t * dy;
        Sample value{};
        tracer.trace(moved, {.x = x, .y = y, .columns = 1, .rows = 1}, pool, [&](const Tile& tile) {
            std::visit([&](const auto& rgb) { std::copy_n(rgb.begin(), 3, value.begin()); }, tile.rgb);
        });
        for (double& v : value) v = std::clamp(v, 0., 1.);
        return value;
    }
    /// What varies smoothly becomes less than a step when looked at closely; a jump does not.
    bool jumps(double a, const Sample& at_a, double b, const Sample& at_b) const {
        if (apart(at_a, at_b) <= step) return false;
        if (b - a < 1e-5 * edge_radius) return true;
        const double middle = (a + b) / 2;
        const Sample at_middle = at(middle);
        return jumps(a, at_a, middle, at_middle) || jumps(middle, at_middle, b, at_b);
    }
};

int steps_apart(double ours, double theirs) {
    return std::abs(int(quantise(ours, false, 65535)) - int(quantise(theirs, false, 65535)));
}

}  // namespace

bool on_edge(Tracer& tracer, const View& view, ThreadPool& pool, int x, int y) {
    constexpr int spokes = 8;
    const Sample middle = Line{tracer, view, pool, x, y, 0, 0}.at(0);
    for (int i = 0; i < spokes; ++i) {
        const double angle = 2 * std::numbers::pi / spokes * i;
        const Line line{tracer, view, pool, x, y, std::cos(angle), std::sin(angle)};
        if (line.jumps(0, middle, edge_radius, line.at(edge_radius))) return true;
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
