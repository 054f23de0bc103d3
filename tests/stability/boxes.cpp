// Boxes of the hierarchy: rays along axes, with zeros of either sign, in the faces of boxes, and boxes without
// thickness.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "num/thread_pool.h"
#include "scene/overlap.h"
#include "tests/stability/naive.h"
#include "tests/stability/stage.h"
#include "tests/unit/levels.h"
#include "trace/world/build_world.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

/// Traces one ray: the middle of the view. Position and direction are exact if they have few bits, and `up` chooses the
/// signs of the direction's zeros.
class Shooter {
  public:
    Shooter(const Scene& scene, Precision precision) : tracer(scene, precision) {}
    double operator()(const DVec3& eye, const DVec3& aim, const DVec3& up) {
        const View view{.camera = {eye, aim, up, 20, {}}, .width = 1, .height = 1, .depth = 3};
        return values_of(tracer, view, {.columns = 1, .rows = 1}, pool)[0];
    }

  private:
    ThreadPool pool{1};
    Tracer tracer;
};

/// The slab test of the textbooks, which orders the ends by d >= 0.
template <class T>
bool naive_slab(const Box& box, const Vec3<T>& o, const Vec3<T>& d) {
    T near = 0, far = std::numeric_limits<T>::infinity();
    for (int i = 0; i < 3; ++i) {
        const T inverse = 1 / d[i];
        T a = (static_cast<T>(box.low[i]) - o[i]) * inverse, b = (static_cast<T>(box.high[i]) - o[i]) * inverse;
        if (!(d[i] >= 0)) std::swap(a, b);
        near = a > near ? a : near;
        far = b < far ? b : far;
    }
    return near <= far;
}

/// x, y and z as the first, second and third axis from `first` on.
DVec3 turned(const DVec3& p, int first) {
    DVec3 result;
    for (int i = 0; i < 3; ++i) result[(first + i) % 3] = p[i];
    return result;
}

}  // namespace

TEST_CASE("the textbooks' slab test loses rays with a zero in their direction") {
    const Box box{DVec3(0), DVec3(1)};
    int missed = 0;
    for (const float zero_x : {0.f, -0.f})
        for (const float zero_y : {0.f, -0.f})
            for (const float x : {0.f, .5f, 1.f})
                for (const float y : {0.f, .5f, 1.f})
                    missed += !naive_slab(box, Vec3<float>{x, y, -1}, Vec3<float>{zero_x, zero_y, 1});
    MESSAGE("naive: misses " << missed << " of 36 rays in or on the box");
    CHECK(missed >= 20);
    CHECK(!naive_slab(box, Vec3<float>{.5f, .5f, -1}, Vec3<float>{-0.f, 0, 1}));  // through its centre
}

TEST_CASE("rays along an axis hit correctly to the last bit of the outline, also in a hierarchy") {
    // Balls and cylinders side by side: faces of boxes lie in common planes, and some rays run in these.
    constexpr double radius = 1, pitch = 2;
    const double inside = std::nextafter(1.f, 0.f), outside = std::nextafter(1.f, 2.f);
    for (const int axis : {0, 1, 2}) {
        Stage stage;
        for (int i = 0; i < 25; ++i) {
            const double x = (i % 5 - 2) * pitch, y = (i / 5 - 2) * pitch;
            stage.put(Sphere{turned({x, y, 0}, axis + 1), radius}, glow(Color(1)));
            stage.put(Cylinder{turned({x, y, 8}, axis + 1), turned({x, y, 9}, axis + 1), radius}, glow(Color(.5)));
        }
        for (const Precision precision : precisions) {
            Shooter shoot(stage.scene, precision);
            for (const double way : {-1., 1.})
                for (const double sky : {-1., 1.})
                    for (const bool upright : {false, true})
                        for (const double cell : {-4., 0., 4.}) {
                            const DVec3 up = turned(upright ? DVec3(0, sky, 0) : DVec3(sky, 0, 0), axis + 1);
                            const auto see = [&](double x, double y) {
                                return shoot(turned({x, y, way > 0 ? -8 : 16}, axis + 1),
                                             turned({x, y, way > 0 ? -7 : 15}, axis + 1), up);
                            };
                            // Along +z the ball is in front, along -z the cylinder.
                            const double seen = way > 0 ? 1 : .5;
                            CHECK(see(cell, 0) == seen);
                            CHECK(see(cell + .5, cell) == seen);
                            if (cell == 0) {  // where such fine positions are exact
                                CHECK(see(inside, 0) == seen);
                                CHECK(see(0, -inside) == seen);
                                // 0 less 0 is 0, but -0 less 0 is -0.
                                CHECK(shoot(turned({0, 0, way > 0 ? -8 : 16}, axis + 1),
                                            turned({-0., -0., way > 0 ? -7 : 15}, axis + 1), up) == seen);
                            }
                            // Nothing is in the common face of four boxes, or in an outer one.
                            CHECK(see(cell + 1, cell + 1) == 0);
                            if (cell == 4) CHECK(see(4 + outside, 0) == 0);
                        }
        }
    }
}

