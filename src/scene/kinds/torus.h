// The torus about an axis.
#pragma once
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <vector>

#include "num/vec_math.h"
#include "scene/kinds/affine.h"
#include "scene/kinds/capsule.h"
#include "scene/kinds/field.h"
#include "scene/kinds/torus_profile.h"

namespace strahl {

/// All points nearer than `minor` to the circle of radius `major`. It has one face.
template <class T>
struct TorusKernel {
    static constexpr int faces = 1;
    Vec3<T> centre, axis;  // axis is of length 1
    T major, minor;

    Ball ball() const { return {DVec3(centre), static_cast<double>(major) + static_cast<double>(minor)}; }

    template <class S>
    STRAHL_INLINE Crossings<S, 4> crossings(const Ray<S>& ray, S start, Mask<S> lanes = all_lanes<S>()) const {
        using E = Element<S>;
        constexpr E inf = std::numeric_limits<E>::infinity(), bits = 8 * std::numeric_limits<E>::epsilon();
        constexpr E noise = bits / 2;  // of the direction's part across the axis
        const S zero(0), one(1), major(this->major), minor(this->minor), reach = major + minor, slack = reach * S(bits);
        const Vec3<S> a = splat<S>(axis), d = ray.direction, f = ray.origin - splat<S>(centre);
        const Mask<S> starts_here = lanes & (start == zero);
        const S towards = dot(f, d), shift = select(starts_here, zero, -towards);
        const Vec3<S> p = fma(shift, d, f);
        S middle = select(starts_here, -towards, -dot(p, d));
        const Vec3<S> nearest = fma(middle, d, p);
        const S nearest2 = dot(nearest, nearest), beyond = fma(reach, reach, -nearest2);
        const S along = dot(p, a);
        S along_d = dot(d, a);
        // Does the ray meet the ball around the torus, and in it the space between the planes that touch the torus?
        const S height = max(abs(fma(middle, along_d, along)) - (minor + S(2) * slack), zero);
        const Mask<S> between = height * height <= along_d * along_d * beyond * S(1 + 4 * bits);
        const Mask<S> hit = (lanes & (beyond > zero) & between) | starts_here;
        if (none(hit)) return {{S(-inf), S(-inf), S(-inf), S(-inf)}, hit};

        const S width = fma(sqrt(max(beyond, zero)), S(1 + bits), slack);
        const Vec3<S> u = across(fma(-along, a, p)), v = across(fma(-along_d, a, d));
        const S vv = dot(v, v);
        const Mask<S> parallel = vv < S(noise * noise);
        const S k = select(parallel, zero, sqrt(vv));
        const Vec3<S> e = scale(one / k, v);
        S x = select(parallel, zero, dot(u, e));
        S y = dot(a, strahl::cross(u, e));
        if (any(parallel)) [[unlikely]]
            y = select(parallel, sqrt(dot(u, u)), y);
        const Mask<S> turned = fma(k, middle, x) < zero;
        x = select(turned, -x, x), along_d = select(turned, -along_d, along_d);
        middle = select(turned, -middle, middle);
        // On the axis F has a kink. Rays that close to it pass it at a distance of some bits.
        const S closest = S(noise) * reach, y2 = max(y * y, closest * closest);
        Mask<S> leaves = starts_here;
        S known_rho = zero;
        if (any(starts_here)) leaves = starts_here & (dot(outwards(f), d) > zero), known_rho = sqrt(fma(x, x, y2));
        const TorusProfile<S> profile{x,     y2,        k,     along, along_d, middle,      major,
                                      minor, known_rho, width, shift, turned,  starts_here, leaves};
        if constexpr (strahl::width < S >> 1)
            return profile.call_crossings(nearest2, y * y, hit);
        else
            return profile.crossings(nearest2, y * y, hit);
    }
    /// The part of `v` at right angles to the axis, for a `v` that nearly is.
    template <class S>
    STRAHL_INLINE Vec3<S> across(const Vec3<S>& v) const {
        const Vec3<S> a = splat<S>(axis);
        return fma(-dot(v, a), a, v);
    }
    /// The unit vector from the axis to a point relative to the centre, or 0 where rounding hides it: at the poles of a
    /// spindle.
    template <class S>
    STRAHL_INLINE Vec3<S> out_from_axis(const Vec3<S>& p) const {
        using E = Element<S>;
        const Vec3<S> once = across(p), u = across(once);  // again, for close to the axis the first is rounding
        const S square = dot(u, u), least(std::numeric_limits<E>::min());
        const Mask<S> known = square > max(S(E(.25)) * dot(once, once), least);
        return scale(select(known, S(1) / sqrt(square), S(0)), u);
    }
    /// The normal at a point relative to the centre.
    template <class S>
    STRAHL_INLINE Vec3<S> outwards(const Vec3<S>& p) const {
        const Vec3<S> q = fma(-S(major), out_from_axis(p), p);
        return scale(S(1) / sqrt(dot(q, q)), q);
    }
    /// The point at `t`, put back onto the torus.
    template <class S>
    STRAHL_INLINE SurfacePoint<S> at(const Ray<S>& ray, S t, S) const {
        const Vec3<S> c = splat<S>(centre), p = fma(t, ray.direction, ray.origin - c), out = out_from_axis(p);
        const Vec3<S> put_back = fma(S(minor), outwards(p), scale(S(major), out));
        const Vec3<S> position = c + select(dot(out, out) > S(0), put_back, p);
        return {position, outwards(position - c)};
    }
};

/// All points nearer than `minor` to a circle. If `minor` is the larger radius, the hole in the middle is closed: a
/// spindle torus.
struct Torus {
    DVec3 centre{0, 0, 0}, axis{0, 0, 1};
    double major = 1, minor = .25;

