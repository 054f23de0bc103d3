// Pictures do not depend on threads, crops, passes and earlier pictures; and tracing can be stopped.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <random>
#include <string>

#include "num/thread_pool.h"
#include "tests/referee/random_scene.h"
#include "tests/referee/referee.h"
#include "tests/unit/levels.h"
#include "tests/unit/sanitized.h"
#include "tests/unit/scenes.h"
#include "trace/tracer.h"

using namespace strahl;

namespace {

const int coarse = sanitized() ? 4 : 1;  // pictures are this much smaller

template <Precision P>
struct As {
    static constexpr Precision precision = P;
};
using Single = As<Precision::float32>;
using Twice = As<Precision::float64>;
using Extended = As<Precision::extended>;

/// Makes a scene with every feature.
Scene busy() { return random_scene(17, {.camera_inside = true}); }
View view_of(const Scene& scene, int width, int height, int depth = 4) {
    return {.camera = scene.camera, .width = width, .height = height, .depth = depth};
}

/// Collects tiles; each pixel may come only once.
struct Canvas {
    int width, height;
    std::vector<double> rgb;
    std::vector<int> times;
    int tiles = 0;
    std::mutex mutex;

    Canvas(int width, int height) : width(width), height(height), rgb(3 * width * height), times(width * height) {}
    void put(const Tile& tile) {
        const std::lock_guard lock(mutex);
        ++tiles;
        const Lattice& l = tile.lattice;
        for (int j = 0; j < l.rows; ++j)
            for (int i = 0; i < l.columns; ++i) {
                const int pixel = (l.y + j * l.step_y) * width + l.x + i * l.step_x;
                ++times.at(pixel);
                for (int c = 0; c < 3; ++c)
                    rgb.at(3 * pixel + c) = std::visit(
                        [&](auto values) -> double { return values[3 * (j * l.columns + i) + c]; }, tile.rgb);
            }
    }
    int count(int n) const { return static_cast<int>(std::count(times.begin(), times.end(), n)); }
};
Counts trace(Tracer& tracer, const View& view, const Lattice& lattice, int threads, Canvas& canvas) {
    ThreadPool pool(threads);
    return tracer.trace({view, pool, [&](const Tile& tile) { canvas.put(tile); }}, lattice);
}

Counts render_counts(const Scene& scene, const View& view, Precision precision) {
    Canvas canvas(view.width, view.height);
    Tracer tracer(scene, precision);
    return trace(tracer, view, {0, 0, view.width, view.height}, 1, canvas);
}

}  // namespace

TEST_CASE_TEMPLATE("any number of threads gives the same picture and counts the same rays", P, Single, Twice,
                   Extended) {
    const Scene scene = busy();
    const View view = view_of(scene, 150 / coarse, 90 / coarse);
    const Lattice whole{0, 0, view.width, view.height};
    const Frame expected = render(scene, view, P::precision, 1);
    Tracer tracer(scene, P::precision);
    std::uint64_t rays = 0;
    for (const int threads : {1, 2, 3, 7}) {
        CAPTURE(threads);
        Canvas canvas(view.width, view.height);
        const Counts counts = trace(tracer, view, whole, threads, canvas);
        CHECK(canvas.count(1) == view.width * view.height);
        CHECK(canvas.rgb == expected.rgb);
        CHECK(counts.camera == std::uint64_t(view.width * view.height));
        CHECK(counts.reflected > 0);
        CHECK(counts.refracted > 0);
        CHECK(counts.shadow > 0);
        CHECK(counts.total() == (rays ? rays : counts.total()));
        rays = counts.total();
    }
}

