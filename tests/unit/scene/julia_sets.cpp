// Julia sets: which points are inside, where rays enter, and the normals there, against the referee's formulas.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "num/vec_math.h"
#include "scene/kinds/julia/julia.h"
#include "tests/referee/dice.h"
#include "tests/referee/julia.h"

using namespace strahl;

namespace {

std::vector<JuliaFractal> some_sets() {
    std::vector<JuliaFractal> all(7);
    for (JuliaFractal& own : all) own.iterations = 7, own.precision = 60;
    all[1].step = JuliaStep::cube, all[1].constant = {-.03, .5, -.2}, all[1].fourth = -.5;
    all[2].hypercomplex = true, all[2].constant = {.2, .1, .59}, all[2].fourth = -.2;
    all[3].hypercomplex = true, all[3].step = JuliaStep::cube, all[3].slice = {.1, -.2, .05}, all[3].distance = .1;
    all[4].slice = {.3, .1, -.2}, all[4].slice_fourth = .8, all[4].distance = -.1;
    all[5].hypercomplex = true, all[5].step = JuliaStep::sin, all[5].constant = {.4, .1, .5}, all[5].iterations = 3;
    all[6].hypercomplex = true, all[6].step = JuliaStep::reciprocal, all[6].constant = {.3, .2, .1};
    all[6].iterations = 4;
    return all;
}

template <class T>
std::vector<T> crossings(const JuliaFractal& body, const Ray<T>& ray, int enough, Vec3<T>* normal = nullptr,
                         T anywhere = 0) {
    std::vector<T> found;
    body.emit<T>(WorldTransform(), [&](const JuliaKernel<T>& kernel) {
        kernel.each_crossing(
            nullptr, enough, ray, ray.source, true, [&](bool, T t, T) { found.push_back(t); }, anywhere);
        if (normal && !found.empty()) *normal = kernel.at(nullptr, ray, found[0]).normal;
    });
    return found;
}

}  // namespace

TEST_CASE("Julia sets: points are inside as the referee says, for each step") {
    Dice dice{1};
    int inside = 0;
    for (JuliaFractal own : some_sets())
        for (int n = 0; n < 300; ++n) {
            const DVec3 p = dice.vector(-1.2, 1.2);
            CHECK(own.contains(p) == referee::contains<long double>(own, p));
            inside += own.contains(p);
        }
    CHECK(inside > 300);
    for (const JuliaStep step : {JuliaStep::exp, JuliaStep::cosh, JuliaStep::atan, JuliaStep::acos, JuliaStep::power}) {
        JuliaFractal own{.constant = {-.4, .3, .2}, .fourth = .1, .iterations = 4, .exponent = 2.5, .imaginary = .2};
        own.hypercomplex = true, own.step = step;
        int differ = 0, in = 0;
        for (int n = 0; n < 200; ++n) {
            const DVec3 p = dice.vector(-3, 3);
            differ += own.contains(p) != referee::contains<long double>(own, p), in += own.contains(p);
        }
        CAPTURE(julia_words[static_cast<std::size_t>(step)]);
        CHECK(differ == 0);
        CHECK((in > 0 && in < 200));
    }
}

TEST_CASE("Julia sets: rays enter where the referee says, and the field grows along the normals") {
    Dice dice{2};
    int hits = 0, missed = 0, far = 0, wrong = 0;
    for (const JuliaFractal& own : some_sets()) {
        if (own.step > JuliaStep::cube) continue;  // other sets have parts thinner than steps, or two sorts of inside
        for (int n = 0; n < 60; ++n) {
            const DVec3 from = 5. * dice.direction(), way = normalize(dice.vector(-.6, .6) - from);
            Vec3<double> normal;
            const auto found = crossings<double>(own, {Vec3<double>(from), Vec3<double>(way), -1.}, 1, &normal);
            const auto wanted = referee::crossings<long double>(own, {from, way}, -1).list;
            const auto ahead = std::ranges::find_if(wanted, [](const auto& at) { return at.t > 0; });
            if (found.empty() || ahead == wanted.end()) {
                missed += found.empty() != (ahead == wanted.end());
                continue;
            }
            ++hits;
            const auto off = static_cast<double>(found[0] - ahead->t);
            far += std::fabs(off) > 2e-7;
            CHECK(own.contains(from + found[0] * way));
            CHECK_FALSE(own.contains(from + (found[0] - 2.5e-7) * way));
            wrong += dot_product(normal, way) > 0;
        }
    }
    CHECK(hits > 150);
    CHECK(missed + far < 5);  // rays step over parts that are thinner than a step
    CHECK(wrong == 0);
}

