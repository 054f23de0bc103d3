// Tori: a ray that is known from elsewhere, thin and spindle-shaped ones, from afar, and rays that start on them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "scene/kinds/torus.h"
#include "tests/referee/line.h"
#include "tests/referee/quadruple.h"
#include "tests/stability/naive.h"
#include "tests/stability/stage.h"

using namespace strahl;
using namespace strahl::stability;
using naive::unit;

namespace {

/// Returns the distance by which p is outside of the torus, in 64 bits.
template <class T>
long double outside(const TorusKernel<T>& torus, const DVec3& p) {
    using L = long double;
    const Vec3<L> f = naive::to<L>(p) - naive::to<L>(torus.centre), a = naive::unit(naive::to<L>(torus.axis));
    const L z = naive::times(f, a), rho = naive::length(f - a * z) - L(torus.major);
    return std::sqrt(rho * rho + z * z) - L(torus.minor);
}
template <class T>
TorusKernel<T> random_torus(Dice& dice) {
    const double major = std::exp(dice(-1, 1)), kind = dice(0, 3);
    const double minor = major * (kind < 1 ? dice(.05, 1) : kind < 2 ? 2e-3 : dice(1, 2));
    return {naive::to<T>(dice.direction()), naive::to<T>(dice.direction()), T(major), T(minor)};
}

using Q = Quadruple;
using Polynomial = std::vector<Q>;  // c[0] + c[1] t + c[2] t^2 + ...

/// Counts the different real roots, by Sturm's theorem: the changes of sign along the chain of remainders, at
/// -infinity less those at infinity.
int real_roots(const Polynomial& whole) {
    std::vector<Polynomial> chain{whole, {}};
    for (std::size_t i = 1; i < whole.size(); ++i) chain[1].push_back(Q(static_cast<int>(i)) * whole[i]);
    while (chain.back().size() > 1) {
        Polynomial rest = chain[chain.size() - 2];
        const Polynomial& by = chain.back();
        for (; rest.size() >= by.size(); rest.pop_back()) {
            const Q factor = rest.back() / by.back();
            for (std::size_t i = 0; i < by.size(); ++i) rest[rest.size() - by.size() + i] -= factor * by[i];
        }
        for (Q& c : rest) c = -c;
        while (!rest.empty() && rest.back() == 0) rest.pop_back();
        if (rest.empty()) break;
        chain.push_back(rest);
    }
    int changes = 0;
    for (std::size_t i = 1; i < chain.size(); ++i) {
        const bool differ = (chain[i].back() < 0) != (chain[i - 1].back() < 0);
        const bool odd = (chain[i].size() + chain[i - 1].size()) % 2 == 1;
        changes += (differ != odd) - differ;
    }
    return changes;
}

/// Counts how often the ray's line crosses a torus that is not a spindle, in 113 bits; returns -1 if that depends on
/// whether the tube is wider or thinner by `unsure`.
int line_crossings(const TorusKernel<double>& torus, const Ray<double>& ray, Q unsure) {
    using referee::Vector;
    const Vector<Q> axis = referee::unit(Vector<Q>(torus.axis)), d = referee::unit(Vector<Q>(ray.direction));
    const Vector<Q> o = Vector<Q>(ray.origin) - Vector<Q>(torus.centre), p = o - dot(o, d) * d;  // p d = 0
    const Q along = dot(p, axis), slope = dot(d, axis), major = torus.major, four = 4 * major * major;
    const auto count = [&](Q minor) {
        const Q k = dot(p, p) + major * major - minor * minor;
        return real_roots({k * k - four * (dot(p, p) - along * along), 2 * four * along * slope,
                           2 * k - four * (1 - slope * slope), 0, 1});
    };
    const int crossings = count(torus.minor);
    return crossings == count(torus.minor - unsure) && crossings == count(torus.minor + unsure) ? crossings : -1;
}

/// Rays at a torus that is no spindle: at any distance; at a thin one, which most of them pass close by; and along its
/// surface, as close by as 1e-15 of its size or as far as a hundredth.
enum Aim { near, thin, grazing };
std::pair<TorusKernel<double>, Ray<double>> aimed(Dice& dice, Aim aim) {
    const double major = std::exp(dice(-1, 1)), minor = major * (aim == thin ? 2e-3 : dice(.05, 1));
    const TorusKernel<double> torus{dice.direction(), dice.direction(), major, minor};
    const DVec3 side = naive::unit(cross(torus.axis, dice.direction())), tube = torus.centre + major * side;
    const double turn = dice(0, 6.283185307179586);
    const DVec3 normal = std::cos(turn) * side + std::sin(turn) * torus.axis;
    const double by = (major + minor) * std::pow(10, dice(-15, -2));
    const double out = aim != grazing ? minor * dice(0, 1.5) : dice(0, 1) < .5 ? minor + by : minor - by;
    const DVec3 to = tube + out * normal, towards = dice.direction();
    const DVec3 d = naive::unit(aim == grazing ? cross(normal, towards) : towards);
    return {torus, {to - (major + minor) * dice(2, 8) * d, d, -1}};
}

}  // namespace

