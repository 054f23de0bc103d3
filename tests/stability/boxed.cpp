// Boxes as bodies: in their own faces' planes, through edges, thin, slanted, from afar and from their own faces.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "scene/kinds/box.h"
#include "tests/referee/box.h"
#include "tests/stability/naive.h"
#include "tests/stability/stage.h"

using namespace strahl;
using namespace strahl::stability;
using naive::unit;

namespace {

template <class T>
BoxKernel<T> kernel(const Cuboid& box, const WorldTransform& to_world = {}) {
    BoxKernel<T> result;
    box.emit<T>(to_world, [&](const BoxKernel<T>& own) { result = own; });
    return result;
}
template <class T>
Span<T> ours(const Cuboid& box, const Vec3<T>& o, const Vec3<T>& d) {
    return kernel<T>(box).span(Ray<T>{o, d, T(-1)}, T(-1));
}
/// The slab test of many books: products with 1/d, ordered with min and max.
template <class T>
bool naive_box(const Cuboid& box, const Vec3<T>& o, const Vec3<T>& d) {
    T near = -T(INFINITY), far = T(INFINITY);
    for (int i = 0; i < 3; ++i) {
        const T low = (T(box.corner[i]) - o[i]) * (1 / d[i]), high = (T(box.opposite[i]) - o[i]) * (1 / d[i]);
        near = std::max(std::min(low, high), near), far = std::min(std::max(low, high), far);
    }
    return near <= far;
}
struct Exact {
    double near = NAN, far = NAN;
    bool hit() const { return near <= far; }
};
Exact exact(const Cuboid& box, const DVec3& o, const DVec3& d) {
    const auto found = referee::crossings<Quadruple>(box, {o, d}, -1);
    if (found.list.size() < 2) return {};
    return {static_cast<double>(found.list[0].t), static_cast<double>(found.list[1].t)};
}
Cuboid grown(const Cuboid& box, double by) {
    const Box b = box.bounds();
    return {b.low - by, b.high + by};
}
/// A matrix of any three vectors that is not all too flat.
glm::dmat4 random_matrix(Dice& dice) {
    for (;;) {
        const DVec3 x = dice.direction(), y = dice.direction(), z = dice.direction();
        if (std::abs(naive::times(x, cross(y, z))) < .1) continue;
        const DVec3 at = dice.direction() * 2.;
        return {{x.x, x.y, x.z, 0}, {y.x, y.y, y.z, 0}, {z.x, z.y, z.z, 0}, {at.x, at.y, at.z, 1}};
    }
}

}  // namespace

TEST_CASE("a ray in the plane of a face meets the box, with zeros of either sign: boxes that touch leave no gap") {
    int naive_wrong = 0;
    const Cuboid box{{0, 0, 0}, {1, 1, 1}};
    for (const double zero : {0., -0.})
        for (const double x : {-.5, -0x1p-53, 0., .5, 1., 1 + 0x1p-52, 1.5})
            for (const double sign : {1., -1.})
                for (int axis = 0; axis < 3; ++axis) {
                    CAPTURE(x);
                    CAPTURE(zero);
                    DVec3 o(.5), d(zero);
                    o[axis] = x, o[(axis + 1) % 3] = .5 - 1.5 * sign, d[(axis + 1) % 3] = sign;
                    const bool right = x >= 0 && x <= 1;
                    naive_wrong += naive_box(box, o, d) != right;
                    const Span<double> span = ours(box, o, d);
                    CHECK(!std::isnan(span.near + span.far));
                    CHECK(span.hit == right);
                    if (span.hit) CHECK(span.near == 1);
                    if (span.hit) CHECK(span.far == 2);
                }
    MESSAGE("naive: " << naive_wrong << " of 84 wrong");
    CHECK(naive_wrong > 0);
}

TEST_CASE("the corners come in any order, and POV-Ray gets the lower one first") {
    const Cuboid box{{1, -2, 3}, {-1, 2, -3}};
    CHECK(box.pov() == std::tuple("box", DVec3(-1, -2, -3), DVec3(1, 2, 3)));
    CHECK(box.contains({0, 1, 2}));
    CHECK(!box.contains({0, 2, 2}));
    const Span<float> span = ours<float>(box, {0, 0, 10}, {0, 0, -1});
    CHECK(span.near == 7);
    CHECK(span.far == 13);
    CHECK(box.fault() == nullptr);
    CHECK(Cuboid{{0, 0, 0}, {1, 0, 1}}.fault() != nullptr);
    CHECK(Cuboid{{0, 0, 0}, {1, 5e-324, 1}}.fault() != nullptr);
    const Ball ball = kernel<double>(box).ball();
    CHECK(ball.radius == doctest::Approx(std::sqrt(14)));
}