TEST_CASE("discs thinner than the last bit of where they are hit") {
    // A disc is entered and left at the same number: a test for near < far gives holes. Its box has no thickness.
    Stage stage;
    std::vector<Cylinder> discs;
    Dice dice;
    for (int i = 0; i < 40; ++i) {
        const DVec3 base{8. * (i % 5), 8. * (i / 5), 0};
        DVec3 rise(0);
        rise[i % 3] = 1e-7;
        discs.push_back({base, base + rise, 1});
        stage.put(discs.back(), glow(Color(1)));
    }
    constexpr int rays = 3000;
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        Shooter shoot(stage.scene, precision);
        dice = {};
        int naive_missed = 0, our_missed = 0;
        for (int i = 0; i < rays; ++i) {
            const int axis = i % 40 % 3;
            const Cylinder& disc = discs[i % 40];
            const DVec3 from = dice.direction() * 3., rim = turned(DVec3(0, 1 - 2e-4, 0), axis + i / 40 % 2);
            if (std::abs(from[axis]) < .3) continue;
            const DVec3 d = rim - from;
            const float start = static_cast<float>(from[axis]), slope = static_cast<float>(d[axis] / naive::length(d));
            const float a = (0 - start) / slope, b = (1e-7f - start) / slope;
            naive_missed += !(std::min(a, b) < std::max(a, b));
            our_missed += shoot(disc.base + from, disc.base + rim, {.1, .2, .3}) != 1;
        }
        MESSAGE("of " << rays << " rays to the rims of discs in float near < far misses " << naive_missed << ", ours "
                      << our_missed);
        CHECK(naive_missed > rays / 20);
        CHECK(our_missed == 0);
    }
}

TEST_CASE("dust: balls no larger than the last bits of their positions") {
    // Boxes are kept in float; unless rounded outwards they cut off half of such a ball.
    Stage stage;
    Dice dice;
    std::vector<Sphere> grains;
    for (int i = 0; i < 64; ++i) {
        grains.push_back({DVec3(dice(-8, 8), dice(-8, 8), dice(-8, 8)), 1e-6});
        stage.put(grains.back(), glow(Color(1)));
    }
    for (int i = 0; i < 64; ++i) stage.put(Sphere{DVec3(dice(-8, 8), 9, dice(-8, 8)), .5}, glow(Color(.5)));
    for (const Precision precision : {Precision::float64, Precision::extended})
        for (const Sphere& grain : grains) {
            Scene all = stage.scene, alone = stage.scene;
            alone.primitives = {{grain, stage.scene.primitives[0].material, {}}};
            all.camera = alone.camera = {grain.centre - DVec3(0, 6e-6, 0), grain.centre, {0, 0, -1}, 15, {}};
            CHECK(count(shoot(all, precision, {16, 12}), Color(1)) ==
                  count(shoot(alone, precision, {16, 12}), Color(1)));
        }
}

TEST_CASE("a hierarchy of cylinders on a grid, seen along every axis, equals a plain loop") {
    // The faces of their boxes lie in a few planes, in which rays run.
    for (const int axis : {0, 1, 2}) {
        DVec3 along(0), up(0);
        along[axis] = 1, up[(axis + 1) % 3] = -1;
        for (const int side : {-1, 1}) {
            Stage all;
            for (int i = 0; i < 27; ++i) {
                const DVec3 centre{i % 3 - 1., i / 3 % 3 - 1., i / 9 - 1.};
                all.put(Cylinder{centre - along * .25, centre + along * .25, .5}, glow({.25 + i * .015625, 1, 0}));
            }
            all.look(along * (6. * side), {0, 0, 0}, 25, up).background({0, 0, 1});
            for (const Precision precision : precisions) {
                const Frame frame = shoot(all.scene, precision, {33, 33, 1});
                // Nine cylinders at a time, without a hierarchy. The nearest layer along the axis wins.
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

TEST_CASE("a ray's hit does not depend on its neighbours in the pack") {
    const Scene scene = still_life();
    const Frame whole = shoot(scene, Precision::float32, {64, 48, 3});
    const View view{.camera = scene.camera, .width = 64, .height = 48, .depth = 3};
    for (const Simd simd : fused_levels()) CHECK(render(scene, view, Precision::float32, 1, simd) == whole);
}

TEST_CASE("a unit of length in which parts that others take away are not too far off") {
    Scene scene;
    scene.camera.position = {0, 0, 6e-112}, scene.camera.look_at = {0, 0, 0};
    const Primitive dot{Sphere{{0, 0, 0}, 1e-112}, 0, {}}, far{Sphere{{0, 0, 9e8}, 1}, 0, {}};
    const auto parts = std::make_shared<const std::vector<Primitive>>(std::vector<Primitive>{dot, far});
    scene.primitives = {{Difference{parts}, 0, {}}};
    CHECK(reach_from({0, 0, -1e8}, scene.primitives[0]) == 1e9 + 1);
    CHECK(9e8 / extent_of(scene).size < 0x1p61);  // or squares of coordinates would overflow in float
}
