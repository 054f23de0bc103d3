// Bodies that lie between the samples.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "scene/capsule.h"
#include "tests/referee/random_scene.h"
#include "tests/unit/scenes.h"
#include "trace/thin.h"
#include "trace/thread_pool.h"

using namespace strahl;

namespace {

double distance_to(const Capsule& capsule, const DVec3& p) {
    const DVec3 way = capsule.to - capsule.from, since = p - capsule.from;
    const double squared = dot_product(way, way);
    const double t = squared > 0 ? std::clamp(dot_product(since, way) / squared, 0., 1.) : 0.;
    return length(since - t * way) - capsule.radius;
}

/// Is the point in the body, in the scene's coordinates?
bool inside(const Primitive& primitive, const DVec3& p) {
    const DVec3 own = transform_point(glm::inverse(matrix(primitive.transformations)), p);
    return std::visit([&](const auto& kind) { return kind.contains(own); }, primitive.shape);
}

std::vector<double> picture(const Scene& scene, int width, const Sampling& sampling) {
    const View view{.camera = scene.camera, .width = width, .height = width * 3 / 4, .error = 1. / 510};
    const Lattice all{.columns = view.width, .rows = view.height};
    std::vector<double> rgb(std::size_t(3) * view.width * view.height);
    ThreadPool pool(2);
    Tracer(scene, Precision::float64).trace(view, sampling, all, pool, [&](const Tile& tile) { place(tile, all, rgb); });
    return rgb;
}

Scene wires() {
    const std::string path = STRAHL_SOURCE "/tests/bench/sampling/wires.rt";
    return parse_scene(read_text(path), path);
}

/// 400 balls, so far away that they are .05 to .3 pixels wide at 320x240.
Scene dust() {
    Scene scene = wires();
    scene.primitives.resize(1);
    const Primitive first = scene.primitives[0];
    scene.primitives.clear();
    std::mt19937 random(5);
    std::uniform_real_distribution<double> across(-3, 3), up(-2.2, 2.2), radius(.0006, .0035);
    for (int i = 0; i < 400; ++i) {
        scene.primitives.push_back(first);
        scene.primitives.back().shape = Sphere{{across(random), 0, up(random)}, radius(random)};
    }
    return scene;
}

}  // namespace

TEST_CASE("capsules contain their bodies") {
    std::mt19937 random(1);
    int tried = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed)
        for (const Primitive& primitive : random_scene(seed).primitives) {
            const std::vector<Capsule> capsules = capsules_of(primitive);
            if (capsules.empty()) continue;
            std::uniform_real_distribution<double> anywhere(-6, 6);
            for (int i = 0; i < 300; ++i) {
                const DVec3 p(anywhere(random), anywhere(random), anywhere(random));
                if (!inside(primitive, p)) continue;
                ++tried;
                double least = 1e9;
                for (const Capsule& capsule : capsules) least = std::min(least, distance_to(capsule, p));
                CHECK(least < 1e-9);
            }
        }
    CHECK(tried > 300);
}

TEST_CASE("strips contain what the picture shows of thin bodies") {
    const Scene scene = wires();
    const View view{.camera = scene.camera, .width = 640, .height = 480};
    const std::vector<Strip> strips = thin_strips(scene, view, 4);
    CHECK(strips.size() >= 9);
    const std::vector<double> exact = picture(scene, 640, {.grid = 8});
    int seen = 0;
    for (int y = 0; y < 480; ++y)
        for (int x = 0; x < 640; ++x) {
            if (exact[3 * (y * 640 + x)] == 0) continue;
            ++seen;
            CHECK(std::ranges::any_of(strips, [&](const Strip& strip) { return meets(strip, x, y, 1); }));
        }
    CHECK(seen > 900);
    // One that is behind everything, or wider than the cell, hides nothing.
    const Strip strip{.x0 = 3, .y0 = 1, .x1 = 4, .y1 = 1, .reach = .5, .nearest = 10};
    CHECK(hides_in({strip}, 0, 0, 8, 11, .01));
    CHECK(!hides_in({strip}, 0, 0, 8, 9, .01));
    CHECK(!hides_in({strip}, 0, 0, .5, 11, .01));
    CHECK(!hides_in({strip}, 0, 4, 8, 11, .01));
    CHECK(!hides_in({strip}, 0, 0, 8, 11, 5));
}

TEST_CASE("wires and dust keep their light") {
    for (const auto& [scene, width] : {std::pair(wires(), 640), std::pair(dust(), 320)}) {
        const std::vector<double> exact = picture(scene, width, {.grid = 32}), ours = picture(scene, width, {});
        double sum = 0, exact_sum = 0;
        int missed = 0, concerned = 0;
        for (std::size_t i = 0; i < exact.size(); i += 3) {
            sum += ours[i], exact_sum += exact[i];
            concerned += exact[i] > .02, missed += exact[i] > .02 && ours[i] < exact[i] / 4;
        }
        CAPTURE(concerned);
        CHECK(concerned > 100);
        CHECK(missed == 0);
        CHECK(sum == doctest::Approx(exact_sum).epsilon(.01));
    }
}
