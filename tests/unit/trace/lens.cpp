// Pictures through a lens: against closed forms, against pinholes all over the lens that share no code with it, and the
// same bits however they are cut.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "num/scrambled_net.h"
#include "num/thread_pool.h"
#include "num/vec_math.h"
#include "tests/referee/dice.h"
#include "tests/referee/random_scene.h"
#include "tests/unit/sanitized.h"
#include "trace/cells/cell_picture.h"
#include "trace/tracer.h"

namespace strahl::lens {

std::vector<double> picture(const Scene& scene, const View& view, const Lattice& part, int threads, double error,
                            Sampled* sampled = nullptr, Simd simd = Simd::automatic) {
    ThreadPool pool(threads);
    Tracer tracer(scene, Precision::float64, simd);
    CellPicture cells(scene, view, part, error);
    if (sampled) cells.check(1000);
    std::vector<double> values(std::size_t(3) * part.columns * part.rows);
    tracer.trace({view, pool, [&](const Tile& tile) { place(tile, part, values); }}, CellPass{cells, 0});
    if (sampled) *sampled = cells.sampled();
    return values;
}
Lattice whole(const View& view) { return {.columns = view.width, .rows = view.height}; }

/// Averages sheared pinholes at n x n places of the lens, each with m x m rays in a pixel, which are at other places of
/// it for each pinhole (the sequence R2 of M. Roberts, 2018).
std::vector<double> by_pinholes(const Scene& scene, const View& view, int n, int m) {
    ThreadPool pool;
    Tracer tracer(scene, Precision::float64);
    const CameraFrame frame = frame_of(view.camera, double(view.width) / view.height);
    const double sharp = focal_distance(view.camera);
    std::vector<double> sum(std::size_t(3) * view.width * view.height);
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            // Equal areas of a disc: rings of equal area, and in each as many equal angles.
            const double radius = std::sqrt((j + .5) / n), angle = 2 * std::numbers::pi * (i + .5 * (j % 2 + .5)) / n;
            const double x = view.camera.aperture * radius * std::cos(angle);
            const double y = view.camera.aperture * radius * std::sin(angle);
            View own = view;
            own.camera.aperture = 0, own.camera.focus.reset(), own.camera.focus_on.reset();
            own.camera.position = view.camera.position + x * frame.right + y * frame.down;
            own.camera.look_at = own.camera.position + frame.forward;
            own.shift_x = -x / sharp / frame.tan_x * view.width / 2;
            own.shift_y = -y / sharp / frame.tan_y * view.height / 2;
            const auto part = [&](double step) { return (std::fmod((j * n + i) * step, 1) - .5) / m; };
            own.shift_x += part(.7548776662466927), own.shift_y += part(.5698402909980532);
            const std::vector<double> one = values_of(tracer, own, whole(view), pool, {.grid = m});
            for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += one[k] / (n * n);
        }
    return sum;
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

/// A random world before a lens that blurs it by several pixels.
Scene world(int seed) {
    Dice dice(seed);
    Scene scene = random_scene(seed, {.lights = seed % 2 == 1, .patterns = seed % 3 == 0, .any_kind = .5});
    const double distance = length(scene.camera.look_at - scene.camera.position);
    scene.camera.projection = Projection::perspective;
    scene.camera.aperture = distance * dice.in(.01, .06);
    scene.camera.focus = distance * dice.in(.4, 1.6);
    return scene;
}

TEST_CASE("each net fills its cube evenly, and each seed has another") {
    std::set<double> first;
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const ScrambledNet net(seed);
        first.insert(net.point(0)[0]);
        // Each of 2^k slices holds one of 2^k points, in each dimension; so does each cell of the first two.
        for (int k = 0; k <= 10; ++k) {
            std::set<int> slices[4], cells;
            for (std::uint32_t i = 0; i < 1u << k; ++i) {
                const auto point = net.point(i);
                for (int d = 0; d < 4; ++d) slices[d].insert(static_cast<int>(std::ldexp(point[d], k)));
                cells.insert(static_cast<int>(std::ldexp(point[0], k / 2)) << 10 |
                             static_cast<int>(std::ldexp(point[1], k - k / 2)));
            }
            for (const auto& own : slices) CHECK(own.size() == 1u << k);
            CHECK(cells.size() == 1u << k);
        }
    }
    CHECK(first.size() == 20);
}

