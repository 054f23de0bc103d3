#include "trace/measure/picture_accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "num/thread_pool.h"
#include "trace/measure/edge_pixels.h"

namespace strahl {
namespace {

constexpr double safety = 16;                  // so many times the sample's largest rounding must be below the error
constexpr double least_jump = 1e-3;            // smaller differences are not taken for edges
constexpr double edge_radius = .1;             // pixels; in float edges are this wide where mirrors magnify
constexpr int few_edges = 4, many_edges = 64;  // pixels on edges that may differ: so many and one in so many

/// Pixels spread over the picture, about a thousand.
Lattice sample_of(const View& view) {
    const int step = std::max(1, static_cast<int>(std::sqrt(view.width * double(view.height) / 1024)));
    const int start = std::min({step / 2, view.width - 1, view.height - 1});
    return {start, start, (view.width - start + step - 1) / step, (view.height - start + step - 1) / step, step, step};
}

/// The largest difference between two precisions on the sample, off the edges; or the first found that is more than
/// enough.
struct Rounding {
    double most = 0;
    bool known = true;  // or so many pixels differ on edges that these are no edges of the picture
};

/// Compares a precision with the next one. If an eye is exactly on a surface, rounding decides in each pixel which side
/// of it is seen, and all of them look like edges.
Rounding rounding_of(Precision precision, Precision next, const Scene& scene, const View& view, double enough,
                     ThreadPool& pool, Simd simd) {
    const Lattice lattice = sample_of(view);
    Tracer coarse(scene, precision, simd), fine(scene, next, simd);
    const std::vector<double> a = values_of(coarse, view, lattice, pool), b = values_of(fine, view, lattice, pool);
    ThreadPool alone(1);  // a single pixel is not worth waking others for
    Rounding rounding;
    int edges = 0;
    for (int i = 0; i < lattice.columns * lattice.rows; ++i) {
        double off = 0;
        for (int c = 0; c < 3; ++c) off = std::max(off, std::abs(a[3 * i + c] - b[3 * i + c]));
        if (off <= rounding.most) continue;
        const int x = lattice.x + i % lattice.columns * lattice.step_x;
        const int y = lattice.y + i / lattice.columns * lattice.step_y;
        if (off > std::max(enough, least_jump) && on_edge(fine, view, alone, {x, y}, edge_radius, off / 4)) {
            rounding.known = ++edges <= few_edges + lattice.columns * lattice.rows / many_edges;
            if (!rounding.known) break;
            continue;
        }
        rounding.most = off;
        if (rounding.most > enough) break;
    }
    return rounding;
}

}  // namespace

Accuracy choose_accuracy(const Scene& scene, const View& view, double error, std::optional<Precision> precision,
                         std::optional<int> depth, ThreadPool& pool, Simd simd) {
    Accuracy choice{.precision = precision.value_or(Precision::float64),
                    .depth = depth.value_or(scene.settings.max_trace_level)};
    choice.dropped = error / 2;
    if (precision || error == 0) return choice;

    View sampled = view;
    sampled.depth = choice.depth, sampled.error = choice.dropped;
    const auto compare = [&](Precision own, Precision next) {
        return rounding_of(own, next, scene, sampled, error / safety, pool, simd);
    };
    choice.precision = Precision::float32;
    Rounding rounding = compare(choice.precision, Precision::float64);
    if (!rounding.known)
        choice.precision = Precision::float64, rounding = compare(choice.precision, Precision::extended);
    if (!rounding.known) choice.precision = Precision::extended;
    if (!rounding.known) return choice;
    choice.rounding = rounding.most;
    constexpr double ratio = std::numeric_limits<double>::epsilon() / std::numeric_limits<float>::epsilon();
    constexpr double extended_ratio =
        static_cast<double>(std::numeric_limits<long double>::epsilon() / std::numeric_limits<double>::epsilon());
    if (choice.precision == Precision::float32 && *choice.rounding > error / safety)
        choice.precision = Precision::float64, *choice.rounding *= ratio;
    if (*choice.rounding > error / safety) choice.precision = Precision::extended, *choice.rounding *= extended_ratio;
    return choice;
}

}  // namespace strahl
