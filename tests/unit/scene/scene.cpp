// Transformations, cameras, flythroughs and materials as values.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "num/vec_math.h"
#include "scene/camera.h"
#include "scene/material.h"
#include "scene/motion/transformation.h"
#include "scene/tangent.h"

using namespace strahl;

namespace {

using Steps = std::vector<Transformation>;

DVec3 apply(const Steps& steps, const DVec3& p) { return transform_point(matrix(steps), p); }

void check_near(const DVec3& a, const DVec3& b, double tolerance = 1e-14) {
    INFO(a.x, " ", a.y, " ", a.z, " is not near ", b.x, " ", b.y, " ", b.z);
    CHECK(length(a - b) <= tolerance);
}

const Camera scene_camera{{0, 0, 0}, {0, 1, 0}, {0, 0, -1}, 30, 1.5};

}  // namespace

TEST_CASE("rotations turn counter-clockwise seen from the tip of the axis, exactly at right angles") {
    CHECK(apply({Rotate{{90, 0, 0}}}, {0, 1, 0}) == DVec3(0, 0, 1));
    CHECK(apply({Rotate{{0, 90, 0}}}, {0, 0, 1}) == DVec3(1, 0, 0));
    CHECK(apply({Rotate{{0, 0, 90}}}, {1, 0, 0}) == DVec3(0, 1, 0));
    CHECK(apply({Rotate{{0, 0, 180}}}, {1, 2, 3}) == DVec3(-1, -2, 3));
    CHECK(apply({Rotate{{0, 0, -90}}}, {1, 0, 0}) == DVec3(0, -1, 0));
    CHECK(apply({Rotate{{0, 0, 270}}}, {1, 0, 0}) == DVec3(0, -1, 0));
    CHECK(apply({Rotate{{0, 0, 3600000090}}}, {1, 0, 0}) == DVec3(0, 1, 0));
    for (int degrees = -720; degrees <= 720; degrees += 10) {
        const double angle = degrees * std::numbers::pi / 180;
        check_near(apply({Rotate{{0, 0, double(degrees)}}}, {1, 0, 0}), {std::cos(angle), std::sin(angle), 0});
    }
    check_near(apply({Rotate{{0, 0, 30}}}, {1, 0, 0}), {std::sqrt(3) / 2, .5, 0});
    check_near(apply({Rotate{{0, 0, 135}}}, {1, 0, 0}), {-std::sqrt(.5), std::sqrt(.5), 0});
    check_near(apply({Rotate{{200, 0, 0}}}, {0, 1, 0}),
               {0, std::cos(200 * std::numbers::pi / 180), std::sin(200 * std::numbers::pi / 180)}, 1e-15);
}

TEST_CASE("one rotation turns about x, then y, then z") {
    const DVec3 p{1, 2, 3};
    CHECK(apply({Rotate{{90, 90, 90}}}, p) == apply({Rotate{{90, 0, 0}}, Rotate{{0, 90, 0}}, Rotate{{0, 0, 90}}}, p));
    CHECK(apply({Rotate{{90, 90, 0}}}, {0, 1, 0}) == DVec3(1, 0, 0));  // to z by x, then to x by y
}

TEST_CASE("transformations apply in the order written") {
    CHECK(apply({}, {1, 2, 3}) == DVec3(1, 2, 3));
    CHECK(apply({Translate{{1, 0, 0}}, Scale{{2, 3, 4}}}, {1, 1, 1}) == DVec3(4, 3, 4));
    CHECK(apply({Scale{{2, 3, 4}}, Translate{{1, 0, 0}}}, {1, 1, 1}) == DVec3(3, 3, 4));
    CHECK(apply({Rotate{{0, 0, 90}}, Translate{{1, 0, 0}}}, {1, 0, 0}) == DVec3(1, 1, 0));
}

TEST_CASE("similarity is the factor of lengths, or 0 where angles change") {
    CHECK(similarity(Steps{}) == 1);
    CHECK(similarity(Steps{Rotate{{10, 20, 30}}, Translate{{1, 2, 3}}}) == 1);
    CHECK(similarity(Steps{Scale{{2, 2, 2}}, Rotate{{10, 20, 30}}, Scale{{-3, 3, 3}}}) == 6);
    CHECK(similarity(Steps{Scale{{1, 1, 2}}}) == 0);
    CHECK(similarity(Steps{Scale{{1, 1, 2}}, Scale{{2, 2, 1}}}) == 0);  // whether steps cancel is not examined
}

