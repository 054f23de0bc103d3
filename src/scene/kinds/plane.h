// The plane through three points. The body is the half-space behind its normal.
#pragma once
#include <cmath>
#include <limits>
#include <tuple>

#include "num/ray.h"
#include "scene/kinds/field.h"
#include "scene/kinds/world_transform.h"

namespace strahl {

/// The plane normal . x = distance. A ray crosses it once; the other end of its span is at infinity.
template <class T>
struct PlaneKernel {
    Vec3<T> normal;
    T distance;

    template <class S>
    STRAHL_INLINE Span<S> span(const Ray<S>& ray, S start) const {
        const Vec3<S> n = splat<S>(normal);
        const S t = (S(distance) - dot(n, ray.origin)) / dot(n, ray.direction);
        constexpr auto inf = std::numeric_limits<Element<S>>::infinity();
        const Mask<S> hit = (abs(t) < S(inf)) & !(start == S(0));  // false for a parallel ray too: +-inf or NaN
        return {t, S(inf), hit};
    }
    /// The point at `t`, put back onto the plane.
    template <class S>
    STRAHL_INLINE SurfacePoint<S> at(const Ray<S>& ray, S t, S) const {
        const Vec3<S> n = splat<S>(normal);
        const Vec3<S> p = fma(t, ray.direction, ray.origin);
        return {fma(S(distance) - dot(n, p), n, p), n};
    }
};

/// The normal is (b - a) x (c - a); the inside, which matters for transparent planes, lies away from it.
struct Plane {
    DVec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};

    bool operator==(const Plane&) const = default;

    static constexpr const char* name = "plane";
    static constexpr int faces = 1, max_crossings = 1;
    static constexpr bool bounded = false, convex = true, closed = true, hot = true, plane_faces = true;
    static constexpr auto fields = std::make_tuple(Field{"first point", &Plane::a, "a point of the plane"},
                                                   Field{"second point", &Plane::b, "another point"},
                                                   Field{"third point", &Plane::c, "a third point, not on their line"});
    /// The unit normal; not finite if the points lie on a line.
    DVec3 normal() const {
        const DVec3 u = b - a, v = c - a;
        // Lengths are taken out first, so that neither tiny nor huge triangles under- or overflow.
        const double lu = std::hypot(u.x, u.y, u.z), lv = std::hypot(v.x, v.y, v.z);
        const DVec3 p = u / lu, q = v / lv;
        const DVec3 n{p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
        const double length = std::hypot(n.x, n.y, n.z);
        return length > 1e-14 ? n / length : DVec3(std::numeric_limits<double>::quiet_NaN());
    }
    const char* fault() const { return std::isnan(normal().x) ? "the three points lie on one line" : nullptr; }
    Box bounds() const {
        constexpr double inf = std::numeric_limits<double>::infinity();
        return {DVec3(-inf), DVec3(inf)};
    }
    bool contains(const DVec3& p) const {
        const DVec3 n = normal(), d = p - a;
        return n.x * d.x + n.y * d.y + n.z * d.z < 0;
    }
    HalfSpace half_space(const glm::dmat4& m) const {
        const DVec3 n = glm::transpose(glm::inverse(glm::dmat3(m))) * normal();
        return {transform_point(m, a), n / std::sqrt(dot_product(n, n))};
    }
    /// POV-Ray's inside is normal . p < distance: the half-space behind the normal, as here.
    auto pov() const {
        const DVec3 n = normal();
        return std::tuple("plane", n, dot_product(n, a));
    }

    template <class T>
    using Kernels = std::tuple<PlaneKernel<T>>;  // under any transformation a plane is a plane
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        const HalfSpace body = half_space(to_world.matrix);
        const DVec3 n = body.normal, p = to_world.place(body.point);
        emit(PlaneKernel<T>{cast<T>(n), static_cast<T>(dot_product(n, p))});
    }
};

}  // namespace strahl
