// The closed cone between two points, with an apex or cut off.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "num/vec_math.h"
#include "scene/kinds/affine.h"
#include "scene/kinds/capsule.h"
#include "scene/kinds/field.h"

namespace strahl {

/// Faces: 0 the side, 1 the base, 2 the cap.
template <class T>
struct ConeKernel {
    static constexpr int faces = 3;
    Vec3<T> base, axis;              // axis is of length 1
    T radius, height, cosine, sine;  // radius of the base; the angle between axis and side, > 0 if the cone widens
    T widest;                        // the larger radius

    static ConeKernel frustum(const DVec3& base, const DVec3& axis, double base_radius, double cap_radius,
                              double height) {
        const double widest = std::max(base_radius, cap_radius), widening = cap_radius - base_radius;
        // The square of the cosine and the height must not underflow, or the bounding volume would be empty. So a cone
        // that is flatter becomes a little higher.
        height = std::max({height, widest * std::ldexp(1., std::numeric_limits<T>::min_exponent / 2 + 4),
                           static_cast<double>(std::numeric_limits<T>::min())});
        const double slant = length({height, widening, 0});  // not hypot of two, whose last bit is the processor's
        return {cast<T>(base),
                cast_unit<T>(axis),
                static_cast<T>(base_radius),
                static_cast<T>(height),
                static_cast<T>(height / slant),
                static_cast<T>(widening / slant),
                static_cast<T>(widest)};
    }

    Ball ball() const {
        const double h = static_cast<double>(height), r = static_cast<double>(radius);
        const double cap = std::max(0., r + h * (static_cast<double>(sine) / static_cast<double>(cosine)));
        const double middle = std::clamp((h + (cap - r) * ((cap + r) / h)) / 2, 0., h);
        return {DVec3(base) + middle * DVec3(axis), std::max(std::hypot(middle, r), std::hypot(h - middle, cap))};
    }

