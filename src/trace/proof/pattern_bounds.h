// By how much colours of patterns, and normals that reliefs bend, may be off where places are: for proofs, compiled
// once per precision and instruction set, in a file of its own.
#pragma once
#include "num/memory.h"
#include "num/ray.h"
#include "trace/proof/proving_kernel.h"
#include "trace/world/world.h"

namespace strahl::inline STRAHL_LEVEL {

/// By how much the coefficients of hits may be off, in their largest channel.
template <class S>
struct ColorErrors {
    S ambient{0}, diffuse{0};
};

/// By how much normals may be off, in what lanes they are bent, and in which of these that is known.
template <class S>
struct BentBounds {
    S off;
    Mask<S> bent, told;
};

template <class S>
struct PatternBounds {
    using T = Element<S>;
    /// Of materials, known by their numbers, that have the colours of their patterns at these positions, which may be
    /// off by `away`.
    static ColorErrors<S> of_hits(const World<T>& world, const int* materials, const Vec3<S>& position,
                                  const S& surface, const S& away, const Slack<T>& slack);
    /// Of the background in directions that are off by `turn`.
    static S of_sky(const World<T>& world, const Vec3<S>& direction, const S& turn);
    /// Of normals as materials bend these, which are off by `normal_off`.
    static BentBounds<S> of_normals(const World<T>& world, const int* materials, const Vec3<S>& position,
                                    const S& surface, const Vec3<S>& normal, const S& normal_off, const S& away,
                                    const Slack<T>& slack);
    /// Of what a transparent material leaves of light at these positions.
    static S of_filter(const World<T>& world, int material, const Vec3<S>& position, const S& surface, const S& away,
                       const Slack<T>& slack);
};

}  // namespace strahl::inline STRAHL_LEVEL
