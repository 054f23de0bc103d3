// Errors of rays, and bounds between which exact arithmetic has their crossings with a ball, a plane or a cylinder.
//
// Each formula takes a computed ray and what is known of its error (Doubt), adds the error of the body's own numbers
// (Slack) and the rounding errors of its own operations, and returns intervals that contain the exact crossings.
#pragma once
#include "trace/forms/items_kernel.h"
#include "trace/proof/proving_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

/// Bounds how far a computed ray may be from the exact one, the ray that exact arithmetic would trace in its place:
/// - `away`: the distance between the two origins.
/// - `turn`: the length of the difference between the two directions, both brought to length 1: as good as the angle
///   between them, in radians. (The kernel's direction itself is at most 3 units longer or shorter than 1.) At distance
///   t, the exact ray is no further than away + t turn from the computed one.
/// - `side`: the distance at which the exact ray's line passes the computed origin. It is at most `away`, and less
///   where rays leave surfaces at a slant, since an error of the origin along the ray does not move the line.
/// - `spin`: of rays that go round inside a ball or a cylinder: the error of what mirrors there keep, f x d of the
///   vector f from the centre and the direction d, as a share of the radius. See bound_inside; infinite if not known.
///
/// A ray is followed as long as these are known. One that is not followed has an `away` below 0 and nothing else: all
/// light that it may bring has been added to its pixel's bound.
template <class S>
struct Doubt {
    S away, turn, side = away, spin{std::numeric_limits<Element<S>>::infinity()};
};

/// One unit: the rounding error of an operation is at most half of it, as a share of the result. Formulas count
/// roundings, as if nothing were fused, and so halves of a unit. The rounding error of a vector is no longer than such
/// a share of the vector. A scalar product of unit vectors is off by 3/2 units, a vector divided by its length by 9/4
/// in length and by 1/2 in direction.
template <class S>
inline constexpr Element<S> unit_error = std::numeric_limits<Element<S>>::epsilon();

template <class S>
STRAHL_INLINE S norm1(const Vec3<S>& v) {
    return abs(v.x) + abs(v.y) + abs(v.z);
}

/// Bounds where the exact ray enters and leaves a convex body, as distances along it: within [near_low, near_high] and
/// [far_low, far_high]. It certainly meets the body where `sure`, and certainly does not where not `maybe`. Crossings
/// behind the ray's start, or at it, may be given as -infinity.
template <class S>
struct SpanBounds {
    static constexpr Element<S> inf = std::numeric_limits<Element<S>>::infinity();
    S near_low{-inf}, near_high{-inf}, far_low{-inf}, far_high{-inf};
    Mask<S> maybe, sure;
};

/// Bounds the span in a ball. The line's distance from the centre is off by at most d; b is off by no more, nor is the
/// radius.
template <class S, class K>
STRAHL_INLINE SpanBounds<S> span_bounds(const SphereKernel<K>& ball, const Ray<S>& ray, const Doubt<S>& doubt,
                                        const S& start, const Slack<Element<S>>& slack) {
    constexpr auto u = unit_error<S>;
    const Vec3<S> to_centre = splat<S>(ball.centre) - ray.origin;
    const S b = dot(to_centre, ray.direction), r = S(ball.radius);
    const Vec3<S> l = fma(-b, ray.direction, to_centre);
    const S square = fma(r, r, -dot(l, l));
    const S own = S(slack.share) * (norm1(splat<S>(ball.centre)) + r);
    const S d = S(1.1) * (doubt.away + own + (abs(b) + r + r) * (doubt.turn + S(12 * u)));
    const S e = fma(S(2) * d, r + d, S(8 * u) * (r * r));
    const Mask<S> here = start == S(0), maybe = here | (!(square + e <= S(0)));
    if (none(maybe)) return {S(0), S(0), S(0), S(0), maybe, maybe};
    const S least = sqrt(max(square - e, S(0))), most = sqrt(max(square + e, S(0))), other = b + b;
    return {select(here, S(-SpanBounds<S>::inf), b - most - d),
            select(here, S(-SpanBounds<S>::inf), b - least + d),
            select(here, other - (d + d), b + least - d),
            select(here, other + (d + d), b + most + d),
            maybe,
            Mask<S>(here | (square - e > S(0)))};
}

template <class S, class K>
STRAHL_INLINE SpanBounds<S> span_bounds(const PlaneKernel<K>& plane, const Ray<S>& ray, const Doubt<S>& doubt,
                                        const S& start, const Slack<Element<S>>& slack) {
    constexpr auto u = unit_error<S>;
    constexpr auto inf = SpanBounds<S>::inf;
    const Vec3<S> n = splat<S>(plane.normal);
    const S distance(plane.distance), over = distance - dot(n, ray.origin), towards = dot(n, ray.direction);
    const S from = norm1(ray.origin);
    const S over_error = doubt.away + S(slack.plane) + S(slack.turn) * from + S(8 * u) * (from + abs(distance));
    const S towards_error = doubt.turn + S(slack.turn + 8 * u), left = abs(towards) - towards_error;
    const S t = over / towards, off = (over_error + abs(t) * towards_error) / left + S(4 * u) * abs(t);
    const Mask<S> slanted = left > S(0), elsewhere = !(start == S(0));
    // A plane nearly parallel to the ray is met far away, if at all.
    const S nearest = (abs(over) - over_error) / (abs(towards) + towards_error);
    return {select(slanted, t - off, nearest), select(slanted, t + off, S(inf)), S(-inf), S(-inf), elsewhere,
            Mask<S>(elsewhere & slanted)};
}