    template <class S>
    STRAHL_INLINE Span<S> span(const Ray<S>& ray, S start) const {
        constexpr auto inf = std::numeric_limits<Element<S>>::infinity();
        const S zero(0), one(1), two(2), h(height);
        const Mask<S> starts_here = (start >= zero) & (start < S(faces));
        const Vec3<S> a = splat<S>(axis), d = ray.direction, f = ray.origin - splat<S>(base);
        const S along_d = dot(d, a);
        S along_f = dot(f, a);
        Span<S> side = cross_side(f, d, along_f, along_d);
        if (none(side.hit | starts_here)) return {zero, zero, side.hit};

        if (any(starts_here)) {
            const S beyond = leave_side(f, d, along_f, along_d);
            // Near is the face that it starts on: cross_side() returns nothing for rays that miss the side.
            side.near = select(start == zero, S(inf), select(starts_here, S(-inf), side.near));
            side.far = select(start == zero, beyond, select(starts_here & !side.hit, zero, side.far));
            along_f = select(start == one, zero, select(start == two, h, along_f));
        }
        const S to_base = -along_f / along_d, to_cap = (h - along_f) / along_d;
        // Across the axis these are -+infinity.
        const Mask<S> upwards = (along_d > zero) | ((!(along_d < zero)) & (to_base < to_cap));
        const S ends_near = select(upwards, to_base, to_cap), ends_far = select(upwards, to_cap, to_base);
        const S near = max(side.near, ends_near), far = min(side.far, ends_far);
        const Mask<S> hit = side.hit & (near <= far) & within_widest(f, d, select(near > zero, near, far));
        // A convex body is never entered again from its own surface.
        return {select(starts_here, zero, near), far, Mask<S>(hit | starts_here),
                select(ends_near > side.near, select(upwards, one, two), zero),
                select(ends_far < side.far, select(upwards, two, one), zero)};
    }
    /// Is the point at `t` no further from the axis than the body reaches, up to rounding? If the height is lost in the
    /// rounding of coordinates, the formulas of side and ends find hits in the whole plane, and whether bounding
    /// volumes rule them out would decide what is seen.
    template <class S>
    STRAHL_INLINE Mask<S> within_widest(const Vec3<S>& f, const Vec3<S>& d, S t) const {
        const S rounding(16 * std::numeric_limits<Element<S>>::epsilon()), w(widest);
        const Vec3<S> a = splat<S>(axis), p = fma(t, d, f);
        const S along = dot(p, a);
        const Vec3<S> out = fma(-along, a, p);
        const S most = fma(rounding, abs(t) + abs(along) + w, w);
        return !(dot(out, out) > most * most);
    }
    /// Crosses the endless double cone A t^2 + 2 B t + C = 0, which is negative inside: c |u| is the distance from the
    /// axis and r the radius, both times the cosine; `growth` is how fast r grows. A ray steeper than the side crosses
    /// both halves once each, and is inside from there on.
    template <class S>
    STRAHL_INLINE Span<S> cross_side(const Vec3<S>& f, const Vec3<S>& d, S along_f, S along_d) const {
        using E = Element<S>;
        constexpr E inf = std::numeric_limits<E>::infinity();
        constexpr E noise = 4 * std::numeric_limits<E>::epsilon();  // of the direction's part across the axis
        const S zero(0), c(cosine), c2 = c * c;
        const Vec3<S> a = splat<S>(axis), v = across(fma(-along_d, a, d));
        const S growth = S(sine) * along_d, vv = dot(v, v), qa = fma(c2, vv, -(growth * growth));
        const Mask<S> steep = qa < zero, parallel = vv < S(noise * noise);
        const Mask<S> widens = growth > zero, narrows = growth < zero;
        // Counted from where the ray is nearest to the axis, none of the sums below cancels, neither for far origins
        // nor for rays along a line of the side. Much steeper rays are nearest far away, and do not need this.
        Vec3<S> u = fma(-along_f, a, f);
        S r = fma(S(sine), along_f, c * S(radius));
        const S turn = select((S(E(4)) * c2 * vv < growth * growth) | parallel, zero, -dot(u, v) / vv);
        u = fma(turn, v, u);
        r = fma(turn, growth, r);
        const S uu = dot(u, u), qb = fma(c2, dot(u, v), -(r * growth)), qc = fma(c2, uu, -(r * r));
        // B^2 - A C is c^2 (|r v - growth u|^2 - c^2 |u x v|^2): Lagrange's identity with a sign turned.
        const Vec3<S> m = fma(r, v, scale(-growth, u));
        const S w = dot(a, cross(u, v)), discriminant = fma(-c2, w * w, dot(m, m));
        Mask<S> crosses = steep | (discriminant > zero);
        if (none(crosses | parallel)) return {zero, zero, crosses};

        const S root = c * sqrt(max(discriminant, zero)), q = select(qb < zero, root - qb, -root - qb);
        const S one_root = q / qa, other = qc / q;  // the first is infinite for a ray parallel to the side
        const S low = turn + min(one_root, other), high = turn + max(one_root, other);
        S near = select(steep, select(widens, high, S(-inf)), low);
        S far = select(steep, select(widens, S(inf), low), high);
        if (any(parallel)) {  // to the axis
            const S distance = c * sqrt(uu), to_side = (distance - r) / growth;
            near = select(parallel, select(widens, to_side, S(-inf)), near);
            far = select(parallel, select(narrows, to_side, S(inf)), far);
            crosses = (crosses & !parallel) | (parallel & (widens | narrows | (distance < r)));
        }
        return {near, far, crosses};
    }
    /// The other root of a ray that starts on the side, where one root is 0 and divided out. The normal that at()
    /// returned decides whether it leaves at once.
    template <class S>
    STRAHL_INLINE S leave_side(const Vec3<S>& f, const Vec3<S>& d, S along_f, S along_d) const {
        constexpr auto inf = std::numeric_limits<Element<S>>::infinity();
        const S c(cosine), zero(0), growth = S(sine) * along_d, r = fma(S(sine), along_f, c * S(radius));
        const Vec3<S> a = splat<S>(axis), v = across(fma(-along_d, a, d));
        const S qa = fma(c * c, dot(v, v), -(growth * growth)), outwards = dot(side_normal(fma(-along_f, a, f)), d);
        return select(outwards < zero, select(qa > zero, S(-2) * r * outwards / qa, S(inf)), zero);
    }
    /// The part of `v` at right angles to the axis, for a `v` that nearly is: most of a short one may be rounding
    /// error.
    template <class S>
    STRAHL_INLINE Vec3<S> across(const Vec3<S>& v) const {
        const Vec3<S> a = splat<S>(axis);
        return fma(-dot(v, a), a, v);
    }
    /// The side's normal at a point `u` across from the axis. At the apex it is the axis.
    template <class S>
    STRAHL_INLINE Vec3<S> side_normal(const Vec3<S>& u) const {
        using E = Element<S>;
        const Vec3<S> a = splat<S>(axis), out = across(u);
        const S s(sine), square = dot(out, out), least(std::numeric_limits<E>::min());
        const Mask<S> apex = !(square > max(S(E(.25)) * dot(u, u), least));
        const Vec3<S> normal = fma(S(cosine) / sqrt(square), out, scale(-s, a));
        return select(apex, scale(select(s > S(0), S(-1), S(1)), a), normal);
    }
    /// The point at `t`, put back onto the face that was hit.
    template <class S>
    STRAHL_INLINE SurfacePoint<S> at(const Ray<S>& ray, S t, S face) const {
        const Vec3<S> a = splat<S>(axis), b = splat<S>(base);
        const Vec3<S> f = fma(t, ray.direction, ray.origin - b);
        const S along = dot(f, a);
        const Vec3<S> u = fma(-along, a, f);
        const S outside = S(cosine) * (sqrt(dot(u, u)) - S(radius)) - S(sine) * along;  // distance to the side
        const Mask<S> side = face == S(0), at_base = face == S(1);
        const Vec3<S> on_side = fma(-outside, side_normal(u), f);
        const Vec3<S> on_end = fma(select(at_base, S(0), S(height)), a, u);
        const Vec3<S> position = b + select(side, on_side, on_end);
        // The normal is that of the rounded point, from which the next ray determines which way is out.
        const Vec3<S> g = position - b;
        const Vec3<S> outwards = side_normal(fma(-dot(g, a), a, g));
        return {position, select(side, outwards, scale(select(at_base, S(-1), S(1)), a))};
    }
};

/// A radius of 0 makes an apex; equal radii make a cylinder.
struct Cone {
    DVec3 base{0, 0, 0};
    double base_radius = 1;
    DVec3 cap{0, 0, 1};
    double cap_radius = 0;

