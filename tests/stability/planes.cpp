// Planes at grazing angles, to the horizon, through the eye, and exactly along the ray.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "scene/kinds/plane.h"
#include "tests/stability/naive.h"
#include "tests/stability/stage.h"

using namespace strahl;
using namespace strahl::stability;

TEST_CASE("a hit at a grazing angle lies on the plane") {
    // A pattern depends on the side of the plane that a point is on: o + t d is sometimes above, sometimes below.
    Dice dice;
    const float height = .3f;
    int naive_off = 0, our_off = 0;
    float our_error = 0;
    for (int i = 0; i < 10000; ++i) {
        const DVec3 across = dice.direction();
        const double slope = std::pow(10, dice(-8, -2));
        const double level = std::hypot(across.x, across.y);
        const DVec3 d{across.x / level, across.y / level, -slope};
        const Ray<float> ray{{static_cast<float>(dice(-9, 9)), 2, 1.3f}, naive::to<float>(d / naive::length(d)), -1};
        const PlaneKernel<float> flat{{0, 0, 1}, height};
        const Span<float> span = flat.span(ray, -1.f);
        REQUIRE(span.hit);
        using Q = Quadruple;
        const Q t = (Q(height) - Q(ray.origin.z)) / Q(ray.direction.z);
        our_error = std::max(our_error, std::abs(static_cast<float>((span.near - t) / t)));
        naive_off += ray.origin.z + span.near * ray.direction.z != height;
        our_off += flat.at(ray, span.near, 0.f).position.z != height;
    }
    MESSAGE("of 10000 hits off the plane: naive " << naive_off << ", ours " << our_off);
    CHECK(naive_off > 500);
    CHECK(our_off == 0);
    CHECK(our_error < 3e-7);
}

TEST_CASE("a plane reaches to the horizon") {
    // Half of a picture 2e-7 degrees wide: the plane is hit 5e8 away at the nearest. A limit of t < 1e7 loses all of
    // it.
    Stage stage;
    stage.look({0, 0, 1}, {0, 1, 1}, 1e-7).background({0, 0, 1});
    stage.put(Plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, glow({1, 1, 0}));
    const double slope = std::tan(1e-7 / 57.29577951308232) * 3 / 4;
    CHECK(1 / slope > 1e7);
    for (const Precision precision : precisions) {
        const Frame frame = shoot(stage.scene, precision);
        CHECK(count(frame, {0, 0, 1}) == 64 * 24);
        CHECK(count(frame, {1, 1, 0}) == 64 * 24);
    }
}

TEST_CASE("a ray within a plane does not hit it") {
    const PlaneKernel<double> plane{{0, 0, 1}, 0};
    for (const double height : {0., -0., 1., -1.})
        for (const double slope : {0., -0.}) {
            const double naive_t = (0 - height) / slope;
            CHECK(!std::isfinite(naive_t));
            CHECK(!plane.span(Ray<double>{{1, 2, height}, {1, 0, slope}, -1}, -1.).hit);
        }
    CHECK(std::isnan((0 - 0.) / 0.));  // the naive method continues with this
}

TEST_CASE("an eye in a plane sees through it, without NaN") {
    // The middle row looks exactly along the plane.
    for (const bool tilted : {false, true}) {
        const DVec3 side = tilted ? DVec3{3, 0, 4} : DVec3{1, 0, 0};
        Stage stage;
        stage.look({0, 0, 0}, {0, 1, 0}, 40, tilted ? DVec3{4, 0, -3} : DVec3{0, 0, -1}).background({0, 0, 1});
        stage.light({0, 0, 0}).light({0, 5, 0});  // in the plane too
        Material shiny = mirror(.5);
        shiny.diffuse = 1, shiny.rgb = Color(1), shiny.specular = 1, shiny.pow = 0;
        stage.put(Plane{{0, 0, 0}, side, {0, 1, 0}}, shiny);
        stage.put(Sphere{{0, 4, 0}, 1}, shiny);  // which it cuts in half
        for (const Precision precision : precisions) {
            const Frame frame = shoot(stage.scene, precision, {65, 49});
            CHECK(not_finite(frame) == 0);
            CHECK(pixel(frame, 0, 24) == Color(0, 0, 1));
            CHECK(pixel(frame, 0, 0) == Color(0, 0, 1));
            CHECK(pixel(frame, 0, 48) == Color(0, 0, 1));
        }
    }
}

TEST_CASE("a far plane at a grazing angle is exact in double") {
    for (const double shift : {1e4, 1e6, 1e8}) {
        CAPTURE(shift);
        Stage stage;
        stage.look({shift, shift - 6, .01}, {shift, shift, 0}, 25).light({shift, shift - 8, 1}).background({0, 0, .5});
        stage.put(Plane{{0, 0, -1e-3}, {1, 0, -1e-3}, {0, 1, -1e-3}}, paint({.5, .5, .5}));
        stage.put(Sphere{{shift, shift, 0}, 1}, mirror(.5));
        const Frame exact = shoot(stage.scene, Precision::extended);
        CHECK(share_apart(shoot(stage.scene, Precision::float64), exact, 1e-7) < .002);
        CHECK(share_apart(shoot(stage.scene, Precision::float32), exact, 1. / 255) < .01);
    }
}
