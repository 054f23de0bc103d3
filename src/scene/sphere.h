// The sphere: a centre and a radius.
#pragma once
#include <tuple>

#include "num/box.h"
#include "num/ray.h"
#include "scene/field.h"

namespace strahl {

struct Sphere {
    DVec3 centre{0};
    double radius = 1;

    bool operator==(const Sphere&) const = default;

    static constexpr const char* name = "sphere";
    static constexpr int faces = 1;
    static constexpr auto fields = std::make_tuple(Field{"centre", &Sphere::centre, "the centre"},
                                                   Field{"radius", &Sphere::radius, "the radius", Range::positive});
    /// Why these values make no body, or nullptr.
    const char* fault() const { return nullptr; }
    Box bounds() const { return {centre - radius, centre + radius}; }
    /// Is p strictly inside?
    bool contains(const DVec3& p) const {
        const DVec3 d = p - centre;
        return d.x * d.x + d.y * d.y + d.z * d.z < radius * radius;
    }
};

/// The sphere as the kernel sees it, for one number or lane by lane.
template <class T>
struct SphereKernel {
    static constexpr int faces = Sphere::faces;
    Vec3<T> centre;
    T radius;

    Ball ball() const { return {DVec3(centre), static_cast<double>(radius)}; }

    /// Closest approach first, then half the chord: r^2 - |l|^2 does not cancel the way b^2 - c does (E. Haines,
    /// J. Guenther, T. Akenine-Moeller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019).
    /// A ray that starts on this sphere has the roots 0 and 2b.
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
        return {fma(S(radius), normal, c), normal, S(0)};
    }
};

}  // namespace strahl
