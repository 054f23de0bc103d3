#include "trace/measure/edge_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>
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
    /// Returns whether the picture jumps within `radius`: smooth differences fall below a step when halved again and
    /// again, jumps do not. What keeps its difference is halved first, so that a jump is found where the picture
    /// changes up to some hundred times as much beside it, and a steep slope ends after `most_halved` samples.
    bool jumps(const Sample& middle) const {
        constexpr int most_halved = 250;
        struct Halving {
            double rank, a, b;
            Sample at_a, at_b;
            bool operator<(const Halving& other) const { return rank < other.rank; }
        };
        std::priority_queue<Halving> halvings;
        const auto add = [&](double a, const Sample& at_a, double b, const Sample& at_b) {
            const double difference = apart(at_a, at_b);
            // Halves of a slope have ranks of 3/4, the half with a jump 3/2.
            if (difference > step)
                halvings.push({difference * std::pow(radius / (b - a), std::log2(1.5)), a, b, at_a, at_b});
        };
        add(0, middle, radius, at(radius));
        for (int i = 0; i < most_halved && !halvings.empty() && !(stop && *stop); ++i) {
            const Halving own = halvings.top();
            halvings.pop();
            if (own.b - own.a < 1e-5 * radius) return true;
            const double half = (own.a + own.b) / 2;
            const Sample at_half = at(half);
            add(own.a, own.at_a, half, at_half);
            add(half, at_half, own.b, own.at_b);
        }
        return false;
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
        if (line.jumps(middle)) return true;
    }
    return false;
}

}  // namespace strahl
