// Error bounds of a ray's crossings with a cone, and of the points there.
#pragma once
#include "trace/proof/point_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// Bounds the errors of a cone's positions and lengths.
template <class S, class K>
STRAHL_INLINE S own_error(const ConeKernel<K>& cone, const Slack<Element<S>>& slack) {
    return S(slack.share) * (norm1(splat<S>(cone.base)) + S(cone.widest) + S(cone.height));
}

/// A ray and the side of a cone, which goes on beyond its ends but ends at the apex. The distance of a point from the
/// side, below 0 inside, is F = c (|u| - r) - s a, where the point is `a` along the axis and u across it: along a line
/// a convex function. Its gradient has length 1, so at t it is off by the errors of the ray and of the cone, by 10
/// units of |f| and t for rounding and by 3 for the direction's length: `off`. Axis and angle are off by slack.turn
/// each, by which F changes by at most 2.5 times the distance from the base and the radius.
template <class S>
struct ConeSide {
    Vec3<S> f, d, axis;
    S along_f, along_d, cosine, sine, radius, off_here, off_per;

    template <class K>
    STRAHL_INLINE ConeSide(const ConeKernel<K>& cone, const Ray<S>& ray, const Doubt<S>& doubt,
                           const Slack<Element<S>>& slack)
        : f(ray.origin - splat<S>(cone.base)),
          d(ray.direction),
          axis(splat<S>(cone.axis)),
          along_f(dot(f, axis)),
          along_d(dot(d, axis)),
          cosine(cone.cosine),
          sine(cone.sine),
          radius(cone.radius) {
        constexpr auto u = unit_error<S>;
        constexpr Element<S> turned = 2.5f;
        const S widest(cone.widest), from = norm1(f);
        off_here = doubt.away + own_error<S>(cone, slack) + S(turned * slack.turn) * (from + widest) +
                   S(10 * u) * from + S(4 * u) * widest;
        off_per = doubt.turn + S(turned * slack.turn + 13 * u);
    }
    STRAHL_INLINE S off(const S& t) const { return fma(abs(t), off_per, off_here); }
    struct Place {
        Vec3<S> across;
        S distance, along;
    };
    STRAHL_INLINE Place at(const S& t) const {
        const Vec3<S> p = fma(t, d, f);
        const S along = dot(p, axis);
        const Vec3<S> u = fma(-along, axis, p);
        return {u, sqrt(dot(u, u)), along};
    }
    STRAHL_INLINE S beyond(const S& distance, const S& along) const {
        return cosine * (distance - radius) - sine * along;
    }
    STRAHL_INLINE Mask<S> inside(const S& t) const {
        const Place place = at(t);
        return beyond(place.distance, place.along) < -off(t);
    }
    STRAHL_INLINE Mask<S> outside(const S& t) const {
        const Place place = at(t);
        return beyond(place.distance, place.along) > off(t);
    }
    /// Returns how fast F grows along the ray there.
    STRAHL_INLINE S growth(const Place& place) const {
        const Vec3<S> across = fma(-along_d, axis, d);
        return cosine * dot(place.across, across) / place.distance - sine * along_d;
    }
    /// Finds an interval around the line's crossing of the side near t. Returns the lanes in which the exact crossing
    /// certainly is in it: F is convex, so the side is crossed once on the way in and once on the way out, and in
    /// between if one end is inside and the other outside for certain, however t was found.
    STRAHL_INLINE Mask<S> enclose(const S& t, bool enters, S& low, S& high) const {
        const Place place = at(t);
        const S grows = growth(place), crossing = t - beyond(place.distance, place.along) / grows;
        const S reach = S(1.1) * off(t) / abs(grows);
        low = crossing - reach, high = crossing + reach;
        return enters ? outside(low) & inside(high) : inside(low) & outside(high);
    }
    /// Returns the lanes in which all of the line from `from` to `to` is certainly outside. This is shown by a plane
    /// that touches the cone, or nearly, where the line is nearest: |u| is at least w u for any w of length 1, so F is
    /// at least a linear function of t, which exceeds the error at both ends.
    STRAHL_INLINE Mask<S> passes(const S& from, const S& to) const {
        const Vec3<S> across_f = fma(-along_f, axis, f), across_d = fma(-along_d, axis, d);
        const S square = dot(across_d, across_d), middle = -dot(across_f, across_d) / square;
        const S grows = sine * along_d, steep = fma(cosine * cosine, square, -(grows * grows));
        const S least(std::numeric_limits<Element<S>>::min());
        const S nearest = middle + grows * at(middle).distance / sqrt(max(steep * square, least));
        const S t = select(nearest > from, min(nearest, to), from);
        const Vec3<S> u = at(t).across, w = scale(S(1) / sqrt(dot(u, u)), u);
        const Place first = at(from), last = at(to);
        const S beyond_plane = min(beyond(dot(w, first.across), first.along), beyond(dot(w, last.across), last.along));
        return beyond_plane > max(off(from), off(to));
    }
    /// Returns the lanes in which a ray that starts on the side certainly leaves it outwards. The normal there turns by
    /// the error of the start, as seen from the axis.
    STRAHL_INLINE Mask<S> leaves_outwards() const {
        const Place here = at(S(0));
        return growth(here) > S(2) * off_here / here.distance + off_per;
    }
};

