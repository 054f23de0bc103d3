// The list of the methods, for one number or a pack of lanes: compiled once per instruction set.
#include "num/memory.h"
#include "tests/bench/methods/boxes.h"
#include "tests/bench/methods/methods.h"
#include "tests/bench/methods/planes_and_cylinders.h"
#include "tests/bench/methods/spheres.h"
#include "tests/bench/methods/starts.h"

namespace strahl::bench::STRAHL_LEVEL {
namespace {

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
