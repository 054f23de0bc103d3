// Prisms: where rays cross them, against the referee's formulas; how often; and what is inside.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "scene/kinds/prism.h"
#include "tests/referee/dice.h"
#include "tests/referee/prism.h"
#include "tests/referee/random_scene.h"

using namespace strahl;

namespace {

/// A prism's kernel in its own space, and its pieces.
template <class T>
struct Placed {
    const Prism& prism;
    std::vector<ContourPiece<T>> pieces;
    PrismKernel<T> kernel{};

    explicit Placed(const Prism& prism) : prism(prism) {
        for (const auto& [ax, ay, cx, cy, hx, hy, ex, ey, dx, dy] : prism.data->pieces)
            pieces.push_back({T(ax), T(ay), T(cx), T(cy), T(hx), T(hy), T(ex), T(ey), T(dx), T(dy)});
        prism.emit<T>(WorldTransform(), [&](const PrismKernel<T>& own) { kernel = own; });
    }
    ContourPiece<T> piece_of(T face) const {
        return pieces[std::min(static_cast<std::size_t>(std::max(face - 2, T(0))), pieces.size() - 1)];
    }
    struct Place {
        T t, face;
    };
    /// Returns all crossings, the nearest first.
    std::vector<Place> crossings(const Ray<T>& ray) const {
        std::vector<Place> found;
        kernel.each_crossing(
            pieces.data(), [&](T face) { return piece_of(face); }, ray, ray.source, true,
            [&](bool, T t, T face) {
                found.push_back({t, face});
            });
        std::ranges::sort(found, {}, &Place::t);
        return found;
    }
    SurfacePoint<T> at(const Ray<T>& ray, const Place& place) const {
        return kernel.at(piece_of(place.face), ray, place.t, place.face);
    }
};

DVec3 any_point(Dice& dice) { return dice.vector(-1.2, 1.2); }

/// Compares crossings with the referee's, which are off by at most `error`.
template <class T>
void compare(double error) {
    Dice dice{1};
    for (int n = 0; n < 40; ++n) {
        const Prism prism = random_prism(dice);
        const Placed<T> placed(prism);
        for (int m = 0; m < 12; ++m) {
            DVec3 to = any_point(dice), from = 5. * dice.direction();
            if (m == 0) from = {to.x, to.y, 5};         // along the walls
            if (m == 1) from = {from.x, from.y, to.z};  // along the caps
            const Ray<T> ray{cast<T>(from), cast<T>(normalize(to - from)), T(-1)};
            const auto found = placed.crossings(ray);
            auto wanted = referee::crossings<long double>(prism, {DVec3(ray.origin), DVec3(ray.direction)}, -1).list;
            std::ranges::sort(wanted, {}, [](const auto& own) { return own.t; });
            CHECK(found.size() % 2 == 0);
            REQUIRE(found.size() == wanted.size());
            for (std::size_t i = 0; i < found.size(); ++i) {
                CHECK(std::fabs(static_cast<double>(found[i].t - wanted[i].t)) < error);
                const DVec3 normal(placed.at(ray, found[i]).normal);
                const auto n = referee::unit(wanted[i].normal);
                const long double cosine = n.x * normal.x + n.y * normal.y + n.z * normal.z;
                CHECK(std::fabs(cosine) > 1 - 100 * error);
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
        const Placed<float> placed(prism);
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
    Dice dice{3};
    int far = 0, near = 0;
    for (int n = 0; n < 60; ++n) {
        const Prism prism = random_prism(dice);
        const Placed<float> placed(prism);
        for (int m = 0; m < 10; ++m) {
            const DVec3 from = 5. * dice.direction();
            const Ray<float> ray{cast<float>(from), cast<float>(normalize(any_point(dice) - from)), -1};
            const auto found = placed.crossings(ray);
            if (found.empty()) continue;
            // On along the ray: the crossings left are those that were behind the first.
            const Ray<float> on{placed.at(ray, found[0]).position, ray.direction, found[0].face};
            std::vector<float> ahead;
            for (const auto& place : placed.crossings(on))
                if (place.t > 0) ahead.push_back(place.t);
            near += ahead.size() != found.size() - 1;
            for (std::size_t i = 0; i + 1 < found.size() && i < ahead.size(); ++i)
                far += std::fabs(ahead[i] - (found[i + 1].t - found[0].t)) > 1e-3;
        }
    }
    CHECK(near == 0);
    CHECK(far == 0);
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
        const DVec3 p = any_point(dice);
        CHECK(prism.contains(p) == referee::contains<long double>(prism, p));
    }
}
