// Lathes: where rays cross them, against the referee's formulas; how often; and what is inside.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/kinds/lathe.h"
#include "tests/referee/dice.h"
#include "tests/referee/lathe.h"
#include "tests/referee/random_scene.h"

using namespace strahl;

namespace {

/// A lathe's kernel in its own space, and its pieces.
template <class T>
struct PlacedLathe {
    std::vector<ContourPiece<T>> pieces;
    LatheKernel<T> kernel{};

    explicit PlacedLathe(const Lathe& lathe) {
        for (const auto& [ax, ay, cx, cy, hx, hy, ex, ey, dx, dy] : lathe.data->pieces)
            pieces.push_back({T(ax), T(ay), T(cx), T(cy), T(hx), T(hy), T(ex), T(ey), T(dx), T(dy)});
        lathe.emit<T>(WorldTransform(), [&](const LatheKernel<T>& own) { kernel = own; });
    }
    struct Place {
        T t, face;
    };
    /// Returns all crossings, the nearest first.
    std::vector<Place> crossings(const Ray<T>& ray) const {
        std::vector<Place> found;
        kernel.each_crossing(pieces.data(), 0, ray, ray.source, true, [&](bool, T t, T face) {
            found.push_back({t, face});
        });
        std::ranges::sort(found, {}, &Place::t);
        return found;
    }
    SurfacePoint<T> at(const Ray<T>& ray, const Place& place) const {
        return kernel.at(pieces[static_cast<std::size_t>(place.face)], ray, place.t, place.face);
    }
};

DVec3 point_near_lathe(Dice& dice) { return dice.vector(-1.2, 1.2); }
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
        const PlacedLathe<T> placed(lathe);
        for (int m = 0; m < 12; ++m) {
            DVec3 to = point_near_lathe(dice), from = 5. * dice.direction();
            if (m == 0) from = {to.x, 5, to.z};                // along the axis
            if (m == 1) from = {from.x, to.y, from.z};         // level
            if (m == 2) from = {from.x, to.y + 1e-5, from.z};  // nearly
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
                const auto n_ = referee::unit(wanted[i].normal);
                const double cosine = static_cast<double>(n_.x * normal.x + n_.y * normal.y + n_.z * normal.z);
                const double slant =
                    std::fabs(static_cast<double>(dot(n_, referee::Vector<Quadruple>(DVec3(ray.direction)))));
                const double off = std::fabs(static_cast<double>(found[i].t - wanted[i].t));
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
        const PlacedLathe<float> placed(lathe);
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
    const PlacedLathe<double> placed(lathe_of({{{0, -1}, {{{1, 0}, {1, 0}}, {{0, 1}, {0, 1}}}}}));
    const auto found = placed.crossings({Vec3<double>(-3, 0, 0), Vec3<double>(1, 0, 0), -1.});
    REQUIRE(found.size() == 2);
    CHECK(found[0].t == doctest::Approx(2));
    CHECK(found[1].t == doctest::Approx(4));
}

TEST_CASE("lathes: rays that start on a surface do not meet it there again, and meet what is ahead") {
    Dice dice{3};
    int far = 0, near = 0;
    for (int n = 0; n < 100; ++n) {
        const Lathe lathe = random_lathe(dice);
        const PlacedLathe<float> placed(lathe);
        for (int m = 0; m < 10; ++m) {
            const DVec3 from = 5. * dice.direction();
            const Ray<float> ray{cast<float>(from), cast<float>(normalize(point_near_lathe(dice) - from)), -1};
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
        const DVec3 p = point_near_lathe(dice);
        CHECK(lathe.contains(p) == referee::contains<long double>(lathe, p));
    }
}
