// Footprints of samples, over which patterns are averaged. Computed only if a batch has `footprints`.
#pragma once
#include "trace/kernel/ray_cone.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns the footprints of camera rays that meet surfaces with these normals at distance `t`. Let D be the direction
/// before it is normalised, of length 1 along `forward`: the ray of the next pixel goes along D + right.
template <class S, class P>
Footprint<S> footprint_of(const Shading<S, P>& shading, const S& pixel, const Vec3<S>& direction, const S& t,
                          const Vec3<S>& normal) {
    const Footprints<Element<S>>& all = *shading.batch.footprints;
    const S size = t * dot(direction, splat<S>(all.forward)) * sides_of(all, pixel);
    return {direction, normal, scale(size, splat<S>(all.right)), scale(size, splat<S>(all.down))};
}

/// Returns the footprints of rays whose cones are `size` wide there: two axes perpendicular to the direction (T. Duff
/// et al., "Building an Orthonormal Basis, Revisited", 2017). Any two will do: the ellipse of a square does not depend
/// on how it is turned.
template <class S>
Footprint<S> footprint_of(const Vec3<S>& d, const S& size, const Vec3<S>& normal) {
    const S sign = select(d.z >= S(0), S(1), S(-1)), a = S(-1) / (sign + d.z), b = d.x * d.y * a;
    return {d, normal, scale(size, {fma(sign * d.x, d.x * a, S(1)), sign * b, -sign * d.x}),
            scale(size, {b, fma(d.y, d.y * a, sign), -d.y})};
}

/// Pixels of an image above which a pixel of the view may show parts of the image that the pixels around it do not
/// show.
inline constexpr float coarse_pixel = .25f;

/// Adds the colours of patterns, of images where footprints exceed that limit, to `Footprints::colors`: over all that a
/// sample sees, each by the share of its light that reaches the sample; and notes the loosest filter among them.
/// Weights up to `Limits::noticed` do not count.
template <class S, class P>
STRAHL_INLINE void note_colors(const Shading<S, P>& shading, const Filtering<S>& filtering, const Vec3<S>& color,
                               const S& pixel, const S& weight, int lanes) {
    using T = Element<S>;
    const Footprints<T>& all = *shading.batch.footprints;
    alignas(64) T colors[3][width<S>], lengths[width<S>], looseness[width<S>], pixels[width<S>], weights[width<S>];
    for (int c = 0; c < 3; ++c) store_lanes(colors[c], color[c]);
    store_lanes(lengths, filtering.length), store_lanes(looseness, filtering.loose);
    store_lanes(pixels, pixel), store_lanes(weights, weight);
    for (int k = 0; k < lanes; ++k) {
        const int own = static_cast<int>(pixels[k]);
        if (!(lengths[k] > coarse_pixel * all.sides[own]) || !(weights[k] > shading.limits.noticed)) continue;
        T* const sum = all.colors + std::ptrdiff_t(4) * own;
        for (int c = 0; c < 3; ++c) sum[c] = std::max(sum[c], T(0)) + weights[k] * colors[c][k];
        sum[3] = std::max(sum[3], looseness[k]);
    }
}

/// Counts filters as loose where the cones of rays are only bounds.
template <class S>
STRAHL_INLINE void loosen(Filtering<S>& filtering, const S& width) {
    filtering.loose = select(width < S(0), select(filtering.loose < S(0), filtering.loose, S(1)), filtering.loose);
}

/// Sets the colours of patterned materials to means over footprints.
template <class S, class P>
[[gnu::noinline]] void paint_filtered(const Shading<S, P>& shading, const int* materials, const SurfaceHit<S>& hit,
                                      const RayQueue<Element<S>>& from, const LaneIndices<S>& pick, const S& t,
                                      MaterialKernel<S>& values) {
    const auto& d = from.direction;
    const Vec3<S> direction(pick(d.x), pick(d.y), pick(d.z)), &normal = hit.point.normal;
    const S pixel = pick(from.pixel);
    const S wide = shading.depth > 1 ? cone_at(shading, from, pick, direction, t).width : S(0);
    const Footprint<S> footprint =
        shading.depth > 1 ? footprint_of(direction, wide, normal) : footprint_of(shading, pixel, direction, t, normal);
    Filtering<S> filtering =
        PatternCalls<S>::paint_filtered(shading.world, materials, hit.point.position, hit.surface, footprint, values);
    loosen(filtering, wide);
    note_colors(shading, filtering, values.ambient + values.diffuse, pixel, pick(from.weight), pick.lanes);
}

/// Returns the mean background over footprints.
template <class S, class P>
[[gnu::noinline]] Vec3<S> filtered_sky(const Shading<S, P>& shading, const LaneIndices<S>& pick) {
    const RayQueue<Element<S>>& from = shading.rays.open;
    const Vec3<S> direction(pick(from.direction.x), pick(from.direction.y), pick(from.direction.z));
    const S pixel = pick(from.pixel);
    Vec3<S> color;
    const Footprint<S> footprint = shading.depth > 1 ? footprint_of(direction, pick(from.spread), direction)
                                                     : footprint_of(shading, pixel, direction, S(1), direction);
    Filtering<S> filtering = PatternCalls<S>::sky_filtered(shading.world, footprint, color);
    loosen(filtering, shading.depth > 1 ? pick(from.width) : S(0));
    note_colors(shading, filtering, color, pixel, pick(from.weight), pick.lanes);
    return color;
}

}  // namespace strahl::inline STRAHL_LEVEL
