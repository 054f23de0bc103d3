// Spheres far away, huge and tiny, and rays that just touch them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/kinds/sphere.h"
#include "tests/stability/naive.h"
#include "tests/stability/stage.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

/// Strahl's answer for one ray.
template <class T>
Span<T> ours(const Vec3<T>& o, const Vec3<T>& d, const Vec3<T>& centre, T radius) {
    return SphereKernel<T>{centre, radius}.span(Ray<T>{o, d, T(-1)}, T(-1));
}
template <class T>
Vec3<T> unit(const DVec3& v) {
    return naive::to<T>(v / std::sqrt(naive::times(v, v)));
}

struct Ball {
    Vec3<float> o, d;
    float radius;
};
/// A ball of radius about 1 around 0, and a ray from 1e3 to 1e5 away that passes near its outline.
Ball far_ball(Dice& dice) {
    const DVec3 o = dice.direction() * std::pow(10, dice(3, 5));
    const DVec3 aim = dice.direction() * dice(0, 1.5) - o;
    return {naive::to<float>(o), unit<float>(aim), static_cast<float>(dice(.5, 2))};
}

struct Wrong {
    int hits = 0;      // misclassified rays
    double error = 0;  // largest relative error of t
};
template <class T, class Method>
Wrong wrong_answers(int rays, const Method& method) {
    Dice dice;
    Wrong wrong;
    for (int i = 0; i < rays; ++i) {
        const Ball ball = far_ball(dice);
        using Q = Quadruple;
        const auto exact = naive::sphere<Q>(naive::to<Q>(ball.o), naive::to<Q>(ball.d), Vec3<Q>(Q(0)), ball.radius);
        const auto span =
            method(naive::to<T>(ball.o), naive::to<T>(ball.d), Vec3<T>(T(0)), static_cast<T>(ball.radius));
        wrong.hits += span.hit != exact.hit;
        if (span.hit && exact.hit)
            wrong.error = std::max(wrong.error, std::abs(static_cast<double>((span.near - exact.near) / exact.near)));
    }
    return wrong;
}

}  // namespace

TEST_CASE("a small ball 10,000 km away") {
    // The ray passes .005 inside the outline; exactly t = 9999999.96877501.
    const DVec3 o{-1e7, .095, 0}, d{1, 0, 0};
    CHECK(naive::sphere(naive::to<float>(o), naive::to<float>(d), Vec3<float>(0.f), .1f).near == 1e7f);
    CHECK(!naive::geometric_sphere(o, d, DVec3(0), .1).hit);  // in double
    CHECK(ours(naive::to<float>(o), naive::to<float>(d), Vec3<float>(0.f), .1f).hit);
    const Span<double> span = ours(o, d, DVec3(0), .1);
    REQUIRE(span.hit);
    CHECK(std::abs(span.near - 9999999.96877501) < 2e-9);
}

TEST_CASE("the outline of a ball 4096 radii away, in float") {
    const Vec3<float> z{0, 0, 1}, inside{.999f, 0, -4096}, outside{1.0001f, 0, -4096}, centre(0.f);
    CHECK(naive::sphere(inside, z, centre, 1.f).near == doctest::Approx(4095).epsilon(1e-9));  // .955 off
    CHECK(naive::sphere(outside, z, centre, 1.f).hit);                                         // the ray misses
    CHECK(ours(inside, z, centre, 1.f).near == doctest::Approx(4095.95528989).epsilon(1.2e-7));
    CHECK(!ours(outside, z, centre, 1.f).hit);
}

TEST_CASE("hit or miss at random far balls") {
    constexpr int rays = 20000;
    const Wrong naive_float = wrong_answers<float>(rays, naive::sphere<float>);
    const Wrong our_float = wrong_answers<float>(rays, ours<float>);
    const Wrong our_double = wrong_answers<double>(rays, ours<double>);
    MESSAGE("wrong answers among " << rays << ": naive float " << naive_float.hits << ", ours in float "
                                   << our_float.hits << ", in double " << our_double.hits);
    CHECK(naive_float.hits > rays / 10);
    CHECK(our_float.hits <= rays / 1000);
    CHECK(our_float.error < 1e-6);
    // The direction's length is off by half an ulp of float, which double sees; nothing else does.
    CHECK(our_double.hits == 0);
    CHECK(our_double.error < 1.2e-7);
}

