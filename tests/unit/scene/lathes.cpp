// Lathes: where rays cross them, against the referee's formulas; how often; and what is inside.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/kinds/lathe.h"
#include "tests/referee/dice.h"
#include "tests/referee/lathe.h"
#include "tests/referee/random_scene.h"
#include "tests/unit/scene/placed_contours.h"

using namespace strahl;

namespace {

Lathe lathe_of(std::vector<Contour> contours) {
    return {std::make_shared<const ContourData>(std::move(contours), true)};
}

/// Compares crossings with the referee's, which are off by at most `error`; grazed surfaces apart.
template <class T>
void compare_lathes(double error) {
    Dice dice{1};
    int compared = 0, grazed = 0;
    for (int n = 0; n < 80; ++n) {
        const Lathe lathe = random_lathe(dice);
        const PlacedContours<Lathe, T> placed(lathe);
        for (int m = 0; m < 12; ++m) {
            DVec3 to = point_near_body(dice), from = 5. * dice.direction();
            if (m == 0) from = {to.x, 5, to.z};                // along the axis
            if (m == 1) from = {from.x, to.y, from.z};         // level
            if (m == 2) from = {from.x, to.y + 1e-5, from.z};  // nearly level
            if (m == 3) from = {from.x, to.y + 1e-2, from.z};
            if (m == 4) to = {0, to.y, 0};  // through the axis
            if (m == 5) from = {to.x + 1e-5, 5, to.z};
            const Ray<T> ray{cast<T>(from), cast<T>(normalize(to - from)), T(-1)};
            const auto found = placed.crossings(ray);
            auto wanted = referee::crossings<Quadruple>(lathe, {DVec3(ray.origin), DVec3(ray.direction)}, -1).list;
            std::ranges::sort(wanted, {}, [](const auto& own) { return own.t; });
            CHECK(found.size() % 2 == 0);
            if (found.size() != wanted.size()) {
                ++grazed;
                MESSAGE("lathe " << n << " ray " << m << ": " << found.size() << " of " << wanted.size());
                continue;
            }
            for (std::size_t i = 0; i < found.size(); ++i) {
                const DVec3 normal(placed.at(ray, found[i]).normal);
                const auto [off, cosine, slant] =
                    referee::error_of(found[i].t, normal, wanted[i], DVec3(ray.direction));
                CHECK_MESSAGE(off * slant < error, n << " " << m << " " << i << " off " << off << " slant " << slant);
                CHECK_MESSAGE(std::fabs(cosine) > 1 - 100 * error, n << " " << m << " " << i << " cosine " << cosine);
                ++compared;
            }
        }
    }
    CHECK(compared > 1000);
    CHECK(grazed < 3);
}

}  // namespace

TEST_CASE("lathes: rays cross them where the referee says") {
    compare_lathes<double>(1e-11);
    compare_lathes<float>(1e-4);
    compare_lathes<long double>(1e-11);
}

TEST_CASE("lathes: rays through the ends of pieces, and beside them, cross the surface an even number of times") {
    Dice dice{2};
    for (int n = 0; n < 60; ++n) {
        const Lathe lathe = random_lathe(dice);
        const PlacedContours<Lathe, float> placed(lathe);
        const ContourData& data = *lathe.data;
        for (const ContourPiece<double>& piece : data.pieces) {
            const double turn = dice.in(0, 6.3);
            const DVec3 end(data.unit * piece.ax * std::cos(turn), data.centre[1] + data.unit * piece.ay,
                            data.unit * piece.ax * std::sin(turn));
            DVec3 way = dice.direction();
            if (dice.chance(.3)) way.y = 0;
            if (dice.chance(.2)) way = {0, 1, 0};
            const DVec3 from = end - dice.in(0, 3) * normalize(way);
            const Ray<float> ray{cast<float>(from), cast<float>(normalize(way)), -1};
            CHECK(placed.crossings(ray).size() % 2 == 0);
        }
    }
}

TEST_CASE("lathes: level rays through an edge meet the surface on both sides") {
    const PlacedContours<Lathe, double> placed(lathe_of({{{0, -1}, {{{1, 0}, {1, 0}}, {{0, 1}, {0, 1}}}}}));
    const auto found = placed.crossings({Vec3<double>(-3, 0, 0), Vec3<double>(1, 0, 0), -1.});
    REQUIRE(found.size() == 2);
    CHECK(found[0].t == doctest::Approx(2));
    CHECK(found[1].t == doctest::Approx(4));
}

TEST_CASE("lathes: rays that start on a surface do not meet it there again, and meet what is ahead") {
    check_rays_that_start_on<Lathe>(100, random_lathe);
}

TEST_CASE("lathes: what is inside is what an odd number of contours surround") {
    const Lathe ring = lathe_of({{{1, 0}, {{{2, 0}, {2, 0}}, {{2, 1}, {2, 1}}, {{1, 1}, {1, 1}}, {{1, 0}, {1, 0}}}}});
    CHECK_FALSE(ring.open());
    CHECK(ring.contains({0, .5, 1.5}));
    CHECK_FALSE(ring.contains({0, .5, .5}));
    CHECK_FALSE(ring.contains({0, 1.5, 1.5}));
    CHECK(lathe_of({{{1, 0}, {{{1, 1}, {1, 1}}}}}).open());
    CHECK_FALSE(lathe_of({{{0, 0}, {{{1, 1}, {0, 1}}}}}).open());
    Dice dice{4};
    for (int n = 0; n < 300; ++n) {
        const Lathe lathe = random_lathe(dice);
        const DVec3 p = point_near_body(dice);
        CHECK(lathe.contains(p) == referee::contains<long double>(lathe, p));
    }
}
