// Sweeps: where rays cross them, against the referee's formulas; rays that start on them; and long ones.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/kinds/sweep/sweep.h"
#include "tests/referee/dice.h"
#include "tests/referee/random_scene.h"
#include "tests/unit/scene/placed_pieces.h"

using namespace strahl;

namespace {

/// Makes a sweep; every eighth has a plane path, which rays cross at right angles.
SphereSweep sweep_of(Dice& dice, int n) {
    SphereSweep body = random_sweep(dice);
    if (n % 8 == 0) {
        std::vector<SweptBall> flat = body.data->balls;
        for (SweptBall& own : flat) own.centre.z = .25;
        body.data = std::make_shared<const SweepData>(flat);
    }
    return body;
}

/// Makes a ray towards the sweep: any, across its path or along it, or to one of its balls.
RayBetween ray_to_sweep(Dice& dice, const SphereSweep& body, int n) {
    const std::vector<SweptBall>& balls = body.data->balls;
    const auto k = static_cast<std::size_t>(1 + dice.upto(static_cast<int>(balls.size()) - 3));
    DVec3 to = dice.vector(-1, 1), from = 5. * dice.direction();
    if (n % 4 == 1) to = balls[k].centre, from = to - 5. * normalize(balls[k + 1].centre - to);
    if (n % 4 == 2) to = .5 * (balls[k].centre + balls[k + 1].centre);
    if (n % 4 == 3) from = {to.x, to.y, 5};
    return {from, to};
}

}  // namespace

TEST_CASE("sweeps: rays cross them where the referee says") {
    compare_crossings<double>(sweep_of, ray_to_sweep, 1e-12);
    compare_crossings<float>(sweep_of, ray_to_sweep, 1e-5);
    compare_crossings<long double>(sweep_of, ray_to_sweep, 1e-12);
}

TEST_CASE("sweeps: rays that start on a surface do not meet it there again, and meet what is ahead") {
    check_rays_on_pieces(sweep_of, ray_to_sweep);
}

TEST_CASE("sweeps: many pieces are one body, however they are grouped") {
    Dice dice{4};
    std::vector<SweptBall> balls;
    for (int i = 0; i < 120; ++i)
        balls.push_back({{2 * std::cos(.4 * i), 2 * std::sin(.4 * i), .05 * i - 3}, dice.in(.05, .25), false});
    const SphereSweep body{std::make_shared<const SweepData>(balls)};
    const auto near = [&] { return balls[static_cast<std::size_t>(dice.upto(119))].centre + dice.vector(-.3, .3); };
    CHECK(compare_many(body, dice, 2, 100, near) > 3);
}
