// Between which numbers exact arithmetic has the crossings of a ray with a ball, a plane or a cylinder.
#pragma once
#include "trace/items.h"
#include "trace/kernel.h"

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

/// What is known of a point where a ray meets a surface: how far the exact point may be, by how much its normal may be
/// turned, and half of what a mirrored ray is turned by that; how far the exact ray's line passes the point, and how
/// high the point is above the plane that touches the exact surface at the exact point. `sure` if the exact ray meets
/// the same face there. `spin` is that of the mirrored ray.
template <class S>
struct PointBounds {
    S away, normal, mirrored, side, height;
    Mask<S> sure;
    S spin{std::numeric_limits<Element<S>>::infinity()};
};

/// Of a point p whose distance from its own exact surface is at most `off`, on a surface of curvature k, by how far the
/// ray misses it: whatever found it. `turned`: by how much the normal there differs from that of the exact surface.
///
/// The exact ray's line passes p at a distance of at most g; what this misses is rounded by (t + |p|) u / 2. It meets
/// the plane that touches the surface no further than g / c from p, c being the cosine, and there the surface is within
/// off + k X^2 / 2 of that plane, where X is how far the exact point is: c X <= g + off + k X^2 / 2, of which the
/// smaller root is 2 d / (c + sqrt(c^2 - 2 k d)) with d = g + off. Factors of 1.1 in k and 1.001 are for k d < .001 and
/// for rounding.
///
/// Of a surface that is bent across an axis only, m is the length of the ray's part across that axis. Along s, at right
/// angles to the axis and the normal n, the exact point is no further than m X: of g the vector s - n (d s) / (d n)
/// counts, which is m / c long, of the height (d s) / (d n). So the normal is turned by k m X, across the axis, and of
/// the ray only what is across it is mirrored elsewhere, by twice that.
template <class S>
STRAHL_INLINE PointBounds<S> point_bounds(const Ray<S>& ray, const Doubt<S>& doubt, const S& t,
                                          const SurfacePoint<S>& point, const S& off, const S& k, const S& turned,
                                          const S& m = S(1)) {
    constexpr auto u = unit_error<S>;
    const Vec3<S> missed = point.position - fma(t, ray.direction, ray.origin);
    const S rounding = S(.51 * u) * (norm1(point.position) + t);
    const S side = doubt.side + t * doubt.turn + norm1(missed) + rounding, d = side + off;
    const S cosine = abs(dot(ray.direction, point.normal)) - doubt.turn - turned - S(8 * u);
    const S square = fma(cosine, cosine, S(-2.2) * k * d);
    const S away = S(2.002) * d / (cosine + sqrt(max(square, S(0))));
    const S across = min(m + doubt.turn + turned + S(8 * u), S(1)), bent = S(1.002) * k * away * across;
    const Mask<S> sure =
        (cosine > S(0)) & (square > S(0)) & (k * d < S(.001)) & (away + doubt.away + d + S(4 * u) * t < t);
    return {away, bent + turned, fma(across, bent, turned), side, fma(S(.55) * k * away, away, off), sure};
}

/// How far a point p that was found on a body may be off the exact one's surface. p = c + r n: by the rounding of this,
/// (r + |p|) u / 2, and by r times what n is too long, 9/4 u.
template <class S>
STRAHL_INLINE S off_surface(const SphereKernel<S>& ball, const Vec3<S>& p, const Slack<Element<S>>& slack) {
    return S(slack.share) * (norm1(ball.centre) + ball.radius) +
           S(unit_error<S>) * fma(S(2.8), ball.radius, S(.51) * norm1(p));
}
/// p is put onto the plane: off by the rounding of n p, 3/2 |p| u, and of this.
template <class S>
STRAHL_INLINE S off_surface(const PlaneKernel<S>&, const Vec3<S>& p, const Slack<Element<S>>& slack) {
    return fma(S(slack.turn + Element<S>(2.1) * unit_error<S>), norm1(p), S(slack.plane));
}
/// With f, no longer than r + height, from the base to p: what is across the axis is off by at most 4 |f| u along it,
/// the end's height by 5/4 u, the radius by 11/4 u, and all of it by the rounding of two sums.
template <class S>
STRAHL_INLINE S off_surface(const CylinderKernel<S>& cylinder, const Vec3<S>& p, const Slack<Element<S>>& slack) {
    const S own = S(slack.share) * (norm1(cylinder.base) + cylinder.radius + cylinder.height);
    const S rounding = fma(S(7), cylinder.radius + cylinder.height, S(.51) * norm1(p));
    return own + fma(S(slack.turn), cylinder.height, S(unit_error<S>) * rounding);
}

/// Of a face near a point that was found on it: its curvature, and by how much the normal there differs from that of
/// the exact surface.
template <class S>
struct Bend {
    S curvature, turned;
};
/// The exact normal at x is (x - c) / r, that is n, (x - p) / r and by what n is too long. Slack counts in both.
template <class S>
STRAHL_INLINE Bend<S> bend_of(const SphereKernel<S>& ball, const Vec3<S>&, const S&, const S& off,
                              const Slack<Element<S>>&) {
    const S k = S(1) / ball.radius;
    return {k, k * off};
}
template <class S>
STRAHL_INLINE Bend<S> bend_of(const PlaneKernel<S>&, const Vec3<S>&, const S&, const S&,
                              const Slack<Element<S>>& slack) {
    return {S(0), S(slack.turn)};
}
template <class S>
STRAHL_INLINE Bend<S> bend_of(const CylinderKernel<S>& cylinder, const Vec3<S>&, const S& face, const S& off,
                              const Slack<Element<S>>& slack) {
    const S k = select(face == S(0), S(1) / cylinder.radius, S(0));
    return {k, fma(S(2) * k, off, S(slack.turn))};
}

