// Cones around rays: how much of a pattern a sample sees in mirrors and behind glass. Computed only where these are
// filtered. Where the width of a cone is not known it counts as narrow: too much filtering loses detail, too little
// only needs more samples.
#pragma once
#include <type_traits>

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

/// Returns the cones of rays at their ends, at distance `t`. Away from the middle of the view a square looks narrower,
/// most along the radius: by the square of the cosine.
template <class S, class P>
RayCone<S> cone_at(const Shading<S, P>& shading, const RayQueue<Element<S>>& from, const LaneIndices<S>& pick,
                   const Vec3<S>& direction, const S& t) {
    if (shading.depth > 1) {
        const S spread = pick(from.spread), width = pick(from.width);
        return {fma(select(width < S(0), -t, t), spread, width), spread};
    }
    const Footprints<Element<S>>& all = *shading.batch.footprints;
    const S cosine = dot(direction, splat<S>(all.forward)), right(dot(all.right, all.right)),
            down(dot(all.down, all.down));
    const S spread = sqrt(min(right, down)) * sides_of(all, S(pick(from.pixel))) * (cosine * cosine);
    return {t * spread, spread};
}

/// Describes how surfaces of a form spread the rays that they mirror.
template <class S>
struct Bending {
    bool flat = false;    // as planes do, on both sides
    bool convex = false;  // at least as planes do, on the outside
    S curvature{0};       // the smallest one; 0 if not known
};
template <class S>
Bending<S> bending_of(const World<Element<S>>& world, int form, const S& surface) {
    using T = Element<S>;
    Bending<S> bending;
    int number = 0;
    world.groups.each([&](const auto& group) {
        if (number++ != form) return;
        using Form = typename std::remove_cvref_t<decltype(group)>::Form;
        bending.flat = Form::plane_faces;
        bending.convex = Form::Kind::convex && Form::Kind::closed;
        if constexpr (requires { group.items[0].shape.curvature(); }) {
            alignas(64) T values[width<S>];
            store_lanes(values, surface);
            for (T& value : values)
                value = group.items[world.references[static_cast<int>(value)].item].shape.curvature();
            bending.curvature = load_lanes<S>(values);
        }
    });
    return bending;
}

/// Appends the cones of rays that go on from hits to those of a queue. A mirror of curvature c adds 2 c cos(incidence)
/// times the width to the spread across the plane of incidence, and more in it. A flat surface between two media
/// multiplies spreads by the ratio of indices and, in that plane, also by the ratio of the cosines; widths in that
/// plane are multiplied by the inverse of the latter (both Igehy 1999). After bumps, concave mirrors and curved or
/// nested glass the width is not known, and 0. After curved mirrors it is only a bound, and below 0.
template <class S, class P>
[[gnu::noinline, gnu::cold]] void put_cones(const Shading<S, P>& shading, RayQueue<Element<S>>& to, const Hit<S>& hit,
                                            const Vec3<S>& direction, Mask<S> lanes, const HitNotes<S, P>& notes) {
    const auto& world = shading.world;
    const Bending<S> bending = bending_of(world, world.sort_bins[hit.bin].form, hit.surface);
    const S zero(0), one(1), cosine = -dot(hit.direction, notes.flat), along = dot(direction, notes.flat);
    const auto all_if = [](bool yes) { return first_lanes<S>(yes ? width<S> : 0); };
    const Mask<S> mirrored = along > zero, flat = all_if(bending.flat);
    const Mask<S> parted = flat | (hit.outside & all_if(bending.convex));
    const Mask<S> even =
        (hit.normal.x == notes.flat.x) & (hit.normal.y == notes.flat.y) & (hit.normal.z == notes.flat.z);
    const S ratio = select(hit.outside, one / hit.material.ior, hit.material.ior), narrower = -along / cosine;
    RayCone<S> cone = notes.cone;
    cone.spread = select(mirrored, fma(S(2) * bending.curvature * cosine, abs(cone.width), cone.spread),
                         ratio * min(one, one / narrower) * cone.spread);
    cone.width = select(mirrored, cone.width, min(one, narrower) * cone.width);
    cone.width = select(flat, cone.width, -abs(cone.width));
    const Mask<S> follows = even & ((mirrored & parted) | (flat & all_if(!world.nested) & !mirrored));
    const auto put = [&](Element<S>* place, const S& value) {
        compress(place + to.count, select(follows & (cone.spread < S(1)), value, zero), lanes);
    };
    put(to.width, cone.width), put(to.spread, cone.spread);
}

}  // namespace strahl::inline STRAHL_LEVEL
