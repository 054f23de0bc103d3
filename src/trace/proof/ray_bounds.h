// Error bounds of reflected and refracted rays.
#pragma once
#include <bit>

#include "trace/kernel/scatter.h"
#include "trace/proof/hit_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// Bounds the angle by which a mirrored direction is off. Here and below b is the ratio of indices, c the cosine before
/// the surface, and k the squared cosine beyond it, which is off by at most `k_error`.
///
/// Mirrors turn rays by twice the turn of the normal, or less, see point_bounds. Roundings: e n is off by 3/2 u, which
/// counts twice, the normal's length by 9/4 u, also twice; two products and sums.
template <class S>
STRAHL_INLINE S turn_reflected(const HitBounds<S>& known) {
    return fma(S(2.002), known.mirrored, known.turn) + S(10 * unit_error<S>);
}
/// Bounds the error of k = 1 - b^2 (1 - c^2). Roundings: c is off by 3/2 u, so c^2 by 3; b twice by 1/2, sums and
/// products by 2.
template <class S>
STRAHL_INLINE S error_beyond(const HitBounds<S>& known, const S& b, const S& c) {
    const S off = known.turn + known.normal;
    return S(1.001) * b * b * off * fma(S(2), abs(c), off) + S(8 * unit_error<S>) * fma(b, b, S(1));
}
/// Bounds the angle by which a refracted direction is off. In the plane of incidence a turn by q becomes one by A q,
/// where A = b c / sqrt(k) by Snell's law, across it by b q. A turn of the normal by N becomes one by |1 - A| N or
/// |b c - sqrt(k)| N. All for any c and k within their errors. Roundings: lengths of directions, c and k itself count
/// b^2 / sqrt(k) times.
template <class S>
STRAHL_INLINE S turn_refracted(const HitBounds<S>& known, const S& b, const S& c, const S& k, const S& k_error) {
    const S off = known.turn + known.normal, least = sqrt(max(k - k_error, S(0))), most = sqrt(max(k, S(0)) + k_error);
    const S low_c = b * (c - off), high_c = b * (c + off), low = low_c / most, high = high_c / least;
    const S by_normal = max(max(abs(S(1) - low), abs(S(1) - high)), max(abs(high_c - least), abs(low_c - most)));
    return S(1.01) * fma(max(b, high), known.turn, by_normal * known.normal) +
           S(8 * unit_error<S>) * (S(1) + b + fma(b, b, S(1)) / least);
}

/// Bounds the distance at which the exact mirrored ray's line passes the computed one's origin p; let x be the exact
/// origin. Mirroring by the plane that touches the surface at x changes the vector from x to p by twice the height of
/// p, and its part across the ray by no more.
template <class S>
STRAHL_INLINE S side_reflected(const HitBounds<S>& known) {
    return min(S(1.001) * fma(S(2), known.height, known.side), known.away);
}
/// Bounds the same for refracted rays. In the plane of incidence the offset across the ray, divided by its cosine c
/// before the surface, is the offset along the surface; this times the cosine beyond is the offset across the refracted
/// ray. k is the square of the latter.
template <class S>
STRAHL_INLINE S side_refracted(const HitBounds<S>& known, const S& c, const S& k, const S& k_error) {
    const S least = max(abs(c) - known.turn - known.normal - S(8 * unit_error<S>), S(0));
    const S most = sqrt(max(k, S(0)) + k_error), ratio = max(S(1), most / least);
    const S side = min(S(1.001) * fma(ratio, known.side + known.height, known.height), known.away);
    return select(least > S(0), side, known.away);
}

/// Returns the number of lanes up to the last one of a mask.
template <class S>
STRAHL_INLINE int lanes_up_to(Mask<S> lanes) {
    return std::bit_width(unsigned(bits(lanes)));
}

/// Returns the lanes in which it is undecided on which side of a bent normal a ray comes, whose cosine is c.
template <class S>
STRAHL_INLINE Mask<S> bent_side_in_doubt(const HitBounds<S>& known, const S& c) {
    return (known.flat >= S(0)) & !(abs(c) > known.turn + known.normal + S(8 * unit_error<S>));
}

/// Bounds the errors of mirrored rays.
template <class S>
STRAHL_INLINE Doubt<S> bound_reflection(const HitBounds<S>& known) {
    return {select(known.followed, known.away, S(-1)), select(known.followed, turn_reflected(known), S(0)),
            side_reflected(known), known.spin};
}

