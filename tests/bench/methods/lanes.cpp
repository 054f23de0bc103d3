// The methods themselves, for one number or a pack of lanes: compiled once per instruction set.
#include <limits>

#include "num/memory.h"
#include "scene/cylinder.h"
#include "scene/plane.h"
#include "scene/sphere.h"
#include "tests/bench/methods/methods.h"

namespace strahl::bench::STRAHL_LEVEL {
namespace {

/// A pack of rays with their bodies.
template <class S>
struct Question {
    Vec3<S> o, d, a, b;
    S r, h;
    Ray<S> ray() const { return {o, d, S(-1)}; }
};
template <class S>
struct Answer {
    S t;
    Vec3<S> p;
};
template <class S>
const S infinite{std::numeric_limits<Element<S>>::infinity()};

template <class S>
Answer<S> along(const Question<S>& q, Mask<S> hit, S near, S far) {
    const S t = select(hit & (far > S(0)), select(near > S(0), near, far), infinite<S>);
    return {t, fma(t, q.d, q.o)};
}

// Spheres

/// b^2 - 4ac as the article has it.
struct Quadratic {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
        const Vec3<S> f = q.o - q.a;
        const S a = dot(q.d, q.d), b = S(2) * dot(f, q.d), c = dot(f, f) - q.r * q.r, e = b * b - S(4) * a * c;
        const S s = sqrt(max(e, S(0))), half = S(Element<S>(.5)) / a;
        return along(q, e > S(0), (-b - s) * half, (s - b) * half);
    }
};
/// The same discriminant; the smaller root from the product of both.
struct StableQuadratic {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
        const Vec3<S> f = q.o - q.a;
        const S a = dot(q.d, q.d), b = dot(f, q.d), c = dot(f, f) - q.r * q.r, e = b * b - a * c;
        const S s = sqrt(max(e, S(0))), w = select(b > S(0), -b - s, s - b), x = w / a, y = c / w;
        return along(q, e > S(0), min(x, y), max(x, y));
    }
};
/// Closest approach and half the chord.
struct Projection {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
        const SphereKernel<S> sphere{q.a, q.r};
        const Span<S> span = sphere.span(q.ray(), S(-1));
        return along(q, span.hit, span.near, span.far);
    }
};
/// r^2 - l^2 as a product (pbrt-v4).
struct Factored {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
        const Vec3<S> f = q.a - q.o;
        const S b = dot(f, q.d);
        const Vec3<S> l = fma(-b, q.d, f);
        const S m = sqrt(dot(l, l)), e = (q.r - m) * (q.r + m), s = sqrt(max(e, S(0)));
        return along(q, e > S(0), b - s, b + s);
    }
};
/// Projection, and the smaller root from c = f^2 - r^2 with the rounding errors of all products added at the end.
struct Compensated {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
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
};
/// What the engine does: projection, and the point put back onto the sphere.
struct PutBack {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
        const SphereKernel<S> sphere{q.a, q.r};
        const Span<S> span = sphere.span(q.ray(), S(-1));
        Answer<S> answer = along(q, span.hit, span.near, span.far);
        answer.p = sphere.at(q.ray(), answer.t, S(-1)).position;
        return answer;
    }
};

// Starts: from a point of the sphere one ray is mirrored, which must not meet it, one goes on through the inside.

