// Error bounds of a ray's crossing with a smooth triangle, and of the normal there.
#pragma once
#include "trace/proof/triangle_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// Bounds the crossing, which is that of the flat triangle.
template <class S, class K>
STRAHL_INLINE SpanBounds<S> span_bounds(const SmoothTriangleKernel<K>& triangle, const Ray<S>& ray,
                                        const Doubt<S>& doubt, const S& start, const Slack<Element<S>>& slack) {
    return span_bounds(triangle.flat, ray, doubt, start, slack);
}
template <class S>
STRAHL_INLINE S off_surface(const SmoothTriangleKernel<S>& triangle, const Vec3<S>& p, const Slack<Element<S>>& slack) {
    return off_surface(triangle.flat, p, slack);
}

/// Bounds the errors of a point and of its normal. The normal is computed once more: the sum of the corners' normals,
/// of which the longest is 1, by the weights of p. The point with the exact point's weights between the corners here is
/// no further from p than the exact point is and the corners are off, and edge() bounds the errors of p's weights: per
/// length the sum changes by at most `slope`. Its error has slack.turn of the normals, 4 units of each and of its own.
/// The kernel's normal is compared with it. On which side of that normal the ray comes must be certain, for it is
/// turned to that side.
template <class S>
[[gnu::noinline]] PointBounds<S> point_bounds(const SmoothTriangleKernel<S>& kernel, const Ray<S>& ray,
                                              const Doubt<S>& doubt, const S& t, const SurfacePoint<S>& point,
                                              const S& face, const Slack<Element<S>>& slack) {
    constexpr auto u = unit_error<S>;
    const KnownTriangle<S> triangle(kernel.flat, slack);
    const SurfacePoint<S> flat{point.position, kernel.flat.normal(ray)};
    PointBounds<S> known = point_bounds(kernel.flat, ray, doubt, t, flat, face, slack);
    const Vec3<S> q = point.position - kernel.flat.a, to_b = kernel.normal_b - kernel.normal_a,
                  to_c = kernel.normal_c - kernel.normal_a;
    const S whole = triangle.tall * triangle.tall;
    const S v = dot(triangle.n, cross(q, triangle.f)) / whole, w = dot(triangle.n, cross(triangle.e, q)) / whole;
    const Vec3<S> bent = fma(v, to_b, fma(w, to_c, kernel.normal_a));
    const S length = sqrt(dot(bent, bent));
    const S slope =
        (sqrt(dot(to_b, to_b) * dot(triangle.f, triangle.f)) + sqrt(dot(to_c, to_c) * dot(triangle.e, triangle.e))) /
        triangle.tall;
    const S off = slope * (known.away + triangle.edge(q)) + S(slack.turn + 16 * u);
    const S side = select(dot(bent, point.normal) < S(0), S(-1), S(1));
    const S wrong = norm1(fma(side, point.normal, scale(S(-1) / length, bent)));
    known.normal = known.mirrored = S(1.02) * off / length + wrong + S(4 * u);
    known.height = known.away;  // measured along a normal that is not the plane's
    known.sure = known.sure & (off < S(.01f) * length) &
                 (abs(dot(ray.direction, point.normal)) > known.normal + doubt.turn + S(8 * u));
    return known;
}

}  // namespace strahl::inline STRAHL_LEVEL
