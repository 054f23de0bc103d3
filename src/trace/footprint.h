// Footprints of camera rays: only where a batch asks for them.
#pragma once
#include "trace/shading.h"

namespace strahl::inline STRAHL_LEVEL::inline STRAHL_INSTANCE {

/// Are images filtered? In the first generation, and where a batch wants it.
template <class S>
STRAHL_INLINE bool filters(const Shading<S>& shading) {
    return shading.batch.footprints && shading.depth == 1;
}

/// Of camera rays, as far as t, to surfaces with these normals. With D the direction before its length became 1, which
/// has length 1 along `forward`, the ray of the next pixel goes along D + right.
template <class S>
Footprint<S> footprint_of(const Shading<S>& shading, const S& pixel, const Vec3<S>& direction, const S& t,
                          const Vec3<S>& normal) {
    using T = Element<S>;
    const Footprints<T>& all = *shading.batch.footprints;
    alignas(64) T sides[width<S>];
    store_lanes(sides, pixel);
    for (T& side : sides) side = all.sides[static_cast<int>(side)];
    const S size = t * dot(direction, splat<S>(all.forward)) * load_lanes<S>(sides);
    return {direction, normal, scale(size, splat<S>(all.right)), scale(size, splat<S>(all.down))};
}

/// From this share of an image's pixel on, a pixel of the view may hide some of the image from the pixels around.
inline constexpr float coarse_pixel = .25f;

/// Notes the colours of samples whose footprints are that long, in pixels of an image.
template <class S>
STRAHL_INLINE void note_colors(const Shading<S>& shading, const S& longer, const Vec3<S>& color, const S& pixel,
                               int lanes) {
    using T = Element<S>;
    const Footprints<T>& all = *shading.batch.footprints;
    alignas(64) T colors[3][width<S>], lengths[width<S>], pixels[width<S>];
    for (int c = 0; c < 3; ++c) store_lanes(colors[c], color[c]);
    store_lanes(lengths, longer), store_lanes(pixels, pixel);
    for (int k = 0; k < lanes; ++k) {
        const int own = static_cast<int>(pixels[k]);
        if (!(lengths[k] > coarse_pixel * all.sides[own])) continue;
        for (int c = 0; c < 3; ++c) all.colors[3 * own + c] = colors[c][k];
    }
}

/// Gives materials the colours of their patterns, images filtered.
template <class S>
[[gnu::noinline]] void paint_filtered(const Shading<S>& shading, const int* materials, const SurfaceHit<S>& hit,
                                      const Vec3<S>& direction, const S& t, const S& pixel, int lanes,
                                      MaterialKernel<S>& values) {
    const Footprint<S> footprint = footprint_of(shading, pixel, direction, t, hit.point.normal);
    const S longer =
        PatternCalls<S>::paint_filtered(shading.world, materials, hit.point.position, hit.surface, footprint, values);
    note_colors(shading, longer, values.ambient + values.diffuse, pixel, lanes);
}

/// The background, images filtered.
template <class S>
[[gnu::noinline]] Vec3<S> filtered_sky(const Shading<S>& shading, const Vec3<S>& direction, const S& pixel, int lanes) {
    Vec3<S> color;
    const Footprint<S> footprint = footprint_of(shading, pixel, direction, S(1), direction);
    const S longer = PatternCalls<S>::sky_filtered(shading.world, footprint, color);
    note_colors(shading, longer, color, pixel, lanes);
    return color;
}

}  // namespace strahl::inline STRAHL_LEVEL::inline STRAHL_INSTANCE