TEST_CASE("the article's camera looks at +y with +x to the right of the picture") {
    const CameraFrame frame = frame_of({{0, -20, 0}, {0, 0, 0}, {0, 0, -1}, 45, {}}, 4. / 3);
    CHECK(frame.forward == DVec3(0, 1, 0));
    CHECK(frame.right == DVec3(1, 0, 0));
    CHECK(frame.down == DVec3(0, 0, -1));
    CHECK(frame.tan_x == 1);  // fov is half of the opening angle
    CHECK(frame.tan_y == .75);
    CHECK(frame_of({{0, -20, 0}, {0, 0, 0}, {0, 0, -1}, 45, 2}, 4. / 3).tan_y ==
          .5);  // its own aspectratio has priority
}

TEST_CASE("tangents are right to the last bit") {
    CHECK(tangent(0) == 0);
    CHECK(tangent(45) == 1);
    // For these the C library of x86-64 returns the neighbouring double.
    CHECK(tangent(35.1) == 0.7028117712403573746701);
    CHECK(tangent(58.37) == 1.6235713841211499852100);
    CHECK(tangent(89.71) == 197.56996633889131866304);
    for (double degrees = 1e-12; degrees < 90; degrees *= 1.001) {
        CAPTURE(degrees);
        const long double exact = std::tan(degrees * (std::numbers::pi_v<long double> / 180));
        CHECK(std::fabs(tangent(degrees) - exact) < .501L * exact * std::numeric_limits<double>::epsilon());
    }
}

TEST_CASE("camera axes are orthonormal and right-handed at any position") {
    for (const Camera& camera :
         {Camera{{5, -20, 18}, {0, 0, 0}, {0, 0, -1}, 25, {}}, Camera{{1, 2, 3}, {-7, 1e6, .5}, {1, 2, 3}, 80, {}},
          Camera{{1e-200, 0, 0}, {0, 1e-200, 3e-200}, {1e-310, 1e-310, 5e-310}, 25, {}},
          Camera{{1e9, 1e9, -1e9}, {-1e9, 1e9, 1e9}, {0, 1e9, 0}, 1e-3, {}},
          Camera{{0, 0, 0}, {0, 0, 1}, {1e-6, 0, -1}, 25, {}}}) {
        REQUIRE(degenerate(camera) == nullptr);
        const CameraFrame f = frame_of(camera, 1);
        for (const DVec3& axis : {f.right, f.down, f.forward}) CHECK(length(axis) == doctest::Approx(1).epsilon(1e-14));
        CHECK(std::fabs(dot_product(f.right, f.down)) < 1e-9);
        CHECK(std::fabs(dot_product(f.down, f.forward)) < 1e-9);
        CHECK(std::fabs(dot_product(f.forward, f.right)) < 1e-9);
        const DVec3 z{f.right.y * f.down.z - f.right.z * f.down.y, f.right.z * f.down.x - f.right.x * f.down.z,
                      f.right.x * f.down.y - f.right.y * f.down.x};
        check_near(z, f.forward, 1e-9);
        CHECK(dot_product(f.down, camera.up) > 0);
    }
}

TEST_CASE("a degenerate camera is reported with its reason") {
    CHECK(std::string(degenerate({{1, 2, 3}, {1, 2, 3}, {0, 0, -1}, 25, {}})) ==
          "position and look_at are the same point");
    CHECK(std::string(degenerate({{1, 2, 3}, {1, 2, 9}, {0, 0, 5}, 25, {}})).starts_with("up is parallel"));
    CHECK(std::string(degenerate({{1, 2, 3}, {1, 2, 9}, {0, 0, -5}, 25, {}})).starts_with("up is parallel"));
    CHECK(std::string(degenerate({{0, 0, 0}, {1, 2, 3}, {.1, .2, .3}, 25, {}})).starts_with("up is parallel"));
    CHECK(std::string(degenerate({{1, 2, 3}, {1, 2, 9}, {0, 0, 0}, 25, {}})) == "up is the zero vector");
    CHECK(std::string(degenerate({{NAN, 2, 3}, {1, 2, 9}, {0, 0, 1}, 25, {}})) == "a coordinate is not finite");
    CHECK(degenerate({{1, 2, 3}, {1, 2, 9}, {0, 1e-9, 1}, 25, {}}) == nullptr);
}

