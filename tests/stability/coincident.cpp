// Coincident surfaces: the one declared first is always visible.
#include <doctest/doctest.h>

#include <cmath>

#include "scene/kinds/kinds.h"
#include "tests/stability/stage.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

const Color red{1, 0, 0}, blue{0, 0, 1};

/// `pairs` balls, each twice in the same place; the first declared of a pair has the colour `first`.
Scene doubled(int pairs, const Color& first, const Color& second, bool far_apart) {
    Stage stage;
    std::vector<std::pair<Sphere, Color>> balls;
    Dice dice;
    for (int i = 0; i < pairs; ++i)
        balls.push_back({Sphere{{dice(-2, 2), dice(-1, 1), dice(-1.5, 1.5)}, dice(.1, .4)}, first});
    if (far_apart) {
        for (int i = 0; i < pairs; ++i) balls.push_back({balls[i].first, second});
    } else {
        for (int i = pairs; i-- > 0;) balls.insert(balls.begin() + i + 1, {balls[i].first, second});
    }
    for (const auto& [ball, color] : balls) stage.put(ball, glow(color));
    return stage.scene;
}

}  // namespace

TEST_CASE("equal balls: of two, and of many in a hierarchy, with any threads and lanes") {
    for (const int pairs : {1, 5, 20, 100})
        for (const bool far_apart : {false, true})
            for (const Precision precision : precisions) {
                CAPTURE(pairs);
                CAPTURE(far_apart);
                const Scene scene = doubled(pairs, red, blue, far_apart),
                            swapped = doubled(pairs, blue, red, far_apart);
                const Frame frame = shoot(scene, precision);
                CHECK(count(frame, blue) == 0);
                CHECK(count(frame, red) > 0);
                CHECK(count(shoot(swapped, precision), red) == 0);
                CHECK(shoot(scene, precision, {.threads = 1}) == frame);
                CHECK(shoot(scene, precision, {.threads = 3}) == frame);
                if (precision != Precision::extended)
                    CHECK(count(shoot(scene, precision, {.simd = Simd::scalar}), blue) == 0);
            }
}

TEST_CASE("taking the last of equal bodies, or the first in the hierarchy, gives other pictures") {
    // Without the rule: the nearest by `<=` is the last declared.
    const SphereKernel<float> ball{{0, 0, 0}, 1};
    const Ray<float> ray{{.3f, .2f, -5}, {0, 0, 1}, -1};
    float best = INFINITY;
    int naive = -1;
    for (int i = 0; i < 2; ++i)
        if (const Span<float> span = ball.span(ray, -1.f); span.near <= best) best = span.near, naive = i;
    CHECK(naive == 1);
}

