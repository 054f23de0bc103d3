// Rays, and the part of a ray that lies inside a convex body.
#pragma once
#include "num/lanes.h"

namespace strahl {

/// `direction` has length 1. `source` is the number of the surface that the ray starts on, or -1. That surface is known
/// to be hit at t = 0; this root is divided out, so that no epsilon is needed.
template <class S>
struct Ray {
    Vec3<S> origin, direction;
    S source;
};

// The kernel of every kind has two functions. `start` is the number of the face (0, 1, ...) on which the ray starts, or
// any other number if it starts elsewhere.
//     Span<S> span(const Ray<S>& ray, S start)                    where the ray crosses the body
//     SurfacePoint<S> at(const Ray<S>& ray, S t, S face)          the surface where it crosses this face, at t

/// Where the line of a ray enters and leaves a convex body: near <= far where `hit`. A crossing counts if its t > 0. A
/// crossing at the ray's own source is exactly 0 and never counts.
template <class S>
struct Span {
    S near, far;
    Mask<S> hit;
    S near_face{0}, far_face{0};
};
/// The first crossing ahead, and its face; what is behind is not above 0.
template <class S>
STRAHL_INLINE S first_crossing(const Span<S>& span) {
    return select(span.near > S(0), span.near, span.far);
}
template <class S>
STRAHL_INLINE S first_face(const Span<S>& span) {
    return select(span.near > S(0), span.near_face, span.far_face);
}

/// A point of a surface, and the unit normal out of the body there.
template <class S>
struct SurfacePoint {
    Vec3<S> position, normal;
};

}  // namespace strahl