TEST_CASE("near, far and thin boxes: hit or miss, where, and at which face") {
    Dice dice;
    constexpr int rays = 20000;
    for (const double reach : {0., 5.}) {
        int hits = 0, wrong = 0, off = 0, other_face = 0;
        for (int i = 0; i < rays; ++i) {
            DVec3 half(std::exp(dice(-2, 1)), std::exp(dice(-2, 1)), std::exp(dice(-2, 1)));
            if (dice(0, 1) < .5) half[static_cast<int>(dice(0, 3))] *= 1e-6;
            const DVec3 centre = dice.direction();
            const Cuboid box{centre - half, centre + half};
            const DVec3 from = dice.direction() * std::pow(10, dice(0, reach)) * 9.;
            const DVec3 aim = centre + half * DVec3(dice(-1.3, 1.3), dice(-1.3, 1.3), dice(-1.3, 1.3));
            const DVec3 d = naive::unit(aim - from);
            const Exact right = exact(box, from, d);
            const double unsure = 0x1p-50 * naive::length(from);
            const Span<double> span = ours(box, from, d);
            hits += span.hit;
            if (span.hit != right.hit())
                wrong += span.hit != exact(grown(box, span.hit ? unsure : -unsure), from, d).hit();
            if (!span.hit || !right.hit()) continue;
            const Exact large = exact(grown(box, unsure), from, d), small = exact(grown(box, -unsure), from, d);
            off += !(large.near <= span.near && span.far <= large.far);
            off += small.hit() && !(span.near <= small.near && small.far <= span.far);
            const int face = referee::crossings<Quadruple>(box, {from, d}, -1).list[0].face;
            other_face += span.near_face != face && small.hit() && right.far - right.near > 1e3 * unsure;
        }
        MESSAGE("up to 10^" << reach << " away, of " << rays << " rays " << hits << " hit: wrong " << wrong
                            << ", elsewhere " << off << ", other face " << other_face);
        CHECK(hits > rays / 10);
        CHECK(wrong == 0);
        CHECK(off == 0);
        CHECK(other_face < rays / 1000);
    }
}

TEST_CASE("under any transformation: the parallelepiped is where its corners are") {
    Dice dice;
    int hits = 0;
    for (int i = 0; i < 5000; ++i) {
        const Cuboid box{dice.direction(), dice.direction() + DVec3(.01)};
        if (std::min({box.bounds().size().x, box.bounds().size().y, box.bounds().size().z}) < .01) continue;
        WorldTransform to_world{random_matrix(dice), 0, dice.direction(), .25};
        const BoxKernel<double> own = kernel<double>(box, to_world);
        // The same ray in both spaces.
        const glm::dmat4 back = glm::inverse(to_world.matrix);
        const DVec3 middle = transform_point(to_world.matrix, box.bounds().centre());
        const DVec3 o = dice.direction() * 2., d = naive::unit(middle + dice.direction() * dice(0, 1) - o);
        const DVec3 from = transform_point(back, o), along = glm::dmat3(back) * d;
        const DVec3 world = to_world.place(o);
        const Span<double> span = own.span(Ray<double>{world, d, -1}, -1.);
        const Exact right = exact(box, from, along);
        if (!right.hit() || right.far - right.near < 1e-9) continue;
        REQUIRE(span.hit);
        ++hits;
        CHECK(span.near == doctest::Approx(right.near * .25));
        CHECK(span.far == doctest::Approx(right.far * .25));
        if (!(span.near > 0)) continue;
        const SurfacePoint<double> point = own.at(Ray<double>{world, d, -1}, span.near, span.near_face);
        CHECK(naive::length(point.normal) == doctest::Approx(1));
        CHECK(naive::times(point.normal, d) < 0);
        CHECK(naive::length(point.position - world - d * span.near) < 1e-12);
        CHECK(naive::length(point.position - own.ball().centre) <= own.ball().radius * (1 + 1e-12));
    }
    CHECK(hits > 300);
}

TEST_CASE("rays that start on a box: none meets it again from outside, all cross it inside, however thin it is") {
    Dice dice;
    int starts[6] = {}, self = 0, lost = 0;
    for (const double thickness : {1., 1e-3, 1e-9, 1e-15})
        for (int i = 0; i < 10000; ++i) {
            const Cuboid box{{-1, -1, -thickness}, {1, 1, thickness}};
            WorldTransform to_world{random_matrix(dice)};
            const auto check = [&]<class T>(T) {
                const BoxKernel<T> own = kernel<T>(box, to_world);
                const DVec3 aim = to_world.point({dice(-.9, .9), dice(-.9, .9), 0}),
                            from = aim + dice.direction() * 9e3;
                const Ray<T> ray{naive::to<T>(from), naive::to<T>(naive::unit(aim - from)), T(-1)};
                const Span<T> span = own.span(ray, T(-1));
                if (!span.hit) return;
                const SurfacePoint<T> point = own.at(ray, span.near, span.near_face);
                ++starts[static_cast<int>(span.near_face)];
                CHECK(dot(point.normal, ray.direction) < T(1e-6));
                // On its face, to the last bits of the point's own coordinates.
                const Vec3<T> row = own.row(span.near_face);
                const T off = dot(row, point.position - own.centre) - (own.high(span.near_face) ? T(1) : T(-1));
                CHECK(std::abs(off) / naive::length(row) < 16 * std::numeric_limits<T>::epsilon());
                Vec3<T> d = naive::to<T>(dice.direction());
                if (dice(0, 1) < .5)
                    d = naive::unit(d - point.normal * (dot(d, point.normal) * T(1 - std::exp(dice(-30, 0)))));
                const Span<T> next = own.span(Ray<T>{point.position, d, span.near_face}, span.near_face);
                CHECK(next.near == 0);
                const T side = dot(point.normal, d);
                self += side > 0 && next.hit && next.far > 0;
                if (span.near_face >= 4) lost += side < T(-1e-6) && !(next.hit && next.far > 0);
            };
            check(1.f), check(1.);
        }
    CHECK(std::min({starts[0], starts[1], starts[2], starts[3], starts[4], starts[5]}) > 100);
    CHECK(self == 0);
    CHECK(lost == 0);
}
