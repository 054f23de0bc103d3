// Boxes of the hierarchy: rays in their faces, along axes, with zeros of either sign, and boxes without thickness.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "num/memory.h"
#include "tests/stability/stage.h"
#include "trace/hierarchy.h"
#include "trace/traverse.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

/// Does the engine's traversal reach the leaf of this box, with nothing added to the box?
template <class S>
bool reaches(const Box& box, const Vec3<Element<S>>& o, const Vec3<Element<S>>& d, double margin = 0) {
    using T = Element<S>;
    Hierarchy<T> tree;
    Node<T> leaf{};
    for (int i = 0; i < 3; ++i) {
        leaf.low[i] = static_cast<T>(box.low[i] - margin);
        leaf.high[i] = static_cast<T>(box.high[i] + margin);
    }
    leaf.count = 1;
    bool reached = false;
    const Ray<S> ray{splat<S>(o), splat<S>(d), S(T(-1))};
    traverse<true>(&leaf, ray, Mask<S>(S(T(0)) < S(T(1))), S(std::numeric_limits<T>::infinity()),
                   [&](int, int, Mask<S>) { return reached = true; });
    return reached;
}
/// The slab test of the textbooks: fmin, fmax, and 1 / d as it comes.
template <class T>
bool naive_slab(const Box& box, const Vec3<T>& o, const Vec3<T>& d) {
    T near = 0, far = std::numeric_limits<T>::infinity();
    for (int i = 0; i < 3; ++i) {
        T a = (static_cast<T>(box.low[i]) - o[i]) / d[i], b = (static_cast<T>(box.high[i]) - o[i]) / d[i];
        if (!(d[i] >= 0)) std::swap(a, b);
        near = a > near ? a : near;
        far = b < far ? b : far;
        if (std::isnan(a) || std::isnan(b)) return false;
    }
    return near <= far;
}

}  // namespace

TEST_CASE_TEMPLATE("rays along an axis, in the box's face, edge and corner, with zeros of either sign", S, float,
                   double, long double, Pack<float>, Pack<double>) {
    using T = Element<S>;
    const Box box{DVec3(0), DVec3(1)};
    int naive_missed = 0;
    for (const T zero_x : {T(0), T(-0.)})
        for (const T zero_y : {T(0), T(-0.)})
            for (const T x : {T(0), T(.5), T(1)})
                for (const T y : {T(0), T(.5), T(1)})
                    for (const T way : {T(1), T(-1)}) {
                        const Vec3<T> o{x, y, way > 0 ? T(-1) : T(2)}, d{zero_x, zero_y, way};
                        naive_missed += !naive_slab(box, o, d);
                        CHECK(reaches<S>(box, o, d));
                        CHECK(reaches<S>(box, {y, o.z, x}, {zero_y, way, zero_x}));
                        CHECK(!reaches<S>(box, {x + 2, y, o.z}, d));
                        CHECK(!reaches<S>(box, {x, y - 2, o.z}, d));
                        CHECK(!reaches<S>(box, o, -d));
                    }
    CHECK(naive_missed > 0);
}

TEST_CASE("flat boxes: rays aimed at their border") {
    // Boxes as thin as those of cylinders' ends, and the exact hit on a corner's side.
    Dice dice;
    constexpr int rays = 100000;
    int naive_missed = 0, our_missed = 0;
    for (int i = 0; i < rays; ++i) {
        Box box;
        for (int c = 0; c < 3; ++c) {
            const float a = static_cast<float>(dice(0, 2));
            box.low[c] = a, box.high[c] = static_cast<double>(a + static_cast<float>(c == i % 3 ? 0 : dice(0, 1e-3)));
        }
        DVec3 aim;
        for (int c = 0; c < 3; ++c) aim[c] = dice(0, 1) < .5 ? box.low[c] : box.high[c];
        const Vec3<float> o{float(dice(-4, 4)), float(dice(-4, 4)), float(dice(-4, 4))};
        // Unrounded the ray ends in the corner at t = 1; in float it is the engine's business to be generous.
        const Vec3<float> d{float(aim.x) - o.x, float(aim.y) - o.y, float(aim.z) - o.z};
        naive_missed += !naive_slab(box, o, d);
        our_missed += !reaches<float>(box, o, d, 32 * 1.2e-7 * 4);  // with the margin that building adds
    }
    MESSAGE("of " << rays << " rays to corners of flat boxes the naive test misses " << naive_missed);
    CHECK(naive_missed > rays / 20);
    CHECK(our_missed == 0);
}

TEST_CASE("a hierarchy of cans on a grid, looked at along every axis, shows what a plain loop shows") {
    // The faces of their boxes are all in a few planes, in which rays run.
    for (const int axis : {0, 1, 2}) {
        DVec3 along(0), up(0);
        along[axis] = 1, up[(axis + 1) % 3] = -1;
        for (const int side : {-1, 1}) {
            Stage all;
            std::vector<Primitive> cans;
            for (int i = 0; i < 27; ++i) {
                const DVec3 centre{i % 3 - 1., i / 3 % 3 - 1., i / 9 - 1.};
                all.put(Cylinder{centre - along * .25, centre + along * .25, .5}, glow({.25 + i * .015625, 1, 0}));
            }
            all.look(along * (6. * side), {0, 0, 0}, 25, up).background({0, 0, 1});
            for (const Precision precision : precisions) {
                const Frame frame = shoot(all.scene, precision, {33, 33, 1});
                // The same, nine cans at a time: no hierarchy. What is nearer wins, by depth of layers along the axis.
                Frame plain = frame;
                std::fill(plain.rgb.begin(), plain.rgb.end(), -1.);
                for (int layer = 0; layer < 3; ++layer) {
                    Scene part = all.scene;
                    std::erase_if(part.primitives, [&](const Primitive& p) {
                        const DVec3 base = std::get<Cylinder>(p.shape).base;
                        return std::lround(base[axis] + .25 + 1) != (side > 0 ? 2 - layer : layer);
                    });
                    const Frame some = shoot(part, precision, {33, 33, 1});
                    for (std::size_t i = 0; i < some.rgb.size(); i += 3)
                        if (plain.rgb[i + 2] != 0)
                            std::copy_n(some.rgb.begin() + std::ptrdiff_t(i), 3, plain.rgb.begin() + std::ptrdiff_t(i));
                }
                CHECK(frame == plain);
            }
        }
    }
}

TEST_CASE("neighbours in a pack do not decide what a ray finds") {
    const Scene scene = still_life();
    const Frame whole = shoot(scene, Precision::single, {64, 48, 3});
    const View view{.camera = scene.camera, .width = 64, .height = 48, .depth = 3};
    for (const Simd simd : {Simd::scalar, Simd::v3, Simd::v4})
        if (supported(simd)) CHECK(render(scene, view, Precision::single, 1, simd) == whole);
}
