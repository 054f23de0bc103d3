// Error bounds of a ray's first crossing with a torus, and of the point there.
#pragma once
#include "trace/proof/point_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// Bounds the first crossing ahead of a body that is not convex: `near` if the ray starts outside, `far` if it starts
/// inside. There may be more from `later` on.
template <class S>
struct FirstBounds : SpanBounds<S> {
    S later;
};

/// Bounds the errors of a torus' positions and lengths. If its axis turns its circle moves by no more than the major
/// radius times that.
template <class S, class K>
STRAHL_INLINE S own_error(const TorusKernel<K>& torus, const Slack<Element<S>>& slack) {
    const S major(torus.major);
    return S(slack.share) * (norm1(splat<S>(torus.centre)) + major + S(torus.minor)) + S(slack.turn) * major;
}

/// Finds how far points of a ray are from a torus: from its circle, less the minor radius; below 0 inside. Along the
/// ray this distance changes by no more than t does, and is off by the errors of ray and torus, by 10 units of |f| and
/// t for rounding and 3 for the direction's length: `off`.
template <class S>
struct TorusDistance {
    Vec3<S> f, d, axis;
    S major, minor, off_here, off_per;

    template <class K>
    STRAHL_INLINE TorusDistance(const TorusKernel<K>& torus, const Ray<S>& ray, const Doubt<S>& doubt,
                                const Slack<Element<S>>& slack)
        : f(ray.origin - splat<S>(torus.centre)),
          d(ray.direction),
          axis(splat<S>(torus.axis)),
          major(torus.major),
          minor(torus.minor) {
        constexpr auto u = unit_error<S>;
        off_here = doubt.away + own_error<S>(torus, slack) + S(10 * u) * norm1(f) + S(8 * u) * (major + minor);
        off_per = doubt.turn + S(13 * u);
    }
    STRAHL_INLINE S off(const S& t) const { return fma(abs(t), off_per, off_here); }

    struct Place {
        Vec3<S> across;  // vector from the axis to the point
        S out, along, distance;
    };
    STRAHL_INLINE Place at(const S& t) const {
        const Vec3<S> p = fma(t, d, f);
        const S along = dot(p, axis);
        const Vec3<S> across = fma(-along, axis, p);
        const S out = sqrt(dot(across, across)), q = out - major;
        return {across, out, along, sqrt(fma(q, q, along * along)) - minor};
    }
    /// Returns how fast the distance grows along the ray there.
    STRAHL_INLINE S growth(const Place& place) const {
        const S across = dot(place.across, d) / place.out;
        return fma(place.out - major, across, place.along * dot(axis, d)) / (place.distance + minor);
    }
    /// `bend` bounds how fast that growth changes, as long as neither the tube's middle nor the axis come nearer by
    /// more than a quarter: on the next `room` of the ray, from where the surface is no further away than a hundredth
    /// of these (`close`).
    STRAHL_INLINE S bend(const Place& place) const { return S(1.4) * (S(1) / minor + S(1) / place.out); }
    STRAHL_INLINE S room(const Place& place) const { return S(.23) * min(minor, place.out); }
    STRAHL_INLINE Mask<S> close(const S& way, const Place& place) const {
        return abs(way) < S(.01) * min(minor, place.out);
    }
};

