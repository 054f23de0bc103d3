// Cylinders seen along their axis, across it, from afar, and thinner than any epsilon.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/kinds/cylinder.h"
#include "tests/stability/naive.h"
#include "tests/stability/stage.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

/// The infinite unit cylinder about z, (-b -+ sqrt(b^2 - a c)) / a, between z = 0 and 1.
template <class T>
T naive_cylinder(const Vec3<T>& o, const Vec3<T>& d) {
    const T a = d.x * d.x + d.y * d.y, b = o.x * d.x + o.y * d.y, c = o.x * o.x + o.y * o.y - 1;
    const T s = std::sqrt(b * b - a * c), low = -o.z / d.z, high = (1 - o.z) / d.z;
    const T near = std::max((-b - s) / a, std::min(low, high)), far = std::min((-b + s) / a, std::max(low, high));
    return near < far ? near : T(INFINITY);
}
template <class T>
Span<T> ours(const Vec3<T>& o, const Vec3<T>& d) {
    return CylinderKernel<T>{{0, 0, 0}, {0, 0, 1}, 1, 1}.span(Ray<T>{o, d, T(-1)}, T(-1));
}
/// Returns the t at which the ray enters the unit cylinder, in 113 bits, or NaN.
double exact(const DVec3& o, const DVec3& d) {
    using Q = Quadruple;
    const Q a = Q(d.x) * d.x + Q(d.y) * d.y, b = Q(o.x) * d.x + Q(o.y) * d.y, c = Q(o.x) * o.x + Q(o.y) * o.y - 1;
    const Q discriminant = b * b - a * c;
    if (discriminant <= 0) return NAN;
    const Q s = root(discriminant), low = -Q(o.z) / d.z, high = (1 - Q(o.z)) / d.z;
    const Q near = std::max<Q>((-b - s) / a, std::min(low, high)), far = std::min<Q>((-b + s) / a, std::max(low, high));
    return near < far ? static_cast<double>(near) : NAN;
}

}  // namespace

TEST_CASE("a ray along the axis hits the end, whatever the last bits of its direction") {
    int naive_wrong = 0;
    for (const float slip : {0.f, -0.f, 1e-45f, 1e-38f, 1e-30f, 1e-24f, 1e-20f, 1e-15f, 1e-12f, 1e-9f, 1e-7f, 1e-6f})
        for (const float sign : {1.f, -1.f})
            for (const float x : {0.f, .5f, .9f, 1.1f, 2.f}) {
                CAPTURE(slip);
                CAPTURE(x);
                const Vec3<float> o{x, 0, -5}, d{sign * slip, 0, 1};
                const bool right = x < 1;
                naive_wrong += !(naive_cylinder(o, d) == (right ? 5.f : INFINITY));
                const Span<float> single = ours(o, d);
                const Span<double> twice = ours(naive::to<double>(o), naive::to<double>(d));
                CHECK(single.hit == right);
                CHECK(twice.hit == right);
                if (right) CHECK(single.near == 5);
                if (right) CHECK(twice.near == 5);
                if (right) CHECK(single.far == doctest::Approx(6));
            }
    MESSAGE("naive: " << naive_wrong << " of 120 wrong");
    CHECK(naive_wrong > 0);
}

TEST_CASE("rays that start on an end and go along the axis hit the other end") {
    const CylinderKernel<float> can{{0, 0, 0}, {0, 0, 1}, 1, 1};
    for (const float slip : {0.f, 1e-30f, 1e-12f, 1e-7f}) {
        const Span<float> inwards = can.span(Ray<float>{{.5f, 0, 0}, {slip, 0, 1}, 1}, 1.f);
        CHECK(inwards.hit);
        CHECK(inwards.far == doctest::Approx(1));
        const Span<float> outwards = can.span(Ray<float>{{.5f, 0, 0}, {slip, 0, -1}, 1}, 1.f);
        CHECK(!(outwards.hit && (outwards.near > 0 || outwards.far > 0)));
        const Span<float> side = can.span(Ray<float>{{1, 0, .5f}, {0, slip, 1}, 0}, 0.f);
        CHECK(!(side.hit && side.near > 0));
        CHECK(side.far <= .5f);
    }
}

