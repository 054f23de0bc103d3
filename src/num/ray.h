// Rays, and the stretch of a ray that lies inside a convex body.
#pragma once
#include "num/lanes.h"

namespace strahl {

/// `direction` has length 1. `source` is the number of the surface that the ray starts on, or -1: that surface's own
/// root is known to be t = 0 and is divided out, instead of being kept away by an epsilon.
template <class S>
struct Ray {
    Vec3<S> origin, direction;
    S source;
};

// Every kernel of a shape answers two questions, with `start` the number of its own face (0, 1, ...) on which the ray
// starts, or any other number if it starts elsewhere:
//     Span<S> span(const Ray<S>& ray, S start)                    where does the ray cross the body?
//     SurfacePoint<S> at(const Ray<S>& ray, S t, S start)         what is there, at its first crossing t?

/// Where a ray's line enters and leaves a convex body: near <= far where `hit`. A crossing counts if its t > 0. A
/// crossing at the ray's own source is exactly 0, and so never counts.
template <class S>
struct Span {
    S near, far;
    Mask<S> hit;
};

/// A point of a surface: where, which way the surface faces (unit, out of the body), and which of the body's faces.
template <class S>
struct SurfacePoint {
    Vec3<S> position, normal;
    S face;
};

}  // namespace strahl