    bool operator==(const Cone&) const = default;

    static constexpr const char* name = "cone";
    static constexpr int faces = 3, max_crossings = 2;
    static constexpr bool bounded = true, convex = true, closed = true, hot = false;
    static constexpr auto fields =
        std::make_tuple(Field{"base", &Cone::base, "centre of one end"},
                        Field{"base's radius", &Cone::base_radius, "its radius, or 0", Range::length_or_zero},
                        Field{"cap", &Cone::cap, "centre of the other end"},
                        Field{"cap's radius", &Cone::cap_radius, "its radius, or 0", Range::length_or_zero});
    const char* fault() const {
        return base == cap                           ? "base and cap are the same point"
               : base_radius == 0 && cap_radius == 0 ? "both radii are 0"
                                                     : nullptr;
    }
    double height() const { return length(cap - base); }
    DVec3 axis() const { return (cap - base) / height(); }
    /// The box around the two ends contains all that is between.
    Box bounds() const {
        const DVec3 a = axis();
        Box box;
        for (int i = 0; i < 3; ++i) {
            const double slant = sine_to_axis(a, i);
            box.low[i] = std::min(base[i] - slant * base_radius, cap[i] - slant * cap_radius);
            box.high[i] = std::max(base[i] + slant * base_radius, cap[i] + slant * cap_radius);
        }
        return box;
    }
    bool contains(const DVec3& p) const {
        const DVec3 a = axis(), d = p - base;
        const double along = dot_product(a, d), whole = height();
        const DVec3 across = d - along * a;
        const double radius = base_radius + (cap_radius - base_radius) * (along / whole);
        return along > 0 && along < whole && length(across) < radius;
    }
    std::vector<Capsule> capsules() const { return {{base, cap, std::max(base_radius, cap_radius)}}; }
    auto pov() const { return std::tuple("cone", base, base_radius, cap, cap_radius); }

    template <class T>
    using Kernels = std::tuple<ConeKernel<T>, AffineKernel<ConeKernel<T>, T>>;
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        const double unit = std::max(base_radius, cap_radius);
        if (to_world.similar())
            emit(ConeKernel<T>::frustum(to_world.point(base), to_world.direction(axis()), to_world.length(base_radius),
                                        to_world.length(cap_radius), to_world.length(height())));
        else
            emit(affine<T>(
                ConeKernel<T>::frustum(DVec3(0), axis(), base_radius / unit, cap_radius / unit, height() / unit), base,
                unit, transformed(bounds(), to_world.matrix), bounds(), to_world));
    }
};

}  // namespace strahl