/// How long the part of a ray of length 1 is that is across the axis, of surfaces that are bent across an axis only.
template <class S, class K>
STRAHL_INLINE S across_axis(const K&, const Vec3<S>&) {
    return S(1);
}
template <class S>
STRAHL_INLINE S across_axis(const CylinderKernel<S>& cylinder, const Vec3<S>& direction) {
    const Vec3<S> across = cross(cylinder.axis, direction);
    return sqrt(dot(across, across));
}

/// Is the face certainly all there is of the surface within `edge` of a point of it?
template <class S>
STRAHL_INLINE Mask<S> on_face(const SphereKernel<S>&, const Vec3<S>&, const S&, const S&) {
    return first_lanes<S>(width<S>);
}
template <class S>
STRAHL_INLINE Mask<S> on_face(const PlaneKernel<S>&, const Vec3<S>&, const S&, const S&) {
    return first_lanes<S>(width<S>);
}
template <class S>
STRAHL_INLINE Mask<S> on_face(const CylinderKernel<S>& cylinder, const Vec3<S>& p, const S& face, const S& edge) {
    const Vec3<S> f = p - cylinder.base;
    const S along = dot(f, cylinder.axis);
    const Vec3<S> across = fma(-along, cylinder.axis, f);
    const Mask<S> side = face == S(0), inside = sqrt(dot(across, across)) + edge < cylinder.radius;
    const Mask<S> between = (along > edge) & (along + edge < cylinder.height);
    return (side & between) | ((!side) & inside);
}

/// Bodies in which rays that are mirrored by their side go round without their bounds growing, see bound_inside.
template <class K>
inline constexpr bool RoundInside = false;
template <class S>
inline constexpr bool RoundInside<SphereKernel<S>> = true;
template <class S>
inline constexpr bool RoundInside<CylinderKernel<S>> = true;

/// Of rays that meet from inside the round side, of radius r, on which they start.
///
/// With f from the centre to any point of a ray, mirrors there keep h = f x d, and of a cylinder its part along the
/// axis and that of d: by no more than `spin` are these off, h as a share of r. Seen along the axis, in which d is m
/// long, the side is met at an angle whose sine is s = |h| / (r m) and whose cosine C is c / m. There d is turned by
/// twice the angle whose sine is C; what s is off by e, turns it by 2 e / C more, while what d was off stays as it is. h
/// is off by the spin, m by that times a / m, a being d's part along the axis: e = spin (1 + s a / m) / m. So half of
/// what a mirrored ray is turned is m e / C = spin (m + s a) / c. A factor of 1.01 is for what the squares of e and of
/// the spin do where they are below a thousandth of those of C and of m.
///
/// The computed ray misses the point by `missed`, and that is up to `off` beside the surface; the normal is `turned`.
/// This moves what is mirrored, and changes the spin as often as that happens. Roundings: 10 units of the direction.
template <class S>
[[gnu::noinline]] void bound_inside(const S& r, const Ray<S>& ray, const Doubt<S>& doubt, const S& t,
                                    const SurfacePoint<S>& point, const S& face, const S& off, const S& turned,
                                    const S& m, PointBounds<S>& known) {
    constexpr auto u = unit_error<S>;
    const Mask<S> inside = (ray.source == S(0)) & (face == S(0));
    if (none(inside)) return;
    const S missed = norm1(point.position - fma(t, ray.direction, ray.origin)) + S(u) * (norm1(point.position) + t);
    const S moved = S(2) * ((missed + off) / r + turned) + S(10 * u);
    const S spin = min(doubt.spin, known.side / r + doubt.turn) + moved;
    const S c = abs(dot(ray.direction, point.normal)), along = sqrt(max(fma(-m, m, S(1)), S(0)) + S(16 * u)) + spin;
    const S sine = sqrt(max(fma(m, m, -(c * c)), S(0)) + S(16 * u)) / m, error = spin * fma(sine, along, m);
    const Mask<S> mild = inside & (error < S(.001f) * c * c) & (spin < S(.001f) * m * m);
    known.mirrored = select(mild, min(known.mirrored, S(1.01) * error / c + moved), known.mirrored);
    known.spin = select(inside, spin, known.spin);
}

/// Of a point that was put onto a body's surface. The ray's source is the face of the body on which it starts.
template <class S, class K>
STRAHL_INLINE PointBounds<S> point_bounds(const K& body, const Ray<S>& ray, const Doubt<S>& doubt, const S& t,
                                          const SurfacePoint<S>& point, const S& face, const Slack<Element<S>>& slack)
    requires requires { bend_of(body, point.position, face, face, slack); }
{
    const S off = off_surface(body, point.position, slack);
    const Bend<S> bend = bend_of(body, point.position, face, off, slack);
    const S m = across_axis(body, ray.direction);
    PointBounds<S> known = point_bounds(ray, doubt, t, point, off, bend.curvature, bend.turned, m);
    const S edge = known.away + off;
    known.sure = known.sure & on_face(body, point.position, face, edge);
    if constexpr (RoundInside<K>) bound_inside(body.radius, ray, doubt, t, point, face, off, bend.turned, m, known);
    return known;
}

}  // namespace strahl::inline STRAHL_LEVEL
