// The interface of the light of rectangles: compiled once per precision and SIMD level, apart from the kernel.
#pragma once
#include <cstdint>

#include "num/pack.h"
#include "num/ray.h"
#include "trace/world/world.h"

namespace strahl {
class MediumStacks;
}  // namespace strahl

namespace strahl::inline STRAHL_LEVEL {

/// Tells where shadow rays to a light start: on which body, by its bin, and in which lanes on its outside. Only used if
/// each item has a bin. Of the bodies that can be in the way of this light only those in `only` are tested.
template <class S>
struct Start {
    int light, bin;
    Mask<S> outside;
    BodySet only = ~BodySet(0);
    S medium{0};  // the numbers of medium stacks, in nested worlds in whose bodies light fades
    MediumStacks* mediums = nullptr;
    bool ends_early = false;  // the rays end before the light: how far bodies are from it tells nothing
};

/// Returns the share of light, per channel, that arrives from `distance` away along the ray: opaque bodies between
/// absorb all of it, transparent ones transmit Kt Of at each surface crossed. The factors are always multiplied in the
/// same order: bodies outside the hierarchy by form and as declared, hot forms first, then those inside in the order of
/// its leaves.
template <class S>
using Visibility = Vec3<S> (*)(const World<Element<S>>&, const Ray<S>&, const S& distance, Mask<S> active,
                               const Start<S>&);

/// Hits that a rectangle may light. `flat` is the normal before a bump bends it; `diffuse` is the largest channel of
/// Kd Of or, of lights whose shadows alone are soft, the share of their light that arrives where nothing is in its way.
template <class S>
struct LitHits {
    Mask<S> lanes, outside;
    Vec3<S> position, normal, flat, reflected;
    S surface, weight, diffuse, specular, pow, shines_from;
    int bin;
    S medium{0};  // see Start
    MediumStacks* mediums = nullptr;
};

/// Means over a rectangle, per channel: of S (n.l), of S (h.l)^p, and of S itself where n.l > 0.
template <class S>
struct AreaMeans {
    Vec3<S> diffuse{0}, highlight{0}, share{0};
    std::int64_t rays = 0;  // shadow rays traced
};

template <class S>
struct AreaLightCalls {
    using T = Element<S>;
    /// Finds these means. `error` is what the light of the pixel may be off, as an estimate of the root mean square.
    static AreaMeans<S> means(const World<T>& world, int light, const LitHits<S>& hits, T error,
                              Visibility<S> visibility);
    /// Finds the means of S over the points of a soft light's grid, as POV-Ray takes them. `strength` is the share of
    /// the light that arrives where nothing is in its way.
    static AreaMeans<S> grid_means(const World<T>& world, int light, const LitHits<S>& hits, const S& strength,
                                   Visibility<S> visibility);
};

}  // namespace strahl::inline STRAHL_LEVEL
