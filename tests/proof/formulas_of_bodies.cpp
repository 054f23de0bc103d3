// Each formula of proofs on its own, against numbers of 113 bits: rays, bodies and lights that are off by some amount
// of any size, or by rounding alone, in the directions that hurt most.
//
//     PROOF_TRIALS=1000000 test_proof -tc='formulas*' -s     more of them
#include "tests/proof/cases.h"

using namespace strahl;
using namespace strahl::trial;

/// Rays that hardly lean, and lines that are off by as much as they are slanted.
TEST_CASE("formulas of cylinders' ends") {
    Closest between{"way in and out"};
    Dice dice(8);
    for (int i = 0; i < trials(); ++i) {
        const double height = std::pow(10, dice.in(-1, 1)), start = dice.chance(.5) ? -1 : dice.upto(2);
        const double slope = (dice.chance(.5) ? 1 : -1) * std::pow(10, dice.in(-6, 0));
        const double slope_error = std::abs(slope) * dice.in(0, 1.5), error = any_size(dice, -1) * height;
        // Rays that start on an end are there up to this.
        const double along = start == 1   ? error * dice.in(-1, 1)
                             : start == 2 ? height + error * dice.in(-1, 1)
                                          : height * dice.in(-.5, 1.5);
        const auto most = [&] { return R(dice.chance(.5) ? dice.in(-1, 1) : dice.chance(.5) ? 1 : -1); };
        const R exact_slope = R(slope) + most() * R(slope_error), off = R(along) + most() * R(error);
        if (exact_slope == 0) continue;
        const R to_base = start == 1 ? R(0) : R(-1) * off / exact_slope;
        const R to_cap = start == 2 ? R(0) : (R(height) - off) / exact_slope;
        const R near = to_base < to_cap ? to_base : to_cap, far = to_base < to_cap ? to_cap : to_base;
        if (far < 0) continue;  // all of it is behind the ray
        const double spare = 9 * unit_error<double>;
        const SpanBounds<double> span =
            between_ends(along, slope, height, error + spare * std::abs(along), slope_error + spare, start);
        const auto holds = [](R t, double low, double high) {
            return (low == -inf || R(low) <= t) && (high == inf || t <= R(high));
        };
        between.demand(holds(near, span.near_low, span.near_high) && holds(far, span.far_low, span.far_high));
    }
}

TEST_CASE("formulas of balls") { try_body<Sphere>(1); }
TEST_CASE("formulas of planes") { try_body<Plane>(2); }
TEST_CASE("formulas of cylinders") { try_body<Cylinder>(3); }
TEST_CASE("formulas of cones") { try_body<Cone>(14); }