TEST_CASE("rays one ulp outside a ball miss, one ulp inside they hit, from any distance") {
    int naive_wrong = 0, our_wrong = 0;
    const float nearer = std::nextafter(1.f, 0.f), farther = std::nextafter(1.f, 2.f);
    for (int i = 1; i <= 4000; ++i) {
        const float z = -1.7f * static_cast<float>(i);
        for (const float x : {farther, nearer}) {
            const Vec3<float> o{x, 0, z}, d{0, 0, 1};
            const bool right = x < 1;
            naive_wrong += naive::sphere(o, d, Vec3<float>(0.f), 1.f).hit != right;
            our_wrong += ours(o, d, Vec3<float>(0.f), 1.f).hit != right;
        }
    }
    MESSAGE("naive: " << naive_wrong << " of 8000 wrong");
    CHECK(naive_wrong > 2000);
    CHECK(our_wrong == 0);
}

TEST_CASE("the ground is a ball as large as the earth") {
    // Straight down from 1 above a ball of radius 1e7; and 1.5 above radius 1e6, down a slope of 1 in 100.
    CHECK(std::abs(naive::stable_sphere<float>({0, 1, 0}, {0, -1, 0}, {0, -1e7f, 0}, 1e7f).near - 1) > .1);
    CHECK(ours<double>({0, 1, 0}, {0, -1, 0}, {0, -1e7, 0}, 1e7).near == doctest::Approx(1).epsilon(1e-9));
    const DVec3 o{0, 1.5, 0}, slope = unit<double>({1, -.01, 0});
    const double naive_t = naive::sphere<float>(naive::to<float>(o), naive::to<float>(slope), {0, -1e6f, 0}, 1e6f).near;
    CHECK(std::abs(naive_t - 151.149755) > .1);
    const Span<double> span = ours(o, slope, {0, -1e6, 0}, 1e6);
    using Q = Quadruple;
    const auto exact = naive::sphere<Q>(naive::to<Q>(o), naive::to<Q>(slope), {0, Q(-1e6), 0}, Q(1e6));
    CHECK(span.near == doctest::Approx(151.149755).epsilon(1e-8));
    CHECK(std::abs(span.near - static_cast<double>(exact.near)) < 1e-6);
}

TEST_CASE("a picture of a scene on a huge ball, in double") {
    Stage stage;
    stage.look({0, -6, 1}, {0, 0, 0}, 30).light({-5, -5, 9}).background({.2, .3, .5});
    stage.put(Sphere{{0, 0, -1e7 - 1}, 1e7}, paint({.5, .6, .4}));
    stage.put(Sphere{{0, 0, 0}, 1}, paint({.9, .4, .2}));
    const Frame twice = shoot(stage.scene, Precision::float64), extended = shoot(stage.scene, Precision::extended);
    const Frame single = shoot(stage.scene, Precision::float32);
    MESSAGE("largest difference: float " << largest_difference(single, extended) << ", double "
                                         << largest_difference(twice, extended));
    CHECK(not_finite(single) == 0);
    CHECK(share_apart(twice, extended, 1e-6) == 0);
}

TEST_CASE("balls of radius 1e-6 through a narrow lens") {
    constexpr int width = 160, height = 120;
    const double reach = std::tan(.001 * std::numbers::pi / 180), per_pixel = 2 * reach / width;
    for (const double radius : {8e-6, 1.1e-5, 8e-9}) {
        CAPTURE(radius);
        const double distance = radius > 1e-6 ? 1 : 1e-3;
        Stage stage;
        stage.look({0, -distance, 0}, {0, 0, 0}, .001).put(Sphere{{0, 0, 0}, radius}, glow({1, 1, 1}));
        int right = 0, naive_count = 0;  // naive: half chords below 1e-5 are ignored
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double l = distance * per_pixel * std::hypot(x - width / 2 + .5, y - height / 2 + .5);
                right += l < radius;
                naive_count += l < radius && std::sqrt(radius * radius - l * l) > 1e-5;
            }
        CHECK(naive_count < right / 4);
        for (const Precision precision : precisions)
            CHECK(std::abs(count(shoot(stage.scene, precision, {width, height}), Color(1)) - right) <= 4);
    }
}
