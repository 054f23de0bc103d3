// Error bounds of a ray's crossing with a triangle, and of the point there.
#pragma once
#include "trace/proof/point_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// A triangle's plane and sides. Exact corners are no further than `own` from the computed ones. To each point of the
/// triangle corresponds the one between the exact corners with the same weights, which is no further off either. Let p
/// be inside the sides by more than E + 3 own, and x a point of the exact plane no further than E from p: then x is in
/// the exact triangle. Otherwise there is a point of an exact side on the way to x from what corresponds to p, which is
/// no longer than E + own, and what corresponds to that point on a side here is nearer to p than own + E + own + own.
/// The same holds for points outside.
///
/// Roundings: n = e x f is off by 2 units of |e| |f|, which is `narrow` times its length, and by 1/2 of this.
template <class S>
struct KnownTriangle {
    Vec3<S> e, f, n;
    S own, width, tall, narrow, tilt;  // error of a corner; |e| + |f|; |n|; |e| |f| / |n|; error of n's direction
    Mask<S> clear;                     // false where it is so small or so narrow that its normal is hardly known

    template <class K>
    STRAHL_INLINE KnownTriangle(const TriangleKernel<K>& triangle, const Slack<Element<S>>& slack) {
        constexpr auto u = unit_error<S>;
        const Vec3<S> a = splat<S>(triangle.a), b = splat<S>(triangle.b), c = splat<S>(triangle.c);
        e = b - a, f = c - a, n = cross(e, f);
        const S e_long = sqrt(dot(e, e)), f_long = sqrt(dot(f, f));
        own = S(slack.share) * (norm1(a) + norm1(b) + norm1(c));
        tall = sqrt(dot(n, n)), width = e_long + f_long, narrow = e_long * f_long / tall;
        tilt = S(2.1) * own * width / tall + S(2 * u) * narrow + S(4 * u);
        clear = (dot(n, n) > S(std::numeric_limits<Element<S>>::min() / u)) & (tilt < S(.01));
    }
    /// Returns how far corner + q is from the nearest side, as computed; below 0 outside.
    STRAHL_INLINE S within(const Vec3<S>& q) const {
        const auto from = [&](const Vec3<S>& side, const Vec3<S>& way) {
            return dot(n, cross(side, way)) / (tall * sqrt(dot(side, side)));
        };
        return min(from(e, q), min(from(-f, q - f), from(f - e, q - e)));
    }
    /// Bounds the errors of within() and of the corners.
    STRAHL_INLINE S edge(const Vec3<S>& q) const {
        return S(3) * own + S(unit_error<S>) * (S(5) + S(3) * narrow) * (norm1(q) + width);
    }
};

/// Bounds the crossing with a triangle. The plane is met at p = o + t d. The exact ray passes p, and any point of the
/// triangle that it meets, at a distance of at most `off`, on a way no longer than `way`; the plane is met no further
/// than that over the slope from there. A ray nearly in the plane meets the triangle, if at all, between its corners;
/// if the plane is further away than `off` and than it may lean towards it on that way, it meets nothing.
template <class S, class K>
STRAHL_INLINE SpanBounds<S> span_bounds(const TriangleKernel<K>& kernel, const Ray<S>& ray, const Doubt<S>& doubt,
                                        const S& start, const Slack<Element<S>>& slack) {
    constexpr auto u = unit_error<S>;
    constexpr auto inf = SpanBounds<S>::inf;
    const KnownTriangle<S> triangle(kernel, slack);
    const Vec3<S> to_a = splat<S>(kernel.a) - ray.origin, d = ray.direction;
    const Vec3<S> to_b = to_a + triangle.e, to_c = to_a + triangle.f;
    const S way = sqrt(max(dot(to_a, to_a), max(dot(to_b, to_b), dot(to_c, to_c))));
    const S over = dot(triangle.n, to_a) / triangle.tall, towards = dot(triangle.n, d) / triangle.tall;
    const S slope = abs(towards) - doubt.turn - triangle.tilt - S(2 * u), t = over / towards;
    const Vec3<S> q = fma(t, d, -to_a);
    const S off = doubt.away + triangle.own + way * (doubt.turn + S(8 * u));
    const S reach = fma(S(3 * u) * triangle.narrow, norm1(q), off) / slope;
    const S within = triangle.within(q), edge = reach + triangle.edge(q);
    const Mask<S> slanted = triangle.clear & (slope > S(0)), elsewhere = !(start == S(0));
    const S leans = fma(way, abs(towards) + S(3 * u) * (S(2) + triangle.narrow), off);
    const S along_e = dot(triangle.e, d), along_f = dot(triangle.f, d);
    const S nearest = dot(to_a, d) + min(S(0), min(along_e, along_f)) - off;
    return {S(-inf),
            S(-inf),
            select(slanted, t - reach, select(nearest > S(0), nearest, S(-inf))),
            select(slanted, t + reach, S(inf)),
            Mask<S>(elsewhere & !((slanted & (within < -edge)) | (triangle.clear & (abs(over) > leans)))),
            Mask<S>(elsewhere & slanted & (within > edge))};
}

/// Bounds how far a point p found on the triangle is off the exact plane. p = a + v e + w f is in the plane of the
/// computed corners but for the roundings of e and f, products and sums.
template <class S>
STRAHL_INLINE S off_surface(const TriangleKernel<S>& kernel, const Vec3<S>& p, const Slack<Element<S>>& slack) {
    const Vec3<S> e = kernel.b - kernel.a, f = kernel.c - kernel.a;
    const S own = S(slack.share) * (norm1(kernel.a) + norm1(kernel.b) + norm1(kernel.c));
    return own + S(.51 * unit_error<S>) * (S(2) * norm1(e) + S(3) * norm1(f) + norm1(kernel.a) + norm1(p));
}
template <class S>
STRAHL_INLINE PointBounds<S> point_bounds(const TriangleKernel<S>& kernel, const Ray<S>& ray, const Doubt<S>& doubt,
                                          const S& t, const SurfacePoint<S>& point, const S&,
                                          const Slack<Element<S>>& slack) {
    const KnownTriangle<S> triangle(kernel, slack);
    const Vec3<S> q = point.position - kernel.a;
    const S off = off_surface(kernel, point.position, slack);
    PointBounds<S> known = point_bounds(ray, doubt, t, point, off, S(0), triangle.tilt);
    known.sure = known.sure & triangle.clear & (triangle.within(q) > known.away + off + triangle.edge(q));
    return known;
}

}  // namespace strahl::inline STRAHL_LEVEL
