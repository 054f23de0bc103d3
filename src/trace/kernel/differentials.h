// Differentials of rays: how their places and directions change from a sample to the one beside it, which tells what a
// sample sees of a pattern, also in mirrors and glass (H. Igehy, "Tracing Ray Differentials", SIGGRAPH 1999). Computed
// only where patterns are filtered.
#pragma once
#include "trace/kernel/shading.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns true if signatures are noted.
template <class S, class P>
STRAHL_INLINE bool notes_sights(const Shading<S, P>& shading) {
    return P::notes && shading.batch.sights;
}

/// Returns true if patterns are filtered.
template <class S, class P>
STRAHL_INLINE bool filters(const Shading<S, P>& shading) {
    return P::notes && shading.batch.footprints;
}

/// Returns the sides of samples' squares, in pixels.
template <class S>
STRAHL_INLINE S sides_of(const Footprints<Element<S>>& footprints, const S& pixel) {
    alignas(64) Element<S> sides[width<S>];
    store_lanes(sides, pixel);
    for (Element<S>& side : sides) side = footprints.sides[static_cast<int>(side)];
    return load_lanes<S>(sides);
}

/// Returns the differentials of rays at their ends, at distance `t`.
template <class S, class P>
Differentials<S> differentials_at(const Shading<S, P>& shading, const RayQueue<Element<S>>& from,
                                  const LaneIndices<S>& pick, const Vec3<S>& direction, const S& t) {
    Differentials<S> all;
    if (shading.depth > 1 || shading.batch.footprints->made) {
        each_number([&](S& value, const Element<S>* array) { value = pick(array); }, all, from.differentials);
    } else {
        // The direction is that of a vector whose part along `forward` has length 1.
        const Footprints<Element<S>>& view = *shading.batch.footprints;
        const S side = dot(direction, splat<S>(view.forward)) * sides_of(view, S(pick(from.pixel)));
        const Vec3<S> ways[2] = {splat<S>(view.right), splat<S>(view.down)};
        for (int i = 0; i < 2; ++i) {
            all.place[i] = splat<S>(Vec3<Element<S>>(0));
            all.direction[i] = scale(side, fma(-dot(ways[i], direction), direction, ways[i]));
        }
        all.loose = S(0);
    }
    for (int i = 0; i < 2; ++i) all.place[i] = fma(t, all.direction[i], all.place[i]);
    return all;
}

/// Returns where ways that lead beside a ray meet a plane through its end, if one goes on along the ray.
template <class S>
STRAHL_INLINE Vec3<S> onto_plane(const Vec3<S>& way, const Vec3<S>& direction, const Vec3<S>& normal) {
    return fma(-dot(way, normal) / dot(direction, normal), direction, way);
}

/// Returns how normals change along a way on a surface: from what the surface says of points a bit of the way off.
template <class S, class P>
[[gnu::noinline, gnu::cold]] Vec3<S> turn_along(const Shading<S, P>& shading, const Hit<S>& hit, const Vec3<S>& normal,
                                                const Vec3<S>& way, const S& t) {
    using T = Element<S>;
    const auto& world = shading.world;
    const S bit(T(.25));
    alignas(64) T surfaces[width<S>], faces[width<S>];
    int items[width<S>], materials[width<S>];
    store_lanes(surfaces, hit.surface), store_lanes(faces, hit.surface - hit.body);
    for (int k = 0; k < width<S>; ++k) items[k] = world.references[static_cast<int>(surfaces[k])].item;
    const Ray<S> beside{fma(-t, hit.direction, fma(bit, way, hit.position)), hit.direction, S(-1)};
    SurfaceHit<S> there;
    const auto& form = calls<S>(world.sort_bins[hit.bin].form);
    form.surfaces_at(world, items, beside, t, load_lanes<S>(faces), there, materials);
    const Vec3<S>& other = there.point.normal;
    return scale(S(1) / bit, select(dot(other, normal) < S(0), -other, other) - normal);
}

/// Returns true if rays may go on from some of these hits.
template <class S, class P>
STRAHL_INLINE bool goes_on(const Shading<S, P>& shading, const Hit<S>& hit) {
    const MaterialKernel<S>& material = hit.material;
    return shading.world.finishes.hides || any((material.reflection > S(0)) | (material.refraction > S(0)));
}

/// Finds the differentials of rays where they end on surfaces, and how normals change there if rays go on.
template <class S, class P>
[[gnu::noinline, gnu::cold]] void note_differentials(const Shading<S, P>& shading, const RayQueue<Element<S>>& from,
                                                     const LaneIndices<S>& pick, const Hit<S>& hit, const S& t,
                                                     HitNotes<S, P>& notes) {
    notes.beside = differentials_at(shading, from, pick, hit.direction, t);
    const bool on = goes_on(shading, hit);
    for (int i = 0; i < 2; ++i) {
        notes.beside.place[i] = onto_plane(notes.beside.place[i], hit.direction, notes.flat);
        if (on) notes.turn[i] = turn_along(shading, hit, notes.flat, notes.beside.place[i], t);
    }
}

/// Appends the differentials of rays that go on from hits to those of a queue (Igehy 1999, equations 12 to 19). After
/// bumps and in nested glass they are not known. Along curved surfaces they change: `loose` is four times the angle by
/// which normals turn, found by experiment.
template <class S, class P>
[[gnu::noinline, gnu::cold]] void put_differentials(const Shading<S, P>& shading, RayQueue<Element<S>>& to,
                                                    const Hit<S>& hit, const Vec3<S>& direction, Mask<S> lanes,
                                                    const HitNotes<S, P>& notes) {
    const Vec3<S>& normal = notes.flat;
    const S zero(0), one(1), cosine = -dot(hit.direction, normal), along = dot(direction, normal);
    const Mask<S> mirrored = along > zero;
    const Mask<S> even = (hit.normal.x == normal.x) & (hit.normal.y == normal.y) & (hit.normal.z == normal.z);
    const S ratio = select(mirrored, one, select(hit.outside, one / hit.material.ior, hit.material.ior));
    // The new direction is ratio * direction + share * normal.
    const S share = fma(ratio, cosine, along), steep = ratio + ratio * ratio * cosine / along;
    Differentials<S> next = notes.beside;
    S turned = next.loose;
    for (int i = 0; i < 2; ++i) {
        const Vec3<S>&turn = notes.turn[i], &before = notes.beside.direction[i];
        const S change = -dot(before, normal) - dot(hit.direction, turn);  // by which the cosine changes
        next.direction[i] = fma(steep * change, normal, fma(share, turn, scale(ratio, before)));
        turned = fma(S(4), sqrt(dot(turn, turn)), turned);
    }
    next.loose = min(turned, one);
    const S wide = dot(next.direction[0], next.direction[0]) + dot(next.direction[1], next.direction[1]);
    const Mask<S> unnested = first_lanes<S>(shading.world.nested ? 0 : width<S>);
    const Mask<S> follows = even & (mirrored | unnested) & (notes.beside.loose >= zero) & (wide < one);
    each_number([&](S& value, Element<S>* array) { compress(array + to.count, select(follows, value, zero), lanes); },
                next, to.differentials);
    compress(to.differentials.loose + to.count, select(follows, next.loose, S(-1)), lanes);
}

}  // namespace strahl::inline STRAHL_LEVEL
