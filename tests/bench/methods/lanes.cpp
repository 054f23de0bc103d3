// The list of the methods, for one number or a pack of lanes: compiled once per instruction set.
#include "num/memory.h"
#include "tests/bench/methods/boxes.h"
#include "tests/bench/methods/methods.h"
#include "tests/bench/methods/planes_and_cylinders.h"
#include "tests/bench/methods/spheres.h"
#include "tests/bench/methods/starts.h"

namespace strahl::bench::STRAHL_LEVEL {
namespace {

template <class S, Answer<S> (*method)(const Question<S>&)>
void run(const Rays<Element<S>>& rays, Answers<Element<S>>& answers) {
    for (std::size_t i = 0; i < rays.size(); i += width<S>) {
        const auto v = [&](int c) { return load_lanes<S>(rays.column[c].data() + i); };
        const Question<S> q{
            {v(0), v(1), v(2)}, {v(3), v(4), v(5)}, {v(6), v(7), v(8)}, {v(9), v(10), v(11)}, v(12), v(13)};
        const Answer<S> answer = method(q);
        store_lanes(answers.t.data() + i, answer.t);
        store_lanes(answers.x.data() + i, answer.p.x), store_lanes(answers.y.data() + i, answer.p.y);
        store_lanes(answers.z.data() + i, answer.p.z);
    }
}

template <class S>
std::vector<Method<Element<S>>> all() {
    constexpr int n = width<S>;
    return {{"sphere", "b^2-4ac", n, false, run<S, quadratic<S>>},
            {"sphere", "stable roots", n, false, run<S, stable_quadratic<S>>},
            {"sphere", "compensated", n, false, run<S, compensated<S>>},
            {"sphere", "factored", n, false, run<S, factored<S>>},
            {"sphere", "projection", n, false, run<S, projection<S>>},
            {"sphere", "projection, put back", n, true, run<S, put_back<S>>},
            {"start", "epsilon 1e-6", n, false, run<S, epsilon<6, S>>},
            {"start", "epsilon 1e-4", n, false, run<S, epsilon<4, S>>},
            {"start", "epsilon 1e-2", n, false, run<S, epsilon<2, S>>},
            {"start", "offset by ulps", n, false, run<S, offset<S>>},
            {"start", "divided out", n, true, run<S, divided_out<S>>},
            {"plane", "point and normal", n, false, run<S, point_normal<S>>},
            {"plane", "distance", n, false, run<S, distance<S>>},
            {"plane", "distance, put back", n, true, run<S, plane_put_back<S>>},
            {"cylinder", "b^2-ac", n, false, run<S, cylinder_quadratic<S>>},
            {"cylinder", "distance of lines", n, true, run<S, cylinder_distance<S>>},
            {"box", "by sign of d", n, false, run<S, ordered<S>>},
            {"box", "by min and max", n, false, run<S, sorted<S>>},
            {"box", "grown, 1/d finite", n, true, run<S, grown<S>>}};
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
