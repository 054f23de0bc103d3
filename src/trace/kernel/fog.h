// Attenuation of rays by fog.
#pragma once
#include <algorithm>
#include <cmath>

#include "num/memory.h"
#include "num/noise_lanes.h"
#include "trace/kernel/shading.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns the mean density of ground fog between two heights: of 1 / (1 + h^2) above 0, and of 1 below.
template <class T>
T fog_density(T a, T b) {
    const T low = std::min(a, b), high = std::max(a, b);
    if (!(high > 0)) return 1;
    if (low <= 0) return (std::atan(high) - low) / (high - low);
    // The difference of two arctangents is one itself.
    const T rise = high - low;
    return rise > 0 ? std::atan(rise / (1 + low * high)) / rise : 1 / (1 + low * low);
}

/// Returns the medium stacks of rays, and 0 for those in hollow bodies only: there is fog in these.
template <class S, class P>
STRAHL_INLINE S medium_in_fog(const Shading<S, P>& shading, const S& medium) {
    using T = Element<S>;
    const std::uint8_t* const hollow = shading.world.media.hollow;
    if (!hollow || !shading.world.nested) return medium;
    alignas(64) T stacks[width<S>];
    store_lanes(stacks, medium);
    const MediumStacks& all = mediums(shading.workspace);
    for (T& stack : stacks)
        if (all_hollow(all, static_cast<int>(stack), hollow)) stack = 0;
    return load_lanes<S>(stacks);
}

/// Finds the noise of patchy fog halfway along rays, where it shortens the way, the less the longer it is.
template <class S>
void turbulence_of_fog(const FogKernel<Element<S>>& fog, const Vec3<S>& middle, double* noise) {
    using D = Widest<double>;
    DVec3 points[width<S>];
    for (int k = 0; k < width<S>; ++k) {
        const DVec3 at(double(lane(middle.x, k)), double(lane(middle.y, k)), double(lane(middle.z, k)));
        points[k] = (fog.place + fog.unit * at) * fog.turbulence;
    }
    each_pack<D>(points, width<S>, [&](const Vec3<D>& p, int first, int number) {
        alignas(64) double own[width<D>];
        store_lanes(own, lattice_turbulence(p, fog.octaves, fog.omega, fog.lambda, fog.generator));
        std::copy_n(own, number, noise + first);
    });
}

/// Returns the weights that fog leaves to rays after a distance `t`: weight * exp(-t * density / the fog's distance).
/// In nested worlds only rays outside all transparent bodies (medium 0) are dimmed. The fog's own light gets the weight
/// that they lose.
template <class S>
[[gnu::noinline]] S left_by_fog(const World<Element<S>>& world, const S& weight, const S& medium, const Vec3<S>& origin,
                                const Vec3<S>& direction, const S& t) {
    using T = Element<S>;
    alignas(64) T share[width<S>], from[width<S>], to[width<S>];
    store_lanes(share, t * S(-world.fog.per));
    if (!world.fog.even) {
        const Vec3<S> rise = splat<S>(world.fog.rise);
        const S start = dot(rise, origin) + S(world.fog.base);
        store_lanes(from, start), store_lanes(to, fma(t, dot(rise, direction), start));
        double noise[width<S>] = {};
        if (world.fog.swirls) turbulence_of_fog(world.fog, fma(S(T(.5)) * t, direction, origin), noise);
        for (int k = 0; k < width<S>; ++k) {
            const double even = std::exp(double(share[k]));
            share[k] *= fog_density(from[k], to[k]);
            if (world.fog.swirls && even > 0)
                share[k] *= static_cast<T>(1 - even * std::min(1., noise[k] * world.fog.depth));
        }
    }
    for (auto& value : share) value = std::exp(value);
    S left = load_lanes<S>(share);
    if (!world.fog.even) left = max(left, S(world.fog.least));
    left = weight * left;
    return world.nested ? select(medium == S(0), left, weight) : left;
}

/// Returns the factors of light that is seen through fog with a filter.
template <class S>
STRAHL_INLINE Vec3<S> tint_of_fog(const World<Element<S>>& world, const S& medium) {
    const Vec3<S> tint = splat<S>(world.fog.tint);
    return world.nested ? select(medium == S(0), tint, splat<S>(Vec3<Element<S>>(1))) : tint;
}

}  // namespace strahl::inline STRAHL_LEVEL
