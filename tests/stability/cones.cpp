// Cones: rays parallel to the side, through the apex, along the axis and past the other half of the double cone, from
// afar and from the cone's own faces.
#include "tests/stability/cones.h"

#include <doctest/doctest.h>

#include "scene/kinds/cylinder.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

/// The double cone of apex 0 and slope 1 about z, (-b -+ sqrt(b^2 - a c)) / a, and what of it lies between z = 0 and 9.
template <class T>
T naive_cone(const Vec3<T>& o, const Vec3<T>& d) {
    const T a = d.x * d.x + d.y * d.y - d.z * d.z, b = o.x * d.x + o.y * d.y - o.z * d.z;
    const T c = o.x * o.x + o.y * o.y - o.z * o.z, s = std::sqrt(b * b - a * c);
    T nearest = T(INFINITY);
    for (const T t : {(-b - s) / a, (-b + s) / a})
        if (t > 0 && o.z + t * d.z > 0 && o.z + t * d.z < 9) nearest = std::min(nearest, t);
    if (const T t = (9 - o.z) / d.z; t > 0 && std::hypot(o.x + t * d.x, o.y + t * d.y) < 9)
        nearest = std::min(nearest, t);
    return nearest;
}
const Cone funnel{{0, 0, 0}, 0, {0, 0, 9}, 9};

}  // namespace

TEST_CASE("parallel to a line of the side, give or take the last bits, the one crossing is where it is") {
    int naive_wrong = 0;
    for (const double slip : {0., 1e-15, -1e-15, 1e-9, -1e-9, 1e-7, -1e-7, 1e-5, -1e-5}) {
        CAPTURE(slip);
        const Vec3<float> o{-3, .5, 0}, d = naive::unit(Vec3<float>(float(1 + slip), 0, 1));
        const double right = exact(funnel, naive::to<double>(o), naive::to<double>(d));
        CHECK(right == doctest::Approx(2.180246).epsilon(1e-4));
        naive_wrong += !(std::abs(naive_cone(o, d) / right - 1) < 1e-4);
        const Span<float> single = ours(funnel, o, d);
        CHECK(single.hit);
        CHECK(std::abs(single.near / right - 1) < 1e-6);
        const Span<double> twice = ours(funnel, naive::to<double>(o), naive::to<double>(d));
        CHECK(twice.hit);
        CHECK(std::abs(twice.near / right - 1) < 1e-14);
    }
    MESSAGE("naive: " << naive_wrong << " of 9 wrong");
    CHECK(naive_wrong > 0);
}

TEST_CASE("a ray into the apex: a hit or none, but a normal of length 1") {
    Dice dice;
    for (int i = 0; i < 2000; ++i) {
        const DVec3 d = i == 0 ? DVec3(0, 0, 1) : i == 1 ? DVec3(0, 0, -1) : dice.direction();
        const auto check = [&]<class T>(T) {
            const Ray<T> ray{naive::to<T>(d * -5.), naive::to<T>(d), T(-1)};
            const ConeKernel<T> cone = kernel<T>(funnel);
            const Span<T> span = cone.span(ray, T(-1));
            CHECK(!std::isnan(span.near + span.far));
            // Rays well inside the cone's angle hit it: upwards at the apex, downwards at the cap.
            if (d.z > .8) CHECK((span.hit && std::abs(span.near - 5) < T(1e-5)));
            if (d.z < -.8) CHECK((span.hit && std::abs(span.far - 5) < T(1e-5)));
            if (std::abs(d.z) < .6) CHECK(!(span.hit && span.far - span.near > T(1e-5)));
            if (!span.hit) return;
            const SurfacePoint<T> point = cone.at(ray, span.near, span.near_face);
            CHECK(std::abs(naive::length(point.normal) - 1) < T(1e-6));
            CHECK(!std::isnan(point.position.x + point.position.y + point.position.z));
        };
        check(1.f), check(1.);
    }
    const Ray<float> upwards{{0, 0, -5}, {0, 0, 1}, -1};
    const Span<float> span = kernel<float>(funnel).span(upwards, -1.f);
    const SurfacePoint<float> tip = kernel<float>(funnel).at(upwards, span.near, span.near_face);
    CHECK(tip.normal == Vec3<float>(0, 0, -1));
}

TEST_CASE("along the axis, whatever the last bits of the direction: end or side, as it should") {
    const Cone pipe{{0, 0, 0}, 1, {0, 0, 1}, 1}, bucket{{0, 0, 0}, 1, {0, 0, 1}, 2}, needle{{0, 0, 0}, 1, {0, 0, 1}, 0};
    for (const float slip : {0.f, -0.f, 1e-45f, 1e-38f, -1e-30f, 1e-24f, 1e-20f, -1e-15f, 1e-12f, 1e-9f, 1e-7f, 1e-6f})
        for (const float x : {0.f, .5f, .9f, 1.1f, 1.9f, 2.1f}) {
            CAPTURE(slip);
            CAPTURE(x);
            const Vec3<float> o{x, 0, -5}, d{slip, 0, 1};
            const auto check = [&](const Cone& cone, double near, double far) {
                const Span<float> single = ours(cone, o, d);
                const Span<double> twice = ours(cone, naive::to<double>(o), naive::to<double>(d));
                CHECK(single.hit == !std::isnan(near));
                CHECK(twice.hit == !std::isnan(near));
                if (!single.hit || !twice.hit) return;
                CHECK(single.near == doctest::Approx(near).epsilon(2e-6));
                CHECK(single.far == doctest::Approx(far).epsilon(2e-6));
                CHECK(twice.near == doctest::Approx(near).epsilon(1e-5));  // the slip
                CHECK(twice.far == doctest::Approx(far).epsilon(1e-5));
            };
            const double none = NAN;
            check(pipe, x < 1 ? 5 : none, 6);
            check(bucket, x < 1 ? 5 : x < 2 ? 4 + x : none, 6);
            check(needle, x < 1 ? 5 : none, 6 - x);
        }
}

