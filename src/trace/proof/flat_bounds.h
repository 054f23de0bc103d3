// Error bounds of a ray's crossings with a disc or a box, and of the points there; span_bounds.h has those of round
// bodies.
#pragma once
#include "trace/proof/point_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// Bounds the crossing with a disc, as `far`: open bodies are left only. The plane is met as in span_bounds of a plane.
/// The exact ray meets it no further than `off` from the computed point: the distance between the two rays, seen along
/// the ray on the plane, is no longer than that over the slope.
template <class S, class K>
STRAHL_INLINE SpanBounds<S> span_bounds(const DiscKernel<K>& disc, const Ray<S>& ray, const Doubt<S>& doubt,
                                        const S& start, const Slack<Element<S>>& slack) {
    constexpr auto u = unit_error<S>;
    constexpr auto inf = SpanBounds<S>::inf;
    const Vec3<S> centre = splat<S>(disc.centre), n = splat<S>(disc.normal), f = ray.origin - centre;
    const S r(disc.radius), hole(disc.hole), over = -dot(f, n), slope = dot(ray.direction, n), from = norm1(f);
    const S over_error = doubt.away + S(slack.share) * (norm1(centre) + r) + S(slack.turn + 8 * u) * from;
    const S slope_error = doubt.turn + S(slack.turn + 8 * u), left = abs(slope) - slope_error;
    const S t = over / slope, off = (over_error + abs(t) * slope_error) / left + S(4 * u) * abs(t);
    const Vec3<S> p = fma(t, ray.direction, f);
    const S out = sqrt(dot(p, p));
    const Mask<S> slanted = left > S(0), elsewhere = !(start == S(0));
    const Mask<S> beside = (out - off > r) | (out + off < hole);
    const Mask<S> within = (out + off < r) & ((hole == S(0)) | (out - off > hole));
    // A disc nearly parallel to the ray is met far away, if at all.
    const S nearest = (abs(over) - over_error) / (abs(slope) + slope_error);
    return {S(-inf),
            S(-inf),
            select(slanted, t - off, select(nearest > S(0), nearest, S(-inf))),
            select(slanted, t + off, S(inf)),
            Mask<S>(elsewhere & !(slanted & beside)),
            Mask<S>(elsewhere & slanted & within)};
}

/// Bounds how far a point p found on the disc is off the exact surface. It is put onto the plane: off by the error of
/// the centre, by (3/2 + 1/2) u of the radius for the scalar product and what is taken from it, and by rounding.
template <class S>
STRAHL_INLINE S off_surface(const DiscKernel<S>& disc, const Vec3<S>& p, const Slack<Element<S>>& slack) {
    constexpr auto u = unit_error<S>;
    return S(slack.share) * (norm1(disc.centre) + disc.radius) +
           fma(S(slack.turn + Element<S>(2.5) * u), disc.radius, S(.51 * u) * norm1(p));
}
template <class S>
STRAHL_INLINE Bend<S> bend_of(const DiscKernel<S>&, const Vec3<S>&, const S&, const S&,
                              const Slack<Element<S>>& slack) {
    return {S(0), S(slack.turn)};
}
template <class S>
STRAHL_INLINE Mask<S> on_face(const DiscKernel<S>& disc, const Vec3<S>& p, const S&, const S& edge) {
    const Vec3<S> f = p - disc.centre;
    const S out = sqrt(dot(f, f));
    return (out + edge < disc.radius) & ((disc.hole == S(0)) | (out - edge > disc.hole));
}

/// Bounds the errors of a box's centre and of its corners.
template <class S, class K>
STRAHL_INLINE S own_error(const BoxKernel<K>& box, const Slack<Element<S>>& slack) {
    return S(slack.share) * (norm1(splat<S>(box.centre)) + norm1(splat<S>(box.box.half)));
}
/// Bounds the span in a box, which is what lies between three pairs of planes, as a cylinder between its ends.
/// Row * (x - centre) is off, relative to the row's length, by the error of x, by slack.turn for the row, and by 2
/// units of rounding: f has 1/2, the product 3/2. The slope has another 3 by the direction's length. Faces are at 1 and
/// -1 by definition.
template <class S, class K>
STRAHL_INLINE SpanBounds<S> span_bounds(const BoxKernel<K>& box, const Ray<S>& ray, const Doubt<S>& doubt,
                                        const S& start, const Slack<Element<S>>& slack) {
    constexpr auto u = unit_error<S>;
    constexpr auto inf = SpanBounds<S>::inf;
    const Vec3<S> f = ray.origin - splat<S>(box.centre), d = ray.direction;
    const S turn = S(slack.turn + 15 * u), off = doubt.away + own_error<S>(box, slack) + norm1(f) * turn;
    SpanBounds<S> span{S(-inf), S(-inf), S(inf), S(inf), first_lanes<S>(width<S>), first_lanes<S>(width<S>)};
    for (int i = 0; i < 3; ++i) {
        const Vec3<S> row = splat<S>(i == 0 ? box.row_x : i == 1 ? box.row_y : box.row_z);
        const S length = sqrt(dot(row, row)), face = start - S(static_cast<Element<S>>(2 * i));
        const SpanBounds<S> own = between_ends(dot(row, f) + S(1), dot(row, d), S(2), length * off + S(10 * u),
                                               length * (doubt.turn + turn), face + S(1));
        span.near_low = max(span.near_low, own.near_low), span.near_high = max(span.near_high, own.near_high);
        span.far_low = min(span.far_low, own.far_low), span.far_high = min(span.far_high, own.far_high);
    }
    const Mask<S> here = (start >= S(0)) & (start < S(6));
    span.near_low = select(here, S(-inf), span.near_low), span.near_high = select(here, S(-inf), span.near_high);
    span.maybe = here | !(span.near_low > span.far_high);
    span.sure = here | (span.near_high < span.far_low);
    return span;
}

/// Bounds how far a point p found on the box is off the exact surface. It is put onto the plane of its face: off by the
/// rounding of row * f there, 2 units, and by that of its sums.
template <class S>
STRAHL_INLINE S off_surface(const BoxKernel<S>& box, const Vec3<S>& p, const Slack<Element<S>>& slack) {
    constexpr auto u = unit_error<S>;
    return own_error<S>(box, slack) +
           fma(S(slack.turn + Element<S>(2.5) * u), norm1(p - box.centre), S(.51 * u) * norm1(p));
}
template <class S>
STRAHL_INLINE PointBounds<S> point_bounds(const BoxKernel<S>& box, const Ray<S>& ray, const Doubt<S>& doubt, const S& t,
                                          const SurfacePoint<S>& point, const S& face, const Slack<Element<S>>& slack) {
    constexpr auto u = unit_error<S>;
    const S off = off_surface(box, point.position, slack);
    PointBounds<S> known = point_bounds(ray, doubt, t, point, off, S(0), S(slack.turn + 3 * u));
    const Vec3<S> f = point.position - box.centre;
    const S edge = known.away + off;
    for (int i = 0; i < 3; ++i) {
        const Vec3<S>& row = i == 0 ? box.row_x : i == 1 ? box.row_y : box.row_z;
        const S low(static_cast<Element<S>>(2 * i)), high(static_cast<Element<S>>(2 * i + 1));
        known.sure = known.sure & ((face == low) | (face == high) |
                                   (fma(sqrt(dot(row, row)), edge, abs(dot(row, f))) < S(1 - 4 * u)));
    }
    return known;
}

}  // namespace strahl::inline STRAHL_LEVEL
