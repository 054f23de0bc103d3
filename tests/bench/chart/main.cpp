// Numbers for two charts: bits that mirrors leave, bounce by bounce, and how a resting picture becomes right in time.
//
//   bench_chart bounces        columns: bounce, and for float, double, long double the bits still right and theory's
//   bench_chart passes SCENE   columns: seconds per megapixel so far, share of pixels of another 8-bit colour than the
//                              exact picture's, mean difference
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "files/read_file.h"
#include "image/transfer.h"
#include "num/thread_pool.h"
#include "scene/kinds/sphere.h"
#include "show/session/progressive.h"
#include "tests/bench/measure.h"
#include "text/parse.h"
#include "trace/cells/cell_picture.h"
#include "trace/tracer.h"

using namespace strahl;

namespace {

constexpr double half_step = .5 / 255;  // what the window's pixels may lack
constexpr double distance = 3;          // of the centres of two mirror balls of radius 1

/// A ray that should go to and fro on the line between the centres for ever: the bits its place is right in, bounce by
/// bounce. What drives it off is rounding alone.
template <class T>
std::vector<double> bits_left() {
    const Vec3<T> axis = Vec3<T>(T(2), T(3), T(6)) / T(7), first(T(.1), T(.2), T(.3));
    const Vec3<T> centres[]{first, first + axis * T(distance)};
    Ray<T> ray{first + axis, axis, T(-1)};
    std::vector<double> bits;
    for (int i = 0; i < 60; ++i) {
        const SphereKernel<T> ball{centres[(i + 1) % 2], T(1)};
        const Span<T> span = ball.span(ray, T(-1));
        if (!span.hit || !(span.near > T(0))) break;
        const SurfacePoint<T> point = ball.at(ray, span.near, T(-1));
        ray.origin = point.position;
        ray.direction = fma(T(-2) * dot(ray.direction, point.normal), point.normal, ray.direction);
        ray.direction = scale(fma(T(-.5), dot(ray.direction, ray.direction), T(1.5)), ray.direction);
        const Vec3<T> off = point.normal - axis * dot(axis, point.normal);
        const double length = static_cast<double>(std::sqrt(dot(off, off)));
        bits.push_back(std::min(-std::log2(length), double(std::numeric_limits<T>::digits)));
    }
    return bits;
}

void bounces() {
    const double growth = distance - 1 + std::sqrt((distance - 1) * (distance - 1) - 1);
    const std::vector<double> measured[]{bits_left<float>(), bits_left<double>(), bits_left<long double>()};
    constexpr int digits[]{24, 53, 64};
    for (std::size_t n = 0; n < measured[2].size(); ++n) {
        std::printf("%zu", n + 1);
        for (int i = 0; i < 3; ++i) {
            const double theory = digits[i] - std::log2(growth) * double(n + 1);
            std::printf("\t%s\t%.3f", n < measured[i].size() ? std::to_string(measured[i][n]).c_str() : "NaN",
                        std::max(theory, 0.));
        }
        std::printf("\n");
    }
}

class Canvas {
  public:
    Canvas(int width, int height) : width(width), height(height), rgb(std::size_t(3) * width * height) {}
    /// Each pixel fills its block of steps.x by steps.y, as the window shows it.
    void fill(const Tile& tile, Steps steps) {
        std::visit(
            [&](const auto& values) {
                const Lattice& part = tile.lattice;
                for (int i = 0; i < part.columns * part.rows; ++i) {
                    const int left = part.x + i % part.columns * part.step_x;
                    const int top = part.y + i / part.columns * part.step_y;
                    for (int y = top; y < std::min(top + steps.y, height); ++y)
                        for (int x = left; x < std::min(left + steps.x, width); ++x)
                            for (int c = 0; c < 3; ++c)
                                rgb[3 * (std::size_t(y) * width + x) + c] = static_cast<double>(values[3 * i + c]);
                }
            },
            tile.rgb);
    }
    int width, height;
    std::vector<double> rgb;
};

struct Difference {
    double other, mean;  // share of pixels of another 8-bit colour, mean difference of values
};
Difference difference(const Canvas& ours, const Canvas& theirs, double gamma) {
    std::size_t other = 0;
    double sum = 0;
    for (std::size_t i = 0; i < ours.rgb.size(); i += 3) {
        bool same = true;
        for (std::size_t k = i; k < i + 3; ++k) {
            const int off = quantise(ours.rgb[k], gamma, 255) - quantise(theirs.rgb[k], gamma, 255);
            same &= off == 0;
            sum += std::abs(off) / 255.;
        }
        other += !same;
    }
    const double values = double(ours.rgb.size());
    return {3 * double(other) / values, sum / values};
}

/// The first picture of the window, of every 8th pixel in both directions, and the passes that follow.
void show_passes(const std::string& path) {
    const Scene scene = parse_scene(read_text(path), path);
    const View view{.camera = scene.camera, .depth = scene.settings.max_trace_level, .error = half_step};
    const Lattice whole{.columns = view.width, .rows = view.height};
    ThreadPool pool;
    Canvas exact(view.width, view.height);
    Tracer(scene, Precision::float64)
        .trace({view, pool, [&](const Tile& tile) { exact.fill(tile, {}); }}, SampledRegion{whole, {.error = 1e-4}});
    Tracer tracer(scene, Precision::float32);
    tracer.prepare(view, pool);
    constexpr int rounds = 7, first = 2;
    const auto later = passes_after(first);
    std::vector<std::vector<double>> seconds(1 + later.size());
    for (int round = 0; round < rounds; ++round) {
        Canvas canvas(view.width, view.height);
        std::optional<CellPicture> cells;
        const double start = bench::seconds();
        for (std::size_t pass = 0; pass < seconds.size(); ++pass) {
            const auto keep = [&](const Tile& tile) { canvas.fill(tile, pass == 0 ? steps_of(first) : Steps{}); };
            if (pass == 0)
                tracer.trace({view, pool, keep}, pixels_of(first, view.width, view.height));
            else
                tracer.trace({view, pool, keep}, CellPass{*cells, later[pass - 1].finest});
            if (pass == 0) cells.emplace(tracer.scene(), view, whole, Sampling{}.error);
            seconds[pass].push_back(bench::seconds() - start);
            if (round + 1 < rounds) continue;
            const auto [other, mean] = difference(canvas, exact, scene.settings.assumed_gamma);
            const double pixels = double(view.width) * view.height;
            std::printf("%g\t%g\t%g\n", bench::median(seconds[pass]) * 1e6 / pixels, other, mean);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 2 && std::strcmp(argv[1], "bounces") == 0)
        bounces();
    else if (argc == 3 && std::strcmp(argv[1], "passes") == 0)
        show_passes(argv[2]);
    else
        return std::fprintf(stderr, "usage: bench_chart bounces | passes SCENE\n"), 2;
}
