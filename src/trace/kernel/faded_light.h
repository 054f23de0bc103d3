// Shadow rays of worlds in whose bodies light fades: from surface to surface, as POV-Ray follows them.
#pragma once
#include <algorithm>
#include <bit>

#include "trace/kernel/surface_at.h"
#include "trace/patterns/finish_calls.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns the rays that come from inside of the bodies which they meet, in nested worlds by their medium stacks.
template <class S>
Mask<S> from_inside(const World<Element<S>>& world, MediumStacks* mediums, const S& medium, const S& body,
                    Mask<S> outside) {
    using T = Element<S>;
    if (!world.nested || !mediums) return !outside;
    alignas(64) T stacks[width<S>], bodies[width<S>], inside[width<S>];
    store_lanes(stacks, medium), store_lanes(bodies, body);
    for (int k = 0; k < width<S>; ++k)
        inside[k] = contains(*mediums, static_cast<int>(stacks[k]), world.media.bodies[static_cast<int>(bodies[k])]);
    return load_lanes<S>(inside) > S(0);
}
/// Returns the stacks of rays that, in these lanes, have gone on into bodies or, in those of `leaving`, out of them.
template <class S>
S stacks_beyond(const World<Element<S>>& world, MediumStacks& mediums, const S& medium, const S& body, Mask<S> lanes,
                Mask<S> leaving) {
    using T = Element<S>;
    alignas(64) T stacks[width<S>], bodies[width<S>];
    store_lanes(stacks, medium), store_lanes(bodies, body);
    for (unsigned left = bits(lanes); left; left &= left - 1) {
        const int k = std::countr_zero(left), stack = static_cast<int>(stacks[k]);
        const int own = world.media.bodies[static_cast<int>(bodies[k])];
        stacks[k] = static_cast<T>((bits(leaving) >> k & 1) ? remove(mediums, stack, own) : push(mediums, stack, own));
    }
    return load_lanes<S>(stacks);
}

/// Attenuates light that crosses the nearest surfaces, all of one bin, in these lanes. `way` is how far light has come
/// since the surface before, which surfaces that cast no shadow leave as it is.
template <class S>
void cross_surfaces(const World<Element<S>>& world, const Ray<S>& ray, const Nearest<S>& met, Mask<S> lanes,
                    Start<S>& start, Ray<S>& after, S& way, Vec3<S>& share) {
    using T = Element<S>;
    const int first_lane = first(lanes);
    const SortBin& bin = world.sort_bins[static_cast<int>(lane(met.bin, first_lane))];
    SurfaceHit<S> hit;
    int materials[width<S>];
    const auto opaque = [&](int material) {
        return world.finishes.list[material].shadow && !(world.materials[material].refraction > T(0));
    };
    const auto hide = [&](Mask<S> dark) {
        for (int c = 0; c < 3; ++c) share[c] = select(dark, S(0), share[c]);
    };
    if (world.bin_per_item) {
        if (opaque(bin.material)) return hide(lanes);
        hit = surface_at(world, bin, ray, met.t);
        std::fill_n(materials, width<S>, bin.material);
    } else {
        // Lanes of other bins get a surface of this one.
        alignas(64) T surfaces[width<S>], order[width<S>];
        store_lanes(surfaces, select(lanes, met.surface, S(lane(met.surface, first_lane))));
        store_lanes(order, iota<S>());
        hit = surfaces_at(world, bin.form, surfaces, LaneIndices<S>(order, width<S>), ray, met.t, materials);
    }
    const Mask<S> outside = dot(ray.direction, hit.point.normal) < S(0);
    const Mask<S> leaving = from_inside(world, start.mediums, start.medium, hit.body, outside);
    for (Mask<S> left = lanes; any(left);) {
        const int k = first(left), own = materials[k];
        unsigned alike = 0;
        for (int n = k; n < width<S>; ++n) alike |= unsigned(materials[n] == own) << n;
        const Mask<S> same = left & mask_of<S>(alike);
        left = left & !same;
        if (!world.finishes.list[own].shadow) continue;
        if (opaque(own)) {
            hide(same);
            continue;
        }
        Vec3<S> kept = FinishCalls<S>::through(world, own, hit.point.position, hit.surface);
        if (world.finishes.list[own].fade_power > T(0) && any(leaving & same)) {
            const Vec3<S> faded = FinishCalls<S>::faded_inside(world, own, way);
            kept = select(leaving, kept * faded, kept);
        }
        for (int c = 0; c < 3; ++c) share[c] = select(same, min(share[c] * kept[c], S(largest_gain)), share[c]);
        way = select(same, S(0), way);
        if (world.nested && start.mediums)
            start.medium = stacks_beyond(world, *start.mediums, start.medium, hit.body, same, leaving);
    }
    after.origin = select(lanes, hit.point.position, after.origin);
    after.source = select(lanes, hit.surface, after.source);
}

/// Returns the share of light that is transmitted, see Visibility.
template <class S>
[[gnu::noinline]] Vec3<S> faded_visibility(const World<Element<S>>& world, const Ray<S>& ray, const S& distance,
                                           Mask<S> active, const Start<S>& start) {
    constexpr int most_surfaces = 256;
    Vec3<S> share = splat<S>(Vec3<Element<S>>(1));
    Ray<S> own = ray;
    Start<S> inside = start;
    S left = distance, way(0);
    for (int i = 0; i < most_surfaces && any(active); ++i) {
        const Nearest<S> met = nearest(world, own, active, ~BodySet(0));
        active = active & (met.t < left);
        left = select(active, left - met.t, left), way = select(active, way + met.t, way);
        Ray<S> after = own;
        for (Mask<S> rest = active; any(rest);) {
            const Mask<S> same = rest & (met.bin == S(lane(met.bin, first(rest))));
            cross_surfaces(world, own, met, same, inside, after, way, share);
            rest = rest & !same;
        }
        own = after;
        active = active & (max(share.x, max(share.y, share.z)) > S(0));
    }
    return share;
}

}  // namespace strahl::inline STRAHL_LEVEL
