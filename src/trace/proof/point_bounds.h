// Error bounds of the point where a ray meets a surface, and of what goes on from there.
#pragma once
#include "trace/proof/span_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// Error bounds of a point where a ray meets a surface:
/// - `away`: the distance to the exact point.
/// - `normal`: how far the normal may be turned.
/// - `mirrored`: half of how far that turns a mirrored ray.
/// - `side`: the distance at which the exact ray's line passes the point.
/// - `height`: the distance of the point from the plane that touches the exact surface at the exact point.
/// - `sure`: the exact ray meets the same face there.
/// - `spin`: that of the mirrored ray, see Doubt.
template <class S>
struct PointBounds {
    S away, normal, mirrored, side, height;
    Mask<S> sure;
    S spin{std::numeric_limits<Element<S>>::infinity()};
};

/// Bounds the errors of a point p on a surface of curvature k, whose distance from its own exact surface is at most
/// `off`: by how far the computed ray misses it, however it was found. `turned` bounds the angle between the normal
/// there and that of the exact surface.
///
/// The exact ray's line passes p at a distance of at most g; what the computed one misses is rounded by
/// (t + |p|) u / 2. It meets the plane that touches the surface no further than g / c from p, c being the cosine, and
/// there the surface is within off + k X^2 / 2 of that plane, where X is the distance of the exact point:
/// c X <= g + off + k X^2 / 2, of which the smaller root is 2 d / (c + sqrt(c^2 - 2 k d)) with d = g + off. Factors of
/// 1.1 in k and 1.001 are for k d < .001 and for rounding.
///
/// On a surface that is bent across an axis only, let m be the length of the ray's part across that axis. Along s,
/// perpendicular to the axis and to the normal n, the exact point is no further than m X: of g the vector
/// s - n (d s) / (d n) counts, which is m / c long, of the height (d s) / (d n). So the normal is turned by k m X,
/// across the axis, and of the ray only what is across it is mirrored elsewhere, by twice that.
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

/// Bounds how far a point p that was found on a body is off the exact one's surface. On a ball p = c + r n: by the
/// rounding of this, (r + |p|) u / 2, and by r times the error of n's length, 9/4 u.
template <class S>
STRAHL_INLINE S off_surface(const SphereKernel<S>& ball, const Vec3<S>& p, const Slack<Element<S>>& slack) {
    return S(slack.share) * (norm1(ball.centre) + ball.radius) +
           S(unit_error<S>) * fma(S(2.8), ball.radius, S(.51) * norm1(p));
}
/// The point is put onto the plane: off by the rounding of n p, 3/2 |p| u, and of this.
template <class S>
STRAHL_INLINE S off_surface(const PlaneKernel<S>&, const Vec3<S>& p, const Slack<Element<S>>& slack) {
    return fma(S(slack.turn + Element<S>(2.1) * unit_error<S>), norm1(p), S(slack.plane));
}
/// With f, no longer than r + height, from the base to p: the part across the axis is off by at most 4 |f| u along it,
/// the end's height by 5/4 u, the radius by 11/4 u, and all of it by the rounding of two sums.
template <class S>
STRAHL_INLINE S off_surface(const CylinderKernel<S>& cylinder, const Vec3<S>& p, const Slack<Element<S>>& slack) {
    const S own = S(slack.share) * (norm1(cylinder.base) + cylinder.radius + cylinder.height);
    const S rounding = fma(S(7), cylinder.radius + cylinder.height, S(.51) * norm1(p));
    return own + fma(S(slack.turn), cylinder.height, S(unit_error<S>) * rounding);
}

/// A face near a point that was found on it: its curvature, and a bound of the angle between the normal there and that
/// of the exact surface.
template <class S>
struct Bend {
    S curvature, turned;
};
/// The exact normal at x is (x - c) / r, the sum of n, (x - p) / r and the error of n's length. Slack counts in both.
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