template <class S>
struct Start {
    Vec3<S> p, normal, mirrored;
    Mask<S> hit;
};
template <class S>
Start<S> start_of(const Question<S>& q) {
    const SphereKernel<S> sphere{q.a, q.r};
    const Span<S> span = sphere.span(q.ray(), S(-1));
    const auto [p, n, face] = sphere.at(q.ray(), span.near, S(-1));
    return {p, n, fma(S(-2) * dot(q.d, n), n, q.d), span.hit};
}
/// t is the chord through the inside.
template <class S>
Answer<S> chord(const Question<S>& q, const Start<S>& start, Mask<S> self, Mask<S> found, S t) {
    t = select(found, t, infinite<S>);
    t = select(self, S(-1), t);
    return {select(start.hit, t, infinite<S>), start.p};
}
template <int digits>
struct Epsilon {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
        Element<S> e = 1;
        for (int i = 0; i < digits; ++i) e /= 10;
        const Start<S> start = start_of(q);
        const SphereKernel<S> sphere{q.a, q.r};
        const Span<S> away = sphere.span(Ray<S>{start.p, start.mirrored, S(-1)}, S(-1));
        const Span<S> on = sphere.span(Ray<S>{start.p, q.d, S(-1)}, S(-1));
        const S t = select(on.near > S(e), on.near, on.far);
        return chord(q, start, away.hit & (away.far > S(e)), on.hit & (t > S(e)), t);
    }
};
/// The point is moved off the surface by some units in the last place (C. Waechter, N. Binder, "A Fast and Robust
/// Method for Avoiding Self-Intersection", Ray Tracing Gems, 2019), written with multiplications so that lanes can have
/// it.
struct Offset {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
        using T = Element<S>;
        constexpr T near_zero = 128 * std::numeric_limits<T>::epsilon(), ulps = near_zero;
        const Start<S> start = start_of(q);
        const auto moved = [&](S sign) {
            Vec3<S> p = start.p;
            for (int i = 0; i < 3; ++i) {
                const S size = max(abs(p[i]), S(T(1) / 32));
                p[i] =
                    fma(sign * start.normal[i], select(abs(p[i]) < S(T(1) / 32), S(near_zero), S(ulps) * size), p[i]);
            }
            return p;
        };
        const SphereKernel<S> sphere{q.a, q.r};
        const Span<S> away = sphere.span(Ray<S>{moved(S(1)), start.mirrored, S(-1)}, S(-1));
        const Span<S> on = sphere.span(Ray<S>{moved(S(-1)), q.d, S(-1)}, S(-1));
        const S t = select(on.near > S(0), on.near, on.far);
        return chord(q, start, away.hit & (away.far > S(0)), on.hit & (t > S(0)), t);
    }
};
/// What the engine does: the root at the start is known, and divided out.
struct DividedOut {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
        const Start<S> start = start_of(q);
        const SphereKernel<S> sphere{q.a, q.r};
        const Span<S> away = sphere.span(Ray<S>{start.p, start.mirrored, S(0)}, S(0));
        const Span<S> on = sphere.span(Ray<S>{start.p, q.d, S(0)}, S(0));
        return chord(q, start, away.hit & ((away.near > S(0)) | (away.far > S(0))), on.hit & (on.far > S(0)), on.far);
    }
};

// Planes

/// (a - o).n / d.n and o + t d.
struct PointNormal {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
        const S t = dot(q.a - q.o, q.b) / dot(q.d, q.b);
        return along(q, abs(t) < infinite<S>, t, t);
    }
};
/// n.x = distance, and o + t d.
struct Distance {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
        const Span<S> span = PlaneKernel<S>{q.b, q.h}.span(q.ray(), S(-1));
        return along(q, span.hit, span.near, span.near);
    }
};
/// What the engine does: the same, put back.
struct PlanePutBack {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
        const PlaneKernel<S> plane{q.b, q.h};
        Answer<S> answer = Distance::of(q);
        answer.p = plane.at(q.ray(), answer.t, S(-1)).position;
        return answer;
    }
};

// Cylinders

/// b^2 - ac of the endless one, cut by both ends.
struct CylinderQuadratic {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
        const Vec3<S> f = q.o - q.a;
        const S fa = dot(f, q.b), da = dot(q.d, q.b);
        const Vec3<S> g = fma(-fa, q.b, f), e = fma(-da, q.b, q.d);
        const S a = dot(e, e), b = dot(g, e), c = dot(g, g) - q.r * q.r, k = b * b - a * c, s = sqrt(max(k, S(0)));
        const S low = -fa / da, high = (q.h - fa) / da;
        const S near = max((-b - s) / a, min(low, high)), far = min((s - b) / a, max(low, high));
        return along(q, (k > S(0)) & (near < far), near, far);
    }
};
/// What the engine does: the discriminant from the distance between ray and axis.
struct CylinderDistance {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
        const CylinderKernel<S> can{q.a, q.b, q.r, q.h};
        const Span<S> span = can.span(q.ray(), S(-1));
        Answer<S> answer = along(q, span.hit, span.near, span.far);
        answer.p = can.at(q.ray(), answer.t, S(-1)).position;
        return answer;
    }
};

// Boxes: a ray that crosses must never be told that it does not

