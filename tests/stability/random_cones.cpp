// Random cones, from needles to coins: hit or miss from near and afar, along the side and from their own faces; and
// what bounds them.
#include <doctest/doctest.h>

#include "tests/stability/cones.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

double first_of(const Span<double>& span) { return span.near > 0 ? span.near : span.far; }

Cone random_cone(Dice& dice) {
    const DVec3 base = dice.direction() * dice(0, 2), axis = dice.direction();
    Cone cone{base, std::exp(dice(-3, 1)), base + axis * std::exp(dice(-2, 2)), std::exp(dice(-3, 1))};
    const double kind = dice(0, 4);
    if (kind < 1) cone.base_radius = 0;
    if (kind > 3) cone.cap_radius = kind > 3.5 ? 0 : cone.base_radius * (1 + std::exp(dice(-30, -10)));
    return cone;
}

}  // namespace

TEST_CASE("near and far cones of all kinds: hit or miss, and where") {
    Dice dice;
    constexpr int rays = 20000;
    for (const double reach : {0., 5.}) {
        int hits = 0, wrong = 0, off = 0;
        for (int i = 0; i < rays; ++i) {
            Cone cone = random_cone(dice);
            const double size = std::max({cone.base_radius, cone.cap_radius, cone.height()});
            const DVec3 from = dice.direction() * size * std::pow(10, dice(0, reach)) * 3.;
            const DVec3 aim = cone.base + (cone.cap - cone.base) * dice(-.2, 1.2) + dice.direction() * dice(0, size);
            const DVec3 d = naive::unit(aim - from);
            const double right = exact(cone, from, d), unsure = 0x1p-50 * (naive::length(from) + naive::length(aim));
            const Span<double> span = ours(cone, from, d);
            const bool hit = span.hit && span.far > 0;
            hits += hit;
            // An answer is wrong if it is not even right for a cone a few bits larger or smaller.
            if (hit != (right < INFINITY))
                wrong += hit != (exact(grown(cone, hit ? unsure : -unsure), from, d) < INFINITY);
            if (!hit || right == INFINITY) continue;
            const double t = first_of(span);
            const bool within = exact(grown(cone, unsure), from, d) <= t && t <= exact(grown(cone, -unsure), from, d);
            off += !within && std::abs(t - right) > unsure;
        }
        MESSAGE("up to 10^" << reach << " sizes away, of " << rays << " rays " << hits << " hit: wrong " << wrong
                            << ", elsewhere " << off);
        CHECK(hits > rays / 10);
        CHECK(wrong == 0);
        CHECK(off == 0);
    }
}

TEST_CASE("no ray along the side, closer to it than rounding, passes through a cone a few bits smaller") {
    Dice dice;
    int wrong = 0, hits = 0;
    for (int i = 0; i < 20000; ++i) {
        const Cone cone = random_cone(dice);
        const DVec3 a = cone.axis(), u = naive::unit(cross(a, dice.direction())), v = cross(a, u);
        const double slope = (cone.cap_radius - cone.base_radius) / cone.height(), slant = std::hypot(1, slope);
        const DVec3 line = (a + slope * u) / slant, normal = (u - slope * a) / slant;  // along the side, and off it
        const double place = dice(0, 1), radius = cone.base_radius + (cone.cap_radius - cone.base_radius) * place;
        const double turn = dice(0, 1) < .5 ? 0 : dice(0, 1) * std::exp(dice(-30, 0));
        const DVec3 d = naive::unit(line + turn * v + normal * (dice(-1, 1) * std::exp(dice(-36, -2))));
        const DVec3 aim = cone.base + place * (cone.cap - cone.base) + radius * (1 + std::exp(dice(-36, -2))) * u;
        const auto check = [&]<class T>(T) {
            const Vec3<T> o = naive::to<T>(aim - d * dice(0, 5)), direction = naive::to<T>(d);
            const DVec3 o2 = naive::to<double>(o), d2 = naive::to<double>(direction);
            const double size = std::max({cone.base_radius, cone.cap_radius, cone.height(), naive::length(o2)});
            const double unsure = 16 * double(std::numeric_limits<T>::epsilon()) * size;
            const Span<T> span = ours(cone, o, direction);
            const bool hit = span.hit && span.far > 0, right = exact(cone, o2, d2) < INFINITY;
            hits += hit;
            if (hit != right) wrong += hit != (exact(grown(cone, hit ? unsure : -unsure), o2, d2) < INFINITY);
        };
        check(1.f), check(1.);
    }
    CHECK(hits > 5000);
    CHECK(wrong == 0);
}

