// Rays and their crossings with a body.
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
//     Span<S> span(const Ray<S>& ray, S start)                    finds the ray's crossings with a convex body
//     Crossings<S, N> crossings(const Ray<S>& ray, S start)       finds those with a body that is not convex
//     SurfacePoint<S> at(const Ray<S>& ray, S t, S face)          returns the surface at the crossing t with a face

/// Returns the mask of all lanes.
template <class S>
STRAHL_INLINE Mask<S> all_lanes() {
    return S(0) < S(1);
}
/// Returns where rays cross a shape; they may be missing outside of `lanes`. Shapes that take long look only there.
template <class Shape, class S>
STRAHL_INLINE auto crossings_in(const Shape& shape, const Ray<S>& ray, S start, Mask<S> lanes) {
    if constexpr (requires { shape.span(ray, start, lanes); })
        return shape.span(ray, start, lanes);
    else if constexpr (requires { shape.span(ray, start); })
        return shape.span(ray, start);
    else if constexpr (requires { shape.crossings(ray, start, lanes); })
        return shape.crossings(ray, start, lanes);
    else
        return shape.crossings(ray, start);
}

/// The part of a ray's line inside a convex body: near <= far where `hit`. A crossing counts if its t > 0. A
/// crossing at the ray's own source is exactly 0 and never counts.
template <class S>
struct Span {
    S near, far;
    Mask<S> hit;
    S near_face{0}, far_face{0};
};
/// Return the first crossing ahead and its face. If all crossings are behind the start, it is not above 0.
template <class S>
STRAHL_INLINE S first_crossing(const Span<S>& span) {
    return select(span.near > S(0), span.near, span.far);
}
template <class S>
STRAHL_INLINE S first_face(const Span<S>& span) {
    return select(span.near > S(0), span.near_face, span.far_face);
}

/// The crossings of a ray's line with a body of one face that is not convex: ascending; if there are fewer than N, the
/// first ones are -infinity. They count as those of a span do. Those behind the start may have any values below 0.
template <class S, int N>
struct Crossings {
    S t[N];
    Mask<S> hit;
};
template <class S, int N>
STRAHL_INLINE S first_crossing(const Crossings<S, N>& crossings) {
    S t = crossings.t[N - 1];
    for (int i = N - 2; i >= 0; --i) t = select(crossings.t[i] > S(0), crossings.t[i], t);
    return t;
}

/// A point of a surface, and the unit normal out of the body there.
template <class S>
struct SurfacePoint {
    Vec3<S> position, normal;
};

}  // namespace strahl
