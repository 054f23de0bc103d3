// Shadow rays through clear surfaces: from surface to surface, as POV-Ray follows them.
#pragma once
#include <algorithm>
#include <bit>

#include "trace/finish/finish_calls.h"
#include "trace/kernel/surface_at.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns the rays that come from inside of the bodies which they meet, in nested worlds by their medium stacks.
template <class S>
Mask<S> from_inside(const World<Element<S>>& world, MediumStacks* mediums, const S& medium, const S& body,
                    Mask<S> outside) {
    if (!world.nested || !mediums) return !outside;
    Mask<S> inside = first_lanes<S>(0);
    each_stack_and_body(world, medium, body, first_lanes<S>(width<S>), [&](int stack, int own, Mask<S> same) {
        if (contains(*mediums, stack, own)) inside = inside | same;
    });
    return inside;
}
/// Returns the stacks of rays that, in these lanes, have gone on into bodies or, in those of `leaving`, out of them.
template <class S>
S stacks_beyond(const World<Element<S>>& world, MediumStacks& mediums, const S& medium, const S& body, Mask<S> lanes,
                Mask<S> leaving) {
    S after = medium;
    each_stack_and_body(world, medium, body, lanes, [&](int stack, int own, Mask<S> same) {
        const int next = any(same & leaving) ? remove(mediums, stack, own) : push(mediums, stack, own);
        after = select(same, S(static_cast<Element<S>>(next)), after);
    });
    return after;
}

/// Does a surface belong to a leaf of a composite?
template <class T>
bool is_on_leaf(const World<T>& world, int surface) {
    return world.composites.leaf_faces && world.composites.leaf_faces[surface] >= 0;
}
/// Returns the lanes without a surface, or with one that lets no light through. Surfaces of a composite are never
/// among these: others of the same composite may be clear.
template <class S>
Mask<S> opaque_lanes(const World<Element<S>>& world, const S& surfaces, Mask<S> lanes) {
    for (unsigned left = bits(lanes); left != 0; left &= left - 1) {
        const int k = std::countr_zero(left), own = static_cast<int>(lane(surfaces, k));
        if (own >= 0 && (is_on_leaf(world, own) || passes_light(world, material_of(world, own))))
            lanes = lanes & !mask_of<S>(1u << k);
    }
    return lanes;
}