/// Bounds the span in a cone. The side is crossed where F changes its sign. Where that is undecided the side is still
/// entered before the ends are, and left after them, if the line is inside there.
template <class S, class K>
STRAHL_INLINE SpanBounds<S> span_bounds(const ConeKernel<K>& cone, const Ray<S>& ray, const Doubt<S>& doubt,
                                        const S& start, const Slack<Element<S>>& slack) {
    constexpr auto inf = SpanBounds<S>::inf;
    const ConeSide<S> side(cone, ray, doubt, slack);
    const S turn = doubt.turn + S(slack.turn + 12 * unit_error<S>);
    const S size = S(1.01) * (S(cone.height) + S(cone.widest)), middle = -dot(side.f, side.d);
    const S reach = size + side.off(abs(middle) + size);
    const Mask<S> here = (start >= S(0)) & (start < S(3)), own_side = start == S(0);
    const Mask<S> maybe = here | !side.passes(middle - reach, middle + reach);
    if (none(maybe)) return {S(0), S(0), S(0), S(0), maybe, maybe};

    const SpanBounds<S> ends = between_ends(
        side.along_f, side.along_d, S(cone.height),
        doubt.away + own_error<S>(cone, slack) + S(slack.turn) * S(cone.height) + norm1(side.f) * turn, turn, start);
    const Span<S> crossed = cone.cross_side(side.f, side.d, side.along_f, side.along_d);
    const S leaves = select(own_side, cone.leave_side(side.f, side.d, side.along_f, side.along_d), crossed.far);
    S near_low, near_high, far_low, far_high;
    const Mask<S> outwards = own_side & side.leaves_outwards();
    const Mask<S> enters_known = side.enclose(crossed.near, true, near_low, near_high);
    const Mask<S> leaves_known = side.enclose(leaves, false, far_low, far_high);
    near_low = select(enters_known, near_low, S(-inf));
    near_high = select(enters_known, near_high, select(side.inside(ends.near_high), ends.near_high, S(inf)));
    far_low = select(leaves_known, far_low, select(side.inside(ends.far_low), ends.far_low, S(-inf)));
    far_high = select(outwards, S(0), select(leaves_known, far_high, S(inf)));
    SpanBounds<S> span;
    span.near_low = select(here, S(-inf), max(near_low, ends.near_low));
    span.near_high = select(here, S(-inf), max(near_high, ends.near_high));
    span.far_low = min(far_low, ends.far_low), span.far_high = min(far_high, ends.far_high);
    span.maybe = here | (maybe & !(span.near_low > span.far_high));
    span.sure = here | (span.near_high < span.far_low);
    return span;
}

/// Bounds how far a point p found on the cone is off the exact surface. Roundings: 7 units of sums and products of
/// lengths in the cone, as of cylinders, and those of two sums.
template <class S>
STRAHL_INLINE S off_surface(const ConeKernel<S>& cone, const Vec3<S>& p, const Slack<Element<S>>& slack) {
    constexpr auto u = unit_error<S>;
    const S size = cone.widest + cone.height;
    return own_error<S>(cone, slack) + fma(S(Element<S>(2.5f) * slack.turn + 7 * u), size, S(.51 * u) * norm1(p));
}
/// Returns a point's distance from the axis.
template <class S>
STRAHL_INLINE S distance_from_axis(const ConeKernel<S>& cone, const Vec3<S>& p) {
    const Vec3<S> f = p - cone.base, across = fma(-dot(f, cone.axis), cone.axis, f);
    return sqrt(dot(across, across));
}
/// Returns the curvature of the side, across its lines that of a circle of radius |u| / c, a twentieth more for points
/// nearby; and how far the normal is turned.
template <class S>
STRAHL_INLINE Bend<S> bend_of(const ConeKernel<S>& cone, const Vec3<S>& p, const S& face, const S& off,
                              const Slack<Element<S>>& slack) {
    constexpr auto u = unit_error<S>;
    const S k = select(face == S(0), S(1.05) * cone.cosine / distance_from_axis(cone, p), S(0));
    return {k, fma(S(2) * k, off, S(2 * slack.turn + 4 * u))};
}
template <class S>
STRAHL_INLINE Mask<S> on_face(const ConeKernel<S>& cone, const Vec3<S>& p, const S& face, const S& edge) {
    const S along = dot(p - cone.base, cone.axis), distance = distance_from_axis(cone, p);
    const S beyond = cone.cosine * (distance - cone.radius) - cone.sine * along;
    const Mask<S> side = face == S(0);
    const Mask<S> between = (along > edge) & (along + edge < cone.height) & (edge < S(.04) * distance);
    return (side & between) | ((!side) & (beyond + edge < S(0)));
}

}  // namespace strahl::inline STRAHL_LEVEL
