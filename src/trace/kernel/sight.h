// Signatures of samples, and what else they saw besides their light. Noted only where a batch asks for it.
#pragma once
#include "trace/kernel/shading.h"
#include "trace/patterns/pattern_calls.h"

namespace strahl::inline STRAHL_LEVEL {

/// Mixes a word into a hash, lane by lane in plain arrays, which the compiler vectorises. Multiplications by odd
/// numbers and shifts lose nothing (M. E. O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good
/// Algorithms for Random Number Generation", 2014, on what such steps reach).
STRAHL_INLINE std::uint32_t mixed(std::uint32_t hash, std::uint32_t word) {
    hash = (hash ^ word) * 0x9e3779b1u;
    return hash ^ hash >> 15;
}
/// Returns the bits of a number as 32; they are the same at every SIMD level.
template <class T>
STRAHL_INLINE std::uint32_t bits_of(T value) {
    if constexpr (sizeof(T) == sizeof(std::uint32_t)) {
        return std::bit_cast<std::uint32_t>(value);
    } else {
        const auto bits = std::bit_cast<std::uint64_t>(static_cast<double>(value));
        return static_cast<std::uint32_t>(bits) * 0x85ebca6bu + static_cast<std::uint32_t>(bits >> 32);
    }
}

/// Returns a word that differs between reflected and refracted rays: the bits of their weight, in fog only its
/// magnitude, since fog dims rays by degrees.
template <class T>
STRAHL_INLINE std::uint32_t weight_word(const World<T>& world, T weight) {
    return world.fog.any ? static_cast<std::uint32_t>(std::ilogb(weight)) : bits_of(weight);
}

/// Patterns count as visible at hits that weigh more than this many times `Limits::noticed`.
inline constexpr int least_uneven = 4;

/// Adds hits above `Limits::noticed` to the signatures of their samples: surface and side, the surface that the ray
/// comes from, its weight and the number of bounces. The weight tells reflected, refracted and totally reflected rays
/// apart. `materials` has the number of each lane's material where there are patterns.
template <class S, class P>
[[gnu::noinline]] void note_hits(const Shading<S, P>& shading, const Hit<S>& hit, const S& source, const S& t,
                                 int lanes, const int* materials, HitNotes<S, P>& notes) {
    using T = Element<S>;
    alignas(64) T surfaces[width<S>], sides[width<S>], sources[width<S>], weights[width<S>], pixels[width<S>];
    alignas(64) T distances[width<S>], reflected[3][width<S>] = {}, reflections[width<S>] = {};
    store_lanes(surfaces, hit.surface), store_lanes(sides, select(hit.outside, S(1), S(0)));
    store_lanes(sources, source), store_lanes(weights, hit.weight), store_lanes(pixels, hit.pixel);
    store_lanes(distances, t);
    const auto depth = static_cast<std::uint32_t>(shading.depth);
    if (shading.depth == 1) {
        const Vec3<S> direction = reflect(hit);
        for (int c = 0; c < 3; ++c) store_lanes(reflected[c], direction[c]);
        store_lanes(reflections, hit.weight * hit.material.reflection);
    }
    for (int k = 0; k < width<S>; ++k) {
        std::uint32_t word = mixed(depth, bits_of(surfaces[k]));
        word = mixed(word, bits_of(sides[k]));
        word = mixed(word, bits_of(sources[k]));
        notes.words[k] =
            weights[k] > shading.limits.noticed ? mixed(word, weight_word(shading.world, weights[k])) | 1 : 0;
    }
    for (int k = 0; k < lanes; ++k) {
        Sight<T>& sight = shading.batch.sights[static_cast<int>(pixels[k])];
        sight.signature += notes.words[k];
        if (shading.world.patterns.list && weights[k] > least_uneven * shading.limits.noticed &&
            uneven(shading.world, materials[k]))
            sight.uneven = true;
        if (shading.depth == 2) sight.further = std::max(sight.further, distances[k]);
        if (shading.depth != 1) continue;
        sight.distance = distances[k], sight.surface = static_cast<std::int32_t>(surfaces[k]);
        for (int c = 0; c < 3; ++c) sight.reflected[c] = reflected[c][k];
        sight.reflection = reflections[k];
    }
}

/// Adds rays that met nothing to the signatures of their samples.
template <class S, class P>
[[gnu::noinline]] void note_misses(const Shading<S, P>& shading, const S& source, const S& weight, const S& pixel,
                                   int lanes) {
    using T = Element<S>;
    alignas(64) T sources[width<S>], weights[width<S>], pixels[width<S>];
    store_lanes(sources, source), store_lanes(weights, weight), store_lanes(pixels, pixel);
    for (int k = 0; k < lanes; ++k) {
        if (!(weights[k] > shading.limits.noticed)) continue;
        const std::uint32_t word = mixed(~static_cast<std::uint32_t>(shading.depth), bits_of(sources[k]));
        Sight<T>& sight = shading.batch.sights[static_cast<int>(pixels[k])];
        sight.signature += mixed(word, weight_word(shading.world, weights[k]));
        if (shading.depth == 2) sight.further = std::numeric_limits<T>::infinity();
    }
}

/// Adds the share of a light that reaches the hits in the lanes of `lit` to the signatures of their samples: surfaces
/// that face away count as dark, and dark ones add nothing. Adds to `Sight::glint` the light that a highlight of
/// exponent 4 would bring: where that varies, a sharper one may lie between two samples.
template <class S, class P>
[[gnu::noinline]] void note_light(const Shading<S, P>& shading, const Hit<S>& hit, const HitNotes<S, P>& notes,
                                  int number, const Vec3<S>& share, const S& shine, Mask<S> lit) {
    using T = Element<S>;
    alignas(64) T shares[3][width<S>], glints[width<S>], pixels[width<S>];
    for (int c = 0; c < 3; ++c) store_lanes(shares[c], select(lit, share[c], S(0)));
    const S squared = max(shine, S(0)) * max(shine, S(0));
    const S most = S(largest(shading.world.lights[number].color)) * hit.material.specular;
    store_lanes(glints, select(lit, hit.weight * most * squared * squared, S(0)));
    store_lanes(pixels, hit.pixel);
    for (unsigned left = bits(lit); left != 0; left &= left - 1) {
        const int k = std::countr_zero(left);
        if (notes.words[k] == 0) continue;
        std::uint32_t word = mixed(notes.words[k], static_cast<std::uint32_t>(number));
        bool dark = true;
        for (int c = 0; c < 3; ++c) word = mixed(word, bits_of(shares[c][k])), dark = dark && shares[c][k] == 0;
        Sight<T>& sight = shading.batch.sights[static_cast<int>(pixels[k])];
        if (dark) continue;
        sight.signature += word, sight.glint += glints[k];
        if (shading.depth == 1) sight.lit |= 1u << std::min(number, most_lit);
    }
}

}  // namespace strahl::inline STRAHL_LEVEL
