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
#include "tests/unit/trace/cut_out.h"
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

/// Returns the mean of a lens's picture of a ball of light 1 in a pixel: of how much of the lens sees each place of the
/// ball's picture. All are in pixels: the way from the ball's middle to the pixel's, its radius, that of its blur.
double seen_of_ball(double x, double y, double radius, double blur) {
    if (std::hypot(x, y) > blur + radius + 1) return 0;
    constexpr int sides = 16, chords = 48;
    double seen = 0;
    for (int i = 0; i < sides * sides; ++i)
        for (int k = 0; k < chords; ++k) {
            const double angle = (k + .5) / chords * std::numbers::pi, half = radius * std::sin(angle);
            const double across = x + (i % sides + .5) / sides - .5 + radius * std::cos(angle);
            const double below = y + (i / sides + .5) / sides - .5;
            if (std::abs(across) >= blur) continue;
            const double end = std::sqrt(blur * blur - across * across);
            seen += half * std::max(0., std::min(below + half, end) - std::max(below - half, -end));
        }
    return seen / (chords * blur * blur) / (sides * sides);
}

TEST_CASE("small bright balls out of focus become discs that have all their light, and the error is what is said") {
    constexpr int runs = 8;
    double wrong = 0, said = 0;
    for (int seed = 0; seed < runs; ++seed) {
        Dice dice(seed);
        constexpr double depth = 20, lens = .1, focus = 5;
        constexpr int side = 32;
        const bool pentagon = seed % 4 == 3;
        const double disc = lens * (depth / focus - 1), radius = disc * std::exp(dice.in(std::log(.02), std::log(.5)));
        const double light = dice.in(.1, 1) * disc * disc / (radius * radius);
        Scene scene;
        scene.camera = {.position = {0, 0, 0},
                        .look_at = {0, 1, 0},
                        .up = {0, 0, -1},
                        .fov = 4,
                        .aspectratio = {},
                        .aperture = lens,
                        .focus = focus};
        if (pentagon) scene.camera.blades = 5;
        Material glowing;
        glowing.rgb = Pigment(1, 1, 1), glowing.ambient = light, glowing.diffuse = glowing.specular = 0;
        scene.settings.ambient_light = Color(1);
        scene.background = Pigment(.1, 0, 0);
        scene.materials.push_back(glowing);
        const DVec3 middle{dice.in(-.6, .6), depth, dice.in(-.6, .6)};
        scene.primitives.push_back({.shape = Sphere{middle, radius}, .material = 0, .transformations = {}});
        const View view{.camera = scene.camera, .width = side, .height = side};
        Sampled sampled;
        const std::vector<double> values = picture(scene, view, whole(view), 2, 1. / 510, &sampled);
        const double pixel = 2 * frame_of(scene.camera, 1).tan_x / side * depth;
        double sum = 0, squares = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const double value = values[std::size_t(3) * (y * side + x) + 1];
                const double exact =
                    light * seen_of_ball(x - (side - 1) / 2. - middle.x / pixel, y - (side - 1) / 2. + middle.z / pixel,
                                         radius / pixel, disc / pixel);
                sum += value, squares += (value - exact) * (value - exact) / (side * side);
            }
        CAPTURE(seed);
        CAPTURE(radius / disc);
        CAPTURE(light);
        CHECK(sum * pixel * pixel == doctest::Approx(light * std::numbers::pi * radius * radius).epsilon(.01));
        if (pentagon) continue;  // its closed form gives the sum of its light only
        CHECK(510 * std::sqrt(squares) < 1.5);
        CHECK(8 * sampled.error() > std::sqrt(squares));
        wrong += squares, said += sampled.error() * sampled.error();
    }
    CHECK(said > wrong / 3);
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

/// Returns the view of an eye of a camera with two, which lie beside each other.
View of_eye(const View& both, int eye) {
    View own = both;
    const Camera& camera = both.camera;
    own.camera.stereo = Stereo::none, own.camera.convergence.reset();
    const bool beside = camera.stereo == Stereo::side_by_side;
    (beside ? own.width : own.height) /= 2;
    if (camera.aspectratio) own.camera.aspectratio = *camera.aspectratio * (beside ? .5 : 2);
    const CameraFrame frame = frame_of(own.camera, double(own.width) / own.height);
    const DVec3 off = eye * camera.eye_distance / 2 * frame.right;
    own.camera.position += off, own.camera.look_at += off;
    if (camera.convergence)
        own.shift_x = -eye * camera.eye_distance / 2 / *camera.convergence / frame.tan_x * own.width / 2;
    return own;
}

