// The sphere: a centre and a radius.
#pragma once
#include <cmath>
#include <tuple>
#include <vector>

#include "scene/kinds/affine.h"
#include "scene/kinds/capsule.h"
#include "scene/kinds/field.h"

namespace strahl {

/// The kernel of spheres, for single numbers or packs.
template <class T>
struct SphereKernel {
    Vec3<T> centre;
    T radius;

    Ball ball() const { return {DVec3(centre), static_cast<double>(radius)}; }

    /// Finds the closest approach first, then half the chord: r^2 - |l|^2 does not cancel the way b^2 - c does (E.
    /// Haines, J. Guenther, T. Akenine-Moeller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems,
    /// 2019). A ray that starts on this sphere has the roots 0 and 2b.
    template <class S>
    STRAHL_INLINE Span<S> span(const Ray<S>& ray, S start) const {
        const Mask<S> starts_here = start == S(0);
        const Vec3<S> to_centre = splat<S>(centre) - ray.origin;
        const S b = dot(to_centre, ray.direction);
        const Vec3<S> l = fma(-b, ray.direction, to_centre);
        const S r = S(radius);
        const S d = fma(r, r, -dot(l, l));
        Mask<S> hit = d > S(0);
        if (none(hit | starts_here)) return {S(0), S(0), hit};
        const S s = sqrt(max(d, S(0)));
        Span<S> span{b - s, b + s, Mask<S>(hit | starts_here)};
        if (any(starts_here)) {
            span.near = select(starts_here, min(b + b, S(0)), span.near);
            span.far = select(starts_here, max(b + b, S(0)), span.far);
        }
        return span;
    }
    /// The point at `t`, put back onto the sphere.
    template <class S>
    STRAHL_INLINE SurfacePoint<S> at(const Ray<S>& ray, S t, S) const {
        const Vec3<S> c = splat<S>(centre);
        const Vec3<S> out = fma(t, ray.direction, ray.origin - c);
        const Vec3<S> normal = scale(S(1) / sqrt(dot(out, out)), out);
        return {fma(S(radius), normal, c), normal};
    }
};

struct Sphere {
    DVec3 centre{0};
    double radius = 1;

    bool operator==(const Sphere&) const = default;

    static constexpr const char* name = "sphere";
    static constexpr int faces = 1, max_crossings = 2;
    static constexpr bool bounded = true, convex = true, closed = true, hot = true;
    static constexpr auto fields = std::make_tuple(Field{"centre", &Sphere::centre, "the centre"},
                                                   Field{"radius", &Sphere::radius, "the radius", Range::positive});
    /// Why these values make no body, or nullptr.
    const char* fault() const { return nullptr; }
    Box bounds() const { return {centre - radius, centre + radius}; }
    /// The box around the transformed sphere. Exact: its reach along an axis is the length of the matrix's row.
    Box bounds(const glm::dmat4& m) const {
        const DVec3 middle = transform_point(m, centre);
        DVec3 reach;
        for (int i = 0; i < 3; ++i) reach[i] = radius * std::hypot(m[0][i], m[1][i], m[2][i]);
        return {middle - reach, middle + reach};
    }
    /// The sphere after a transformation that scales all lengths by `similarity`.
    Ball ball(const glm::dmat4& m, double similarity) const {
        return {transform_point(m, centre), radius * similarity};
    }
    /// Is p strictly inside?
    bool contains(const DVec3& p) const {
        const DVec3 d = p - centre;
        return d.x * d.x + d.y * d.y + d.z * d.z < radius * radius;
    }
    std::vector<Capsule> capsules() const { return {{centre, centre, radius}}; }
    auto pov() const { return std::tuple("sphere", centre, radius); }

    template <class T>
    using Kernels = std::tuple<SphereKernel<T>, AffineKernel<SphereKernel<T>, T>>;
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        if (to_world.similar())
            emit(SphereKernel<T>{cast<T>(to_world.point(centre)), static_cast<T>(to_world.length(radius))});
        else
            emit(affine<T>(SphereKernel<T>{Vec3<T>(T(0)), T(1)}, centre, radius, bounds(to_world.matrix), bounds(),
                           to_world));
    }
};

}  // namespace strahl