/// Bounds the errors of mirrored rays where normals may be bent, so that reflect_bent may have mirrored them twice: it
/// must be certain on which side of the surface the mirrored direction is and, if it is under it, how the bent normal
/// faces that direction.
template <class S>
[[gnu::noinline]] void bound_bent_reflection(const ProvedShading<S>& shading, const Hit<S>& hit,
                                             const HitNotes<S, Proving>& notes, const S& share,
                                             Branch<S, Proving>& reflected) {
    constexpr auto u = unit_error<S>;
    const HitBounds<S>& known = notes.own;
    const Vec3<S> mirrored = reflect(hit);
    const S over = dot(mirrored, notes.flat), back = dot(mirrored, hit.normal), turn = turn_reflected(known);
    const Mask<S> bent = known.followed & (known.flat >= S(0)), above = over > turn + known.flat + S(16 * u);
    const Mask<S> under =
        (over < -(turn + known.flat + S(16 * u))) & (abs(back) > known.turn + known.normal + S(16 * u));
    const S again = select(back < S(0), known.turn, turn) + fma(S(2.002), known.flat, S(20 * u));
    reflected.own.turn = select(bent & under, again, reflected.own.turn);
    const Mask<S> doubt = bent & !(above | under);
    if (none(doubt)) return;
    reflected.own.away = select(doubt, S(-1), reflected.own.away);
    reflected.own.turn = select(doubt, S(0), reflected.own.turn);
    const S most(shading.limits.brightest_beyond(shading.depth));
    add_bounds(shading.batch, hit.pixel, lanes_up_to<S>(doubt),
               select(doubt, hit.weight * known.tint * share * most, S(0)));
}

/// Bounds the errors of refracted rays; c is the cosine before the surface, k its square beyond it and b the ratio of
/// indices. Where it is undecided whether the reflection is total, the pixel's bound grows by all that the refracted
/// light may be. Bent normals are turned to the side that the ray comes from, which must be certain. Medium stacks are
/// those of exact arithmetic if the camera's rays begin with its own: each hit that is certain is one on the same body.
template <class S>
STRAHL_INLINE void bound_refraction(const ProvedShading<S>& shading, const Hit<S>& hit, const HitBounds<S>& known,
                                    Mask<S> glass, Mask<S> far, const S& b, const S& c, const S& k,
                                    Branch<S, Proving>& refracted) {
    const S k_error = error_beyond(known, b, c);
    const Mask<S> told = abs(k) > k_error,
                  all_told = first_lanes<S>(proving(shading.limits).slack.medium ? width<S> : 0);
    Mask<S> doubt = glass & known.followed & !(told & all_told & !far);
    if (shading.world.patterns.bends) [[unlikely]]
        doubt = doubt | (glass & known.followed & bent_side_in_doubt(known, c));
    refracted.own.away = select(known.followed & !doubt, known.away, S(-1));
    refracted.own.turn = select(known.followed & !doubt, turn_refracted(known, b, c, k, k_error), S(0));
    refracted.own.side = side_refracted(known, c, k, k_error);
    if (none(doubt)) return;
    const S most(shading.limits.brightest_beyond(shading.depth));
    add_bounds(shading.batch, hit.pixel, lanes_up_to<S>(doubt),
               select(doubt, hit.weight * known.tint * known.sent * most, S(0)));
}

/// Adds the error of the share of light that a ray brings, `off`, and leaves rays whose strength is off by more than
/// 1e-9 of it, which are not followed any more. So no strength is off by more than 256 times that, and rays are dropped
/// as too weak as in exact arithmetic, but where their strength is within 1e-6 of the limit: these are not followed.
template <class S>
[[gnu::noinline]] void bound_strength(const ProvedShading<S>& shading, const Hit<S>& hit, const HitBounds<S>& known,
                                      const S& off, Branch<S, Proving>& ray) {
    const S most(shading.limits.brightest_beyond(shading.depth)), weight = hit.weight * known.tint;
    const S least(shading.world.finishes.bailout);
    const auto near = [&](const S& strength) { return abs(strength - least) < S(1e-6f) * least; };
    const Mask<S> sends = hit.active & known.followed & ((ray.weight > S(0)) | (off > S(0)));
    const Mask<S> doubt = sends & ((off * hit.weight > S(1e-9f) * ray.weight) | near(ray.weight) |
                                   near(hit.weight * hit.material.refraction));
    const S all = fma(weight, off, ray.weight * known.tint);
    add_bounds(shading.batch, hit.pixel, lanes_up_to<S>(sends),
               select(doubt, all * most, select(sends, weight * off * most, S(0))));
    ray.own.away = select(doubt, S(-1), ray.own.away), ray.own.turn = select(doubt, S(0), ray.own.turn);
}

}  // namespace strahl::inline STRAHL_LEVEL
