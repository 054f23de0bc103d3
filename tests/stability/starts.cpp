// Rays that start on surfaces: at any size none hits the surface it leaves, and none misses what is near.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/stability/naive.h"
#include "tests/stability/stage.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

struct WrongRays {
    int self = 0, lost = 0;  // reflected rays that hit the sphere again; refracted ones that miss its far side
};
struct Comparison {
    WrongRays naive, ours;
    double chord = 0;  // largest error of Strahl's chords, in radii
};

/// Rays that hit a sphere, and from there a reflected one and one straight through the inside. Naive: t > 1e-4 counts.
Comparison compare(float size, float shift, int rays) {
    using S = float;
    Dice dice;
    Comparison sum;
    const Vec3<S> centre(shift);
    const SphereKernel<S> sphere{centre, size};
    for (int i = 0; i < rays; ++i) {
        const DVec3 from = dice.direction() * dice(2, 20), aim = dice.direction() * dice(0, .999) - from;
        const Vec3<S> o = naive::to<S>(from * double(size) + DVec3(shift));
        const Ray<S> ray{o, naive::to<S>(aim / naive::length(aim)), -1};
        const Span<S> span = sphere.span(ray, S(-1));
        if (!span.hit || !(span.near > 0)) continue;
        const SurfacePoint<S> point = sphere.at(ray, span.near, S(0));
        const Vec3<S> mirrored = naive::mirrored(ray.direction, point.normal);

        const Vec3<S> naive_point = o + ray.direction * naive::stable_sphere(o, ray.direction, centre, size).near;
        const auto again = naive::stable_sphere(naive_point, mirrored, centre, size);
        sum.naive.self += again.hit && again.far > 1e-4f;
        const auto through = naive::stable_sphere(naive_point, ray.direction, centre, size);
        sum.naive.lost += !(through.hit && through.far > 1e-4f);

        const Span<S> away = sphere.span(Ray<S>{point.position, mirrored, 0}, S(0));
        sum.ours.self += away.hit && (away.near > 0 || away.far > 0);
        const Span<S> on = sphere.span(Ray<S>{point.position, ray.direction, 0}, S(0));
        sum.ours.lost += !(on.hit && on.far > 0);
        const double exact = -2 * naive::times(naive::to<double>(ray.direction), naive::to<double>(point.normal));
        sum.chord = std::max(sum.chord, std::abs(on.far / size - exact));
    }
    return sum;
}

}  // namespace

TEST_CASE("a ray leaves the sphere it starts on, and crosses it inside, at any size and far from the origin") {
    constexpr int rays = 10000;
    struct {
        float size, shift;
        bool naive_meets_itself, naive_is_lost;
        double chord;  // bound: the point's rounding, 6e-8 of its coordinates, in radii
    } const cases[]{{1, 0, false, false, 2e-6},    {1, 1e5, true, false, .05},  {1e-6f, 0, false, true, 2e-6},
                    {1e-4f, 0, false, true, 2e-6}, {1e3, 0, true, false, 2e-6}, {1e6, 0, true, false, 2e-6},
                    {1e3, 1e8, true, false, .05}};
    for (const auto& [size, shift, naive_self, naive_lost, chord] : cases) {
        CAPTURE(size);
        CAPTURE(shift);
        const Comparison sum = compare(size, shift, rays);
        MESSAGE("size " << size << ", shift " << shift << ", of " << rays << ": naive meets itself " << sum.naive.self
                        << ", is lost " << sum.naive.lost << "; ours " << sum.ours.self << ", " << sum.ours.lost
                        << ", chord off by " << sum.chord << " radii");
        CHECK((sum.naive.self > rays / 10) == naive_self);
        CHECK((sum.naive.lost > rays / 100) == naive_lost);
        CHECK(sum.ours.self == 0);
        CHECK(sum.ours.lost == 0);
        CHECK(sum.chord < chord);
    }
}