/// Bounds the first crossing. It is where the computed one is, if the distance has a sign before it and the other
/// behind it, is monotonic in between, and no crossing comes earlier. The last is shown by steps as long as the
/// distance is (J. Hart, "Sphere Tracing", 1996), up to where it is monotonic. A ray that starts on the torus first
/// leaves it monotonically.
template <class S, class K>
[[gnu::noinline]] FirstBounds<S> span_bounds(const TorusKernel<K>& torus, const Ray<S>& ray, const Doubt<S>& doubt,
                                             const S& start, const Slack<Element<S>>& slack) {
    constexpr auto u = unit_error<S>;
    constexpr auto inf = SpanBounds<S>::inf;
    using Place = typename TorusDistance<S>::Place;
    const TorusDistance<S> torus_at(torus, ray, doubt, slack);
    const S zero(0), middle = -dot(torus_at.f, torus_at.d), reach = torus_at.major + torus_at.minor;
    const Vec3<S> passed = fma(middle, torus_at.d, torus_at.f);
    const S widest = reach + torus_at.off(abs(middle) + reach), beyond = fma(widest, widest, -dot(passed, passed));
    const S end = middle + sqrt(max(beyond, zero)) + S(8 * u) * (abs(middle) + widest);
    const Mask<S> here = start == zero, maybe = here | !((beyond < zero) | (end < zero));
    FirstBounds<S> span{{S(-inf), S(inf), S(-inf), S(inf), maybe, first_lanes<S>(0)}, S(0)};
    if (none(maybe)) return span;

    const Place first = torus_at.at(zero);
    const S rises = torus_at.growth(first), bend = torus_at.bend(first);
    const S unknown = fma(bend, torus_at.off_here, torus_at.off_per + S(16 * u));
    const Mask<S> leaves = here & torus_at.close(torus_at.off_here, first) & (abs(rises) > unknown);
    const Mask<S> outside = (leaves & (rises > zero)) | ((first.distance > torus_at.off_here) & !here);
    const Mask<S> inside = (leaves & (rises < zero)) | ((first.distance < -torus_at.off_here) & !here);
    const S sign = select(inside, S(-1), S(1));

    const Crossings<S, 4> crossings = torus.crossings(ray, start);
    const S found = first_crossing(crossings);
    const Mask<S> crossed = maybe & crossings.hit & (found > zero) & (found < S(inf));
    const Place near = torus_at.at(found);
    const S slope = torus_at.growth(near), off = torus_at.off(found), crossing = found - near.distance / slope;
    const S doubtful = S(1.1) * off / abs(slope), low = crossing - doubtful, high = crossing + doubtful;
    const S steady = min(torus_at.room(near), S(.5) * abs(slope) / torus_at.bend(near));
    const Mask<S> changes = crossed & (sign * slope < zero) & (sign * torus_at.at(low).distance > torus_at.off(low)) &
                            (sign * torus_at.at(high).distance < -torus_at.off(high)) & (doubtful < steady) &
                            torus_at.close(near.distance, near) & torus_at.close(off, near) &
                            (abs(crossing - found) < S(.1) * steady) &
                            (fma(torus_at.bend(near), off, torus_at.off_per) < S(.2) * abs(slope));

    const S goal = select(changes, crossing - steady, select(crossed, S(inf), end));
    S clear = select(leaves, min(torus_at.room(first), S(.5) * (abs(rises) - unknown) / bend), zero);
    Mask<S> going = maybe & (outside | inside) & (clear < goal);
    constexpr int most_steps = 48;
    for (int i = 0; i < most_steps && any(going); ++i) {
        const S step = sign * torus_at.at(clear).distance - torus_at.off(clear);
        going = going & (step > zero);
        clear = select(going, fma(S(1 - 8 * u), step, clear), clear);
        going = going & (clear < goal) & (step > S(64 * u) * clear);
    }
    const Mask<S> told = (outside | inside) & (clear >= goal);
    const Mask<S> missed = told & outside & !crossed;
    span.maybe = maybe & !missed, span.sure = told & changes;
    span.near_low = select(inside, S(-inf), select(span.sure, low, select(outside, clear, S(-inf))));
    span.near_high = select(inside, S(-inf), select(span.sure, high, S(inf)));
    span.far_low = select(span.sure, select(inside, low, crossing + steady), select(outside | inside, clear, S(-inf)));
    span.far_high = select(span.sure & inside, high, S(inf));
    span.later = select(span.sure, crossing + steady, zero);
    return span;
}

/// Bounds how far a point p found on the torus is off the exact surface. Roundings: 10 units of sums and products of
/// lengths in the torus, and those of two sums.
template <class S>
STRAHL_INLINE S off_surface(const TorusKernel<S>& torus, const Vec3<S>& p, const Slack<Element<S>>& slack) {
    return own_error<S>(torus, slack) + S(unit_error<S>) * fma(S(10), torus.major + torus.minor, S(.51) * norm1(p));
}
/// Returns the largest curvature, that of the tube or of the circles around the axis, a twentieth more for points
/// nearby; and how far the normal is turned. The direction out from the axis is turned by the rounding of its part
/// across the axis.
template <class S>
STRAHL_INLINE Bend<S> bend_of(const TorusKernel<S>& torus, const Vec3<S>& p, const S&, const S& off,
                              const Slack<Element<S>>& slack) {
    const Vec3<S> f = p - torus.centre, across = fma(-dot(f, torus.axis), torus.axis, f);
    const S out = sqrt(dot(across, across)), k = S(1.05) / min(torus.minor, out);
    const S rounding = S(4 * unit_error<S>) * (S(1) + norm1(f) * (S(1) + torus.major / out) / torus.minor);
    return {k, fma(S(2) * k, off, S(2 * slack.turn) + rounding)};
}
template <class S>
STRAHL_INLINE Mask<S> on_face(const TorusKernel<S>& torus, const Vec3<S>& p, const S&, const S& edge) {
    const Vec3<S> f = p - torus.centre, across = fma(-dot(f, torus.axis), torus.axis, f);
    return edge < S(.04) * min(torus.minor, sqrt(dot(across, across)));
}

}  // namespace strahl::inline STRAHL_LEVEL