/// Attenuates light that crosses the nearest surfaces, all of one bin, in these lanes, where the rays go on from there.
/// `way` is how far light has come since the surface before, and `over` how far rays pass over what is there: surfaces
/// that cast no shadow leave both as they are.
template <class S>
void cross_surfaces(const World<Element<S>>& world, Ray<S>& ray, const Nearest<S>& met, Mask<S> lanes, Start<S>& start,
                    S& way, S& over, Vec3<S>& share) {
    using T = Element<S>;
    const int first_lane = first(lanes);
    const int surface = static_cast<int>(lane(met.surface, first_lane)), material = material_of(world, surface);
    const SortBin& bin = world.sort_bins[static_cast<int>(lane(met.bin, first_lane))];
    const Mask<S> alike = lanes & (met.surface == S(static_cast<T>(surface)));
    const bool on_leaf = is_on_leaf(world, surface);
    SurfaceHit<S> hit;
    int materials[width<S>];
    const auto opaque = [&](int material) { return !passes_light(world, material); };
    const auto hide = [&](Mask<S> dark) {
        for (int c = 0; c < 3; ++c) share[c] = select(dark, S(0), share[c]);
    };
    // Needs neither the normal nor the pattern of an opaque surface.
    if (opaque(material)) {
        hide(alike), lanes = lanes & !alike;
        if (none(lanes)) return;
    }
    if (bin.material >= 0 || (none(lanes & !alike) && !on_leaf)) {
        hit = surface_at(world, {bin.form, world.references[surface].item, material}, ray, met.t);
        std::fill_n(materials, width<S>, material);
    } else {
        // Lanes of other bins get a surface of this one.
        alignas(64) T surfaces[width<S>], order[width<S>];
        store_lanes(surfaces, select(lanes, met.surface, S(static_cast<T>(surface))));
        store_lanes(order, iota<S>());
        hit = surfaces_at(world, bin.form, surfaces, LaneIndices<S>(order, width<S>), ray, met.t, materials);
    }
    const Mask<S> outside = dot(ray.direction, hit.point.normal) < S(0);
    const Mask<S> leaving = from_inside(world, start.mediums, start.medium, hit.body, outside);
    alignas(64) T numbers[width<S>];
    std::copy_n(materials, width<S>, numbers);
    for (Mask<S> left = lanes; any(left);) {
        const int own = materials[first(left)];
        const Mask<S> same = left & (load_lanes<S>(numbers) == S(static_cast<T>(own)));
        left = left & !same;
        if (!world.finishes.list[own].shadow) continue;
        if (opaque(own)) {
            hide(same);
            continue;
        }
        Vec3<S> kept = FinishCalls<S>::through(world, own, hit.point.position, hit.surface, outside);
        if (world.finishes.list[own].fade_power > T(0) && any(leaving & same)) {
            const Vec3<S> faded = FinishCalls<S>::faded_inside(world, own, way, leaving & same);
            kept = select(leaving, kept * faded, kept);
        }
        for (int c = 0; c < 3; ++c) share[c] = select(same, min(share[c] * kept[c], S(largest_gain)), share[c]);
        way = select(same, S(0), way), over = select(same, S(world.passed_in_shadows), over);
        if (world.nested && start.mediums)
            start.medium = stacks_beyond(world, *start.mediums, start.medium, hit.body, same, leaving);
    }
    ray.origin = select(lanes, hit.point.position, ray.origin);
    ray.source = select(lanes, hit.surface, ray.source);
}

/// Returns the share of light that is transmitted, and adds to `hidden` the rays that pass over an opaque surface,
/// behind which they do not see the same body again.
template <class S>
[[gnu::noinline]] Vec3<S> followed_light(const World<Element<S>>& world, const Ray<S>& ray, const S& distance,
                                         Mask<S> active, const Start<S>& start, Mask<S>& hidden) {
    constexpr int most_surfaces = 256;
    Vec3<S> share = splat<S>(Vec3<Element<S>>(1));
    Ray<S> own = ray;
    Start<S> inside = start;
    S left = way_before_light(world, ray, distance), way(0), over(world.passed_in_shadows);
    for (int i = 0; i < most_surfaces && any(active); ++i) {
        Nearest<S> met = nearest(world, own, active, ~BodySet(0));
        const Mask<S> close = active & (met.t < over);
        if (any(close)) {
            hidden = hidden | opaque_lanes(world, met.surface, close);
            pass_over(world, over, close, S(-1), own, met);
            left = select(close, left - over, left), way = select(close, way + over, way);
            over = select(close, S(0), over);
        }
        active = active & (met.t < left);
        left = select(active, left - met.t, left), way = select(active, way + met.t, way);
        over = max(over - met.t, S(0));
        for (Mask<S> rest = active; any(rest);) {
            const Mask<S> same = rest & (met.bin == S(lane(met.bin, first(rest))));
            cross_surfaces(world, own, met, same, inside, way, over, share);
            rest = rest & !same;
        }
        active = active & (max(share.x, max(share.y, share.z)) > S(0));
    }
    return share;
}

/// Returns the share of light that is transmitted, followed from surface to surface.
template <class S>
Vec3<S> faded_visibility(const World<Element<S>>& world, const Ray<S>& ray, const S& distance, Mask<S> active,
                         const Start<S>& start) {
    Mask<S> hidden = first_lanes<S>(0);
    return followed_light(world, ray, distance, active, start, hidden);
}

