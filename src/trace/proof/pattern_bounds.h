// Error bounds of patterns' colours and of normals that reliefs bend, at places that are off: for proofs, compiled once
// per precision and SIMD level, apart from the kernel.
#pragma once
#include "num/memory.h"
#include "num/ray.h"
#include "trace/proof/proving_kernel.h"
#include "trace/world/world.h"

namespace strahl::inline STRAHL_LEVEL {

/// Error bounds of hits' coefficients, in their largest channel.
template <class S>
struct ColorErrors {
    S ambient{0}, diffuse{0}, color{0};  // color: of the pattern itself
};

/// Error bounds of normals, with the lanes in which they are bent, and those of these in which a bound is known.
template <class S>
struct BentBounds {
    S off;
    Mask<S> bent, told;
};

template <class S>
struct PatternBounds {
    using T = Element<S>;
    /// Bounds the errors of materials, known by their numbers, that have the colours of their patterns at these
    /// positions, which may be off by `away`.
    static ColorErrors<S> of_hits(const World<T>& world, const int* materials, const Vec3<S>& position,
                                  const S& surface, const S& away, const Slack<T>& slack);
    /// Bounds the error of the background in directions that are off by `turn`.
    static S of_sky(const World<T>& world, const Vec3<S>& direction, const S& turn);
    /// Bounds the errors of normals that materials bend; unbent they are off by `normal_off`.
    static BentBounds<S> of_normals(const World<T>& world, const int* materials, const Vec3<S>& position,
                                    const S& surface, const Vec3<S>& normal, const S& normal_off, const S& away,
                                    const Slack<T>& slack);
    /// Bounds the error of the light that a transparent material transmits at these positions.
    static S of_filter(const World<T>& world, int material, const Vec3<S>& position, const S& surface, const S& away,
                       const Slack<T>& slack);
};

}  // namespace strahl::inline STRAHL_LEVEL
