// The closed cylinder between two points.
#pragma once
#include <cmath>
#include <tuple>
#include <vector>

#include "scene/kinds/affine.h"
#include "scene/kinds/capsule.h"
#include "scene/kinds/field.h"

namespace strahl {

/// Faces: 0 the side, 1 the base, 2 the cap.
template <class T>
struct CylinderKernel {
    static constexpr int faces = 3;
    Vec3<T> base, axis;  // axis is of length 1
    T radius, height;

    Ball ball() const {
        const double half = static_cast<double>(height) / 2;
        return {DVec3(base) + half * DVec3(axis), std::hypot(half, static_cast<double>(radius))};
    }

    template <class S>
    STRAHL_INLINE Span<S> span(const Ray<S>& ray, S start) const {
        using E = Element<S>;
        constexpr E inf = std::numeric_limits<E>::infinity();
        constexpr E noise = 4 * std::numeric_limits<E>::epsilon();  // of the direction's part across the axis
        const Vec3<S> a = splat<S>(axis), f = ray.origin - splat<S>(base), d = ray.direction;
        const S along_f = dot(f, a), along_d = dot(d, a), zero(0);
        const Vec3<S> across_f = fma(-along_f, a, f), across_d = fma(-along_d, a, d);
        // The endless cylinder A t^2 + 2 B t + C = 0. Its discriminant comes from the distance between ray and axis,
        // which, as for the sphere, does not cancel for far origins as B^2 - A C does.
        const S qa = dot(across_d, across_d), qb = dot(across_f, across_d), w = dot(a, cross(f, d));
        const S r2 = S(radius) * S(radius), discriminant = fma(r2, qa, -(w * w));
        const Mask<S> parallel = qa < S(noise * noise), inside = dot(across_f, across_f) < r2;
        const Mask<S> crosses = (parallel & inside) | ((!parallel) & (discriminant > zero));
        const Mask<S> starts_here = (start >= zero) & (start < S(faces));
        if (none(crosses | starts_here)) return {zero, zero, crosses};

        const S s = sqrt(max(discriminant, zero)), inverse = S(1) / qa;
        S side_near = (-qb - s) * inverse, side_far = (s - qb) * inverse;
        S to_base = -along_f / along_d, to_cap = (S(height) - along_f) / along_d;
        if (any(starts_here)) {  // divide out the known root
            const S other = S(-2) * qb * inverse;
            side_near = select(start == zero, min(other, zero), side_near);
            side_far = select(start == zero, max(other, zero), side_far);
            to_base = select(start == S(1), zero, to_base);
            to_cap = select(start == S(2), zero, to_cap);
        }
        side_near = select(parallel, S(-inf), side_near);
        side_far = select(parallel, S(inf), side_far);
        const Mask<S> upwards = to_base < to_cap;  // also across the axis, where these are -+infinity
        const S ends_near = select(upwards, to_base, to_cap), ends_far = select(upwards, to_cap, to_base);
        const S near = max(side_near, ends_near), far = min(side_far, ends_far);
        // A convex body is never entered again from its own surface.
        return {select(starts_here, zero, near), far, Mask<S>((crosses | starts_here) & ((near <= far) | starts_here)),
                select(ends_near > side_near, select(upwards, S(1), S(2)), zero),
                select(ends_far < side_far, select(upwards, S(2), S(1)), zero)};
    }
    template <class S>
    STRAHL_INLINE SurfacePoint<S> at(const Ray<S>& ray, S t, S face) const {
        const Vec3<S> a = splat<S>(axis), b = splat<S>(base);
        const Vec3<S> f = fma(t, ray.direction, ray.origin - b);
        const S along = dot(f, a);
        const Vec3<S> across = fma(-along, a, f);
        // Points on the axis may be hit of rods so thin that rounding hides them.
        const S distance = sqrt(max(dot(across, across), S(std::numeric_limits<Element<S>>::min())));
        const Vec3<S> outwards = scale(S(1) / distance, across);
        // The point is put back onto the face that was hit.
        const Mask<S> side = face == S(0), at_base = face == S(1);
        const S end = select(at_base, S(0), S(height));
        const Vec3<S> on_side = fma(along, a, scale(S(radius), outwards)), on_end = fma(end, a, across);
        return {b + select(side, on_side, on_end), select(side, outwards, scale(select(at_base, S(-1), S(1)), a))};
    }
};

struct Cylinder {
    DVec3 base{0, 0, 0}, cap{0, 0, 1};
    double radius = 1;

    bool operator==(const Cylinder&) const = default;

    static constexpr const char* name = "cylinder";
    static constexpr int faces = 3, max_crossings = 2;
    static constexpr bool bounded = true, convex = true, closed = true, hot = true;
    static constexpr auto fields = std::make_tuple(Field{"base", &Cylinder::base, "centre of one end"},
                                                   Field{"cap", &Cylinder::cap, "centre of the other end"},
                                                   Field{"radius", &Cylinder::radius, "the radius", Range::positive});
    const char* fault() const { return base == cap ? "base and cap are the same point" : nullptr; }
    DVec3 axis() const {
        const DVec3 a = cap - base;
        return a / std::hypot(a.x, a.y, a.z);
    }
    Box bounds() const {
        const DVec3 a = axis();
        Box box;
        for (int i = 0; i < 3; ++i) {
            const double reach = radius * sine_to_axis(a, i);
            box.low[i] = std::min(base[i], cap[i]) - reach;
            box.high[i] = std::max(base[i], cap[i]) + reach;
        }
        return box;
    }
    bool contains(const DVec3& p) const {
        const DVec3 a = axis(), d = p - base, h = cap - base;
        const double along = a.x * d.x + a.y * d.y + a.z * d.z;
        const DVec3 across = d - along * a;
        return along > 0 && along < std::hypot(h.x, h.y, h.z) &&
               across.x * across.x + across.y * across.y + across.z * across.z < radius * radius;
    }
    std::vector<Capsule> capsules() const { return {{base, cap, radius}}; }
    auto pov() const { return std::tuple("cylinder", base, cap, radius); }

    template <class T>
    using Kernels = std::tuple<CylinderKernel<T>, AffineKernel<CylinderKernel<T>, T>>;
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        const DVec3 rise = cap - base;
        const double height = std::sqrt(dot_product(rise, rise));
        if (to_world.similar())
            emit(CylinderKernel<T>{cast<T>(to_world.point(base)), cast_unit<T>(to_world.direction(axis())),
                                   static_cast<T>(to_world.length(radius)), static_cast<T>(to_world.length(height))});
        else
            emit(
                affine<T>(CylinderKernel<T>{Vec3<T>(T(0)), cast_unit<T>(axis()), T(1), static_cast<T>(height / radius)},
                          base, radius, transformed(bounds(), to_world.matrix), bounds(), to_world));
    }
};

}  // namespace strahl
