// Methods of intersection with planes and cylinders.
#pragma once
#include "scene/kinds/cylinder.h"
#include "scene/kinds/plane.h"
#include "tests/bench/methods/question.h"

namespace strahl::bench::STRAHL_LEVEL {

// Planes

/// (a - o).n / d.n and o + t d.
template <class S>
Answer<S> point_normal(const Question<S>& q) {
    const S t = dot(q.a - q.o, q.b) / dot(q.d, q.b);
    return along(q, abs(t) < infinite<S>(), t, t);
}
/// n.x = distance, and o + t d.
template <class S>
Answer<S> distance(const Question<S>& q) {
    const Span<S> span = PlaneKernel<S>{q.b, q.h}.span(q.ray(), S(-1));
    return along(q, span.hit, span.near, span.near);
}
/// The engine's method: the same, and the point put back onto the plane.
template <class S>
Answer<S> plane_put_back(const Question<S>& q) {
    const PlaneKernel<S> plane{q.b, q.h};
    Answer<S> answer = distance(q);
    answer.p = plane.at(q.ray(), answer.t, S(-1)).position;
    return answer;
}

// Cylinders

/// b^2 - ac of the endless one, cut by both ends.
template <class S>
Answer<S> cylinder_quadratic(const Question<S>& q) {
    const Vec3<S> f = q.o - q.a;
    const S fa = dot(f, q.b), da = dot(q.d, q.b);
    const Vec3<S> g = fma(-fa, q.b, f), e = fma(-da, q.b, q.d);
    const S a = dot(e, e), b = dot(g, e), c = dot(g, g) - q.r * q.r, k = b * b - a * c, s = sqrt(max(k, S(0)));
    const S low = -fa / da, high = (q.h - fa) / da;
    const S near = max((-b - s) / a, min(low, high)), far = min((s - b) / a, max(low, high));
    return along(q, (k > S(0)) & (near < far), near, far);
}
/// The engine's method: the discriminant from the distance between ray and axis.
template <class S>
Answer<S> cylinder_distance(const Question<S>& q) {
    const CylinderKernel<S> can{q.a, q.b, q.r, q.h};
    const Span<S> span = can.span(q.ray(), S(-1));
    Answer<S> answer = along(q, span.hit, span.near, span.far);
    answer.p = can.at(q.ray(), answer.t, first_face(span)).position;
    return answer;
}

}  // namespace strahl::bench::STRAHL_LEVEL