TEST_CASE("rays that start on a cone: none meets it again from outside, all cross it inside") {
    Dice dice;
    int starts[3] = {}, self = 0, lost = 0, outside = 0;
    for (int i = 0; i < 30000; ++i) {
        const Cone cone = random_cone(dice);
        const auto check = [&]<class T>(T) {
            const ConeKernel<T> own = kernel<T>(cone);
            const DVec3 from = cone.base + dice.direction() * 9.;
            DVec3 aim = cone.base + (cone.cap - cone.base) * dice(0, 1) + dice.direction() * dice(0, .1);
            if (dice(0, 1) < .1 && cone.base_radius == 0) aim = cone.base;
            if (dice(0, 1) < .1 && cone.cap_radius == 0) aim = cone.cap;
            const Ray<T> ray{naive::to<T>(from), naive::to<T>(naive::unit(aim - from)), T(-1)};
            const Span<T> span = own.span(ray, T(-1));
            if (!span.hit || !(span.near > 0)) return;
            const SurfacePoint<T> point = own.at(ray, span.near, span.near_face);
            ++starts[static_cast<int>(span.near_face)];
            CHECK(std::abs(naive::length(point.normal) - 1) < 8 * std::numeric_limits<T>::epsilon());
            // Any direction, or one close to the surface.
            Vec3<T> d = naive::to<T>(dice.direction());
            if (dice(0, 1) < .5)
                d = naive::unit(d - point.normal * (dot(d, point.normal) * T(1 - std::exp(dice(-30, 0)))));
            const Span<T> next = own.span(Ray<T>{point.position, d, span.near_face}, span.near_face);
            CHECK(next.near == 0);
            const T side = dot(point.normal, d);
            if (side < 0) CHECK(next.near_face == span.near_face);
            self += side > 0 && next.hit && next.far > 0;
            const double slack = 1e3 * double(std::numeric_limits<T>::epsilon()) * (cone.height() + 9);
            const bool deep =
                grown(cone, -slack).contains(naive::to<double>(point.position) + naive::to<double>(d) * .01);
            lost += side < 0 && deep && !(next.hit && next.far > T(.005));
            const DVec3 end = naive::to<double>(point.position) + naive::to<double>(d) * double(next.far);
            outside += side < 0 && next.far > 0 && !grown(cone, slack).contains(end);
        };
        check(1.f), check(1.);
    }
    MESSAGE("starts on side, base and cap: " << starts[0] << ", " << starts[1] << ", " << starts[2]);
    CHECK(std::min({starts[0], starts[1], starts[2]}) > 1000);
    CHECK(self == 0);
    CHECK(lost == 0);
    CHECK(outside == 0);
}

TEST_CASE("box and ball of a cone: around it, and tight") {
    Dice dice;
    for (int i = 0; i < 300; ++i) {
        const Cone cone = random_cone(dice);
        const DVec3 a = cone.axis(), any = dice.direction();
        const DVec3 u = naive::unit(cross(a, any)), v = cross(a, u);
        const Box box = cone.bounds();
        const Ball ball = kernel<double>(cone).ball();
        Box rims;
        double reach = 0;
        for (int k = 0; k < 720; ++k) {
            const DVec3 out = std::cos(k / 114.59155902616465) * u + std::sin(k / 114.59155902616465) * v;
            for (const DVec3& p : {cone.base + cone.base_radius * out, cone.cap + cone.cap_radius * out})
                rims.add(p), reach = std::max(reach, naive::length(p - ball.centre));
        }
        const double size = std::max({cone.base_radius, cone.cap_radius, cone.height()});
        CHECK(std::abs(reach - ball.radius) < 1e-12 * size);
        for (int c = 0; c < 3; ++c) {
            CHECK(std::abs(box.low[c] - rims.low[c]) < 2e-5 * size);
            CHECK(std::abs(box.high[c] - rims.high[c]) < 2e-5 * size);
            CHECK(box.low[c] <= rims.low[c] + 1e-14 * size);
            CHECK(box.high[c] >= rims.high[c] - 1e-14 * size);
        }
        const DVec3 p = cone.base + dice.direction() * dice(0, 3);
        CHECK(cone.contains(p) == referee::contains<long double>(cone, p));
    }
    CHECK(Cone{{0, 0, 0}, 1, {0, 0, 0}, 2}.fault() != nullptr);
    CHECK(Cone{{0, 0, 0}, 0, {0, 0, 1}, 0}.fault() != nullptr);
    CHECK(Cone{{0, 0, 0}, 0, {0, 0, 1}, 1}.fault() == nullptr);
}

TEST_CASE("a box is around what hardly leans") {
    // Naive: sqrt(1 - a^2) is 0 or 1e-8, and the edge of a wide disc sticks out of its box.
    for (const double lean : {1e-3, 3e-9, 1e-12, 0.})
        for (int axis = 0; axis < 3; ++axis) {
            CAPTURE(lean);
            DVec3 cap(0);
            cap[axis] = 1, cap[(axis + 1) % 3] = lean;
            const double wide = 1e6, edge = wide * lean / std::sqrt(1 + lean * lean), apart = 1e-15 * (1 + edge);
            for (const Box& box : {Cone{DVec3(0), wide, cap, wide}.bounds(), Cylinder{DVec3(0), cap, wide}.bounds()}) {
                CHECK(std::abs(box.low[axis] + edge) <= apart);
                CHECK(std::abs(box.high[axis] - 1 - edge) <= apart);
            }
        }
}