TEST_CASE_TEMPLATE("a crop is the same region of the whole picture", P, Single, Twice, Extended) {
    const Scene scene = busy();
    for (const auto& [width, height] : {std::pair{101, 67}, {64, 48}, {33, 1}, {1, 33}, {1, 1}}) {
        const View view = view_of(scene, std::max(1, width / coarse), std::max(1, height / coarse));
        const Frame whole = render(scene, view, P::precision, 2);
        const int w = view.width, h = view.height;
        Tracer tracer(scene, P::precision);
        for (const Lattice& crop :
             {Lattice{0, 0, w, h}, Lattice{w / 3, h / 2, w - w / 3, h - h / 2}, Lattice{w / 2, h / 3, 1, 1},
              Lattice{w - 1, 0, 1, h}, Lattice{0, h - 1, w, 1}, Lattice{w / 4, h / 4, w / 2, h / 2}}) {
            Canvas canvas(w, h);
            trace(tracer, view, crop, 2, canvas);
            CHECK(canvas.count(1) == crop.columns * crop.rows);
            CHECK(canvas.count(0) == w * h - crop.columns * crop.rows);
            bool same = true;
            for (int i = 0; i < 3 * w * h; ++i) same &= canvas.times[i / 3] == 0 || canvas.rgb[i] == whole.rgb[i];
            CHECK(same);
        }
    }
}

