// Methods of intersection with spheres.
#pragma once
#include "scene/kinds/sphere.h"
#include "tests/bench/methods/question.h"

namespace strahl::bench::STRAHL_LEVEL {

/// b^2 - 4ac as the article has it.
template <class S>
Answer<S> quadratic(const Question<S>& q) {
    const Vec3<S> f = q.o - q.a;
    const S a = dot(q.d, q.d), b = S(2) * dot(f, q.d), c = dot(f, f) - q.r * q.r, e = b * b - S(4) * a * c;
    const S s = sqrt(max(e, S(0))), half = S(Element<S>(.5)) / a;
    return along(q, e > S(0), (-b - s) * half, (s - b) * half);
}
/// The same discriminant, but the smaller root is computed from the product of both.
template <class S>
Answer<S> stable_quadratic(const Question<S>& q) {
    const Vec3<S> f = q.o - q.a;
    const S a = dot(q.d, q.d), b = dot(f, q.d), c = dot(f, f) - q.r * q.r, e = b * b - a * c;
    const S s = sqrt(max(e, S(0))), w = select(b > S(0), -b - s, s - b), x = w / a, y = c / w;
    return along(q, e > S(0), min(x, y), max(x, y));
}
/// Closest approach and half the chord.
template <class S>
Answer<S> projection(const Question<S>& q) {
    const SphereKernel<S> sphere{q.a, q.r};
    const Span<S> span = sphere.span(q.ray(), S(-1));
    return along(q, span.hit, span.near, span.far);
}
/// r^2 - l^2 as a product (pbrt-v4).
template <class S>
Answer<S> factored(const Question<S>& q) {
    const Vec3<S> f = q.a - q.o;
    const S b = dot(f, q.d);
    const Vec3<S> l = fma(-b, q.d, f);
    const S m = sqrt(dot(l, l)), e = (q.r - m) * (q.r + m), s = sqrt(max(e, S(0)));
    return along(q, e > S(0), b - s, b + s);
}
/// Projection, and the smaller root from c = f^2 - r^2 with the rounding errors of all products added at the end.
template <class S>
Answer<S> compensated(const Question<S>& q) {
    const Vec3<S> f = q.a - q.o;
    const S b = dot(f, q.d);
    const Vec3<S> l = fma(-b, q.d, f);
    S sum(0), rest(0);
    const auto add = [&](S x, S y) {
        const S p = x * y, error = fma(x, y, -p), total = sum + p, part = total - sum;
        rest += (sum - (total - part)) + (p - part) + error;
        sum = total;
    };
    add(f.x, f.x), add(-q.r, q.r), add(f.y, f.y), add(f.z, f.z);
    const S e = fma(q.r, q.r, -dot(l, l)), s = sqrt(max(e, S(0)));
    const S w = select(b > S(0), b + s, b - s), other = (sum + rest) / w;
    return along(q, e > S(0), min(w, other), max(w, other));
}
/// The engine's method: projection, and the point put back onto the sphere.
template <class S>
Answer<S> put_back(const Question<S>& q) {
    Answer<S> answer = projection(q);
    answer.p = SphereKernel<S>{q.a, q.r}.at(q.ray(), answer.t, S(0)).position;
    return answer;
}

}  // namespace strahl::bench::STRAHL_LEVEL