TEST_CASE("an edge out of focus is the share of the lens that sees beyond it") {
    for (const int blades : {0, 4})
        for (const double focus : {4., 20.}) {
            constexpr double depth = 10, radius = .5;
            Scene scene;
            scene.camera = {.position = {0, 0, 0},
                            .look_at = {0, 1, 0},
                            .up = {0, 0, -1},
                            .fov = 20,
                            .aspectratio = {},
                            .aperture = radius,
                            .focus = focus};
            if (blades) scene.camera.blades = blades;
            scene.background = Pigment(0, 0, 0);
            Material glowing;
            glowing.rgb = Pigment(1, 1, 1), glowing.ambient = 1, glowing.diffuse = glowing.specular = 0;
            scene.materials.push_back(glowing);
            scene.primitives.push_back(
                {.shape = Cuboid{{0, depth, -100}, {100, depth + 1e-6, 100}}, .material = 0, .transformations = {}});
            const View view{.camera = scene.camera, .width = 64, .height = 8};
            const std::vector<double> values = picture(scene, view, whole(view), 2, 1. / 510);
            const double tan_x = frame_of(scene.camera, 8).tan_x, off = std::abs(1 - depth / focus) * radius;
            double squares = 0;
            for (int x = 0; x < view.width; ++x) {
                double exact = 0;
                constexpr int parts = 1000;
                for (int i = 0; i < parts; ++i) {
                    const double u = ((x + (i + .5) / parts) / view.width * 2 - 1) * tan_x;
                    const double c = std::clamp(u * depth / off, -1., 1.);
                    exact += (blades ? .5 + c - c * std::abs(c) / 2
                                     : .5 + (c * std::sqrt(1 - c * c) + std::asin(c)) / std::numbers::pi) /
                             parts;
                }
                for (int y = 0; y < view.height; ++y) {
                    const double wrong = values[std::size_t(3) * (y * view.width + x)] - exact;
                    squares += wrong * wrong / (view.width * view.height);
                }
            }
            CAPTURE(blades);
            CAPTURE(focus);
            CHECK(std::sqrt(squares) * 510 < 1.5);
        }
}

TEST_CASE("random worlds are what pinholes all over the lens see, and the error is what is said") {
    if (sanitized()) return;  // only figures count: the case of threads, crops and lanes runs the same code
    double all = 0, said = 0;
    for (const int seed : {3, 8, 21, 34}) {
        const Scene scene = world(seed);
        const View view{.camera = scene.camera, .width = 27, .height = 19, .depth = 6};
        Sampled sampled;
        const std::vector<double> values = picture(scene, view, whole(view), 2, 1. / 100, &sampled);
        const double off = rms(values, by_pinholes(scene, view, 20, 4));
        CAPTURE(seed);
        CHECK(off < 1.6 / 100);
        all += off * off, said += sampled.error() * sampled.error();
    }
    CHECK(std::sqrt(all) < 2 * std::sqrt(said));
    CHECK(std::sqrt(said) < 2 * std::sqrt(all));
}

TEST_CASE("pictures through a lens do not depend on threads, crops and lanes") {
    for (const int seed : {5, 13}) {
        const Scene scene = world(seed);
        const View view{.camera = scene.camera, .width = 75, .height = 21, .depth = 4};
        const std::vector<double> values = picture(scene, view, whole(view), 1, 1. / 50);
        CHECK(picture(scene, view, whole(view), 3, 1. / 50) == values);
        CHECK(picture(scene, view, whole(view), 1, 1. / 50, nullptr, Simd::scalar) == values);
        const Lattice part{.x = 61, .y = 5, .columns = 9, .rows = 11};
        const std::vector<double> crop = picture(scene, view, part, 2, 1. / 50);
        for (int y = 0; y < part.rows; ++y)
            for (int i = 0; i < 3 * part.columns; ++i)
                CHECK(crop[std::size_t(3) * part.columns * y + i] ==
                      values[std::size_t(3) * ((part.y + y) * view.width + part.x) + i]);
    }
}

}  // namespace strahl::lens