TEST_CASE("a point of a sphere is not in the sphere's own shadow") {
    // Only the cosine dims a lit surface: black spots would be shadows of the surface on itself.
    for (const double size : {1e-6, 1e-3, 1., 1e3, 1e6})
        for (const double shift : {0., 1e4, 1e8}) {
            CAPTURE(size);
            CAPTURE(shift);
            Stage stage;
            stage.put(Sphere{{0, 0, 0}, 1}, paint({1, 1, 1})).light({0, -6, 0});
            const Scene scene = placed(stage.scene, size, DVec3(shift * size));
            for (const Precision precision : precisions) {
                const Frame frame = shoot(scene, precision);
                // Light and eye are in one place: all that is visible is lit, by n.l, up to the outline.
                int dark = 0;
                for (int y = 20; y < 28; ++y)
                    for (int x = 28; x < 36; ++x) dark += !(pixel(frame, x, y).x > .9);
                CHECK(dark == 0);
                CHECK(pixel(frame, 0, 0) == Color(0));
                CHECK(not_finite(frame) == 0);
            }
        }
}

TEST_CASE("a mirror ball, a glass ball and a cylinder look the same at any size") {
    Stage stage;
    stage.background({.5, .25, .125}).light({-4, -5, 6});
    stage.put(Sphere{{-1.25, 0, 0}, 1}, mirror(.5)).put(Sphere{{1, 0, .25}, .75}, glass(1.5, .75));
    stage.put(Cylinder{{.25, .5, -1}, {.25, 1, 1}, .5}, paint({.5, .75, 1}));
    for (const Precision precision : precisions) {
        const Frame frame = shoot(stage.scene, precision);
        const double tolerance = precision == Precision::float32 ? 1e-3 : 1e-9;
        for (const double size : {1e-6, 1e-3, 1e3, 1e6}) {
            CAPTURE(size);
            CHECK(share_apart(shoot(placed(stage.scene, size), precision), frame, tolerance) < .01);
        }
    }
}

TEST_CASE("contact shadows: a body just above the ground darkens it, at any gap") {
    // A flat cylinder above a plane, the light straight above. Naive: occluders nearer than 1e-3 cast no shadow.
    for (const double gap : {9e-4, 5e-4, 1e-6, 1e-9}) {
        CAPTURE(gap);
        Stage stage;
        stage.look({0, -.02, .01}, {0, 0, 0}, 12).light({0, 0, 1}).background({0, 0, 1});
        stage.put(Plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, paint({1, 1, 1}));
        stage.put(Cylinder{{0, 0, gap}, {0, 0, gap + 1e-5}, 2e-3}, glass(1, .5));  // transparent, with half a shadow
        const Frame frame = shoot(stage.scene, Precision::float64, {160, 120});
        // The eye sees the plane through the cylinder; each surface transmits half of the light, in both directions.
        int shadow = 0;
        for (int y = 0; y < 120; ++y)
            for (int x = 0; x < 160; ++x) shadow += std::abs(pixel(frame, x, y).x - 1. / 16) < 1e-3;
        CHECK(shadow > 500);
        CHECK(not_finite(frame) == 0);
    }
}

TEST_CASE("bodies that touch: light enters the gap correctly") {
    // A ball that lies on a plane, and one whose lowest point is 1e-9 above it: the point of contact is dark, and all
    // else that the light reaches is lit.
    for (const double gap : {0., 1e-9, 1e-6}) {
        Stage stage;
        stage.look({0, -6, .05}, {0, 0, 0}, 12).light({0, -8, .001});
        stage.put(Plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, paint({1, 1, 1}));
        stage.put(Sphere{{0, 0, 1 + gap}, 1}, paint({1, 1, 1}));
        for (const Precision precision : {Precision::float64, Precision::extended}) {
            const Frame frame = shoot(stage.scene, precision, {65, 49});
            CHECK(not_finite(frame) == 0);
            CHECK(pixel(frame, 32, 40).x > 0);  // the plane in front of the ball
        }
        CHECK(share_apart(shoot(stage.scene, Precision::float64), shoot(stage.scene, Precision::extended), 1e-9) <
              .002);
    }
}