TEST_CASE("the halves of a picture for two eyes are the pictures of cameras beside each other") {
    for (const int seed : {3, 8, 6, 11}) {
        if (sanitized() && seed == 6) break;
        CAPTURE(seed);
        Scene scene = random_scene(seed, {.lights = seed % 2 == 1, .patterns = seed % 3 == 0, .any_kind = .5});
        const bool beside = seed % 2 == 0;
        scene.camera.stereo = beside ? Stereo::side_by_side : Stereo::top_bottom;
        scene.camera.eye_distance = .1 * length(scene.camera.position);
        if (seed > 5) scene.camera.convergence = length(scene.camera.position);
        scene.camera.projection = seed == 8 ? Projection::fisheye : Projection::perspective;
        if (seed == 8) scene.camera.convergence.reset();
        const View view{.camera = scene.camera, .width = beside ? 84 : 42, .height = beside ? 30 : 60, .depth = 4};
        ThreadPool pool(2);
        Tracer tracer(scene, Precision::float64);
        const std::vector<double> sharp = values_of(tracer, view, whole(view), pool);
        const std::vector<double> means = picture(scene, view, whole(view), 2, 1. / 510);
        for (const int eye : {-1, 1}) {
            const View own = of_eye(view, eye);
            const std::vector<double> own_sharp = values_of(tracer, own, whole(own), pool);
            const std::vector<double> own_means = picture(scene, own, whole(own), 2, 1. / 510);
            int differ = 0;
            double squares = 0, at_border = 0;
            for (int y = 0; y < own.height; ++y)
                for (int x = 0; x < own.width; ++x) {
                    const int left = beside && eye > 0 ? own.width : 0, top = !beside && eye > 0 ? own.height : 0;
                    const auto at = std::size_t(3) * ((top + y) * view.width + left + x);
                    const auto own_at = std::size_t(3) * (y * own.width + x);
                    bool same = true;
                    for (std::size_t c = 0; c < 3; ++c) {
                        same &= std::abs(sharp[at + c] - own_sharp[own_at + c]) < 1e-6;
                        const double off = means[at + c] - own_means[own_at + c];
                        squares += off * off / (3 * own.width * own.height);
                        const int from_border =
                            beside ? (eye > 0 ? x : own.width - 1 - x) : (eye > 0 ? y : own.height - 1 - y);
                        if (from_border == 0) at_border += off * off / (3 * (beside ? own.height : own.width));
                    }
                    differ += !same;
                }
            CAPTURE(eye);
            CHECK(differ <= 3);  // edges that rounding decides
            CHECK(std::sqrt(squares) * 510 < 1.5);
            CHECK(std::sqrt(at_border) * 510 < 3);
        }
        const std::vector<double> coarse = picture(scene, view, whole(view), 1, 1. / 50);
        const Lattice part{.x = 17, .y = 13, .columns = 23, .rows = 15};  // across the halves
        const std::vector<double> crop = picture(scene, view, part, 2, 1. / 50);
        for (int y = 0; y < part.rows; ++y)
            for (int i = 0; i < 3 * part.columns; ++i)
                CHECK(crop[std::size_t(3) * part.columns * y + i] ==
                      coarse[std::size_t(3) * ((part.y + y) * view.width + part.x) + i]);
    }
}

TEST_CASE("each column of a picture of all around has eyes beside each other in its own direction") {
    Scene scene = random_scene(21, {.lights = true, .any_kind = .5});
    scene.camera.projection = Projection::spherical, scene.camera.fov = 180;
    scene.camera.position = .3 * scene.camera.position;
    scene.camera.stereo = Stereo::top_bottom, scene.camera.eye_distance = .2;
    const View view{.camera = scene.camera, .width = 40, .height = 40, .depth = 4};
    ThreadPool pool(2);
    Tracer tracer(scene, Precision::float64);
    const std::vector<double> values = values_of(tracer, view, whole(view), pool);
    int differ = 0, light = 0;
    for (int x = 0; x < view.width; ++x)
        for (const int eye : {-1, 1}) {
            View own = view;
            own.height /= 2, own.camera.stereo = Stereo::none;
            const CameraFrame frame = frame_of(own.camera, 2);
            const double longitude = (2 * (x + .5) / view.width - 1) * std::numbers::pi;
            const DVec3 off = eye * .1 * (std::cos(longitude) * frame.right - std::sin(longitude) * frame.forward);
            own.camera.position += off, own.camera.look_at += off;
            const std::vector<double> column = values_of(tracer, own, {.x = x, .columns = 1, .rows = 20}, pool);
            for (std::size_t i = 0; i < column.size(); ++i) {
                const std::size_t y = i / 3 + (eye > 0 ? 20 : 0);
                differ += std::abs(values[3 * (y * 40 + std::size_t(x)) + i % 3] - column[i]) > 1e-6;
                light += column[i] > .01;
            }
        }
    CHECK(differ <= 9);
    CHECK(light > 500);
}

}  // namespace strahl::lens