    bool operator==(const Torus&) const = default;

    static constexpr const char* name = "torus";
    static constexpr int faces = 1, max_crossings = 4;
    static constexpr bool bounded = true, convex = false, closed = true, hot = false;
    static constexpr auto fields = std::make_tuple(
        Field{"centre", &Torus::centre, "the point in the middle"},
        Field{"axis", &Torus::axis, "the axis around which the torus lies", Range::direction},
        Field{"major radius", &Torus::major,
              "from the centre to the middle of the tube; at least a thousandth of the minor radius", Range::positive},
        Field{"minor radius", &Torus::minor, "the radius of the tube", Range::positive});
    const char* fault() const {
        if (!(length(axis) > 0)) return "its axis has no direction";
        // If it is nearly a sphere, rounding does not separate the two sheets.
        return major >= minor / 1000 ? nullptr : "its major radius is less than a thousandth of its minor one";
    }
    Box bounds() const {
        const DVec3 a = normalize(axis);
        DVec3 reach;
        for (int i = 0; i < 3; ++i) reach[i] = minor + major * sine_to_axis(a, i);
        return {centre - reach, centre + reach};
    }
    bool contains(const DVec3& p) const {
        const DVec3 a = normalize(axis), f = p - centre;
        const double along = dot_product(f, a);
        return std::hypot(length(f - along * a) - major, along) < minor;
    }
    auto pov() const { return std::tuple("torus", major, minor); }
    /// POV-Ray's axes and origin for this torus: its own torus lies around the y axis.
    std::array<DVec3, 4> pov_axes() const {
        const DVec3 y = normalize(axis), other = std::abs(y.x) < .5 ? DVec3(1, 0, 0) : DVec3(0, 1, 0);
        const DVec3 z = normalize(cross_product(other, y));
        return {cross_product(y, z), y, z, centre};
    }
    /// POV-Ray's default solver takes nearly flat quartics for cubics.
    static constexpr const char* pov_more = " sturm";
    /// Capsules along chords of its circle, whose arcs are no further from them than a quarter of the tube's radius.
    std::vector<Capsule> capsules() const {
        constexpr double fewest = 48, most = 512;
        const double wanted = std::numbers::pi / std::acos(1 - std::min(minor / (4 * major), 1.));
        const int chords = static_cast<int>(std::ceil(std::min(std::max(wanted, fewest), most)));
        const auto [x, y, z, middle] = pov_axes();
        const auto point = [&](int i) {
            const double turn = 2 * std::numbers::pi * i / chords;
            return centre + major * (std::cos(turn) * x + std::sin(turn) * z);
        };
        const double reach = minor + major * (1 - std::cos(std::numbers::pi / chords));
        std::vector<Capsule> around;
        for (int i = 0; i < chords; ++i) around.push_back({point(i), point(i + 1), reach});
        return around;
    }

    template <class T>
    using Kernels = std::tuple<TorusKernel<T>, AffineKernel<TorusKernel<T>, T>>;
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        const DVec3 a = normalize(axis);
        const double unit = major + minor;
        if (to_world.similar())
            emit(TorusKernel<T>{cast<T>(to_world.point(centre)), cast_unit<T>(to_world.direction(a)),
                                static_cast<T>(to_world.length(major)), static_cast<T>(to_world.length(minor))});
        else
            emit(affine<T>(
                TorusKernel<T>{Vec3<T>(0), cast_unit<T>(a), static_cast<T>(major / unit), static_cast<T>(minor / unit)},
                centre, unit, transformed(bounds(), to_world.matrix), bounds(), to_world));
    }
};

}  // namespace strahl
