// Rays, and the stretch of a ray that lies inside a convex body.
#pragma once
#include "num/lanes.h"

namespace strahl {

/// `direction` has length 1. `source` is the number of the surface that the ray starts on, or -1: that surface's own
/// root is known to be t = 0 and is divided out instead of being kept away by an epsilon.
template <class S>
struct Ray {
    Vec3<S> origin, direction;
    S source;
};

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