TEST_CASE("a flythrough passes exactly through its keys and waits before and after") {
    const Flythrough path{10,
                          false,
                          {{1, {0, 0, 0}, {0, 5, 0}, {}, {}},
                           {2, {.1, .7, .3}, {0, 9, 0}, 40., {}},
                           {5, {7, 2, 3}, {0, 9, 1}, {}, DVec3(.3, 0, -1)},
                           {8, {1, 1, 1}, {3, 3, 3}, 10., {}}}};
    for (const Keyframe& key : path.keys)
        CHECK(camera_at(path, scene_camera, key.time) == camera_of(key, scene_camera));
    CHECK(camera_at(path, scene_camera, 0) == camera_of(path.keys.front(), scene_camera));
    CHECK(camera_at(path, scene_camera, -1e300) == camera_of(path.keys.front(), scene_camera));
    CHECK(camera_at(path, scene_camera, 9) == camera_of(path.keys.back(), scene_camera));
    CHECK(camera_at(path, scene_camera, 1e300) == camera_of(path.keys.back(), scene_camera));
    CHECK(camera_at(path, scene_camera, NAN) == camera_of(path.keys.front(), scene_camera));
    CHECK(camera_of(path.keys[0], scene_camera).fov == 30);
    CHECK(camera_of(path.keys[0], scene_camera).aspectratio == 1.5);
    CHECK(camera_of(path.keys[2], scene_camera).up == DVec3(.3, 0, -1));
    CHECK(camera_at({1, false, {}}, scene_camera, .5) == scene_camera);
}

TEST_CASE("evenly spaced keys on a line give even motion; two keys give a straight line") {
    const Flythrough line{3,
                          false,
                          {{0, {0, 0, 0}, {0, 9, 0}, 10., {}},
                           {1, {1, 0, 0}, {1, 9, 0}, 20., {}},
                           {2, {2, 0, 0}, {2, 9, 0}, 30., {}},
                           {3, {3, 0, 0}, {3, 9, 0}, 40., {}}}};
    for (double t = 0; t <= 3; t += 1. / 16) {
        const Camera camera = camera_at(line, scene_camera, t);
        check_near(camera.position, {t, 0, 0});
        check_near(camera.look_at, {t, 9, 0});
        CHECK(camera.fov == doctest::Approx(10 + 10 * t));
    }
    const Flythrough two{4, false, {{0, {0, 0, 0}, {0, 9, 0}, {}, {}}, {4, {4, 8, 0}, {0, 9, 0}, {}, {}}}};
    check_near(camera_at(two, scene_camera, 1).position, {1, 2, 0});
    CHECK(camera_at(two, scene_camera, 1).look_at == DVec3(0, 9, 0));
}

TEST_CASE("the curve is centripetal: knots are the square root of a chord apart") {
    // Chords of 1, 4 and 1 have knots 1, 2 and 1 apart; with keys at those times, time is the knot. The values are
    // those of Barry and Goldman's pyramid at the middle of the second interval.
    const DVec3 p[] = {{0, 1, 0}, {0, 0, 0}, {4, 0, 0}, {4, 1, 0}};
    const double knot[] = {0, 1, 3, 4};
    Flythrough path{4, false, {}};
    for (int i = 0; i < 4; ++i) path.keys.push_back({knot[i], p[i], {0, 99, 0}, {}, {}});
    for (const double t : {1.25, 2., 2.75}) {
        const auto blend = [&](const DVec3& a, const DVec3& b, int i, int k) {
            return a * ((knot[k] - t) / (knot[k] - knot[i])) + b * ((t - knot[i]) / (knot[k] - knot[i]));
        };
        const DVec3 a1 = blend(p[0], p[1], 0, 1), a2 = blend(p[1], p[2], 1, 2), a3 = blend(p[2], p[3], 2, 3);
        check_near(camera_at(path, scene_camera, t).position, blend(blend(a1, a2, 0, 2), blend(a2, a3, 1, 3), 1, 2));
    }
}

namespace {

/// The largest change of velocity in one step of time, over `count` steps from `start`.
double greatest_jolt(const Flythrough& path, double start, double step, int count) {
    double greatest = 0;
    for (int i = 0; i < count; ++i) {
        const auto at = [&](int k) { return camera_at(path, scene_camera, start + (i + k) * step).position; };
        greatest = std::max(greatest, length(at(2) - 2. * at(1) + at(0)) / step);
    }
    return greatest;
}

}  // namespace