/// May bodies that light passes be in its way? If each item has a bin, those that are known to be beside it do not
/// count. Composites always do: the material of their bin says nothing of their parts.
template <class T, class S>
bool may_pass_bodies(const World<T>& world, const Start<S>& start) {
    constexpr int composites = place_of<CompositeForm>(Forms{});
    if (!world.bin_per_item) return true;
    BodySet left = world.few.occluders[start.light * world.bins + start.bin] & start.only;
    for (; left; left &= left - 1) {
        const SortBin& bin = world.sort_bins[std::countr_zero(left)];
        if (bin.form == composites || bin.material < 0 || passes_light(world, bin.material)) return true;
    }
    return false;
}

/// Returns up to which distance behind their start or a clear surface shadow rays may pass over others.
template <class T>
T most_passed_over(const World<T>& world) {
    constexpr T more = 11;  // once, and then 10 times as far, see FormFunctions::passed_over
    const bool blobs = world.groups.template get<Form<Blob, 0>>().count > 0;
    return (blobs ? more : T(1)) * world.passed_in_shadows;
}

/// Returns the light that comes through where it does not fade and no surface has two sides. Follows only rays that
/// cross clear surfaces near to each other or to their starts, since what is near behind a clear one is passed over.
/// Rays that lose all light may lose it to colours alone, or to open bodies that are passed over, unless they are in an
/// opaque body, which followed rays do not see.
template <class S>
[[gnu::noinline]] Vec3<S> clear_visibility(const World<Element<S>>& world, const Ray<S>& ray, const S& distance,
                                           Mask<S> active, const Start<S>& start) {
    const S way = way_before_light(world, ray, distance);
    ShadowNotes<S> met(most_passed_over(world));
    Vec3<S> share = visibility_of_all<true>(world, ray, way, active, start, &met);
    const auto is_lit = [](const Vec3<S>& light) { return Mask<S>(largest(light) > S(0)); };
    const Mask<S> less = active & dimmed(share), lit = less & is_lit(share);
    look_past(world, ray, way, less & !lit & !met.dark, start, share);
    if (!may_pass_bodies(world, start)) return share;
    const Mask<S> close = less & met.close();
    Mask<S> dark = (close | (less & met.opened)) & !met.closed & !is_lit(share);
    Mask<S> hidden = opaque_lanes(world, ray.source, dark & !start.outside);
    dark = dark & !hidden;
    const Mask<S> followed = (lit & close) | dark;
    if (none(followed)) return share;
    const Vec3<S> light = followed_light(world, ray, distance, followed, start, hidden);
    return select((lit & close) | (dark & dimmed(light) & !hidden), light, share);
}

template <class S>
[[gnu::noinline]] Vec3<S> visibility_by_parts(const World<Element<S>>& world, const Ray<S>& ray, const S& distance,
                                              Mask<S> active, const Start<S>& start) {
    if (!start.ends_early && any(active & ends_before(world, distance))) [[unlikely]] {
        Start<S> early = start;
        early.ends_early = true;
        return visibility_by_parts(world, ray, distance, active, early);
    }
    if (world.shadow_rays == ShadowRays::followed) return faded_visibility(world, ray, distance, active, start);
    if (world.shadow_rays == ShadowRays::followed_where_dimmed)
        return clear_visibility(world, ray, distance, active, start);
    const S way = way_before_light(world, ray, distance);
    if (!(world.passed_in_shadows > 0)) return visibility_of_all(world, ray, way, active, start);
    ShadowNotes<S> met(most_passed_over(world));
    Vec3<S> share = visibility_of_all<true>(world, ray, way, active, start, &met);
    const Mask<S> lit = largest(share) > S(0), doubtful = dimmed(share) & !met.dark & (met.close_to_start() | !lit);
    look_past(world, ray, way, active & doubtful, start, share);
    return share;
}

}  // namespace strahl::inline STRAHL_LEVEL