TEST_CASE_TEMPLATE("Julia sets: rays come to an end by all steps, and packs find what single rays find", T, double,
                   float) {
    using V = Pack<T>;
    Dice dice{4};
    int hits = 0, differ = 0;
    for (int step = 0; step <= static_cast<int>(JuliaStep::power); ++step) {
        JuliaFractal own{.constant = {-.4, .3, .2}, .fourth = .1, .iterations = 4, .exponent = 2.5, .imaginary = .2};
        own.hypercomplex = step > 1, own.step = static_cast<JuliaStep>(step);
        own.emit<T>(WorldTransform(), [&](const JuliaKernel<T>& kernel) {
            for (int n = 0; n < 20; ++n) {
                std::array<std::array<T, width<V>>, 6> of_lanes;
                std::array<std::vector<T>, width<V>> found, wanted;
                const int rays = n % 2 ? width<V> : 1;  // a single ray has all lanes of its pack
                for (int k = 0; k < width<V>; ++k) {
                    const Vec3<T> from((k % 2 ? .5 : 5.) * dice.direction());
                    const Vec3<T> way(normalize(dice.vector(-.6, .6) - DVec3(from)));
                    for (int c = 0; c < 3; ++c) of_lanes[c][k] = from[c], of_lanes[3 + c][k] = way[c];
                    if (k < rays) wanted[k] = crossings<T>(own, {from, way, T(-1)}, 1 << 30);
                }
                const auto lanes = [&](int c) { return load_lanes<V>(of_lanes[c].data()); };
                const Ray<V> all{{lanes(0), lanes(1), lanes(2)}, {lanes(3), lanes(4), lanes(5)}, V(-1)};
                kernel.each_crossing(nullptr, 1 << 30, all, V(-1), first_lanes<V>(rays),
                                     [&](Mask<V> there, const V& t, const V&) {
                                         for (unsigned left = bits(there); left; left &= left - 1)
                                             found[std::countr_zero(left)].push_back(lane(t, std::countr_zero(left)));
                                     });
                for (int k = 0; k < width<V>; ++k) {
                    CAPTURE(step);
                    // The steps of hypercomplex ones make the last bits of numbers many times larger.
                    const double near = std::is_same_v<T, float> ? 1e-5 : 1e-9;
                    if (!own.hypercomplex)
                        differ +=
                            !std::ranges::equal(found[k], wanted[k], [&](T a, T b) { return std::fabs(a - b) < near; });
                    CHECK(std::ranges::is_sorted(found[k], [](T a, T b) { return a < b - T(1e-6); }));
                    hits += static_cast<int>(found[k].size());
                }
            }
        });
    }
    CHECK(differ == 0);
    CHECK(hits > 200);
}

TEST_CASE("Julia sets: a ball and a box hold them, which are smaller than POV-Ray's ball") {
    Dice dice{5};
    int inside = 0;
    const auto check = [&](const JuliaFractal& own) {
        const double reach = std::sqrt(own.reach());
        CHECK(reach <= own.radius() * (1 + 1e-5));
        for (int n = 0; n < 2000; ++n) {
            const DVec3 p = own.radius() * dice.vector(-1, 1);
            if (!own.contains(p)) continue;
            ++inside;
            CHECK(std::sqrt(dot_product(p, p)) <= reach);
            CHECK((own.bounds().low.x <= p.x && p.z <= own.bounds().high.z));
        }
    };
    for (JuliaFractal own : some_sets()) {
        if (own.step > JuliaStep::cube) continue;  // nothing is known of those but POV-Ray's ball
        CHECK(std::sqrt(own.reach()) < .95 * own.radius());
        check(own);
        for (int n = 0; n < 20; ++n) {
            own.constant = dice.vector(-.8, .8), own.fourth = dice.in(-.8, .8);
            own.iterations = 1 + n % 4;
            check(own);
        }
    }
    CHECK(inside > 2000);
}

TEST_CASE("Julia sets: nearer than `anywhere` rays cross the surface, but anywhere in a step") {
    Dice dice{6};
    int hits = 0, vague = 0;
    for (const JuliaFractal& own : some_sets())
        for (int n = 0; n < 100; ++n) {
            const DVec3 from = 5. * dice.direction(), way = normalize(dice.vector(-.6, .6) - from);
            const Ray<double> ray{Vec3<double>(from), Vec3<double>(way), -1.};
            const auto wanted = crossings<double>(own, ray, 1), found = crossings<double>(own, ray, 1, nullptr, 100.);
            REQUIRE(found.size() == wanted.size());
            if (found.empty()) continue;
            ++hits, vague += found[0] != wanted[0];
            // A step is longer than the least only where the surface is far from where it begins.
            CHECK(std::fabs(found[0] - wanted[0]) < 1 / own.precision + .5);
            CHECK(crossings<double>(own, ray, 1, nullptr, wanted[0])[0] == wanted[0]);
        }
    CHECK(hits > 150);
    CHECK(vague > hits / 2);
}

TEST_CASE("Julia sets: normals are where the last number grows, and rays that start on it go on") {
    Dice dice{3};
    const JuliaFractal own{.iterations = 5, .precision = 100};
    int tried = 0;
    for (int n = 0; n < 100; ++n) {
        const DVec3 from = 3. * dice.direction(), way = normalize(dice.vector(-.4, .4) - from);
        Vec3<double> normal;
        const auto found = crossings<double>(own, {Vec3<double>(from), Vec3<double>(way), -1.}, 1, &normal);
        if (found.empty()) continue;
        const DVec3 p = from + found[0] * way, n_(normal);
        if (dot_product(n_, way) > -.3) continue;
        ++tried;
        // The last number grows along it, and not across it.
        const auto size = [&](const DVec3& at) { return referee::size_after<long double>(own, at, 5); };
        const auto growth = [&](const DVec3& along) { return size(p + 1e-6 * along) - size(p - 1e-6 * along); };
        const DVec3 side = normalize(cross_product(n_, way)), other = cross_product(n_, side);
        CHECK(growth(n_) > 0);
        CHECK(std::fabs(growth(side)) < 1e-6 * growth(n_));
        CHECK(std::fabs(growth(other)) < 1e-6 * growth(n_));
        // Inwards there is a way out, outwards none back at the start.
        const auto inwards = crossings<double>(own, {Vec3<double>(p), Vec3<double>(-n_), 0.}, 1);
        CHECK((!inwards.empty() && inwards[0] > 1e-4));
        for (const double t : crossings<double>(own, {Vec3<double>(p), Vec3<double>(n_), 0.}, 1)) CHECK(t > 1e-4);
        const Ray<float> rough{Vec3<float>(p), Vec3<float>(-n_), 0.F};
        const auto in_float = crossings<float>(own, rough, 1);
        CHECK((!in_float.empty() && std::fabs(in_float[0] - inwards[0]) < 1e-3));
    }
    CHECK(tried > 20);
}