TEST_CASE("across the axis, also in the plane of an end") {
    for (const double z : {.5, 0., 1., -0., 1e-300, 1 - 0x1p-53}) {
        CAPTURE(z);
        const Span<double> span = ours<double>({-5, 0, z}, {1, 0, 0});
        CHECK(!std::isnan(span.near + span.far));
        if (z > 0 && z < 1) CHECK(span.hit);
        if (span.hit) CHECK(span.near == 4);
    }
    for (const double z : {-1e-300, 1 + 0x1p-52, 2.}) CHECK(!ours<double>({-5, 0, z}, {1, 0, 0}).hit);
}

TEST_CASE("hit or miss at far cylinders, and where") {
    Dice dice;
    constexpr int rays = 20000;
    int naive_wrong = 0, our_wrong = 0, hits = 0;
    double our_error = 0;
    for (int i = 0; i < rays; ++i) {
        const DVec3 from = dice.direction() * std::pow(10, dice(3, 5));
        const DVec3 aim = dice.direction() * dice(0, 1.5) + DVec3(0, 0, .5) - from;
        const Vec3<float> o = naive::to<float>(from), d = naive::to<float>(aim / naive::length(aim));
        const double right = exact(naive::to<double>(o), naive::to<double>(d));
        hits += !std::isnan(right);
        naive_wrong += std::isinf(naive_cylinder(o, d)) != std::isnan(right);
        const Span<float> span = ours(o, d);
        our_wrong += span.hit == std::isnan(right);
        if (span.hit && !std::isnan(right)) our_error = std::max(our_error, std::abs(span.near - right) / right);
    }
    MESSAGE("wrong among " << rays << ", of which " << hits << " hit: naive " << naive_wrong << ", ours " << our_wrong
                           << ", largest relative error " << our_error);
    CHECK(naive_wrong > rays / 50);
    CHECK(our_wrong < rays / 200);
    CHECK(our_error < 1e-4);
}

TEST_CASE("pictures along the axis: a tube's end is round, without NaN") {
    for (const double length : {1e-6, 1., 1e6}) {
        CAPTURE(length);
        Stage stage;
        stage.light({0, -6, 0});
        stage.put(Cylinder{{0, 0, 0}, {0, length, 0}, 1}, paint({1, 1, 1}));
        for (const Precision precision : precisions) {
            const Frame frame = shoot(stage.scene, precision, {65, 49});
            CHECK(not_finite(frame) == 0);
            int lit = 0;
            for (int x = 0; x < 65; ++x) lit += pixel(frame, x, 24).x > .9;
            const double half = 65 / (2 * 6 * std::tan(20 / 57.29577951308232));
            CHECK(std::abs(lit - 2 * half) <= 1);
            CHECK(pixel(frame, 32, 24).x == doctest::Approx(1));
        }
    }
}

TEST_CASE("a wire thinner than any epsilon") {
    for (const double radius : {1e-3, 1e-6, 1e-9}) {
        CAPTURE(radius);
        Stage stage;
        stage.look({0, -6 * radius, 0}, {0, 0, 0}, 20);
        stage.put(Cylinder{{-1, 0, 0}, {1, 0, 0}, radius}, glow({1, 1, 1}));
        for (const Precision precision : {Precision::float64, Precision::extended}) {
            const Frame frame = shoot(stage.scene, precision);
            int seen = 0;
            for (int y = 0; y < 48; ++y) seen += pixel(frame, 32, y) == Color(1);
            // asin(1/6) to both sides, of 2 * 20 * 3/4 degrees.
            CHECK(std::abs(seen - 64 * std::tan(std::asin(1. / 6)) / std::tan(20 / 57.29577951308232)) <= 1);
        }
    }
}

TEST_CASE_TEMPLATE("points on a rod that rounding hides are points of its axis", T, float, double) {
    const CylinderKernel<T> rod{{0, 0, 0}, {0, 0, 1}, std::numeric_limits<T>::min(), 1};
    const SurfacePoint<T> point = rod.at(Ray<T>{{0, -1, T(.5)}, {0, 1, 0}, -1}, T(1), T(0));
    CHECK(point.position.z == T(.5));
    CHECK(naive::length(Vec3<T>(point.position.x, point.position.y, 0)) < T(1e-30));
    CHECK(!std::isnan(point.normal.x + point.normal.y + point.normal.z));
}