/// Bounds the span between the planes of a cylinder's ends; rays may start on one of them. The errors of `along` and of
/// the slope include 9 units more than their own roundings, as shares of |along| and of 1: these are for the roundings
/// here.
template <class S>
STRAHL_INLINE SpanBounds<S> between_ends(const S& along, const S& slope, const S& height, const S& error,
                                         const S& slope_error, const S& start) {
    constexpr auto inf = SpanBounds<S>::inf;
    constexpr auto u = unit_error<S>;
    const Mask<S> at_base = start == S(1), at_cap = start == S(2);
    const S left = abs(slope) - slope_error;
    const S to_base = select(at_base, S(0), -along / slope), to_cap = select(at_cap, S(0), (height - along) / slope);
    const S off_base = select(at_base, S(0), (error + abs(to_base) * slope_error) / left + S(4 * u) * abs(to_base));
    const S off_cap = select(at_cap, S(0), (error + abs(to_cap) * slope_error) / left + S(4 * u) * abs(to_cap));
    const Mask<S> slanted = left > S(0);
    // If a ray nearly perpendicular to the axis starts between the ends, both are far away; if it starts beyond them,
    // so is the way in.
    const S room = (min(along, height - along) - error) / (abs(slope) + slope_error);
    const S gap = (max(-along, along - height) - error) / (abs(slope) + slope_error);
    const Mask<S> within = room > S(0), beyond = gap > S(0);
    SpanBounds<S> span;
    span.near_low = select(slanted, min(to_base - off_base, to_cap - off_cap), select(beyond, gap, S(-inf)));
    span.near_high = select(slanted, min(to_base + off_base, to_cap + off_cap), select(within, -room, S(inf)));
    span.far_low = select(slanted, max(to_base - off_base, to_cap - off_cap), select(within, room, S(-inf)));
    span.far_high = select(slanted, max(to_base + off_base, to_cap + off_cap), S(inf));
    span.maybe = span.sure = first_lanes<S>(width<S>);
    return span;
}

/// Bounds the span in a cylinder: as for the ball, seen along the axis, where the ray's direction is only m long.
template <class S, class K>
STRAHL_INLINE SpanBounds<S> span_bounds(const CylinderKernel<K>& cylinder, const Ray<S>& ray, const Doubt<S>& doubt,
                                        const S& start, const Slack<Element<S>>& slack) {
    constexpr auto u = unit_error<S>;
    constexpr auto inf = SpanBounds<S>::inf;
    const Vec3<S> base = splat<S>(cylinder.base), a = splat<S>(cylinder.axis), f = ray.origin - base, d = ray.direction;
    const S r(cylinder.radius), height(cylinder.height);
    const S along_f = dot(f, a), along_d = dot(d, a);
    const Vec3<S> across_f = fma(-along_f, a, f), across_d = fma(-along_d, a, d);
    const S qa = dot(across_d, across_d), m = sqrt(qa), t0 = -dot(across_f, across_d) / qa, w = dot(a, cross(f, d));
    const S own = S(slack.share) * (norm1(base) + r + height) + S(slack.turn) * height;
    const S turn = doubt.turn + S(slack.turn + 12 * u);
    const S off = S(1.1) * (doubt.away + own + (S(2) * abs(t0) + abs(along_f) + S(4) * r) * turn / m);
    const S square = fma(r, r, -(w * w / qa)), e = fma(S(2) * off, r + off, S(8 * u) * (r * r));
    const Mask<S> steep = m > S(32) * turn, own_side = start == S(0), here = (start >= S(0)) & (start < S(3));
    const Mask<S> maybe = here | (!steep) | (!(square + e <= S(0)));
    if (none(maybe)) return {S(0), S(0), S(0), S(0), maybe, maybe};
    const S least = sqrt(max(square - e, S(0))), most = sqrt(max(square + e, S(0)));
    const auto side = [&](const S& value, const S& else_value) { return select(steep, value / m, else_value); };
    const S middle_low = select(steep, t0, S(0)), other = t0 + t0, other_off = side(off + off, S(inf));
    const S side_near_low = middle_low - side(most + off, S(inf)),
            side_near_high = middle_low - side(least - off, S(-inf));
    const S side_far_low =
        select(own_side, select(steep, other - other_off, S(-inf)), middle_low + side(least - off, S(-inf)));
    const S side_far_high =
        select(own_side, select(steep, other + other_off, S(inf)), middle_low + side(most + off, S(inf)));
    const SpanBounds<S> ends =
        between_ends(along_f, along_d, height, S(doubt.away + own + norm1(f) * turn), turn, start);
    SpanBounds<S> span;
    span.near_low = select(here, S(-inf), max(side_near_low, ends.near_low));
    span.near_high = select(here, S(-inf), max(side_near_high, ends.near_high));
    span.far_low = min(side_far_low, ends.far_low), span.far_high = min(side_far_high, ends.far_high);
    span.maybe = here | (maybe & !(span.near_low > span.far_high));
    span.sure = here | (steep & (square - e > S(0)) & (span.near_high < span.far_low));
    return span;
}

}  // namespace strahl::inline STRAHL_LEVEL
