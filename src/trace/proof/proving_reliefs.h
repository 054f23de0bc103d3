// What bent normals do to bounds.
#pragma once
#include "trace/proof/proving_lights.h"

namespace strahl::inline STRAHL_LEVEL::inline STRAHL_INSTANCE {

/// What is known of hits whose normals materials bend. What bends them makes them steeper than what is known of the
/// surface, so `height` is as for any direction. Those of which nothing is known are left.
template <class S>
[[gnu::noinline]] void bound_bent(const Shading<S>& shading, const int* materials, const Hit<S>& hit,
                                  const Vec3<S>& flat, const S& weight, int lanes, HitBounds<S>& known) {
    const BentBounds<S> found = PatternBounds<S>::of_normals(shading.world, materials, hit.position, hit.surface, flat,
                                                             known.normal, known.away, shading.limits.slack);
    const Mask<S> bent = known.followed & found.bent, lost = bent & !found.told, told = bent & found.told;
    known.flat = select(told, known.normal, S(-1));
    known.normal = select(told, found.off, known.normal), known.mirrored = select(told, found.off, known.mirrored);
    known.height = select(told, known.away, known.height), known.spin = select(bent, HitBounds<S>{}.spin, known.spin);
    if (none(lost)) return;
    const auto leave = [&](S& value) { value = select(lost, S(0), value); };
    leave(known.away), leave(known.normal), leave(known.mirrored), leave(known.turn), leave(known.side);
    leave(known.height);
    known.followed = known.followed & !lost;
    const S most = weight * S(brightest_of(shading.limits, shading.depth));
    add_bounds(shading.batch, hit.pixel, lanes, select(lost, most, S(0)));
}

/// Behind a surface there is no light, whatever the bent normal faces. Where it can't be told on which side it is, it
/// is in doubt.
template <class S>
[[gnu::noinline]] void bound_side_of_light(const HitBounds<S>& known, const Vec3<S>& flat, const Vec3<S>& l,
                                           LitBounds<S>& lit, Mask<S>& faces) {
    const S cosine = dot(flat, l), off = cosine_error(known.flat + lit.ray.turn, cosine) + S(8 * unit_error<S>);
    const Mask<S> bent = known.flat >= S(0), told = (lit.ray.turn >= S(0)) & (abs(cosine) > off);
    const Mask<S> behind = bent & told & (cosine < S(0));
    faces = faces & !behind;
    lit.doubt = (lit.doubt | (bent & !told)) & !behind;
}

/// What is known of mirrored rays where normals may be bent, by which the mirrored direction is made twice: on which
/// side of the surface it is must be certain, and where it is under it how the bent normal faces the ray.
template <class S>
[[gnu::noinline]] void bound_bent_reflection(const Shading<S>& shading, const Hit<S>& hit, const RareHit<S>& rare,
                                             const S& share, Branch<S>& reflected) {
    constexpr auto u = unit_error<S>;
    const HitBounds<S>& known = rare.bounds;
    const Vec3<S> mirrored = reflect(hit);
    const S over = dot(mirrored, rare.flat), back = dot(mirrored, hit.normal), turn = turn_reflected(known);
    const Mask<S> bent = known.followed & (known.flat >= S(0)), above = over > turn + known.flat + S(16 * u);
    const Mask<S> under =
        (over < -(turn + known.flat + S(16 * u))) & (abs(back) > known.turn + known.normal + S(16 * u));
    const S again = select(back < S(0), known.turn, turn) + fma(S(2.002), known.flat, S(20 * u));
    reflected.doubt.turn = select(bent & under, again, reflected.doubt.turn);
    const Mask<S> doubt = bent & !(above | under);
    if (none(doubt)) return;
    reflected.doubt.away = select(doubt, S(-1), reflected.doubt.away);
    reflected.doubt.turn = select(doubt, S(0), reflected.doubt.turn);
    const S most(shading.limits.brightest[shading.limits.depth - shading.depth]);
    add_bounds(shading.batch, hit.pixel, count(hit.active), select(doubt, hit.weight * share * most, S(0)));
}

/// Can it not be told on which side of a bent normal a ray comes, whose cosine is c?
template <class S>
STRAHL_INLINE Mask<S> bent_side_in_doubt(const HitBounds<S>& known, const S& c) {
    return (known.flat >= S(0)) & !(abs(c) > known.turn + known.normal + S(8 * unit_error<S>));
}

}  // namespace strahl::inline STRAHL_LEVEL::inline STRAHL_INSTANCE
