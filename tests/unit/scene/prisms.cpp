// Prisms: where rays cross them, against the referee's formulas; how often; and what is inside.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/kinds/prism.h"
#include "tests/referee/dice.h"
#include "tests/referee/prism.h"
#include "tests/referee/random_scene.h"
#include "tests/unit/scene/placed_contours.h"

using namespace strahl;

namespace {

/// Compares crossings with the referee's, which are off by at most `error`.
template <class T>
void compare(double error) {
    Dice dice{1};
    for (int n = 0; n < 40; ++n) {
        const Prism prism = random_prism(dice);
        const PlacedContours<Prism, T> placed(prism);
        for (int m = 0; m < 12; ++m) {
            DVec3 to = point_near_body(dice), from = 5. * dice.direction();
            if (m == 0) from = {to.x, to.y, 5};         // along the walls
            if (m == 1) from = {from.x, from.y, to.z};  // along the caps
            const Ray<T> ray{cast<T>(from), cast<T>(normalize(to - from)), T(-1)};
            const auto found = placed.crossings(ray);
            auto wanted = referee::crossings<long double>(prism, {DVec3(ray.origin), DVec3(ray.direction)}, -1).list;
            std::ranges::sort(wanted, {}, [](const auto& own) { return own.t; });
            CHECK(found.size() % 2 == 0);
            REQUIRE(found.size() == wanted.size());
            for (std::size_t i = 0; i < found.size(); ++i) {
                const DVec3 normal(placed.at(ray, found[i]).normal);
                const auto apart = referee::error_of(found[i].t, normal, wanted[i], DVec3(ray.direction));
                CHECK(apart.off < error);
                CHECK(std::fabs(apart.cosine) > 1 - 100 * error);
            }
        }
    }
}

}  // namespace

TEST_CASE("prisms: rays cross them where the referee says") {
    compare<double>(1e-12);
    compare<float>(1e-4);
}

TEST_CASE("prisms: rays through the ends of pieces, and beside them, cross the surface an even number of times") {
    Dice dice{2};
    for (int n = 0; n < 60; ++n) {
        const Prism prism = random_prism(dice);
        const PlacedContours<Prism, float> placed(prism);
        const auto& data = *prism.data;
        for (const ContourPiece<double>& piece : data.pieces) {
            const DVec3 end(data.centre[0] + data.unit * piece.ax, data.centre[1] + data.unit * piece.ay,
                            dice.chance(.3) ? prism.base : dice.in(prism.base, prism.top));
            DVec3 way = dice.direction();
            if (dice.chance(.3)) way = {piece.hx, piece.hy, 0};  // along the curve
            if (dice.chance(.2)) way = {0, 0, 1};
            const DVec3 from = end - dice.in(0, 3) * normalize(way);
            const Ray<float> ray{cast<float>(from), cast<float>(normalize(way)), -1};
            CHECK(placed.crossings(ray).size() % 2 == 0);
        }
    }
}

TEST_CASE("prisms: rays that start on walls do not meet them there again, and meet what is ahead") {
    check_rays_that_start_on<Prism>(60, random_prism);
}

TEST_CASE("prisms: what is inside is what an odd number of contours surround") {
    const Prism ring{0, 1, ContourData::usual()};
    CHECK(ring.contains({.5, .5, .5}));
    CHECK_FALSE(ring.contains({.1, .1, .5}));
    CHECK_FALSE(ring.contains({.9, .9, .5}));
    CHECK_FALSE(ring.contains({.5, .5, 1.5}));
    Dice dice{4};
    for (int n = 0; n < 300; ++n) {
        const Prism prism = random_prism(dice);
        const DVec3 p = point_near_body(dice);
        CHECK(prism.contains(p) == referee::contains<long double>(prism, p));
    }
}
