// Shared by the trials of formulas: errors of any size, and rays that are off by them.
#pragma once
#define STRAHL_LEVEL formulas
#define STRAHL_SCALAR
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <tuple>

#include "tests/proof/exact.h"
#include "tests/referee/dice.h"
#include "trace/kernel/illuminate.h"
#include "trace/kernel/plain.h"
#include "trace/kernel/scatter.h"
#include "trace/proof/lighting_bounds.h"

namespace strahl::trial {

using R = Quadruple;
using Vector = referee::Vector<R>;
using referee::Line;

inline constexpr double inf = std::numeric_limits<double>::infinity();

inline R length(const Vector& v) { return root(dot(v, v)); }
inline R size(R x) { return x < 0 ? -x : x; }
template <class T>
Vector vector(const Vec3<T>& v) {
    return {v.x, v.y, v.z};
}
inline DVec3 rounded(const Vector& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
/// Returns the least double that is not below x.
inline double above(R x) {
    const double nearest = static_cast<double>(x);
    return nearest < x ? std::nextafter(nearest, inf) : nearest;
}

/// Records how near errors of one kind come to their bounds, and fails if one is above.
struct Closest {
    const char* name;
    bool expected = true;
    double share = 0;
    long tried = 0, violated = 0;
    void take(R error, double bound) {
        ++tried;
        violated += !(error <= R(bound) + R(1e-32));  // what is exact has 34 digits
        if (bound > 0) share = std::max(share, static_cast<double>(error) / bound);
    }
    void demand(bool so) { ++tried, violated += !so; }
    ~Closest() {
        if (expected)
            std::printf("    %-36s %8ld tried, %5ld violated, error / bound at most %.3f\n", name, tried, violated,
                        share);
        CHECK((tried > 0) == expected);
        CHECK(violated == 0);
    }
};

inline int trials() {
    const char* const text = std::getenv("PROOF_TRIALS");
    return text ? std::atoi(text) : 20000;
}

/// Returns an error relative to 1, of any size, or 0.
inline double any_size(Dice& dice, double most = -4) { return dice.chance(.4) ? 0 : std::pow(10, dice.in(-15, most)); }
inline Vector perpendicular(Dice& dice, const Vector& to) { return unit(cross(to, Vector(dice.direction()))); }

/// A ray, and what it is in exact arithmetic.
struct OffRay {
    Ray<double> ray;
    Doubt<double> doubt;
    Line<R> line;
};
/// Returns the distance of a direction from a computed one, brought to length 1.
inline double turn_from(const Vector& exact, const DVec3& computed) {
    return above(length(exact - unit(vector(computed))));
}
/// Returns a direction whose length is off by as much as is allowed.
inline DVec3 nearly_unit(Dice& dice, const Vector& v) {
    return rounded(R(1 + dice.in(-2, 2) * std::numeric_limits<double>::epsilon()) * unit(v));
}
/// Returns a computed ray and an exact one beside it, which is moved and turned along these vectors.
inline OffRay off_ray(Dice& dice, const DVec3& origin, const Vector& towards, const Vector& moved,
                      const Vector& turned) {
    OffRay off;
    off.ray = {origin, nearly_unit(dice, towards), -1};
    off.line = {Vector(origin) + R(any_size(dice)) * moved,
                unit(vector(off.ray.direction) + R(any_size(dice)) * turned)};
    const Vector away = off.line.origin - Vector(origin);
    off.doubt = {above(length(away)), turn_from(off.line.direction, off.ray.direction),
                 above(length(cross(away, off.line.direction)))};
    return off;
}
/// The ray that is mirrored at a point of a surface, and what is known of it.
template <class T>
std::pair<Ray<T>, Doubt<T>> mirrored(const Ray<T>& ray, const Doubt<T>& doubt, const SurfacePoint<T>& point,
                                     const PointBounds<T>& known, T surface) {
    const MaterialKernel<T> material{};
    const Hit<T> hit{true, ray.direction, point.position, point.normal, true, surface, 0, 0, 1, 0, material, true, 0};
    HitBounds<T> bounds;
    bounds.away = known.away, bounds.normal = known.normal, bounds.turn = doubt.turn, bounds.followed = true;
    bounds.mirrored = known.mirrored, bounds.side = known.side, bounds.height = known.height, bounds.spin = known.spin;
    return {{point.position, branch<Plain>(hit, true, reflect(hit), T(1), T(0)).direction, surface},
            bound_reflection(bounds)};
}
inline Vector any_of(Dice& dice, const Vector& normal) {
    const int which = dice.upto(3);
    return which == 0   ? normal
           : which == 1 ? R(-1) * normal
           : which == 2 ? perpendicular(dice, normal)
                        : Vector(dice.direction());
}

}  // namespace strahl::trial
