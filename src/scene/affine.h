// Any shape under a transformation that does not keep it similar: an ellipsoid, say.
#pragma once
#include "num/ray.h"

namespace strahl {

/// K in a space of its own: local = rows * (world - centre).
template <template <class> class K>
struct Affine {
    template <class T>
    struct Kernel {
        static constexpr int faces = K<T>::faces;
        Vec3<T> centre, row_x, row_y, row_z;
        K<T> shape;

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
        STRAHL_INLINE Span<S> span(const Ray<S>& ray, S start) const {
            const Local<S> local = to_local(ray);
            const Span<S> span = shape.span(local.ray, start);
            return {span.near / local.stretch, span.far / local.stretch, span.hit};
        }
        template <class S>
        STRAHL_INLINE SurfacePoint<S> at(const Ray<S>& ray, S t, S start) const {
            const Local<S> local = to_local(ray);
            const SurfacePoint<S> point = shape.at(local.ray, t * local.stretch, start);
            // Normals go by the transposed inverse, whose rows these are.
            const Vec3<S> n = fma(point.normal.x, splat<S>(row_x),
                                  fma(point.normal.y, splat<S>(row_y), scale(point.normal.z, splat<S>(row_z))));
            return {fma(t, ray.direction, ray.origin), scale(S(1) / sqrt(dot(n, n)), n), point.face};
        }
    };
};

}  // namespace strahl