/// Ends ordered by the sign of the direction.
struct Ordered {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
        S near(0), far = infinite<S>;
        for (int i = 0; i < 3; ++i) {
            const S inverse = S(1) / q.d[i], a = (q.a[i] - q.o[i]) * inverse, b = (q.b[i] - q.o[i]) * inverse;
            const Mask<S> up = q.d[i] >= S(0);
            near = max(near, select(up, a, b)), far = min(far, select(up, b, a));
        }
        return {select(near <= far, near, infinite<S>), q.o};
    }
};
/// Ends ordered by minimum and maximum.
struct Sorted {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
        S near(0), far = infinite<S>;
        for (int i = 0; i < 3; ++i) {
            const S inverse = S(1) / q.d[i], a = (q.a[i] - q.o[i]) * inverse, b = (q.b[i] - q.o[i]) * inverse;
            near = max(near, min(a, b)), far = min(far, max(a, b));
        }
        return {select(near <= far, near, infinite<S>), q.o};
    }
};
/// What the engine does: finite reciprocals, a box grown by some units in the last place of its coordinates, and far
/// ends a little farther (T. Ize, "Robust BVH Ray Traversal", 2013). In a hierarchy boxes grow once, when built.
struct Grown {
    template <class S>
    static Answer<S> of(const Question<S>& q) {
        using T = Element<S>;
        constexpr T tiny = T(1) / (std::uint64_t(1) << 60), epsilon = std::numeric_limits<T>::epsilon();
        S near(0), far = infinite<S>;
        for (int i = 0; i < 3; ++i) {
            const S d = q.d[i], inverse = S(1) / select(abs(d) < S(tiny), select(d < S(0), S(-tiny), S(tiny)), d);
            const S a = (q.a[i] - q.h - q.o[i]) * inverse, b = (q.b[i] + q.h - q.o[i]) * inverse;
            near = max(near, min(a, b)), far = min(far, max(a, b) * S(1 + 4 * epsilon));
        }
        return {select(near <= far, near, infinite<S>), q.o};
    }
};

template <class S, class M>
void run(const Rays<Element<S>>& rays, Answers<Element<S>>& answers) {
    for (std::size_t i = 0; i < rays.size(); i += width<S>) {
        const auto v = [&](int c) { return load_lanes<S>(rays.column[c].data() + i); };
        const Question<S> q{
            {v(0), v(1), v(2)}, {v(3), v(4), v(5)}, {v(6), v(7), v(8)}, {v(9), v(10), v(11)}, v(12), v(13)};
        const Answer<S> answer = M::of(q);
        store_lanes(answers.t.data() + i, answer.t);
        store_lanes(answers.x.data() + i, answer.p.x), store_lanes(answers.y.data() + i, answer.p.y);
        store_lanes(answers.z.data() + i, answer.p.z);
    }
}

template <class S>
std::vector<Method<Element<S>>> all() {
    constexpr int n = width<S>;
    return {{"sphere", "b^2-4ac", n, false, run<S, Quadratic>},
            {"sphere", "stable roots", n, false, run<S, StableQuadratic>},
            {"sphere", "compensated", n, false, run<S, Compensated>},
            {"sphere", "factored", n, false, run<S, Factored>},
            {"sphere", "projection", n, false, run<S, Projection>},
            {"sphere", "projection, put back", n, true, run<S, PutBack>},
            {"start", "epsilon 1e-6", n, false, run<S, Epsilon<6>>},
            {"start", "epsilon 1e-4", n, false, run<S, Epsilon<4>>},
            {"start", "epsilon 1e-2", n, false, run<S, Epsilon<2>>},
            {"start", "offset by ulps", n, false, run<S, Offset>},
            {"start", "divided out", n, true, run<S, DividedOut>},
            {"plane", "point and normal", n, false, run<S, PointNormal>},
            {"plane", "distance", n, false, run<S, Distance>},
            {"plane", "distance, put back", n, true, run<S, PlanePutBack>},
            {"cylinder", "b^2-ac", n, false, run<S, CylinderQuadratic>},
            {"cylinder", "distance of lines", n, true, run<S, CylinderDistance>},
            {"box", "by sign of d", n, false, run<S, Ordered>},
            {"box", "by min and max", n, false, run<S, Sorted>},
            {"box", "grown, 1/d finite", n, true, run<S, Grown>}};
}
template <class T>
using Widest =
#ifdef STRAHL_SCALAR
    T;
#else
    Pack<T>;
#endif

}  // namespace

std::vector<Method<float>> methods_float() { return all<Widest<float>>(); }
std::vector<Method<double>> methods_double() { return all<Widest<double>>(); }
#ifdef STRAHL_SCALAR
std::vector<Method<long double>> methods_extended() { return all<long double>(); }
#endif

}  // namespace strahl::bench::STRAHL_LEVEL