TEST_CASE("rays that pass close by, against 113 bits") {
    const char* const wanted = std::getenv("STRAHL_RAYS");
    const long rays = std::lround((wanted ? std::atof(wanted) : 6e4) / 3);
    for (const Aim aim : {near, thin, grazing}) {
        Dice dice;
        long hits = 0, fours = 0, unsure = 0, wrong = 0, off = 0;
        double worst = 0;
        for (long i = 0; i < rays; ++i) {
            const auto [torus, ray] = aimed(dice, aim);
            const double size = naive::length(ray.origin - torus.centre) + torus.major + torus.minor;
            const int expected = line_crossings(torus, ray, 1e-15 * size);
            const Crossings<double, 4> found = torus.crossings(ray, -1.);
            const int crossings = !found.hit ? 0 : found.t[0] < -1e30 ? 2 : 4;
            hits += found.hit, fours += crossings == 4, unsure += expected < 0;
            wrong += expected >= 0 && crossings != expected;
            for (int k = 4 - crossings; k < 4; ++k) {
                const DVec3 at = ray.origin + ray.direction * found.t[k];
                const double apart = std::abs(static_cast<double>(outside(torus, at))) / size;
                worst = std::max(worst, apart), off += !(apart < 1e-15 * 8);
            }
        }
        MESSAGE(std::string(aim == near   ? "near: "
                            : aim == thin ? "thin: "
                                          : "grazing: ")
                << rays << " rays, " << hits << " hit, " << fours << " four times, " << unsure << " too close to call, "
                << wrong << " wrong; crossings off by " << worst << " of the distance");
        CHECK(hits > rays / 4);
        CHECK(fours > rays / 1000);
        CHECK(unsure < rays / 10);
        CHECK(wrong == 0);
        CHECK(off == 0);
    }
}

TEST_CASE("the crossing of a ray that passes many a solver by") {
    const TorusKernel<double> torus{{0, 0, 0}, {0, 0, 1}, 143, 113.2};
    const Ray<double> ray{{160.37125, -6.351337, -.000241}, naive::unit(DVec3(.852793, -.522249, -.00002)), -1};
    const Crossings<double, 4> found = torus.crossings(ray, -1.);
    CHECK(found.hit);
    CHECK(found.t[3] == doctest::Approx(103.849237).epsilon(1e-9));
}

TEST_CASE("crossings ahead are on the torus, ascending, and between them is its inside") {
    Dice dice;
    int hits = 0, fours = 0, off = 0, disorder = 0, misplaced = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto check = [&]<class T>(T) {
            const TorusKernel<T> torus = random_torus<T>(dice);
            const DVec3 c = naive::to<double>(torus.centre), aim = c + dice.direction() * double(torus.major);
            const DVec3 from = aim + dice.direction() * std::pow(10, dice(0, 3));
            const Ray<T> ray{naive::to<T>(from), naive::to<T>(naive::unit(aim - from)), T(-1)};
            const Crossings<T, 4> found = torus.crossings(ray, T(-1));
            const DVec3 o = naive::to<double>(ray.origin), d = naive::to<double>(ray.direction);
            const double unsure = 16 * double(std::numeric_limits<T>::epsilon()) * (naive::length(from) + 4);
            hits += found.hit;
            bool inside = false;
            double before = 0;
            for (const T crossing : found.t) {
                if (!found.hit || crossing < T(-1e30)) continue;
                const double t = std::max(0., double(crossing)), middle = (before + t) / 2;
                off += t > 0 && std::abs(outside(torus, o + d * t)) > unsure;
                disorder += t < before;
                misplaced += t > 0 && (inside ? outside(torus, o + d * middle) > unsure
                                              : outside(torus, o + d * middle) < -unsure);
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
            const Ray<T> ray{naive::to<T>(from),
                             naive::to<T>(naive::unit(c + dice.direction() * double(torus.major) - from)), T(-1)};
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
            // Rays outwards and away from the axis meet nothing.
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
