// Superellipsoids: where rays cross them, against the referee's formulas; rays that start on them; and powers.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "num/vec_math.h"
#include "scene/kinds/superellipsoid.h"
#include "tests/referee/dice.h"
#include "tests/referee/superellipsoid.h"

using namespace strahl;

namespace {

template <class T>
using PlacedSuperellipsoid = std::tuple_element_t<0, Superellipsoid::Kernels<T>>;

template <class T>
PlacedSuperellipsoid<T> placed(const Superellipsoid& body) {
    PlacedSuperellipsoid<T> kernel{};
    body.emit<T>(WorldTransform(), [&](const PlacedSuperellipsoid<T>& own) { kernel = own; });
    return kernel;
}

/// Makes one whose edges are from nearly sharp to those of a double cone; often one of the limits.
Superellipsoid random_superellipsoid(Dice& dice) {
    const auto roundness = [&] {
        return dice.chance(.3) ? 1. + dice.upto(1) : dice.chance(.3) ? .02 : dice.in(.05, 2);
    };
    return {roundness(), roundness()};
}
/// Makes a ray towards a point in the box; every third along an axis, or from far away.
template <class T>
Ray<T> random_ray(Dice& dice, int n) {
    const DVec3 to = dice.vector(-.999, .999);
    DVec3 from = to + dice.arrow(3, n % 3 == 0 ? 300 : 5);
    if (n % 3 == 1) from = to, from[n % 9 / 3] = 4;
    return {cast<T>(from), cast<T>(normalize(to - from)), T(-1)};
}

/// Compares spans with the referee's, from which they are off by at most `error` times the distance.
template <class T>
void compare_superellipsoids(double error) {
    Dice dice{1};
    int compared = 0, grazed = 0;
    for (int n = 0; n < 60; ++n) {
        const Superellipsoid body = random_superellipsoid(dice);
        const auto kernel = placed<T>(body);
        for (int m = 0; m < 9; ++m) {
            const Ray<T> ray = random_ray<T>(dice, m);
            const auto span = kernel.span(ray, T(-1));
            const auto wanted = referee::crossings<Quadruple>(body, {DVec3(ray.origin), DVec3(ray.direction)}, -1).list;
            if (span.hit == wanted.empty()) {
                ++grazed;
                continue;
            }
            for (std::size_t i = 0; i < wanted.size(); ++i) {
                const T t = i == 0 ? span.near : span.far;
                const DVec3 normal(kernel.at(ray, t, T(0)).normal);
                const auto [off, cosine, slant] = referee::error_of(t, normal, wanted[i], DVec3(ray.direction));
                const double far = std::fabs(double(t));
                CHECK_MESSAGE(off * slant < error * far, body.e << " " << body.n << " off " << off);
                CHECK_MESSAGE(cosine > 1 - 1e4 * error, body.e << " " << body.n << " cosine " << cosine);
                ++compared;
            }
        }
    }
    CHECK(compared > 500);
    CHECK(grazed < 4);
}

}  // namespace

TEST_CASE("superellipsoids: rays cross them where the referee says") {
    compare_superellipsoids<double>(1e-14);
    compare_superellipsoids<float>(1e-6);
    compare_superellipsoids<long double>(1e-16);
}

TEST_CASE("superellipsoids: a ray from the surface inwards leaves on the other side, one outwards meets nothing") {
    Dice dice{2};
    for (int n = 0; n < 300; ++n) {
        const auto kernel = placed<float>(random_superellipsoid(dice));
        const Ray<float> ray = random_ray<float>(dice, n);
        const auto whole = kernel.span(ray, -1.F);
        if (!whole.hit || !(whole.near > 0)) continue;
        const auto point = kernel.at(ray, whole.near, 0.F);
        const auto inwards = kernel.span(Ray<float>{point.position, ray.direction, 0}, 0.F);
        CHECK(inwards.near == 0);
        const float slant = -dot(point.normal, ray.direction), width = whole.far - whole.near;
        CHECK(std::fabs(inwards.far - width) * slant < 3e-6F * (1 + whole.near));
        const auto outwards = kernel.span(Ray<float>{point.position, -ray.direction, 0}, 0.F);
        CHECK(outwards.far <= 0);
    }
}

TEST_CASE("superellipsoids: sharp ones are boxes, and rays along their faces and axes have finite normals") {
    const auto kernel = placed<double>({1e-6, 1e-6});
    const auto box = kernel.span(Ray<double>{{-3, .2, .3}, {1, 0, 0}, -1}, -1.);
    CHECK(box.hit);
    CHECK(box.near == doctest::Approx(2).epsilon(1e-12));
    CHECK(box.far == doctest::Approx(4).epsilon(1e-12));
    for (const double e : {1e-6, .1, 1., 2.})
        for (const double n : {1e-6, .1, 1., 2.})
            for (int axis = 0; axis < 3; ++axis) {
                Ray<double> ray{DVec3(0), DVec3(0), -1};
                ray.origin[axis] = -3, ray.direction[axis] = 1;
                const auto own = placed<double>({e, n});
                const auto span = own.span(ray, -1.);
                CHECK(span.hit);
                CHECK(span.near == doctest::Approx(2).epsilon(1e-9));
                CHECK(length(own.at(ray, span.near, 0.).normal) == doctest::Approx(1).epsilon(1e-9));
            }
    CHECK(Superellipsoid{2.1, 1}.fault() != nullptr);
    CHECK(Superellipsoid{1, 1e-7}.fault() != nullptr);
}

TEST_CASE("powers by series are off by some units in the last place, with fewer terms by more") {
    Dice dice{3};
    for (int n = 0; n < 20000; ++n) {
        const double x = n % 2 ? dice.in(.5, 2.1) : std::exp2(dice.in(-70, 0)), p = dice.in(0, n % 3 ? 3 : 12);
        const double wanted = std::pow(x, p), size = std::fabs(p * std::log2(x));
        CHECK(std::fabs(power_by_series(x, p) - wanted) <= (2 + size) * 1e-15 * wanted);
        CHECK(std::fabs(power_by_series<6, 9>(x, p) - wanted) <= (2 + size) * 2e-10 * wanted);
        if (size > 125) continue;
        const float of_floats = power_by_series<4, 7>(float(x), float(p));
        CHECK(std::fabs(of_floats - std::pow(double(float(x)), double(float(p)))) <= (2 + size) * 2e-7 * wanted);
    }
    CHECK(power_by_series(1., 1e6) == 1);
    CHECK(power_by_series(.5, 1e6) < 1e-300);
    CHECK(power_by_series<4, 7>(.5F, 1e6F) < 1e-37F);
}
