// Blobs and sweeps by themselves: crosses them with rays one by one, compares that with the referee, and tests rays
// that start on them.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <type_traits>
#include <vector>

#include "num/vec_math.h"
#include "scene/kinds/world_transform.h"
#include "tests/referee/blob.h"
#include "tests/referee/dice.h"
#include "tests/referee/sweep.h"

namespace strahl {

/// A body's kernel in its own space, and its pieces.
template <class Body, class T>
struct PlacedPieces {
    using Kernel = std::tuple_element_t<0, typename Body::template Kernels<T>>;
    decltype(Body::data->pieces.data()) pieces;
    Kernel kernel{};

    explicit PlacedPieces(const Body& body) : pieces(body.data->pieces.data()) {
        body.template emit<T>(WorldTransform(), [&](const Kernel& own) { kernel = own; });
    }
    /// Returns all crossings, the nearest first, or some from the first `enough` on. Some kernels take lines of doubles
    /// in worlds of floats.
    std::vector<T> crossings(const Ray<T>& ray, int enough = 1000) const {
        using V = std::conditional_t < requires { Kernel::in_double; }
        , Doubles<T>, T > ;
        std::vector<T> found;
        kernel.each_crossing(pieces, enough, Ray<V>{Vec3<V>(ray.origin), Vec3<V>(ray.direction), V(0)}, V(ray.source),
                             true, [&](bool, V t, V) { found.push_back(static_cast<T>(t)); });
        return found;
    }
    SurfacePoint<T> at(const Ray<T>& ray, T t) const { return kernel.at(pieces, ray, t); }
};

/// A ray from one point towards another.
struct RayBetween {
    DVec3 from, to;
    template <class T>
    Ray<T> as() const {
        return {cast<T>(from), cast<T>(normalize(to - from)), T(-1)};
    }
};

/// Compares the crossings of random bodies with the referee's, which are off by at most `error` times the distance;
/// grazed surfaces apart. Makes bodies by body_of(dice, n) and rays by ray_of(dice, body, m).
template <class T>
void compare_crossings(const auto& body_of, const auto& ray_of, double error) {
    Dice dice{1};
    int compared = 0, grazed = 0;
    for (int n = 0; n < 80; ++n) {
        const auto body = body_of(dice, n);
        const PlacedPieces<std::remove_const_t<decltype(body)>, T> placed(body);
        for (int m = 0; m < 12; ++m) {
            const Ray<T> ray = ray_of(dice, body, m).template as<T>();
            const std::vector<T> found = placed.crossings(ray);
            auto wanted = referee::crossings<long double>(body, {DVec3(ray.origin), DVec3(ray.direction)}, -1).list;
            std::erase_if(wanted, [](const auto& own) { return own.t < 0; });
            std::ranges::sort(wanted, {}, [](const auto& own) { return own.t; });
            CHECK(std::ranges::is_sorted(found));
            CHECK(found.size() % 2 == 0);
            if (found.size() != wanted.size()) {
                ++grazed;
                MESSAGE("body " << n << " ray " << m << ": " << found.size() << " of " << wanted.size());
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

/// Compares with the referee where rays cross a body of many pieces within `reach` of the origin, more often than
/// `least`, and whether points point_of() are inside. Returns how many are.
int compare_many(const auto& body, Dice& dice, double reach, int least, const auto& point_of) {
    const PlacedPieces<std::remove_cvref_t<decltype(body)>, double> placed(body);
    int compared = 0, inside = 0;
    for (int n = 0; n < 60; ++n) {
        const DVec3 from = 9. * dice.direction(), way = normalize(dice.vector(-reach, reach) - from);
        const auto found = placed.crossings({Vec3<double>(from), Vec3<double>(way), -1.});
        auto wanted = referee::crossings<long double>(body, {from, way}, -1).list;
        std::ranges::sort(wanted, {}, [](const auto& own) { return own.t; });
        REQUIRE(found.size() == wanted.size());
        for (std::size_t i = 0; i < found.size(); ++i, ++compared)
            CHECK(std::fabs(static_cast<double>(found[i] - wanted[i].t)) < 1e-9);
        const DVec3 p = point_of();
        CHECK(body.contains(p) == referee::contains<long double>(body, p));
        inside += body.contains(p);
    }
    CHECK(compared > least);
    return inside;
}

/// Checks that rays which go on from their first crossing of a body meet the others, and that rays back meet nothing.
void check_rays_on_pieces(const auto& body_of, const auto& ray_of) {
    Dice dice{3};
    int far = 0, near = 0, tried = 0;
    for (int n = 0; n < 100; ++n) {
        const auto body = body_of(dice, 1);
        const PlacedPieces<std::remove_const_t<decltype(body)>, float> placed(body);
        const auto ahead_of = [&](const Vec3<float>& from, const Vec3<float>& way) {
            std::vector<float> ahead = placed.crossings({from, way, 0.F});
            std::erase_if(ahead, [](float t) { return t <= 0; });
            return ahead;
        };
        for (int m = 0; m < 10; ++m) {
            const Ray<float> ray = ray_of(dice, body, m).template as<float>();
            const std::vector<float> found = placed.crossings(ray);
            if (found.empty()) continue;
            CHECK(placed.crossings(ray, 1).at(0) == found[0]);
            ++tried;
            const Vec3<float> start = placed.at(ray, found[0]).position;
            const std::vector<float> ahead = ahead_of(start, ray.direction);
            near += ahead.size() != found.size() - 1;
            for (std::size_t i = 0; i + 1 < found.size() && i < ahead.size(); ++i)
                far += std::fabs(ahead[i] - (found[i + 1] - found[0])) > 1e-3;
            near += !ahead_of(start, -ray.direction).empty();
        }
    }
    CHECK(tried > 300);
    CHECK(near < 4);  // where a ray grazes the surface
    CHECK(far < 4);
}

}  // namespace strahl