TEST_CASE("velocity is continuous, at keys with uneven times and at the seam of a loop") {
    Flythrough path{10,
                    true,
                    {{0, {0, 0, 0}, {0, 50, 0}, {}, {}},
                     {1, {5, 1, 0}, {1, 50, 0}, {}, {}},
                     {4, {6, 7, 2}, {2, 50, 1}, {}, {}},
                     {8, {0, 8, 1}, {3, 50, 2}, {}, {}}}};
    // A jump of the velocity would not shrink with the step.
    CHECK(greatest_jolt(path, -1, .001, 12000) < .05);
    CHECK(greatest_jolt(path, 9.99, .0001, 200) < .005);
    path.loop = false;
    CHECK(greatest_jolt(path, .5, .001, 7000) < .05);
    CHECK(greatest_jolt(path, -.01, .001, 20) > 1);  // an open path starts at full speed, a jump that is measured
}

TEST_CASE("ease slows the flight down at its keys, on the same way") {
    Flythrough path{9,
                    false,
                    {{0, {0, 0, 0}, {0, 50, 0}, 20., {}},
                     {3, {3, 0, 0}, {0, 50, 0}, 30., {}},
                     {6, {6, 3, 0}, {0, 50, 0}, 40., {}},
                     {9, {9, 9, 0}, {0, 50, 0}, 50., {}}}};
    const Flythrough even = path;
    constexpr double h = 1e-6;
    const auto speed = [&](const Flythrough& flown, double time) {
        const auto at = [&](double t) { return camera_at(flown, scene_camera, t).position; };
        return length(at(time + h) - at(time)) / h;
    };
    path.keys[1].ease = .25, path.keys[2].ease = 1;
    for (const double time : {3 - 2 * h, 3.}) CHECK(speed(path, time) == doctest::Approx(.75 * speed(even, time)));
    for (const double time : {6 - 2 * h, 6.}) CHECK(speed(path, time) < 1e-4);
    CHECK(speed(path, 0) == doctest::Approx(speed(even, 0)));
    for (const Keyframe& key : path.keys)
        CHECK(camera_at(path, scene_camera, key.time) == camera_of(key, scene_camera));
    // A flight with ease passes the places of one without ease, at other times, and never stops.
    double before = 0;
    for (double time = 3.1; time < 6; time += .1) {
        const double t = (time - 3) / 3, over = t - .25 * t * (1 - t) * (1 - t) + t * t * (1 - t);
        CHECK(over > before);
        before = over;
        const Camera camera = camera_at(path, scene_camera, time), other = camera_at(even, scene_camera, 3 + 3 * over);
        check_near(camera.position, other.position, 1e-12);
        CHECK(camera.fov == doctest::Approx(other.fov));
    }
    for (double time = 0; time < 3; time += .1) {
        Flythrough first = path;
        first.keys[1].ease = 0;
        CHECK(camera_at(first, scene_camera, time) == camera_at(even, scene_camera, time));
    }
}

TEST_CASE("a loop repeats every duration; a last key at its end is the first again") {
    const Keyframe a{0, {0, 0, 0}, {0, 50, 0}, {}, {}}, b{2, {5, 1, 0}, {1, 50, 0}, {}, {}},
        c{5, {6, 7, 2}, {2, 50, 1}, {}, {}};
    const Flythrough path{8, true, {a, b, c}};
    for (const double t : {.25, 1., 3.5, 6., 7.75}) {
        CHECK(camera_at(path, scene_camera, t + 8) == camera_at(path, scene_camera, t));
        CHECK(camera_at(path, scene_camera, t - 16) == camera_at(path, scene_camera, t));
    }
    check_near(camera_at(path, scene_camera, 8 - 1e-9).position, a.position, 1e-7);
    Keyframe again = a;
    again.time = 8;
    const Flythrough said_twice{8, true, {a, b, c, again}};
    for (double t = 0; t < 8; t += .25)
        CHECK(camera_at(said_twice, scene_camera, t) == camera_at(path, scene_camera, t));
    // A loop whose first key is late is on its way there before.
    const Flythrough late{8, true, {{3, b.position, b.look_at, {}, {}}, {5, c.position, c.look_at, {}, {}}}};
    CHECK(camera_at(late, scene_camera, 3) == camera_of(late.keys[0], scene_camera));
    check_near(camera_at(late, scene_camera, 2.999).position, b.position, .01);
    check_near(camera_at(late, scene_camera, 8 - 1e-9).position, camera_at(late, scene_camera, 0).position, 1e-7);
}

