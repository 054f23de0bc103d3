#include "trace/measure/edge_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>

#include "num/thread_pool.h"

namespace strahl {
namespace {

using Sample = std::array<double, 3>;

double apart(const Sample& a, const Sample& b) {
    return std::max({std::fabs(a[0] - b[0]), std::fabs(a[1] - b[1]), std::fabs(a[2] - b[2])});
}

/// Searches for a jump on a line from a pixel's sampling point. Places on the line are in pixels. When the line is
/// halved again and again, smooth differences fall below a step, jumps do not. The part that keeps its difference is
/// halved first, so that a jump is found where the picture changes up to some hundred times as much beside it. A steep
/// slope ends after `most_halved` samples.
class Line {
  public:
    /// The place whose sample the search needs next, unless it is done.
    double wanted = 0;
    bool done = false, jumps = false;

    void begin(const Sample& middle, double whole) { near = middle, wanted = radius = whole; }
    void take(const Sample& sample, double step) {
        constexpr int most_halved = 250;
        if (halved++ == 0) {
            add(0, near, radius, sample, step);
        } else {
            add(own.a, own.at_a, wanted, sample, step);
            add(wanted, sample, own.b, own.at_b, step);
        }
        done = halved > most_halved || halvings.empty();
        if (done) return;
        own = halvings.top();
        halvings.pop();
        wanted = (own.a + own.b) / 2;
        done = jumps = own.b - own.a < 1e-5 * radius;
    }

  private:
    struct Halving {
        double rank, a, b;
        Sample at_a, at_b;
        bool operator<(const Halving& other) const { return rank < other.rank; }
    };
    void add(double a, const Sample& at_a, double b, const Sample& at_b, double step) {
        const double difference = apart(at_a, at_b);
        // Halves of a slope have ranks of 3/4, the half with a jump 3/2.
        if (difference > step)
            halvings.push({difference * std::pow(radius / (b - a), std::log2(1.5)), a, b, at_a, at_b});
    }

    double radius = 0;
    Sample near{};
    int halved = 0;
    Halving own{};
    std::priority_queue<Halving> halvings;
};

constexpr int spokes = 8;

/// The lines from a pixel.
struct Star {
    std::array<Line, spokes> lines;
    bool jumps() const {
        return std::ranges::any_of(lines, [](const Line& line) { return line.jumps; });
    }
    bool done() const { return std::ranges::all_of(lines, &Line::done) || jumps(); }
};

}  // namespace

std::vector<bool> on_edges(Tracer& tracer, const View& view, ThreadPool& pool, std::span<const Pixel> pixels,
                           double radius, double step, const std::atomic<bool>* stop) {
    std::vector<PicturePoint> points;
    std::vector<double> rgb;
    const auto trace = [&] {
        rgb.resize(3 * points.size());
        tracer.trace({view, pool, {}, stop}, PointList{points, rgb.data()});
    };
    const auto sample = [&](std::size_t i) {
        return Sample{std::clamp(rgb[3 * i], 0., 1.), std::clamp(rgb[3 * i + 1], 0., 1.),
                      std::clamp(rgb[3 * i + 2], 0., 1.)};
    };
    for (const Pixel& pixel : pixels) points.push_back({double(pixel.x), double(pixel.y)});
    trace();
    std::vector<Star> stars(pixels.size());
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        for (Line& line : stars[i].lines) line.begin(sample(i), radius);
        open.push_back(i);
    }
    std::vector<Line*> asked;
    while (!open.empty() && !(stop && *stop)) {
        // Most edges are found by the first lines. Of few pixels all are searched at once, to fill packs.
        const int together = open.size() < spokes ? spokes : 1;
        points.clear(), asked.clear();
        for (const std::size_t i : open)
            for (int k = 0, taken = 0; k < spokes && taken < together; ++k) {
                Line& line = stars[i].lines[k];
                if (line.done) continue;
                const double angle = 2 * std::numbers::pi / spokes * k;
                points.push_back(
                    {pixels[i].x + line.wanted * std::cos(angle), pixels[i].y + line.wanted * std::sin(angle)});
                asked.push_back(&line), ++taken;
            }
        trace();
        for (std::size_t i = 0; i < asked.size(); ++i) asked[i]->take(sample(i), step);
        std::erase_if(open, [&](std::size_t i) { return stars[i].done(); });
    }
    std::vector<bool> found;
    for (const Star& star : stars) found.push_back(star.jumps());
    return found;
}

bool on_edge(Tracer& tracer, const View& view, ThreadPool& pool, Pixel pixel, double radius, double step,
             const std::atomic<bool>* stop) {
    return on_edges(tracer, view, pool, {&pixel, 1}, radius, step, stop)[0];
}

}  // namespace strahl
