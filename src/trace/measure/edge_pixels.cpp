#include "trace/measure/edge_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "num/thread_pool.h"

namespace strahl {
namespace {

using Sample = std::array<double, 3>;

double apart(const Sample& a, const Sample& b) {
    return std::max({std::fabs(a[0] - b[0]), std::fabs(a[1] - b[1]), std::fabs(a[2] - b[2])});
}

/// The picture along a line through a pixel's sampling point; positions in pixels.
struct Line {
    Tracer& tracer;
    const View& view;
    ThreadPool& pool;
    int x, y;
    double radius, step;
    const std::atomic<bool>* stop;
    double dx, dy;

    Sample at(double t) const {
        View moved = view;
        moved.shift_x += t * dx;
        moved.shift_y += t * dy;
        const Lattice pixel{.x = x, .y = y, .columns = 1, .rows = 1};
        const std::vector<double> value = values_of(tracer, moved, pixel, pool, {.grid = 1}, stop);
        return {std::clamp(value[0], 0., 1.), std::clamp(value[1], 0., 1.), std::clamp(value[2], 0., 1.)};
    }
    /// Returns whether the picture jumps between a and b: smooth differences fall below a step when halved again and
    /// again, jumps do not.
    bool jumps(double a, const Sample& at_a, double b, const Sample& at_b) const {
        if (apart(at_a, at_b) <= step || (stop && *stop)) return false;
        if (b - a < 1e-5 * radius) return true;
        const double middle = (a + b) / 2;
        const Sample at_middle = at(middle);
        return jumps(a, at_a, middle, at_middle) || jumps(middle, at_middle, b, at_b);
    }
};

}  // namespace

bool on_edge(Tracer& tracer, const View& view, ThreadPool& pool, int x, int y, double radius, double step,
             const std::atomic<bool>* stop) {
    constexpr int spokes = 8;
    const Sample middle = Line{tracer, view, pool, x, y, radius, step, stop, 0, 0}.at(0);
    for (int i = 0; i < spokes; ++i) {
        const double angle = 2 * std::numbers::pi / spokes * i;
        const Line line{tracer, view, pool, x, y, radius, step, stop, std::cos(angle), std::sin(angle)};
        if (line.jumps(0, middle, radius, line.at(radius))) return true;
    }
    return false;
}

}  // namespace strahl
