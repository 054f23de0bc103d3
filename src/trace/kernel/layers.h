// Layers: what pixels show besides their light. Noted only where a batch asks for it, lane by lane.
//
// The fraction of a ray's pixel number says how it came from the eye; whatever uses the number as an index cuts it off.
#pragma once
#include "trace/kernel/shading.h"

namespace strahl::inline STRAHL_LEVEL {

/// The ways of rays: from the eye, reflected at the first surface, or refracted there and perhaps reflected later.
template <class T>
inline constexpr T way_reflected = T(.25);
template <class T>
inline constexpr T way_refracted = T(.5);
template <class T>
inline constexpr T way_both = T(.75);

/// Returns true if layers are noted.
template <class S, class P>
STRAHL_INLINE bool notes_layers(const Shading<S, P>& shading) {
    return P::notes && shading.batch.layers;
}

/// Returns the pixel numbers of rays that go on from hits in these directions; `flat` as in carried_on.
template <class S>
[[gnu::noinline, gnu::cold]] S pixel_of_way(const S& pixel, const Vec3<S>& direction, const Vec3<S>& flat) {
    using T = Element<S>;
    const S number = floor(pixel), way = pixel - number;
    const Mask<S> reflected = dot(direction, flat) > S(0);
    const S first = select(reflected, S(way_reflected<T>), S(way_refracted<T>));
    const S later = select(reflected & (way == S(way_refracted<T>)), S(way_both<T>), way);
    return number + select(way == S(0), first, later);
}

/// Returns the share of the background that shows through where rays meet nothing: mirrors show it as it is.
template <class S, class P>
[[gnu::noinline, gnu::cold]] S clear_share(const Shading<S, P>& shading, const S& pixel) {
    using T = Element<S>;
    const S way = pixel - floor(pixel);
    const Mask<S> reflected = (way == S(way_reflected<T>)) | (way == S(way_both<T>));
    return select(reflected, S(0), S(1 - shading.batch.layers->opacity));
}

/// Adds light to the layer of the way that it came; returns the row. Light of rays from the eye goes to `own`.
template <class T>
T* add_to_layer(const LayerRows<T>& layers, T pixel, const T* light) {
    using Rows = LayerRows<T>;
    const int number = static_cast<int>(pixel);
    T* const row = layers.values + number * layers.length;
    const T way = pixel - static_cast<T>(number);
    const int place = way == 0 ? Rows::own : way == way_reflected<T> ? Rows::reflected : Rows::refracted;
    for (int c = 0; c < 3 && layers.length > Rows::own; ++c) row[place + c] += light[c];
    return row;
}

/// Notes rays that meet nothing, with their light and the share of the background that shows through.
template <class S, class P>
[[gnu::noinline, gnu::cold]] void note_clear(const Shading<S, P>& shading, const S& pixel, int lanes, const S& share,
                                             const Vec3<S>& light) {
    using T = Element<S>;
    alignas(64) T pixels[width<S>], shares[width<S>], colors[3][width<S>];
    store_lanes(pixels, pixel), store_lanes(shares, share);
    for (int c = 0; c < 3; ++c) store_lanes(colors[c], light[c]);
    for (int k = 0; k < lanes; ++k) {
        const T own[3]{colors[0][k], colors[1][k], colors[2][k]};
        add_to_layer(*shading.batch.layers, pixels[k], own)[LayerRows<T>::clear] += shares[k];
    }
}

/// Notes the light of hits before another light is added.
template <class S, class P>
[[gnu::noinline, gnu::cold]] void note_light_before(const Shading<S, P>& shading, const Vec3<S>& sum) {
    LayerRows<Element<S>>& layers = *shading.batch.layers;
    if (layers.length <= LayerRows<Element<S>>::lights) return;
    for (int c = 0; c < 3; ++c) store_lanes(layers.lit + (3 * layers.lights_noted + c) * width<S>, sum[c]);
    ++layers.lights_noted;
}

/// Notes hits with their light: `sum`, multiplied by `factor`, to which that of fog may have been added. `materials`
/// has the number of each lane's material where they are not all of one. Of several calls for the same hits one is
/// `first`.
template <class S, class P>
[[gnu::noinline, gnu::cold]] void note_layers(const Shading<S, P>& shading, const Hit<S>& hit, const S& t, int lanes,
                                              const int* materials, bool first, const Vec3<S>& light,
                                              const Vec3<S>& sum, const Vec3<S>& factor) {
    using T = Element<S>;
    using Rows = LayerRows<T>;
    LayerRows<T>& layers = *shading.batch.layers;
    alignas(64) T pixels[width<S>], seen[width<S>], surfaces[width<S>], distances[width<S>];
    alignas(64) T positions[3][width<S>], normals[3][width<S>], colors[3][width<S>], factors[3][width<S>];
    store_lanes(pixels, hit.pixel), store_lanes(surfaces, hit.surface), store_lanes(distances, t);
    store_lanes(seen, select(hit.active, S(1), S(0)));
    for (int c = 0; c < 3; ++c) {
        store_lanes(positions[c], hit.position[c]), store_lanes(normals[c], hit.normal[c]);
        store_lanes(colors[c], light[c]), store_lanes(factors[c], factor[c]);
        store_lanes(layers.lit + (3 * layers.lights_noted + c) * width<S>, sum[c]);
    }
    const int lights = layers.lights_noted, material = shading.world.sort_bins[hit.bin].material;
    for (int k = 0; k < lanes; ++k) {
        const bool from_eye = pixels[k] == static_cast<T>(static_cast<int>(pixels[k]));
        T own[3]{colors[0][k], colors[1][k], colors[2][k]};
        T* const row = layers.values + static_cast<int>(pixels[k]) * layers.length;
        for (int i = 0; i < 3 * lights && from_eye; ++i) {
            const T* const before = layers.lit + i * width<S> + k;
            const T part = (before[3 * width<S>] - *before) * factors[i % 3][k];
            row[Rows::lights + i] += part, own[i % 3] -= part;
        }
        add_to_layer(layers, pixels[k], own);
        if (!from_eye || !first || seen[k] == 0 || layers.length <= Rows::distance) continue;
        row[Rows::distance] = distances[k], row[Rows::surface] = surfaces[k];
        row[Rows::material] = static_cast<T>(material >= 0 ? material : materials[k]);
        for (int c = 0; c < 3; ++c) row[Rows::position + c] = positions[c][k], row[Rows::normal + c] = normals[c][k];
    }
    layers.lights_noted = 0;
}

}  // namespace strahl::inline STRAHL_LEVEL
