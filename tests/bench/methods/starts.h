// Starts: from a point of the sphere one ray is mirrored, which must not meet it, one goes on through the inside.
#pragma once
#include <limits>

#include "scene/kinds/sphere.h"
#include "tests/bench/methods/question.h"

namespace strahl::bench::STRAHL_LEVEL {

template <class S>
struct Start {
    Vec3<S> p, normal, mirrored;
    Mask<S> hit;
};
template <class S>
Start<S> start_of(const Question<S>& q) {
    const SphereKernel<S> sphere{q.a, q.r};
    const Span<S> span = sphere.span(q.ray(), S(-1));
    const auto [p, n] = sphere.at(q.ray(), span.near, S(-1));
    return {p, n, fma(S(-2) * dot(q.d, n), n, q.d), span.hit};
}
/// t is the chord through the inside.
template <class S>
Answer<S> chord(const Start<S>& start, Mask<S> self, Mask<S> found, S t) {
    t = select(found, t, infinite<S>());
    t = select(self, S(-1), t);
    return {select(start.hit, t, infinite<S>()), start.p};
}
template <int digits, class S>
Answer<S> epsilon(const Question<S>& q) {
    Element<S> e = 1;
    for (int i = 0; i < digits; ++i) e /= 10;
    const Start<S> start = start_of(q);
    const SphereKernel<S> sphere{q.a, q.r};
    const Span<S> away = sphere.span(Ray<S>{start.p, start.mirrored, S(-1)}, S(-1));
    const Span<S> on = sphere.span(Ray<S>{start.p, q.d, S(-1)}, S(-1));
    const S t = select(on.near > S(e), on.near, on.far);
    return chord(start, away.hit & (away.far > S(e)), on.hit & (t > S(e)), t);
}
/// The point is moved off the surface by some units in the last place (C. Waechter, N. Binder, "A Fast and Robust
/// Method for Avoiding Self-Intersection", Ray Tracing Gems, 2019), written with multiplications so that lanes can have
/// it.
template <class S>
Answer<S> offset(const Question<S>& q) {
    using T = Element<S>;
    constexpr T near_zero = 128 * std::numeric_limits<T>::epsilon(), ulps = near_zero;
    const Start<S> start = start_of(q);
    const auto moved = [&](S sign) {
        Vec3<S> p = start.p;
        for (int i = 0; i < 3; ++i) {
            const S size = max(abs(p[i]), S(T(1) / 32));
            p[i] = fma(sign * start.normal[i], select(abs(p[i]) < S(T(1) / 32), S(near_zero), S(ulps) * size), p[i]);
        }
        return p;
    };
    const SphereKernel<S> sphere{q.a, q.r};
    const Span<S> away = sphere.span(Ray<S>{moved(S(1)), start.mirrored, S(-1)}, S(-1));
    const Span<S> on = sphere.span(Ray<S>{moved(S(-1)), q.d, S(-1)}, S(-1));
    const S t = select(on.near > S(0), on.near, on.far);
    return chord(start, away.hit & (away.far > S(0)), on.hit & (t > S(0)), t);
}
/// The engine's method: the root at the start is known and divided out.
template <class S>
Answer<S> divided_out(const Question<S>& q) {
    const Start<S> start = start_of(q);
    const SphereKernel<S> sphere{q.a, q.r};
    const Span<S> away = sphere.span(Ray<S>{start.p, start.mirrored, S(0)}, S(0));
    const Span<S> on = sphere.span(Ray<S>{start.p, q.d, S(0)}, S(0));
    return chord(start, away.hit & ((away.near > S(0)) | (away.far > S(0))), on.hit & (on.far > S(0)), on.far);
}

}  // namespace strahl::bench::STRAHL_LEVEL
