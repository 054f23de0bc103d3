// Any kernel under a transformation that does not keep angles, as for an ellipsoid.
#pragma once
#include "num/ray.h"
#include "scene/kinds/hit_box.h"

namespace strahl {

/// The kernel K in a space of its own: own = rows * (world - centre).
template <class K, class T>
struct AffineKernel {
    Vec3<T> centre, row_x, row_y, row_z;
    HitBox<T> box;
    K shape;

    /// Returns the rays that start on a face of it.
    template <class S>
    STRAHL_INLINE static Mask<S> starts_here(S start) {
        constexpr int faces = [] {
            if constexpr (requires { K::faces; })
                return K::faces;
            else
                return 1;
        }();
        return (start >= S(0)) & (start < S(faces));
    }
    /// Does a ray that starts on face `start` meet the body there? If so it is in the box, however thin that is.
    template <class S>
    STRAHL_INLINE Mask<S> meets_box(const Ray<S>& ray, S t, S start) const {
        return box.holds(ray, t, abs(t)) | starts_here(start);
    }

    template <class S>
    struct Local {
        Ray<S> ray;
        S stretch;  // local length of a world length of 1
    };
    template <class S>
    STRAHL_INLINE Vec3<S> to_local(const Vec3<S>& v) const {
        return {dot(splat<S>(row_x), v), dot(splat<S>(row_y), v), dot(splat<S>(row_z), v)};
    }
    template <class S>
    STRAHL_INLINE Local<S> to_local(const Ray<S>& ray) const {
        const Vec3<S> d = to_local(ray.direction);
        const S stretch = sqrt(dot(d, d));
        return {{to_local(ray.origin - splat<S>(centre)), scale(S(1) / stretch, d), ray.source}, stretch};
    }
    template <class S>
    STRAHL_INLINE auto crossings(const Ray<S>& ray, S start, Mask<S> lanes = all_lanes<S>()) const requires requires {
        shape.crossings(ray, start);
    }
    {
        lanes = lanes & (starts_here(start) | box.may_meet(ray));
        const Local<S> local = to_local(ray);
        auto crossings = crossings_in(shape, local.ray, start, lanes);
        for (S& t : crossings.t) t = t / local.stretch;
        crossings.hit = crossings.hit & meets_box(ray, first_crossing(crossings), start);
        return crossings;
    }
    template <class S>
    STRAHL_INLINE Span<S> span(const Ray<S>& ray, S start, Mask<S> lanes = all_lanes<S>()) const requires requires {
        shape.span(ray, start);
    }
    {
        lanes = lanes & (starts_here(start) | box.may_meet(ray));
        const Local<S> local = to_local(ray);
        Span<S> span = crossings_in(shape, local.ray, start, lanes);
        if (none(span.hit)) return span;
        span.near = span.near / local.stretch, span.far = span.far / local.stretch;
        span.hit = span.hit & meets_box(ray, first_crossing(span), start);
        return span;
    }
    template <class S>
    STRAHL_INLINE SurfacePoint<S> at(const Ray<S>& ray, S t, S face) const {
        const Local<S> local = to_local(ray);
        const SurfacePoint<S> point = shape.at(local.ray, t * local.stretch, face);
        // Normals are transformed by the transposed inverse, whose rows these are.
        const Vec3<S> n = fma(point.normal.x, splat<S>(row_x),
                              fma(point.normal.y, splat<S>(row_y), scale(point.normal.z, splat<S>(row_z))));
        return {fma(t, ray.direction, ray.origin), scale(S(1) / sqrt(dot(n, n)), n)};
    }
};

/// Makes such a kernel. `shape` stands at the origin of a space whose origin is `centre` in the primitive's own space,
/// and whose unit is `unit` there. `bounds` is the box around the transformed shape, `local` that in the primitive's
/// own space.
template <class T, class K>
AffineKernel<K, T> affine(const K& shape, const DVec3& centre, double unit, const Box& bounds, const Box& local,
                          const WorldTransform& to_world) {
    const glm::dmat3 inverse = glm::inverse(glm::dmat3(to_world.matrix)) * (1 / (unit * to_world.scale));
    const auto row = [&](int i) { return cast<T>(DVec3(inverse[0][i], inverse[1][i], inverse[2][i])); };
    return {cast<T>(to_world.point(centre)), row(0), row(1), row(2), HitBox<T>::of(bounds, local, to_world), shape};
}

}  // namespace strahl
