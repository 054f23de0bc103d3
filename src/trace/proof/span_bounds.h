// Between which numbers exact arithmetic has the crossings of a ray with a ball, a plane or a cylinder.
#pragma once
#include "trace/forms/items_kernel.h"
#include "trace/proof/proving_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

/// Of a ray: the exact one starts no further than `away` from the computed origin, and its direction, of length 1, is
/// no further than `turn` from the computed one brought to length 1; that of the latter is off by at most 3 units. Its
/// line passes the computed origin no further than `side`, which is less where rays leave surfaces at an angle. `spin`
/// is for rays that stay in the body on which they start, see bound_inside. Rays that are not followed have nothing of
/// the kind, `away` is below 0: all light that they may bring is in the bound of their pixel already.
template <class S>
struct Doubt {
    S away, turn, side = away, spin{std::numeric_limits<Element<S>>::infinity()};
};

/// A unit: twice the rounding of an operation, as a share of its result. Formulas count roundings, without fma, and so
/// halves of it. A vector's are no longer than a share of the vector; a scalar product of unit vectors is off by 3/2
/// units, a vector divided by its length by 9/4 in length and by 1/2 in direction.
template <class S>
inline constexpr Element<S> unit_error = std::numeric_limits<Element<S>>::epsilon();

template <class S>
STRAHL_INLINE S norm1(const Vec3<S>& v) {
    return abs(v.x) + abs(v.y) + abs(v.z);
}

/// Where the exact ray enters and leaves a convex body, if it does: certainly where `sure`, certainly not where not
/// `maybe`. What of that is behind the ray's start, or is the start, may be told as -infinity.
template <class S>
struct SpanBounds {
    static constexpr Element<S> inf = std::numeric_limits<Element<S>>::infinity();
    S near_low{-inf}, near_high{-inf}, far_low{-inf}, far_high{-inf};
    Mask<S> maybe, sure;
};

/// The line passes the centre at a distance that is off by at most d; b is off by no more, nor is the radius.
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
    // A parallel plane is met far away, if at all.
    const S nearest = (abs(over) - over_error) / (abs(towards) + towards_error);
    return {select(slanted, t - off, nearest), select(slanted, t + off, S(inf)), S(-inf), S(-inf), elsewhere,
            Mask<S>(elsewhere & slanted)};
}

/// Between the planes of a cylinder's ends; rays may start on one. The errors of `along` and of the slope hold 9 units
/// more than their own roundings, as shares of |along| and of 1: these are for roundings here.
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
    // Of a ray across the axis that starts between the ends, both are far away; so is the way in from beyond them.
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

/// As for the ball, seen along the axis, where the ray is only m long.
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
