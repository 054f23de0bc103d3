// The light of rectangles: compiled once per precision and SIMD level, apart from the kernel.
#pragma once
#include <cstdint>

#include "num/pack.h"
#include "num/ray.h"
#include "trace/world/world.h"

namespace strahl::inline STRAHL_LEVEL {

/// Where shadow rays to a light start: on which body, by its bin, and whether on its outside. Only where there is a bin
/// for each item. Of the bodies that can be in the way of this light, only these are.
template <class S>
struct Start {
    int light, bin;
    Mask<S> outside;
    BodySet only = ~BodySet(0);
};

/// The share of light, per channel, that comes from `distance` away along the ray: opaque bodies between take all of
/// it, transparent ones Kt Of at each surface crossed. These are multiplied in one order for good: bodies outside the
/// hierarchy by form and as declared, hot forms first, then those inside in the order of its leaves.
template <class S>
using Visibility = Vec3<S> (*)(const World<Element<S>>&, const Ray<S>&, const S& distance, Mask<S> active,
                               const Start<S>&);

/// Hits that a rectangle may shine on. `flat` is the normal that a bump does not bend; `diffuse` is the largest channel
/// of Kd Of.
template <class S>
struct LitHits {
    Mask<S> lanes, outside;
    Vec3<S> position, normal, flat, reflected;
    S surface, weight, diffuse, specular, pow, shines_from;
    int bin;
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
    /// `error`: by how much the light that the pixel gets may be off, as an estimate of the root mean square.
    static AreaMeans<S> means(const World<T>& world, int light, const LitHits<S>& hits, T error,
                              Visibility<S> visibility);
};

}  // namespace strahl::inline STRAHL_LEVEL
