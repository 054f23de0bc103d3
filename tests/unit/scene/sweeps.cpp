// Sweeps: where rays cross them, against the referee's formulas; rays that start on them; and long ones.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "num/vec_math.h"
#include "scene/kinds/sweep/sweep.h"
#include "tests/referee/dice.h"
#include "tests/referee/random_scene.h"
#include "tests/referee/sweep.h"

using namespace strahl;

namespace {

template <class T>
struct PlacedSweep {
    SweepKernel<T> kernel{};
    const SweepPiece* pieces;

    explicit PlacedSweep(const SphereSweep& body) : pieces(body.data->pieces.data()) {
        body.emit<T>(WorldTransform(), [&](const SweepKernel<T>& own) { kernel = own; });
    }
    /// Rays are of doubles, or more digits, as in worlds of floats.
    std::vector<T> crossings(const Ray<T>& ray, int enough = 1000) const {
        using V = Doubles<T>;
        std::vector<T> found;
        kernel.each_crossing(pieces, enough, Ray<V>{Vec3<V>(ray.origin), Vec3<V>(ray.direction), V(0)}, V(ray.source),
                             true, [&](bool, V t, V) { found.push_back(static_cast<T>(t)); });
        return found;
    }
    SurfacePoint<T> at(const Ray<T>& ray, T t) const { return kernel.at(pieces, ray, t); }
};

/// A ray towards the sweep: any, across its path or along it, or to one of its balls.
template <class T>
Ray<T> random_ray(Dice& dice, const SphereSweep& body, int n) {
    const std::vector<SweptBall>& balls = body.data->balls;
    const auto k = static_cast<std::size_t>(1 + dice.upto(static_cast<int>(balls.size()) - 3));
    DVec3 to = dice.vector(-1, 1), from = 5. * dice.direction();
    if (n % 4 == 1) to = balls[k].centre, from = to - 5. * normalize(balls[k + 1].centre - to);
    if (n % 4 == 2) to = .5 * (balls[k].centre + balls[k + 1].centre);
    if (n % 4 == 3) from = {to.x, to.y, 5};
    return {cast<T>(from), cast<T>(normalize(to - from)), T(-1)};
}

/// Compares crossings with the referee's, which are off by at most `error` times the distance; grazed surfaces apart.
template <class T>
void compare_sweeps(double error) {
    Dice dice{1};
    int compared = 0, grazed = 0;
    for (int n = 0; n < 80; ++n) {
        SphereSweep body = random_sweep(dice);
        if (n % 8 == 0) {  // a plane path, which rays cross at right angles
            std::vector<SweptBall> flat = body.data->balls;
            for (SweptBall& own : flat) own.centre.z = .25;
            body.data = std::make_shared<const SweepData>(flat);
        }
        const PlacedSweep<T> placed(body);
        for (int m = 0; m < 12; ++m) {
            const Ray<T> ray = random_ray<T>(dice, body, m);
            const std::vector<T> found = placed.crossings(ray);
            auto wanted = referee::crossings<long double>(body, {DVec3(ray.origin), DVec3(ray.direction)}, -1).list;
            std::ranges::sort(wanted, {}, [](const auto& own) { return own.t; });
            CHECK(std::ranges::is_sorted(found));
            CHECK(found.size() % 2 == 0);
            if (found.size() != wanted.size()) {
                ++grazed;
                MESSAGE("sweep " << n << " ray " << m << ": " << found.size() << " of " << wanted.size());
                continue;
            }
            for (std::size_t i = 0; i < found.size(); ++i) {
                const DVec3 normal(placed.at(ray, found[i]).normal);
                const auto [off, cosine, slant] = referee::error_of(found[i], normal, wanted[i], DVec3(ray.direction));
                CHECK_MESSAGE(off * slant < error, n << " " << m << " " << i << " off " << off << " slant " << slant);
                CHECK_MESSAGE(cosine > 1 - 1e3 * error, n << " " << m << " " << i << " cosine " << cosine);
                ++compared;
            }
        }
    }
    CHECK(compared > 1000);
    CHECK(grazed < 4);
}

}  // namespace

TEST_CASE("sweeps: rays cross them where the referee says") {
    compare_sweeps<double>(1e-12);
    compare_sweeps<float>(1e-5);
    compare_sweeps<long double>(1e-12);
}

TEST_CASE("sweeps: rays that start on a surface do not meet it there again, and meet what is ahead") {
    Dice dice{3};
    int far = 0, near = 0, tried = 0;
    for (int n = 0; n < 100; ++n) {
        const SphereSweep body = random_sweep(dice);
        const PlacedSweep<float> placed(body);
        for (int m = 0; m < 10; ++m) {
            const Ray<float> ray = random_ray<float>(dice, body, m);
            const std::vector<float> found = placed.crossings(ray);
            if (found.empty()) continue;
            CHECK(placed.crossings(ray, 1).at(0) == found[0]);
            ++tried;
            const auto point = placed.at(ray, found[0]);
            std::vector<float> ahead = placed.crossings({point.position, ray.direction, 0.F});
            std::erase_if(ahead, [](float t) { return t <= 0; });
            near += ahead.size() != found.size() - 1;
            for (std::size_t i = 0; i + 1 < found.size() && i < ahead.size(); ++i)
                far += std::fabs(ahead[i] - (found[i + 1] - found[0])) > 1e-3;
            std::vector<float> back = placed.crossings({point.position, -ray.direction, 0.F});
            std::erase_if(back, [](float t) { return t <= 0; });
            near += !back.empty();
        }
    }
    CHECK(tried > 300);
    CHECK(near < 4);  // where a ray grazes the surface
    CHECK(far < 4);
}

TEST_CASE("sweeps: many pieces are one body, however they are grouped") {
    Dice dice{4};
    std::vector<SweptBall> balls;
    for (int i = 0; i < 120; ++i)
        balls.push_back({{2 * std::cos(.4 * i), 2 * std::sin(.4 * i), .05 * i - 3}, dice.in(.05, .25), false});
    const SphereSweep body{std::make_shared<const SweepData>(balls)};
    const PlacedSweep<double> placed(body);
    int compared = 0, inside = 0;
    for (int n = 0; n < 60; ++n) {
        const DVec3 from = 9. * dice.direction(), way = normalize(dice.vector(-2, 2) - from);
        const auto found = placed.crossings({Vec3<double>(from), Vec3<double>(way), -1.});
        auto wanted = referee::crossings<long double>(body, {from, way}, -1).list;
        std::ranges::sort(wanted, {}, [](const auto& own) { return own.t; });
        REQUIRE(found.size() == wanted.size());
        for (std::size_t i = 0; i < found.size(); ++i, ++compared)
            CHECK(std::fabs(static_cast<double>(found[i] - wanted[i].t)) < 1e-9);
        const DVec3 p = balls[static_cast<std::size_t>(dice.upto(119))].centre + dice.vector(-.3, .3);
        CHECK(body.contains(p) == referee::contains<long double>(body, p));
        inside += body.contains(p);
    }
    CHECK(compared > 100);
    CHECK(inside > 3);
}
