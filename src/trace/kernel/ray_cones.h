// Cones of rays: how wide what a sample sees is where its ray ends, also in mirrors and glass (T. Akenine-Möller, C.
// Crassin, J. Boksansky, L. Belcour, A. Panteleev, O. Wright, "Improved Shader and Texture Level of Detail Using Ray
// Cones", JCGT 10(1), 2021). For pictures in motion, whose filters are approximate: two numbers of each ray in place of
// the 13 of its differentials.
#pragma once
#include "trace/kernel/differentials.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns the cones of rays at distance `t`.
template <class S, class P>
RayCone<S> cone_at(const Shading<S, P>& shading, const RayQueue<Element<S>>& from, const LaneIndices<S>& pick,
                   const Vec3<S>& direction, const S& t) {
    using T = Element<S>;
    RayCone<S> own{S(0), S(0)};
    if (shading.depth > 1 || shading.batch.footprints->made) {
        own.width = pick(from.cone.width), own.spread = pick(from.cone.spread);
    } else {
        const Footprints<T>& view = *shading.batch.footprints;
        own.spread = dot(direction, splat<S>(view.forward)) * S(view.sides[0] * std::sqrt(dot(view.down, view.down)));
    }
    own.width = fma(t, own.spread, own.width);
    return own;
}

/// Returns the footprint of rays whose cones are so wide where they end, on surfaces with this normal. Its first side
/// is on the surface.
template <class S>
STRAHL_INLINE Footprint<S> footprint_of(const S& width, const Vec3<S>& direction, const Vec3<S>& normal) {
    using T = Element<S>;
    const S zero(0), one(1);
    const Mask<S> other = abs(direction.x) < S(T(.6));
    const Vec3<S> any_axis(select(other, one, zero), select(other, zero, one), zero);
    Vec3<S> across = cross(direction, normal);
    const Mask<S> straight = dot(across, across) < S(T(1e-6));
    if (any(straight)) across = select(straight, cross(direction, any_axis), across);
    across = scale(abs(width) / sqrt(dot(across, across)), across);
    return {direction, normal, across, cross(direction, across), one};
}

/// Finds the cones of rays where they end on surfaces, and how these are curved there if rays go on.
template <class S, class P>
[[gnu::noinline, gnu::cold]] void note_cones(const Shading<S, P>& shading, const RayQueue<Element<S>>& from,
                                             const LaneIndices<S>& pick, const Hit<S>& hit, const S& t,
                                             HitNotes<S, P>& notes) {
    notes.cone = cone_at(shading, from, pick, hit.direction, t);
    notes.bend = S(0);
    if (!goes_on(shading, hit)) return;
    const Vec3<S> way = footprint_of(notes.cone.width, hit.direction, notes.flat).across;
    const S squared = dot(way, way);
    const S along = dot(turn_along(shading, hit, notes.flat, way, t), way);
    notes.bend = select(squared > S(0), notes.cone.width * along / squared, S(0));
}

/// Appends the cones of rays that go on from hits to those of a queue.
template <class S, class P>
[[gnu::noinline, gnu::cold]] void put_cones(RayQueue<Element<S>>& to, const Hit<S>& hit, const Vec3<S>& direction,
                                            Mask<S> lanes, const HitNotes<S, P>& notes) {
    const S one(1), along = dot(direction, notes.flat), cosine = -dot(hit.direction, notes.flat);
    const Mask<S> mirrored = along > S(0);
    const S ratio = select(mirrored, one, select(hit.outside, one / hit.material.ior, hit.material.ior));
    // A mirror turns rays by twice what its normal turns by; for refraction see put_differentials().
    const S turn = select(mirrored, S(2), fma(ratio, cosine, along));
    compress(to.cone.width + to.count, notes.cone.width, lanes);
    compress(to.cone.spread + to.count, fma(turn, notes.bend, ratio * notes.cone.spread), lanes);
}

}  // namespace strahl::inline STRAHL_LEVEL