TEST_CASE_TEMPLATE("the passes of Adam7 together are the whole picture", P, Single, Twice, Extended) {
    constexpr struct {
        int x, y, step_x, step_y;
    } passes[]{{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
    const Scene scene = busy();
    const View view = view_of(scene, 75 / coarse, 53 / coarse);
    Tracer tracer(scene, P::precision);
    Canvas canvas(view.width, view.height);
    for (const auto& pass : passes) {
        const int columns = (view.width - pass.x + pass.step_x - 1) / pass.step_x;
        const int rows = (view.height - pass.y + pass.step_y - 1) / pass.step_y;
        trace(tracer, view, {pass.x, pass.y, columns, rows, pass.step_x, pass.step_y}, 2, canvas);
    }
    CHECK(canvas.count(1) == view.width * view.height);
    CHECK(canvas.rgb == render(scene, view, P::precision, 1).rgb);
}

TEST_CASE_TEMPLATE("what is left out of a pixel depends on that pixel alone, not on its neighbours or the lanes", P,
                   Single, Twice) {
    for (const char* name :
         {"article", "crosscheck/camera_inside_opaque", "crosscheck/nested", "crosscheck/bright_glass"}) {
        CAPTURE(name);
        const Scene scene = read_scene(name);
        View view = view_of(scene, 24 / coarse, 18 / coarse, 12);
        std::uint64_t all = render_counts(scene, view, P::precision).total();
        for (const double error : {1e-3, 3e-2, .3}) {
            CAPTURE(error);
            view.error = error;
            const Frame expected = render(scene, view, P::precision, 1);
            const Counts counts = render_counts(scene, view, P::precision);
            CHECK(counts.total() < all);
            all = counts.total();
            CHECK(counts.lost() > 0);
            for (const Simd simd : fused_levels()) CHECK(render(scene, view, P::precision, 1, simd) == expected);
            Tracer tracer(scene, P::precision);
            Canvas canvas(view.width, view.height);
            Counts sum;
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) sum += trace(tracer, view, {x, y, 1, 1}, 1, canvas);
            CHECK(canvas.rgb == expected.rgb);
            CHECK(sum.total() == counts.total());
            CHECK(sum.lost() == counts.lost());
        }
    }
}

TEST_CASE("an empty lattice traces nothing") {
    const Scene scene = busy();
    Tracer tracer(scene, Precision::float64);
    Canvas canvas(8, 8);
    CHECK(trace(tracer, view_of(scene, 8, 8), {3, 3, 0, 4}, 2, canvas).total() == 0);
    CHECK(canvas.tiles == 0);
}

TEST_CASE_TEMPLATE("a picture does not depend on the views before it, nor on the tracer being moved", P, Single,
                   Twice) {
    const Scene scene = busy();
    View near = view_of(scene, 40 / coarse, 30 / coarse);
    View far = near;
    far.camera.position = 1000. * far.camera.position;
    Tracer first(scene, P::precision);
    Canvas before(near.width, near.height);
    trace(first, far, {0, 0, near.width, near.height}, 2, before);
    Tracer tracer = std::move(first);
    CHECK(tracer.precision() == P::precision);
    Canvas canvas(near.width, near.height);
    trace(tracer, near, {0, 0, near.width, near.height}, 2, canvas);
    CHECK(canvas.rgb == render(scene, near, P::precision, 1).rgb);
}

TEST_CASE("tracing can be stopped, and delivered tiles are complete") {
    const Scene scene = busy();
    const View view = view_of(scene, 800 / coarse, 600 / coarse, 6);
    const Lattice whole{0, 0, view.width, view.height};
    const int pixels = view.width * view.height;
    Tracer tracer(scene, Precision::float64);
    ThreadPool pool(2);
    std::atomic<bool> stop = true;
    Canvas none(view.width, view.height);
    tracer.trace({view, pool, [&](const Tile& tile) { none.put(tile); }, &stop}, whole);
    CHECK(none.tiles <= pool.size());

    stop = false;
    Canvas some(view.width, view.height);
    const auto stop_after_one = [&](const Tile& tile) {
        some.put(tile);
        stop = true;
    };
    tracer.trace({view, pool, stop_after_one, &stop}, whole);
    CHECK(some.tiles >= 1);
    CHECK(some.tiles <= 2 * pool.size());
    CHECK(some.count(0) + some.count(1) == pixels);
    CHECK(some.count(1) < pixels);

    // Complete tiles hold the same pixels as the whole picture, traced afterwards by the same tracer.
    stop = false;
    Canvas all(view.width, view.height);
    tracer.trace({view, pool, [&](const Tile& tile) { all.put(tile); }, &stop}, whole);
    CHECK(all.count(1) == pixels);
    bool same = true;
    for (int i = 0; i < 3 * pixels; ++i) same &= some.times[i / 3] == 0 || some.rgb[i] == all.rgb[i];
    CHECK(same);
}

TEST_CASE("a shifted view samples beside the pixels' centres") {
    const Scene scene = busy();
    View view = view_of(scene, 24, 18);
    view.shift_x = .25, view.shift_y = -.375;
    const Frame frame = render(scene, view, Precision::float64, 2);
    const Referee<long double> referee(scene, scene.camera, 24, 18, view.depth);
    double worst = 0;
    for (int y = 0; y < 18; ++y)
        for (int x = 0; x < 24; ++x)
            for (int c = 0; c < 3; ++c) {
                const double seen = frame.rgb[3 * (24 * y + x) + c];
                worst = std::max(worst, std::abs(seen - double(referee.at(x + .75, y + .125).rgb[c])));
            }
    CHECK(worst < 1e-9);
}

TEST_CASE_TEMPLATE("no pixel is ever without a number", P, Single, Twice, Extended) {
    const auto finite = [](const Scene& scene, int width, int height) {
        for (const Simd simd : all_levels()) {
            CAPTURE(std::string(name(simd)));
            const Frame frame = render(scene, view_of(scene, width, height, 6), P::precision, 1, simd);
            CHECK(std::all_of(frame.rgb.begin(), frame.rgb.end(), [](double v) { return std::abs(v) < 100; }));
        }
    };
    Scene scene;
    scene.lights = {{{0, 0, 0}, {1, 1, 1}}};
    scene.materials = {{.refraction = .5, .pow = .5, .ior = 1.5}};
    scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 30, {}};
    const Plane floor{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.primitives = {{floor, 0, {}}};
    SUBCASE("a light in the middle of what is seen") {}
    SUBCASE("the same on a ball") { scene.primitives = {{Sphere{{0, 0, -1}, 1}, 0, {}}}; }
    SUBCASE("the same on a cylinder's cap, along its axis") {
        scene.primitives = {{Cylinder{{0, 0, -1}, {0, 0, 0}, 1}, 0, {}}};
    }
    SUBCASE("an eye on a surface, looking along it") {
        scene.camera = {{0, -3, 0}, {0, 0, 0}, {0, 0, -1}, 30, {}};
        scene.primitives.push_back({Cylinder{{0, 0, 0}, {0, 2, 0}, 1}, 0, {}});
    }
    SUBCASE("an eye at a centre") { scene.primitives = {{Sphere{{0, 0, 5}, 1}, 0, {}}}; }
    SUBCASE("an eye and a light at a centre, and the sharpest of highlights") {
        scene.primitives = {{Sphere{{0, 0, 5}, 1}, 0, {}}};
        scene.lights[0].position = {0, 0, 5};
        scene.materials[0].pow = 1e30;
    }
    SUBCASE("an eye on a light") { scene.lights[0].position = {0, 0, 5}; }
    SUBCASE("bodies that touch") {
        scene.primitives.push_back({Sphere{{0, 0, 1}, 1}, 0, {}}),
            scene.primitives.push_back({Sphere{{0, 0, 3}, 1}, 0, {}});
    }
    SUBCASE("the same body twice") { scene.primitives = {{Sphere{}, 0, {}}, {Sphere{}, 0, {}}}; }
    SUBCASE("exponents at both ends") {
        scene.lights[0].position = {0, 1, 3};
        scene.materials[0].pow = 0;
        scene.materials.push_back({.pow = 1e9});
        scene.primitives.push_back({Sphere{{0, 0, 1}, 1}, 1, {}});
    }
    SUBCASE("a needle and a coin") {
        scene.primitives.push_back({Cylinder{{0, 0, 0}, {0, 0, 4}, 1e-6}, 0, {}});
        scene.primitives.push_back({Cylinder{{1, 0, 0}, {1, 0, 1e-6}, .5}, 0, {}});
    }
    SUBCASE("an index that bends almost nothing through") { scene.materials[0].ior = 1e-3; }
    finite(scene, 33 / coarse | 1, 25 / coarse | 1);
}

TEST_CASE_TEMPLATE("a camera on a flat face sees it whole or not at all, in every direction and precision", P, Single,
                   Twice, Extended) {
    std::mt19937 random(7);
    const auto number = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    const std::string bright = " material { rgb <1, 0, 0>  ambient 1  reflection 0  diffuse 0  specular 0 } ";
    for (int i = 0; i < 12; ++i) {
        const std::string bodies[]{
            "box { <-12, -12, -9>, <12, 12, 0>" + bright, "disc { <0, 0, 0>, <0, 0, 1>, 12" + bright,
            "cylinder { <0, 0, -9>, <0, 0, 0>, 12" + bright, "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>" + bright};
        Scene scene = parse_scene(
            "camera { position <0, 0, 5> look_at <0, 0, 0> sky <0, 1, 0> fov 50 } background { color <0, 0, 1> } "
            "global_settings { ambient_light <1, 1, 1> } " +
                bodies[i % 4] + " rotate <" + std::to_string(number(-80, 80)) + ", 20, 30> }",
            "face");
        const glm::dmat4 m = matrix(scene.primitives[0].transformations);
        // The camera looks away from the face by 60 degrees, so that no ray looks back at it.
        scene.camera.position = transform_point(m, {number(-3, 3), number(-3, 3), 0});
        const DVec3 outwards = transform_point(m, {0, 0, 1}) - transform_point(m, {0, 0, 0});
        const DVec3 aside = transform_point(m, {1, 0, 0}) - transform_point(m, {0, 0, 0});
        scene.camera.look_at = scene.camera.position + outwards + .5 * aside;
        scene.camera.fov = 50, scene.camera.up = {.2, 1, .1};
        const Frame frame = render(scene, view_of(scene, 40, 30), P::precision);
        CAPTURE(i);
        CHECK(std::ranges::count(frame.rgb, 1.) == 40 * 30);
        bool blue = true;
        for (std::size_t k = 0; k < frame.rgb.size(); k += 3) blue &= frame.rgb[k] == 0;
        CHECK(blue);
    }
}