TEST_CASE("equal planes and cylinders, and the same ball written in three ways") {
    const auto only_red = [](const Stage& stage) {
        for (const Precision precision : precisions) {
            const Frame frame = shoot(stage.scene, precision);
            CHECK(count(frame, blue) == 0);
            CHECK(count(frame, red) > 200);
        }
    };
    const Plane slope{{0, 0, -.1}, {3, 1, 0}, {-1, 2, .7}};
    only_red(Stage().put(slope, glow(red)).put(slope, glow(blue)));
    const Cylinder can{{-1, 0, 0}, {1, .3, .2}, .5};
    only_red(Stage().put(can, glow(red)).put(can, glow(blue)));
    only_red(Stage()
                 .put(Sphere{{0, 0, 0}, 1}, glow(red))
                 .put(Sphere{{0, 0, 0}, .5}, glow(blue), {Scale{DVec3(2)}})
                 .put(Sphere{{0, 0, 0}, 1}, glow(blue), {Rotate{{10, 20, 30}}}));
    // The end of a cylinder lies in a plane.
    only_red(Stage()
                 .look({0, 0, -6}, {0, 0, 0}, 20, {0, 1, 0})
                 .put(Cylinder{{.1, .2, 0}, {.1, .2, 1}, 1}, glow(red))
                 .put(Plane{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, glow({0, 1, 0}))
                 .put(Cylinder{{-.1, .2, 0}, {-.1, .2, 2}, .5}, glow(blue)));
}

TEST_CASE("of two bodies in one place, light and reflected rays see only the first") {
    // The duplicate of such a ball, a rounding error in front or behind, would block every second ray.
    Material shiny = paint({.8, .6, .4});
    shiny.reflection = .5, shiny.specular = .5;
    const Sphere ball{{-1, .3, .1}, .9};
    const Cylinder can{{1, 0, -.8}, {1.2, .3, .7}, .6};
    const Plane floor{{0, 0, -1}, {1, .1, -1}, {0, 1, -1.1}};
    const std::vector<Transformation> squeezed{Scale{{.2, .5, .3}}, Rotate{{10, 20, 30}}};
    for (const Material& second : {paint({0, 0, 1}), glass(1.5, .8)}) {
        Stage single, twice;
        for (Stage* stage : {&single, &twice}) {
            stage->look({0, -6, 1}, {0, 0, 0}, 25).light({-4, -5, 6}).light({3, -5, 2}, {.3, .3, .3});
            stage->put(ball, shiny).put(can, glass(1.3, .7)).put(floor, shiny).put(ball, shiny, squeezed);
        }
        twice.put(ball, second).put(can, second).put(floor, second).put(ball, second, squeezed);
        for (const Precision precision : precisions) {
            const Frame one = shoot(single.scene, precision), both = shoot(twice.scene, precision);
            CHECK(share_apart(one, both, 0) == 0);
        }
    }
}

TEST_CASE("glass with water: their common surface is the same in every run") {
    for (const bool water_first : {false, true}) {
        Stage stage;
        stage.background({.25, .5, .75}).light({-3, -5, 6});
        const auto water = [&] { stage.put(Cylinder{{0, 0, -.5}, {0, 0, .25}, .5}, glass(1.33, .9)); };
        if (water_first) water();
        stage.put(Cylinder{{0, 0, -.5}, {0, 0, .5}, .5}, glass(1.5, .9));
        if (!water_first) water();
        stage.put(Sphere{{.5, 2, 0}, .75}, paint({.9, .4, .2}));
        for (const Precision precision : precisions) {
            const Frame frame = shoot(stage.scene, precision, {.depth = 10});
            CHECK(not_finite(frame) == 0);
            for (const int threads : {1, 2, 3})
                CHECK(shoot(stage.scene, precision, {.depth = 10, .threads = threads}) == frame);
        }
    }
}

namespace {

/// Many bodies whose surfaces lie closer together than float can say, one colour each.
Scene nearly_coincident(const std::vector<Shape>& shapes, const Material& material) {
    Stage stage;
    stage.look({0, -8, 5}, {0, 0, 0}, 10, {0, 0, 1}).light({-6, -8, 10}).background({.25, .5, .75});
    for (const Shape& shape : shapes) stage.put(shape, material);
    return stage.scene;
}

std::vector<Shape> balls_in_a_row(int count, double apart) {
    std::vector<Shape> row;
    for (int i = 0; i < count; ++i) row.push_back(Sphere{{(i - count / 2) * apart, 0, 0}, 1});
    return row;
}
std::vector<Shape> shells(int count, double apart) {
    std::vector<Shape> all;
    for (int i = 0; i < count; ++i) all.push_back(Sphere{{0, 0, 0}, 1 + i * apart});
    return all;
}
std::vector<Shape> tubes(int count, double apart) {
    std::vector<Shape> all;
    for (int i = 0; i < count; ++i) {
        const double x = i * apart;
        all.push_back(Cylinder{{-1 + x, .2, 0}, {1 + x, 0, .3}, .8});
        all.push_back(Cone{{-1 + x, .2, -1}, .9, {1, 0, -.8}, .5});
        all.push_back(Cuboid{{-.9 + x, -.9, -.9}, {.9 + x, .5, .7}});
    }
    return all;
}

}  // namespace

TEST_CASE("bodies that nearly coincide: float has the shadows and reflections of double") {
    Material shiny = paint({.8, .6, .4});
    shiny.reflection = .5;
    const Still shot{.width = 160, .height = 120, .depth = 5};
    // Up to 64 bodies are tested in a loop, more of them in a hierarchy.
    for (const auto& shapes : {balls_in_a_row(50, .02), balls_in_a_row(1000, .001), balls_in_a_row(300, 1e-6),
                               shells(40, 1e-6), shells(200, 1e-7), tubes(20, 1e-5), tubes(100, 1e-6)})
        for (const Material& material : {paint({.8, .6, .4}), shiny}) {
            const Scene scene = nearly_coincident(shapes, material);
            const Frame near = shoot(scene, Precision::float32, shot), exact = shoot(scene, Precision::float64, shot);
            CAPTURE(shapes.size());
            CAPTURE(material.reflection);
            CHECK(share_apart(near, exact, 2. / 255) == 0);
            CHECK(count(near, {.25, .5, .75}) < 160 * 120 * 3 / 4);
            CHECK(share_apart(near, shoot(scene, Precision::float32, {160, 120, 5, 1, Simd::scalar}), 0) == 0);
        }
}

TEST_CASE("an eye in an opaque body sees it from inside, and no light from beyond") {
    for (const int inner : {1, 100})  // in a loop, and in a hierarchy
        for (const Shape& room : {Shape(Sphere{{0, 0, 0}, 9}), Shape(Cuboid{{-5, -9, -5}, {5, 9, 5}}),
                                  Shape(Cylinder{{0, -9, 0}, {0, 9, 0}, 5})})
            for (const Precision precision : precisions) {
                Stage stage;
                stage.light({-30, -20, 40}).put(room, paint({.5, .5, .5}));
                for (int i = 0; i < inner; ++i)
                    stage.put(Sphere{{-2 + .04 * i, 1, .3}, .5 + 1e-7 * i}, paint({.9, .2, .1}));
                CHECK(count(shoot(stage.scene, precision), Color(0)) == 64 * 48);
                stage.light({3, -5, 4}, {.5, .5, .5});
                CHECK(count(shoot(stage.scene, precision), Color(0)) < 64 * 48 / 2);
            }
}
