// The disc: a flat round surface, perhaps with a round hole. It has no thickness and no inside.
#pragma once
#include <cmath>
#include <limits>
#include <tuple>

#include "num/vec_math.h"
#include "scene/kinds/affine.h"
#include "scene/kinds/field.h"

namespace strahl {

template <class T>
struct DiscKernel {
    Vec3<T> centre, normal;  // normal is of length 1
    T radius, hole;

    Ball ball() const { return {DVec3(centre), static_cast<double>(radius)}; }

    /// A ray crosses once and comes from outside on both sides: `near` is at -infinity.
    template <class S>
    STRAHL_INLINE Span<S> span(const Ray<S>& ray, S start) const {
        constexpr auto inf = std::numeric_limits<Element<S>>::infinity();
        const Vec3<S> n = splat<S>(normal), f = ray.origin - splat<S>(centre);
        const S t = -dot(f, n) / dot(ray.direction, n);
        const Vec3<S> p = fma(t, ray.direction, f), in_plane = fma(-dot(p, n), n, p);
        const S r(radius), h(hole), squared = dot(in_plane, in_plane);
        const Mask<S> hit = (abs(t) < S(inf)) & (squared <= r * r) & (squared >= h * h) & !(start == S(0));
        return {S(-inf), t, hit};
    }
    /// The point at `t`, put back onto the disc's plane.
    template <class S>
    STRAHL_INLINE SurfacePoint<S> at(const Ray<S>& ray, S t, S) const {
        const Vec3<S> n = splat<S>(normal), c = splat<S>(centre);
        const Vec3<S> p = fma(t, ray.direction, ray.origin - c);
        return {c + fma(-dot(p, n), n, p), n};
    }
};

/// A disc, seen from both sides. The direction of the normal only distinguishes the sides.
struct Disc {
    DVec3 centre{0, 0, 0}, normal{0, 0, 1};
    double radius = 1, hole = 0;

    bool operator==(const Disc&) const = default;

    static constexpr const char* name = "disc";
    static constexpr int faces = 1, max_crossings = 1;
    static constexpr bool bounded = true, convex = true, closed = false, hot = false, plane_faces = true;
    static constexpr auto fields =
        std::make_tuple(Field{"centre", &Disc::centre, "the point in the middle"},
                        Field{"normal", &Disc::normal, "the direction that the disc faces", Range::direction},
                        Field{"radius", &Disc::radius, "its radius", Range::positive},
                        Field{"hole's radius", &Disc::hole, "the radius of a hole in the middle; no hole if not given",
                              Range::length_or_zero, Given::optional});
    const char* fault() const {
        return !(length(normal) > 0) ? "its normal has no direction"
               : !(hole < radius)    ? "the hole is as large as the disc"
                                     : nullptr;
    }
    Box bounds() const {
        const DVec3 n = normalize(normal);
        DVec3 reach;
        for (int i = 0; i < 3; ++i) reach[i] = radius * sine_to_axis(n, i);
        return {centre - reach, centre + reach};
    }
    bool contains(const DVec3&) const { return false; }
    auto pov() const { return std::tuple("disc", centre, normalize(normal), radius, hole); }

    template <class T>
    using Kernels = std::tuple<DiscKernel<T>, AffineKernel<DiscKernel<T>, T>>;
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        const DVec3 n = normalize(normal);
        if (to_world.similar())
            emit(DiscKernel<T>{cast<T>(to_world.point(centre)), cast_unit<T>(to_world.direction(n)),
                               static_cast<T>(to_world.length(radius)), static_cast<T>(to_world.length(hole))});
        else
            emit(affine<T>(DiscKernel<T>{Vec3<T>(0), cast_unit<T>(n), T(1), static_cast<T>(hole / radius)}, centre,
                           radius, transformed(bounds(), to_world.matrix), bounds(), to_world));
    }
};

}  // namespace strahl
