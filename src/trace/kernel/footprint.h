// Footprints of samples, over which patterns are averaged. Computed only if a batch has `footprints`.
#pragma once
#include <limits>

#include "trace/kernel/ray_cones.h"

namespace strahl::inline STRAHL_LEVEL {

/// Pixels of an image above which a pixel of the view may show parts of the image that the pixels around it do not
/// show.
inline constexpr float coarse_pixel = .25f;

/// Adds the colours of patterns, of images where footprints exceed that limit, to `Footprints::seen`: over all that a
/// sample sees, each by the share of its light that reaches the sample, and what they may be off; and notes the loosest
/// filter among them.
/// Weights up to `Limits::noticed` do not count.
template <class S, class P>
STRAHL_INLINE void note_colors(const Shading<S, P>& shading, const Filtering<S>& filtering, const Vec3<S>& color,
                               const S& pixel, const S& weight, int lanes) {
    using T = Element<S>;
    const Footprints<T>& all = *shading.batch.footprints;
    alignas(64) T colors[3][width<S>], lengths[width<S>], looseness[width<S>], doubts[width<S>];
    alignas(64) T pixels[width<S>], weights[width<S>];
    for (int c = 0; c < 3; ++c) store_lanes(colors[c], color[c]);
    store_lanes(lengths, filtering.length), store_lanes(looseness, filtering.loose);
    store_lanes(doubts, filtering.doubt);
    store_lanes(pixels, pixel), store_lanes(weights, weight);
    for (int k = 0; k < lanes; ++k) {
        const int own = static_cast<int>(pixels[k]);
        if (!(lengths[k] > coarse_pixel * all.sides[own]) || !(weights[k] > shading.limits.noticed)) continue;
        SeenPatterns<T>& seen = all.seen[own];
        for (int c = 0; c < 3; ++c) seen.color[c] = std::max(seen.color[c], T(0)) + weights[k] * colors[c][k];
        seen.loose = std::max(seen.loose, looseness[k]);
        seen.doubt = std::max(seen.doubt, T(0)) + weights[k] * doubts[k];
    }
}

/// Counts filters as loose where differentials are.
template <class S>
STRAHL_INLINE void loosen(Filtering<S>& filtering, const S& loose) {
    filtering.loose = select(filtering.loose < S(0), filtering.loose, max(filtering.loose, loose));
}

/// Rays of a sample are taken to end on a surface no nearer than so many times less than its middle does, and no
/// further than as many times more: a surface has a horizon, and its pixels no end.
inline constexpr double most_shrink = 1.6;

/// Returns the footprint of rays that end on surfaces with this normal.
template <class S>
Footprint<S> footprint_of(const Differentials<S>& beside, const Vec3<S>& direction, const Vec3<S>& normal,
                          const S& weight) {
    using T = Element<S>;
    const S zero(0), most(static_cast<T>(most_shrink)), per = S(1) / dot(normal, direction);
    const S shrink[2] = {per * dot(normal, beside.direction[0]), per * dot(normal, beside.direction[1])};
    const S all = abs(shrink[0]) + abs(shrink[1]), limit = min(S(1), most / all);
    const Mask<S> known = (all > zero) & (all < S(std::numeric_limits<T>::max()));
    return {direction,       normal, beside.place[0],
            beside.place[1], weight, {select(known, limit * shrink[0], zero), select(known, limit * shrink[1], zero)}};
}

/// Sets the colours of patterned materials to means over footprints.
template <class S, class P>
[[gnu::noinline]] void paint_filtered(const Shading<S, P>& shading, const int* materials, const SurfaceHit<S>& hit,
                                      const RayQueue<Element<S>>& from, const LaneIndices<S>& pick, const S& t,
                                      MaterialKernel<S>& values) {
    const auto& d = from.direction;
    const Vec3<S> direction(pick(d.x), pick(d.y), pick(d.z)), &normal = hit.point.normal;
    const auto paint = [&](const Footprint<S>& footprint) {
        return PatternCalls<S>::paint_filtered(shading.world, materials, hit.point.position, hit.surface, footprint,
                                               values);
    };
    if (shading.world.patterns.quick) {
        const S wide = cone_at(shading, from, pick, direction, t).width;
        return void(paint(footprint_of(wide, direction, normal)));
    }
    const Differentials<S> beside = differentials_at(shading, from, pick, direction, t);
    Filtering<S> filtering = paint(footprint_of(beside, direction, normal, S(pick(from.weight))));
    loosen(filtering, beside.loose);
    note_colors(shading, filtering, values.ambient + values.diffuse, pick(from.pixel), pick(from.weight), pick.lanes);
}

/// Returns the mean background over footprints.
template <class S, class P>
[[gnu::noinline]] Vec3<S> filtered_sky(const Shading<S, P>& shading, const LaneIndices<S>& pick) {
    const RayQueue<Element<S>>& from = shading.rays.open;
    const Vec3<S> direction(pick(from.direction.x), pick(from.direction.y), pick(from.direction.z));
    Vec3<S> color;
    if (shading.world.patterns.quick) {
        const S wide = cone_at(shading, from, pick, direction, S(0)).spread;
        return PatternCalls<S>::sky_filtered(shading.world, footprint_of(wide, direction, direction), color), color;
    }
    const Differentials<S> beside = differentials_at(shading, from, pick, direction, S(0));
    const Footprint<S> footprint{direction, direction, beside.direction[0], beside.direction[1], pick(from.weight)};
    Filtering<S> filtering = PatternCalls<S>::sky_filtered(shading.world, footprint, color);
    loosen(filtering, beside.loose);
    note_colors(shading, filtering, color, pick(from.pixel), pick(from.weight), pick.lanes);
    return color;
}

}  // namespace strahl::inline STRAHL_LEVEL
