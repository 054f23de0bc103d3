// Tori: a ray that is known from elsewhere, thin and spindle-shaped ones, from afar, and rays that start on them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "scene/torus.h"
#include "tests/stability/naive.h"
#include "tests/stability/stage.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

template <class T>
Vec3<T> unit(const Vec3<T>& v) {
    return v / naive::length(v);
}
/// How far p is outside of the torus, in 64 bits.
template <class T>
long double outside(const TorusKernel<T>& torus, const DVec3& p) {
    using L = long double;
    const Vec3<L> f = naive::to<L>(p) - naive::to<L>(torus.centre), a = unit(naive::to<L>(torus.axis));
    const L z = naive::times(f, a), rho = naive::length(f - a * z) - L(torus.major);
    return std::sqrt(rho * rho + z * z) - L(torus.minor);
}
template <class T>
TorusKernel<T> random_torus(Dice& dice) {
    const double major = std::exp(dice(-1, 1)), kind = dice(0, 3);
    const double minor = major * (kind < 1 ? dice(.05, 1) : kind < 2 ? 2e-3 : dice(1, 2));
    return {naive::to<T>(dice.direction()), naive::to<T>(dice.direction()), T(major), T(minor)};
}

}  // namespace

TEST_CASE("the crossing of a ray that passes many a solver by") {
    const TorusKernel<double> torus{{0, 0, 0}, {0, 0, 1}, 143, 113.2};
    const Ray<double> ray{{160.37125, -6.351337, -.000241}, unit(DVec3(.852793, -.522249, -.00002)), -1};
    const Crossings<double, 4> found = torus.crossings(ray, -1.);
    CHECK(found.hit);
    CHECK(found.t[3] == doctest::Approx(103.849237).epsilon(1e-9));
}

TEST_CASE("crossings are on the torus, ascending, and between them is its inside") {
    Dice dice;
    int hits = 0, fours = 0, off = 0, disorder = 0, misplaced = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto check = [&]<class T>(T) {
            const TorusKernel<T> torus = random_torus<T>(dice);
            const DVec3 c = naive::to<double>(torus.centre), aim = c + dice.direction() * double(torus.major);
            const DVec3 from = aim + dice.direction() * std::pow(10, dice(0, 3));
            const Ray<T> ray{naive::to<T>(from), naive::to<T>(unit(aim - from)), T(-1)};
            const Crossings<T, 4> found = torus.crossings(ray, T(-1));
            const DVec3 o = naive::to<double>(ray.origin), d = naive::to<double>(ray.direction);
            const double unsure = 16 * double(std::numeric_limits<T>::epsilon()) * (naive::length(from) + 4);
            hits += found.hit;
            bool inside = false;
            double before = -1e9;
            for (const T crossing : found.t) {
                if (!found.hit || crossing < T(-1e30)) continue;
                const double t = crossing, middle = before < -1e8 ? t - 1 : (before + t) / 2;
                off += std::abs(outside(torus, o + d * t)) > unsure;
                disorder += t < before;
                misplaced +=
                    inside ? outside(torus, o + d * middle) > unsure : outside(torus, o + d * middle) < -unsure;
                inside = !inside, before = t;
            }
            fours += found.hit && found.t[0] > T(-1e30);
            // Nothing is passed by: no point of the ray is deep inside where no crossings say so.
            for (int k = 0; k < 50 && !found.hit; ++k) {
                const DVec3 p = o + d * (naive::times(c - o, d) + dice(-6, 6));
                misplaced += outside(torus, p) < -unsure;
            }
        };
        check(1.f), check(1.);
    }
    MESSAGE(hits << " of 40000 rays hit, " << fours << " of them four times");
    CHECK(hits > 10000);
    CHECK(fours > 300);
    CHECK(off == 0);
    CHECK(disorder == 0);
    CHECK(misplaced == 0);
}

TEST_CASE("a ray that starts on a torus: that crossing is 0, and it alternates between inside and outside from there") {
    Dice dice;
    int starts = 0, again = 0, wrong = 0, off = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto check = [&]<class T>(T) {
            const TorusKernel<T> torus = random_torus<T>(dice);
            const DVec3 c = naive::to<double>(torus.centre), from = c + dice.direction() * 9.;
            const Ray<T> ray{naive::to<T>(from), naive::to<T>(unit(c + dice.direction() * double(torus.major) - from)),
                             T(-1)};
            const Crossings<T, 4> found = torus.crossings(ray, T(-1));
            if (!found.hit) return;
            const SurfacePoint<T> point = torus.at(ray, found.t[2], T(-1));
            CHECK(std::abs(naive::length(point.normal) - 1) < 8 * std::numeric_limits<T>::epsilon());
            const Vec3<T> d = naive::to<T>(dice.direction());
            const T side = dot(point.normal, d);
            const Crossings<T, 4> next = torus.crossings(Ray<T>{point.position, d, T(0)}, T(0));
            ++starts;
            CHECK(next.hit);
            CHECK(std::count(next.t, next.t + 4, T(0)) >= 1);
            const int ahead = static_cast<int>(std::count_if(next.t, next.t + 4, [](T t) { return t > 0; }));
            for (const T t : next.t)
                off += t > 0 &&
                       std::abs(outside(torus, naive::to<double>(point.position) + naive::to<double>(d) * double(t))) >
                           64 * double(std::numeric_limits<T>::epsilon()) * double(torus.major + torus.minor);
            wrong += ahead % 2 != (side < 0);
            // Outwards and away from the axis, where nothing is left to meet.
            const Vec3<T> f = point.position - torus.centre, u = f - torus.axis * dot(f, torus.axis);
            again += side > 0 && dot(u, d) > 0 && naive::length(u) > torus.major && ahead > 0;
        };
        check(1.f), check(1.);
    }
    CHECK(starts > 10000);
    CHECK(wrong == 0);
    CHECK(again == 0);
    CHECK(off == 0);
}
