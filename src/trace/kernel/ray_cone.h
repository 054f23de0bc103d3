// Cones around rays, which tell how much of an image a sample sees in mirrors and behind glass: only where images are
// filtered. They count as narrow where it is not known how wide they are, since what is filtered too much is lost, and
// what is filtered too little only wants more samples.
#pragma once
#include <type_traits>

#include "trace/kernel/shading.h"

namespace strahl::inline STRAHL_LEVEL {

/// Are signatures noted?
template <class S, class P>
STRAHL_INLINE bool notes(const Shading<S, P>& shading) {
    return P::notes && shading.batch.sights;
}

/// Are images filtered?
template <class S, class P>
STRAHL_INLINE bool filters(const Shading<S, P>& shading) {
    return P::notes && shading.batch.footprints;
}

/// The sides of samples' squares, in pixels.
template <class S>
STRAHL_INLINE S sides_of(const Footprints<Element<S>>& footprints, const S& pixel) {
    alignas(64) Element<S> sides[width<S>];
    store_lanes(sides, pixel);
    for (Element<S>& side : sides) side = footprints.sides[static_cast<int>(side)];
    return load_lanes<S>(sides);
}

/// The cones of rays where these end, `t` away. Off the middle of the view a square is narrower along the radius.
template <class S, class P>
RayCone<S> cone_at(const Shading<S, P>& shading, const RayQueue<Element<S>>& from, const LaneIndices<S>& pick,
                   const Vec3<S>& direction, const S& t) {
    if (shading.depth > 1) {
        const S spread = pick(from.spread);
        return {fma(t, spread, pick(from.width)), spread};
    }
    const Footprints<Element<S>>& all = *shading.batch.footprints;
    const S cosine = dot(direction, splat<S>(all.forward)), right(dot(all.right, all.right)),
            down(dot(all.down, all.down));
    const S spread = sqrt(min(right, down)) * sides_of(all, S(pick(from.pixel))) * (cosine * cosine);
    return {t * spread, spread};
}

/// How the surfaces of a form part the rays that they mirror.
template <class S>
struct Bending {
    bool flat = false;    // as planes do, from either side
    bool convex = false;  // at least as planes do, those from outside
    S curvature{0};       // the least one
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

/// Puts the cones of rays that go on from hits into a queue, behind its last ones. A mirror of curvature c adds
/// 2 c cos(incidence) to the spread across the plane of incidence, and more in it. A flat surface between two media
/// multiplies spreads by the ratio of indices and, in that plane, by that of the cosines, too; widths there by its
/// inverse (both Igehy 1999). Bumps, and what is hollow or bent otherwise, leave nothing known.
template <class S, class P>
[[gnu::noinline, gnu::cold]] void put_cones(const Shading<S, P>& shading, RayQueue<Element<S>>& to, const Hit<S>& hit,
                                            const Vec3<S>& direction, Mask<S> lanes, const HitNotes<S, P>& known) {
    const auto& world = shading.world;
    const Bending<S> bending = bending_of(world, world.sort_bins[hit.bin].form, hit.surface);
    const S zero(0), one(1), cosine = -dot(hit.direction, known.flat), along = dot(direction, known.flat);
    const auto all_if = [](bool yes) { return first_lanes<S>(yes ? width<S> : 0); };
    const Mask<S> mirrored = along > zero, flat = all_if(bending.flat);
    const Mask<S> parted = flat | (hit.outside & all_if(bending.convex));
    const Mask<S> even =
        (hit.normal.x == known.flat.x) & (hit.normal.y == known.flat.y) & (hit.normal.z == known.flat.z);
    const S ratio = select(hit.outside, one / hit.material.ior, hit.material.ior), narrower = -along / cosine;
    RayCone<S> cone = known.cone;
    cone.spread = select(mirrored, fma(S(2) * bending.curvature * cosine, cone.width, cone.spread),
                         ratio * min(one, one / narrower) * cone.spread);
    cone.width = select(mirrored, cone.width, min(one, narrower) * cone.width);
    const Mask<S> follows = even & ((mirrored & parted) | (flat & all_if(!world.nested) & !mirrored));
    const auto put = [&](Element<S>* place, const S& value) {
        compress(place + to.count, select(follows & (cone.spread < S(1)), value, zero), lanes);
    };
    put(to.width, cone.width), put(to.spread, cone.spread);
}

}  // namespace strahl::inline STRAHL_LEVEL