TEST_CASE("a pause between equal keys stands still, and fov and up never overshoot") {
    const Flythrough path{6,
                          false,
                          {{0, {0, 0, 0}, {0, 9, 0}, 80., {}},
                           {1, {1, 0, 0}, {0, 9, 0}, 10., {}},
                           {2, {1, 0, 0}, {0, 9, 0}, 10., DVec3(0, 0, -2)},
                           {3, {2, 1, 0}, {0, 9, 0}, 89., DVec3(1, 0, 0)}}};
    for (double t = 1; t <= 2; t += .125) {
        CHECK(camera_at(path, scene_camera, t).position == DVec3(1, 0, 0));
        CHECK(camera_at(path, scene_camera, t).fov == 10);
    }
    for (double t = 0; t <= 6; t += 1. / 64) {
        const Camera camera = camera_at(path, scene_camera, t);
        CHECK((camera.fov >= 10 && camera.fov <= 89));
        CHECK((camera.position.x >= 0 && camera.position.x <= 2));
        CHECK(degenerate(camera) == nullptr);
    }
    const DVec3 halfway = camera_at(path, scene_camera, 2.5).up;
    CHECK((halfway.x > .1 && halfway.z < -.1));
}

TEST_CASE("where the curves give a degenerate camera, axes come from a moment nearby") {
    // Over the top, looking straight down along `up`, at t = 1.
    const Flythrough over{2, false, {{0, {-4, 0, 6}, {0, 0, 0}, {}, {}}, {2, {4, 0, 6}, {0, 0, 0}, {}, {}}}};
    const Camera top = camera_at(over, scene_camera, 1);
    CHECK(top.position == DVec3(0, 0, 6));
    REQUIRE(degenerate(top) == nullptr);
    const CameraFrame here = frame_of(top, 1), before = frame_of(camera_at(over, scene_camera, 1 - 1e-5), 1);
    check_near(here.down, before.down, 1e-4);
    check_near(here.forward, before.forward, 1e-4);
    // Through look_at.
    const Flythrough through{2, false, {{0, {0, -3, 0}, {0, 0, 0}, {}, {}}, {2, {0, 3, 0}, {0, 0, 0}, {}, {}}}};
    const Camera middle = camera_at(through, scene_camera, 1);
    CHECK(middle.position == DVec3(0, 0, 0));
    REQUIRE(degenerate(middle) == nullptr);
    check_near(frame_of(middle, 1).forward, {0, 1, 0});
    // From one `up` to its opposite.
    const Flythrough flip{
        2, false, {{0, {0, -3, 0}, {0, 0, 0}, {}, DVec3(0, 0, -1)}, {2, {0, -3, 1}, {0, 0, 0}, {}, DVec3(0, 0, 1)}}};
    for (double t = 0; t <= 2; t += .125) CHECK(degenerate(camera_at(flip, scene_camera, t)) == nullptr);
}

TEST_CASE("extreme times and distances give finite cameras") {
    for (const double tiny : {5e-324, 1e-300, 1e-12})
        for (const double huge : {1., 1e9}) {
            const Flythrough path{huge,
                                  true,
                                  {{0, {huge, 0, 0}, {0, huge, 0}, 1e-300, {}},
                                   {tiny, {-huge, 0, 0}, {0, huge, 0}, 89., {}},
                                   {huge / 2, {tiny, tiny, 0}, {0, huge, 0}, 2., {}},
                                   {huge * .75, {0, tiny, 0}, {0, huge, tiny}, 2., {}}}};
            for (double share = 0; share <= 1; share += 1. / 64) {
                const Camera camera = camera_at(path, scene_camera, share * huge);
                CAPTURE(share);
                CHECK(degenerate(camera) == nullptr);
                CHECK((camera.fov >= 1e-300 && camera.fov <= 89));
                CHECK(std::fabs(camera.position.x) <= 2 * huge);
            }
        }
}

TEST_CASE("a material with a term of a finish is not plain, unless the term counts with others only") {
    const std::set<std::string> plain{"rgb",       "reflection", "refraction", "diffuse",    "ambient",
                                      "specular",  "pow",        "ior",        "normal",     "bump",
                                      "roughness", "falloff",    "film",       "fade_power", "fade_color"};
    const auto look = [&]<class V>(const Field<Material, V>& field) {
        Material own;
        if constexpr (std::is_same_v<V, double>)
            own.*field.member += .5;
        else if constexpr (!std::is_base_of_v<Relief, V>)
            own.*field.member = V(Color(.25));
        INFO(std::string(field.name));
        CHECK(own.plain() == plain.contains(field.name));
    };
    std::apply([&](const auto&... field) { (look(field), ...); }, Material::fields);
    Material coated;
    coated.coats.emplace_back();
    CHECK_FALSE(coated.plain());
}
