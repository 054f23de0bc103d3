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

namespace {

/// Returns a prism over a polygon whose corners lie on a circle: one that is convex, or if `skipped` is not 0, one that
/// passes over so many corners each time.
Prism random_star(Dice& dice, int corners, int skipped) {
    std::vector<double> angles;
    for (int i = 0; i < corners; ++i) angles.push_back(6.28 * (i + dice.in(.1, .9)) / corners);
    Contour outline;
    for (int i = 0; i < corners; ++i) {
        const double angle = angles[static_cast<std::size_t>(i * (skipped + 1) % corners)];
        const Contour::Point corner{std::cos(angle), std::sin(angle)};
        if (i == 0)
            outline.start = corner;
        else
            outline.strokes.push_back({corner, corner, {}});
    }
    const double height = std::pow(10., dice.in(-3, 0));
    return {-height, height, std::make_shared<const ContourData>(std::vector<Contour>{outline})};
}
/// Checks that lines which start inside, close to a cap, cross the surface before and behind.
template <class T>
void cross_from_inside() {
    Dice dice{5};
    for (int n = 0; n < 400; ++n) {
        const Prism prism = random_star(dice, 5 + dice.upto(4), 0);
        const PlacedContours<Prism, T> placed(prism);
        const DVec3 from(dice.in(-.1, .1), dice.in(-.1, .1), prism.top * (1 - std::pow(10., dice.in(-3, 0))));
        const auto found = placed.crossings({cast<T>(from), cast<T>(dice.direction()), T(-1)});
        REQUIRE(found.size() == 2);
        CHECK(found[0].t < 0);
        CHECK(found[1].t > 0);
    }
}

}  // namespace

TEST_CASE("prisms: lines that start inside, close to a cap, cross the surface before and behind") {
    cross_from_inside<double>();
    cross_from_inside<float>();
}

TEST_CASE("contours: a convex polygon has one outline of straight lines that goes around once") {
    Dice dice{6};
    for (int n = 0; n < 200; ++n) {
        CHECK(random_star(dice, 5 + dice.upto(5), 0).data->is_convex_polygon());
        CHECK(!random_star(dice, 5 + 2 * dice.upto(2), 1).data->is_convex_polygon());
        std::vector<Contour> changed = random_star(dice, 5 + dice.upto(5), 0).data->contours;
        Contour& outline = changed[0];
        switch (dice.upto(2)) {
            case 0:
                changed.push_back(outline);
                break;
            case 1:
                outline.start = {-.5 * outline.start[0], -.5 * outline.start[1]};  // a notch
                break;
            default:
                outline.strokes[1].control = {0, 0};  // a curve
        }
        CHECK(!ContourData(changed).is_convex_polygon());
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
