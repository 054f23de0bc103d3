// Mirrors that face each other: errors grow from bounce to bounce as in theory, not faster, and start at the last bit.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "scene/kinds/sphere.h"
#include "tests/stability/naive.h"
#include "tests/stability/stage.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

/// Growth of a small error per bounce between two spheres of radius 1 with this gap: the larger eigenvalue of
/// [[1, t], [2/r, 1 + 2t/r]], which maps (position, direction) from bounce to bounce.
double growth(double gap) { return 1 + gap + std::sqrt((1 + gap) * (1 + gap) - 1); }

/// Two unit balls on an axis that is not aligned with a coordinate, and a ray from one to the centre of the other.
template <class T>
struct Pair {
    Vec3<T> axis, centre[2], o, d;
    explicit Pair(double distance, double tilt) {
        const DVec3 a = DVec3(2, 3, 6) / 7., first{.1, .2, .3}, across = DVec3(3, -2, 0) / std::sqrt(13.);
        axis = naive::to<T>(a);
        centre[0] = naive::to<T>(first), centre[1] = naive::to<T>(first + a * distance);
        d = naive::to<T>(a + across * tilt);
        d = d / naive::length(d);
        o = naive::to<T>(first + a);
    }
};
constexpr int most = 100;

/// The distance of each bounce from the axis, until the ray leaves.
template <class T>
std::vector<double> bounces(double distance, double tilt) {
    Pair<T> pair(distance, tilt);
    std::vector<double> offsets;
    for (int i = 0; i < most; ++i) {
        const SphereKernel<T> ball{pair.centre[(i + 1) % 2], 1};
        const Ray<T> ray{pair.o, pair.d, -1};
        const Span<T> span = ball.span(ray, T(-1));
        if (!span.hit || !(span.near > 0)) break;
        const SurfacePoint<T> point = ball.at(ray, span.near, T(0));
        pair.o = point.position, pair.d = naive::mirrored(pair.d, point.normal);
        pair.d = pair.d * (T(1.5) - T(.5) * naive::times(pair.d, pair.d));
        const Vec3<T> off = point.normal - pair.axis * naive::times(pair.axis, point.normal);
        offsets.push_back(static_cast<double>(naive::length(off)));
    }
    return offsets;
}
/// Counts bounces by the formula of 1999, with rays that start 1e-4 further on.
std::size_t naive_bounces(double distance) {
    Pair<float> pair(distance, 0);
    for (int i = 0; i < most; ++i) {
        const Vec3<float> centre = pair.centre[(i + 1) % 2];
        const auto [near, far, hit] = naive::sphere<float>(pair.o, pair.d, centre, 1);
        if (!hit || !(near > 0)) return i;
        const Vec3<float> p = pair.o + pair.d * near;
        pair.d = naive::mirrored(pair.d, p - centre);
        pair.o = p + pair.d * 1e-4f;
    }
    return most;
}

/// Four mirror balls that touch each other, lit from four sides (P. Bourke, "Wada basins", 1998).
Scene wada() {
    Stage stage;
    stage.look({0, .577, -6}, {0, .577, .5}, 14, {0, -1, 0}).background({.1, .1, .2});
    for (const DVec3& centre : {DVec3{-1, 0, 0}, {1, 0, 0}, {0, 1.7320508, 0}, {0, .57735, 1.632993}})
        stage.put(Sphere{centre, 1}, mirror(1));
    stage.put(Plane{{0, -9, 0}, {0, -9, 1}, {1, -9, 0}}, glow({1, 0, 0}));
    stage.put(Plane{{-9, 0, 0}, {-9, 1, 0}, {-9, 0, 1}}, glow({0, 1, 0}));
    stage.put(Plane{{9, 0, 0}, {9, 0, 1}, {9, 1, 0}}, glow({0, 0, 1}));
    return stage.scene;
}

}  // namespace

TEST_CASE("the growth per bounce between two mirror balls, measured beside theory") {
    int naive_sum = 0, our_sum = 0;
    for (const double distance : {2.1, 2.5, 3., 4., 6., 10.}) {
        CAPTURE(distance);
        const double theory = growth(distance - 2), per_bit = std::log(2) / std::log(theory);
        const auto tilted = bounces<long double>(distance, 1e-12);
        // After it has settled, and before it is so large that more than the curvature of the spheres matters.
        std::size_t from = 2, to = from;
        while (to + 1 < tilted.size() && tilted[to + 1] < .01) ++to;
        const double measured = std::pow(tilted[to] / tilted[from], 1. / double(to - from));
        // A ray along the axis would stay for ever. Only rounding makes it leave, after (bits) / log2(growth) bounces.
        const auto single = bounces<float>(distance, 0).size(), twice = bounces<double>(distance, 0).size(),
                   extended = bounces<long double>(distance, 0).size(), naive_single = naive_bounces(distance);
        MESSAGE("distance " << distance << ": growth " << measured << ", in theory " << theory
                            << "; bounces until nothing is left: float " << single << " (theory " << 24 * per_bit
                            << ", naive " << naive_single << "), double " << twice << " (" << 53 * per_bit
                            << "), extended " << extended << " (" << 64 * per_bit << ")");
        CHECK(measured == doctest::Approx(theory).epsilon(.01));
        CHECK(std::abs(double(single) - 24 * per_bit) <= 2 + 3 * per_bit);
        CHECK(std::abs(double(twice) - 53 * per_bit) <= 2 + 3 * per_bit);
        naive_sum += static_cast<int>(naive_single), our_sum += static_cast<int>(single);
    }
    CHECK(naive_sum < our_sum);
}

TEST_CASE("four touching mirror balls") {
    const Scene scene = wada();
    for (const int depth : {5, 20, 50}) {
        CAPTURE(depth);
        const Still shot{.width = 64, .height = 48, .depth = depth};
        const Frame exact = shoot(scene, Precision::extended, shot), single = shoot(scene, Precision::float32, shot),
                    twice = shoot(scene, Precision::float64, shot);
        CHECK(not_finite(single) + not_finite(twice) + not_finite(exact) == 0);
        MESSAGE("depth " << depth << ": other pixels in float " << share_apart(single, exact, 1. / 510)
                         << ", in double " << share_apart(twice, exact, 1. / 510));
        CHECK(share_apart(single, exact, 1. / 510) < .01);
        CHECK(share_apart(twice, exact, 1. / 510) == 0);
        for (const Precision precision : precisions)
            CHECK(shoot(scene, precision, {64, 48, depth, 1}) == shoot(scene, precision, {64, 48, depth, 3}));
    }
}

TEST_CASE("two flat mirrors do not multiply errors: 200 bounces") {
    Stage stage;
    stage.look({0, 0, 0}, {0, 1, .01}, 20).light({.2, -1, .1});
    Material shiny = mirror(1);
    shiny.diffuse = .01, shiny.rgb = {1, .5, .2};
    stage.put(Plane{{0, 2, 0}, {0, 2, 1}, {1, 2, 0}}, shiny).put(Plane{{0, -2, 0}, {1, -2, 0}, {0, -2, 1}}, shiny);
    stage.put(Sphere{{.3, 1, .2}, .25}, paint({.2, .4, .8}));
    const Still shot{.depth = 200};
    const Frame exact = shoot(stage.scene, Precision::extended, shot);
    CHECK(share_apart(shoot(stage.scene, Precision::float64, shot), exact, 1e-9) < .005);
    CHECK(share_apart(shoot(stage.scene, Precision::float32, shot), exact, 1. / 255) < .02);
}