TEST_CASE("the other half of the double cone is not there") {
    Dice dice;
    int through = 0, wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const DVec3 aim = DVec3(0, 0, -3) + dice.direction() * dice(0, 2), d = dice.direction(), o = aim - d * 9.;
        if (exact(funnel, o, d) < INFINITY) continue;
        const double a = d.x * d.x + d.y * d.y - d.z * d.z, b = o.x * d.x + o.y * d.y - o.z * d.z;
        through += b * b > a * (o.x * o.x + o.y * o.y - o.z * o.z);
        const Span<double> twice = ours(funnel, o, d);
        const Span<float> single = ours(funnel, naive::to<float>(o), naive::to<float>(d));
        wrong += (twice.hit && twice.far > 0) + (single.hit && single.far > 0);
    }
    MESSAGE(through << " rays crossed the other half only");
    CHECK(through > 5000);
    CHECK(wrong == 0);
}

TEST_CASE("equal radii make a cylinder") {
    Dice dice;
    for (int i = 0; i < 5000; ++i) {
        const DVec3 base = dice.direction(), cap = base + dice.direction() * dice(.1, 3);
        const Cylinder can{base, cap, dice(.1, 2)};
        const double height = std::hypot(cap.x - base.x, cap.y - base.y, cap.z - base.z);
        const CylinderKernel<double> other{base, can.axis(), can.radius, height};
        const Ray<double> ray{dice.direction() * 4., naive::unit(dice.direction() * dice(0, 2) - dice.direction()), -1};
        const Span<double> right = other.span(ray, -1.);
        const Span<double> span = ours(Cone{base, can.radius, cap, can.radius}, ray.origin, ray.direction);
        CHECK(span.hit == right.hit);
        if (!span.hit) continue;
        CHECK(span.near == doctest::Approx(right.near).epsilon(1e-9));
        CHECK(span.far == doctest::Approx(right.far).epsilon(1e-9));
    }
}

TEST_CASE("flat as a coin: what is hit is the end that faces the ray, at the rim too") {
    Dice dice;
    int rim = 0, again = 0;
    for (const double height : {1e-3, 1e-7, 1e-12})
        for (int i = 0; i < 3000; ++i) {
            const DVec3 a = dice.direction();
            const ConeKernel<float> coin = ConeKernel<float>::frustum(dice.direction(), a, 1, 1 - height / 2, height);
            const DVec3 from = dice.direction() * 4., out = naive::unit(cross(a, dice.direction()));
            const DVec3 aim = naive::to<double>(coin.base) + out * (i % 2 ? 1 - std::exp(dice(-20, -10)) : dice(0, .9));
            const Ray<float> ray{naive::to<float>(from), naive::to<float>(naive::unit(aim - from)), -1};
            const Span<float> span = coin.span(ray, -1.f);
            if (i % 2 == 0) REQUIRE(span.hit);
            if (!span.hit) continue;
            const SurfacePoint<float> point = coin.at(ray, span.near, span.near_face);
            if (i % 2 == 0) CHECK(dot(point.normal, ray.direction) <= 0);
            const Vec3<float> d = naive::to<float>(dice.direction());
            const Span<float> next = coin.span(Ray<float>{point.position, d, span.near_face}, span.near_face);
            again += dot(d, point.normal) > 0 && next.hit && next.far > 0;
            rim += i % 2;
        }
    CHECK(rim > 1000);
    CHECK(again == 0);
}

TEST_CASE_TEMPLATE("a cone flatter than its coordinates can say is hit no further out than it is wide", T, float,
                   double) {
    // Hierarchies cut off what is beyond by more than rounding, or not, as rays go together or alone.
    constexpr T beyond = 100 * std::numeric_limits<T>::epsilon();
    Dice dice;
    int inside = 0, outside = 0;
    for (int i = 0; i < 3000; ++i) {
        const DVec3 a = dice.direction(), across = naive::unit(cross(a, dice.direction()));
        const ConeKernel<T> disc = ConeKernel<T>::frustum(dice.direction(), a, 1, 0, 1e-20);
        const double off = beyond * std::exp(dice(0, 5));
        const auto hit = [&](double distance) {
            const Vec3<T> to = naive::to<T>(naive::to<double>(disc.base) + distance * across);
            const Vec3<T> d = naive::to<T>(naive::unit(a + .5 * dice.direction()));
            return disc.span(Ray<T>{to - d, d, -1}, T(-1)).hit;
        };
        inside += hit(1 - off);
        outside += hit(1 + off);
    }
    CHECK(inside > 100);
    CHECK(outside == 0);
}