/// The lengths of the parts of a unit vector across and along the axis of a surface that is bent across that only. For
/// other surfaces 1 and 0.
template <class S>
struct Parts {
    S across, along;
};
template <class S, class K>
STRAHL_INLINE Parts<S> parts_of(const K&, const Vec3<S>&) {
    return {S(1), S(0)};
}
template <class S>
STRAHL_INLINE Parts<S> parts_of(const CylinderKernel<S>& cylinder, const Vec3<S>& direction) {
    const Vec3<S> across = cross(cylinder.axis, direction);
    return {sqrt(dot(across, across)), abs(dot(cylinder.axis, direction))};
}

/// Returns the lanes in which the face is certainly all there is of the surface within `edge` of a point of it.
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

/// True for bodies in which rays that are mirrored by their side go round without their bounds growing, see
/// bound_inside.
template <class K>
inline constexpr bool round_inside = false;
template <class S>
inline constexpr bool round_inside<SphereKernel<S>> = true;
template <class S>
inline constexpr bool round_inside<CylinderKernel<S>> = true;

/// Bounds how far mirrors turn rays that go round inside a body: they meet, from inside, the round side of curvature
/// k = 1 / r on which they start.
///
/// Let f be the vector from the centre to any point of a ray. Mirrors there keep h = f x d, and of a cylinder its part
/// along the axis and that of d: these are off by at most `spin`, h as a share of r. Seen along the axis, in which d is
/// m long, the side is met at an angle whose sine is s = |h| / (r m) and whose cosine C is c / m. There d is turned by
/// twice the angle whose sine is C; an error e of s turns it by 2 e / C more, while the error of d itself stays as it
/// is. h is off by the spin, m by that times a / m, a being d's part along the axis: e = spin (1 + s a / m) / m. So
/// half of what a mirrored ray is turned is m e / C = spin (m + s a) / c. A factor of 1.01 is for the squares of e and
/// of the spin, where they are below a thousandth of those of C and of m.
///
/// The computed ray misses the point by `missed`, and that is up to `off` beside the surface; the normal is off by
/// `turned`. This moves the mirrored ray, and changes the spin each time. Roundings: 10 units of the direction.
template <class S>
STRAHL_INLINE void bound_inside(const S& k, const Ray<S>& ray, const Doubt<S>& doubt, const S& t,
                                const SurfacePoint<S>& point, const S& off, const S& turned, const Parts<S>& parts,
                                Mask<S> inside, PointBounds<S>& known) {
    constexpr auto u = unit_error<S>;
    const S missed = norm1(point.position - fma(t, ray.direction, ray.origin)) + S(u) * (norm1(point.position) + t);
    const S moved = S(2) * fma(k, missed + off, turned) + S(10 * u), m = parts.across;
    const S spin = min(doubt.spin, fma(known.side, k, doubt.turn)) + moved;
    const S c = abs(dot(ray.direction, point.normal)), error = spin * (m + parts.along + spin);
    const Mask<S> mild = inside & (error < S(.001f) * c * c) & (spin < S(.001f) * m * m);
    known.mirrored = select(mild, min(known.mirrored, S(1.01) * error / c + moved), known.mirrored);
    known.spin = select(inside, spin, known.spin);
}

/// Bounds the errors of a point that was put onto a body's surface. The ray's source is the face of the body on which
/// it starts.
template <class S, class K>
STRAHL_INLINE PointBounds<S> point_bounds(const K& body, const Ray<S>& ray, const Doubt<S>& doubt, const S& t,
                                          const SurfacePoint<S>& point, const S& face,
                                          const Slack<Element<S>>& slack) requires requires {
    bend_of(body, point.position, face, face, slack);
}
{
    const S off = off_surface(body, point.position, slack);
    const Bend<S> bend = bend_of(body, point.position, face, off, slack);
    const Parts<S> parts = parts_of(body, ray.direction);
    PointBounds<S> known = point_bounds(ray, doubt, t, point, off, bend.curvature, bend.turned, parts.across);
    const S edge = known.away + off;
    known.sure = known.sure & on_face(body, point.position, face, edge);
    if constexpr (round_inside<K>) {
        const Mask<S> inside = (ray.source == S(0)) & (face == S(0));
        if (any(inside)) bound_inside(bend.curvature, ray, doubt, t, point, off, bend.turned, parts, inside, known);
    }
    return known;
}

}  // namespace strahl::inline STRAHL_LEVEL
