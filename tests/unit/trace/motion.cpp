// Bodies and lights that move: their values, their pictures, and what the language says of them.
#include <cmath>
#include <numbers>
#include <random>

#include "num/thread_pool.h"
#include "num/vec_math.h"
#include "scene/moving_scene.h"
#include "tests/unit/text/language.h"
#include "text/write.h"
#include "trace/tracer.h"

using namespace strahl;
using namespace strahl::language;

namespace {

DVec3 apply(const Motion& motion, double time, const DVec3& p) { return transform_point(matrix(at(motion, time)), p); }
Motion turning(const std::vector<DVec3>& keys) {
    Motion motion;
    for (const DVec3& key : keys) motion.keys.push_back({double(motion.keys.size()), {}, key, DVec3(1)});
    return motion;
}
void check_near(const DVec3& a, const DVec3& b, double tolerance = 1e-13) {
    INFO(a.x, " ", a.y, " ", a.z, " is not near ", b.x, " ", b.y, " ", b.z);
    CHECK(length(a - b) <= tolerance);
}
DVec3 around_z(double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return {std::cos(angle), std::sin(angle), 0};
}

Frame picture(const Scene& scene, double time, Precision precision = Precision::float64) {
    return render(scene, {.camera = scene.camera, .width = 60, .height = 45, .depth = 5, .time = time}, precision);
}

}  // namespace

TEST_CASE("a motion is exactly at its keys, and waits before the first and after the last") {
    const MotionKey first{1, {1, 2, 3}, {10, 20, 30}, {1, 2, 3}}, last{3, {-1, 7, 3}, {400, 20, 30}, {2, .5, 3}};
    const Motion motion{{first, {2, {0, 0, 1}, {0, 90, 0}, DVec3(1)}, last}};
    for (const double time : {-1., 0., 1.}) CHECK(key_at(motion, time) == first);
    for (const double time : {3., 4., 1e9}) CHECK(key_at(motion, time) == last);
    CHECK(key_at(motion, 2) == motion.keys[1]);
    CHECK(at(motion, 1) == std::vector<Transformation>{Scale{{1, 2, 3}}, Rotate{{10, 20, 30}}, Translate{{1, 2, 3}}});
    CHECK(at(motion, 2) == std::vector<Transformation>{Rotate{{0, 90, 0}}, Translate{{0, 0, 1}}});
}

TEST_CASE("what moves follows the curve of the flight") {
    Flythrough path{4, false, {}};
    Motion motion;
    const double times[] = {0, 1, 1.5, 4}, eases[] = {0, 0, .5, 1};
    const DVec3 places[] = {{0, 0, 0}, {3, 1, 0}, {3, 4, 2}, {-2, 4, 9}};
    for (int i = 0; i < 4; ++i) {
        path.keys.push_back({times[i], places[i], {50, 60, 70}, {}, {}, eases[i]});
        motion.keys.push_back({times[i], places[i], {}, DVec3(1), {}, eases[i]});
    }
    for (double time = -.5; time < 5; time += .07)
        CHECK(key_at(motion, time).translate == camera_at(path, {}, time).position);
}

TEST_CASE("rotations go the shorter way, evenly where keys are even, and half a turn as written") {
    for (double time = 0; time < 3; time += .09) {
        check_near(apply(turning({{0, 0, 0}, {0, 0, 120}, {0, 0, 240}, {0, 0, 360}}), time, {1, 0, 0}),
                   around_z(120 * time));
        check_near(apply(turning({{0, 0, 0}, {0, 0, -180}, {0, 0, -360}, {0, 0, -540}}), time, {1, 0, 0}),
                   around_z(-180 * time));
    }
    check_near(apply(turning({{0, 0, 10}, {0, 0, 350}}), .5, {1, 0, 0}), {1, 0, 0});
    check_near(apply(turning({{0, 0, 30}, {0, 0, 210}}), .5, {1, 0, 0}), around_z(120));
    // Between two keys about one axis, which is neither x, y nor z: half of the angle at half of the time.
    const Motion two = turning({{0, 0, 0}, {90, 90, 0}});
    const glm::dmat4 half = matrix(at(two, .5));
    const DVec3 twice = transform_point(half, transform_point(half, {1, 2, 3}));
    check_near(twice, apply(two, 1, {1, 2, 3}));
    // If the angle about y is 90 degrees, rotations about x and z are about the same axis.
    for (double time = 0; time < 2; time += .11) {
        const DVec3 p = apply(turning({{0, 90, 0}, {0, 90, 60}, {0, 90, 120}}), time, {0, 1, 0});
        check_near(p, around_z(90 + 60 * time));
    }
    // Between two ways to write the same rotation nothing turns.
    check_near(apply(turning({{0, 0, 30}, {180, 180, 210}}), .3, {1, 2, 3}),
               transform_point(matrix(std::vector<Transformation>{Rotate{{0, 0, 30}}}), {1, 2, 3}));
}

TEST_CASE("speed is continuous at keys, also that of rotations") {
    const Motion motion{{{0, {0, 0, 0}, {0, 0, 0}, {1, 1, 1}},
                         {1, {1, 0, 0}, {0, 70, 20}, {1, 2, 1}},
                         {1.7, {1, 2, 0}, {50, 100, 20}, {3, 4, 1}},
                         {3, {4, 2, 1}, {50, 10, -90}, {3, 1, 1}}}};
    for (const double key : {1., 1.7}) {
        constexpr double h = 1e-6;
        for (const DVec3& p : {DVec3(1, 0, 0), DVec3(0, 1, 2)}) {
            const DVec3 here = apply(motion, key, p);
            const DVec3 before = (here - apply(motion, key - h, p)) / h, after = (apply(motion, key + h, p) - here) / h;
            check_near(before, after, 1e-4);
            CHECK(length(before) > .1);
        }
    }
    for (double time = 0; time < 3; time += .01) {
        const DVec3 scale = key_at(motion, time).scale;
        CHECK((scale.x >= 1 && scale.x <= 3 && scale.y >= 1 && scale.y <= 4 && scale.z == 1));
    }
}

namespace {

const std::string world =
    "light { position <-4,-6,8> color <.8,.8,.8> LAMP }\n"
    "light { direction <1,1,-2> color <.2,.2,.2> SUN }\n"
    "plane { <0,0,0>, <1,0,0>, <0,1,0> }\n"
    "define ball sphere { <0,0,1>, 1 material { rgb checker { <1,0,0>, <0,1,1> scale .5 } } scale .75 BALL }\n"
    "ball { translate <2,1,0> }\n"
    "difference { box { <-1,-1,0>, <1,1,1.5> } sphere { <0,0,1.5>, .75 PART } WHOLE translate <-2,0,.5> }\n"
    "mesh { triangle { <0,0,0>, <1,0,0>, <0,0,1> } MESH }\n"
    "sphere { <0,-2,1>, .5 material { refraction .7 ior 1.3 } GLASS }\n";

/// The world with each of its moving things replaced by motion(its number).
template <class Text>
Scene world_with(const Text& motion) {
    std::string text = world;
    int number = 0;
    for (const char* name : {"LAMP", "SUN", "BALL", "PART", "WHOLE", "MESH", "GLASS"})
        text.replace(text.find(name), std::string(name).size(), motion(number++));
    return parse_scene("camera { position <0,-9,4> look_at <0,0,1> sky <0,0,1> angle 45 }\n" + text, "test");
}
const std::string moved_to[] = {"translate <1,-2,.5>",
                                "rotate <0,0,90>",
                                "scale 1.5 translate <0,.25,0>",
                                "translate <.5,0,0>",
                                "rotate <0,0,90> translate <0,0,.25>",
                                "scale <1,1,2> rotate <0,0,180> translate <1,2,0>",
                                "scale <1,1,.5>"};

}  // namespace

TEST_CASE("a picture at a key is that of the scene with the key's transformations written out") {
    const Scene moving = world_with([](int i) {
        return "motion { key { time .5 rotate <9,0,7> } key { time 1 " + moved_to[i] +
               " } key { time 2 translate <1,1,1> } }";
    });
    Scene still = world_with([](int i) { return i < 2 ? std::string() : moved_to[i]; });
    still.lights[0].position += DVec3(1, -2, .5);
    still.lights[1].direction = DVec3(-1, 1, -2);
    for (const Precision precision : {Precision::float32, Precision::float64, Precision::extended})
        CHECK(picture(moving, 1, precision) == picture(still, 0, precision));
    CHECK(at(moving, 1) == still);
    CHECK(picture(moving, 1.1) != picture(still, 0));
    CHECK(picture(moving, 0) == picture(at(moving, .5), 0));  // waits for its first key
    CHECK(picture(moving, 1.1) == picture(at(moving, 1.1), 0));
}

TEST_CASE("pictures do not depend on the moments traced before, nor on averages") {
    const Scene moving = world_with([](int i) {
        return "motion { key { time 0 } key { time 1 " + moved_to[i] + " } key { time 2 translate <1,1,.5> } }";
    });
    Tracer tracer(moving, Precision::float32);
    ThreadPool pool(2);
    const auto traced = [&](Tracer& with, double time, const Sampling& sampling) {
        const View view{.camera = moving.camera, .width = 30, .height = 20, .time = time};
        return values_of(with, view, {.columns = 30, .rows = 20}, pool, sampling);
    };
    for (const double time : {1.3, 0., .4, 1.3, 2., 0.})
        for (const Sampling& sampling : {Sampling{}, Sampling{.grid = 1}}) {
            Tracer fresh(at(moving, time), Precision::float32);
            CHECK(traced(tracer, time, sampling) == traced(fresh, 0, sampling));
        }
}

TEST_CASE("among many bodies pictures do not depend on the moments traced before, glass or none") {
    for (const bool glass : {false, true}) {
        std::string text =
            "camera { position <0,-30,9> look_at <0,0,0> sky <0,0,1> angle 45 }\n"
            "light { position <-9,-20,30> color <1,1,1> } defaultmaterial { reflection .3 }\n";
        std::mt19937 random(2);
        for (int i = 0; i < 400; ++i) {
            const auto place = [&random] {
                const auto one = [&random] { return std::to_string(int(random() % 2000) - 1000) + "e-2"; };
                return "<" + one() + "," + one() + "," + one() + ">";
            };
            text += "sphere { <0,0,0>, .6 motion { key { time 0 translate " + place() + " } key { time 1 translate " +
                    place() + " } } material { rgb <." + std::to_string(31 + i * 7 % 68) + ",.7,.9> " +
                    (glass ? "refraction .93" : "") + " } }\n";
        }
        const Scene moving = parse_scene(text, "test");
        Tracer tracer(moving, Precision::float32);
        ThreadPool pool(2);
        for (const double time : {0., .03, .06, .09, .5, .9, .86}) {
            CAPTURE(time);
            const View view{.camera = moving.camera, .width = 60, .height = 45, .depth = 5, .time = time};
            const Frame frame{60, 45, values_of(tracer, view, {.columns = 60, .rows = 45}, pool)};
            CHECK(frame == picture(at(moving, time), 0, Precision::float32));
        }
    }
}

TEST_CASE("a scene lasts until its last key, and begins anew with a flythrough that loops") {
    const std::string ball = "sphere { <0,0,0>, 1 motion { key { time 1 } key { time 5 translate <4,0,0> } } }";
    const std::string keys =
        " key { time 0 position <0,-9,0> look_at <0,0,0> } key { time 2 position <0,9,0> look_at <0,0,1> } }";
    CHECK(!flight_of(with_eye("sphere { <0,0,0>, 1 }")));
    CHECK(flight_of(with_eye(ball))->duration == 5);
    CHECK(flight_of(with_eye(ball))->keys.empty());
    CHECK(flight_of(with_eye(ball + "flythrough { duration 2" + keys))->duration == 5);
    const Scene loop = with_eye(ball + "flythrough { duration 4 loop" + keys);
    CHECK(flight_of(loop)->duration == 4);
    CHECK(at(loop, 11) == at(loop, 3));
    CHECK(at(loop, 3).primitives[0].transformations == std::vector<Transformation>{Translate{{2, 0, 0}}});
    CHECK(at(with_eye(ball), 11).primitives[0].transformations == std::vector<Transformation>{Translate{{4, 0, 0}}});
}

TEST_CASE("the language of motions") {
    const Scene scene = with_eye(
        "sphere { <0,0,0>, 1 scale 2 motion { key { scale 3 translate <1,2,3> time 0 } key { time 1 rotate <4,5,6> } }"
        " translate <7,8,9> motion { key { time 0 } key { time 3 scale <1,2,3> } } }");
    const Motion first{{{0, {1, 2, 3}, {0, 0, 0}, DVec3(3)}, {1, {0, 0, 0}, {4, 5, 6}, DVec3(1)}}};
    const Motion second{{{0, {0, 0, 0}, {0, 0, 0}, DVec3(1)}, {3, {0, 0, 0}, {0, 0, 0}, {1, 2, 3}}}};
    const std::vector<Transformation> steps{Scale{DVec3(2)}, first, Translate{{7, 8, 9}}, second};
    CHECK(scene.primitives[0].transformations == steps);
    CHECK(parse_scene(write_scene(scene), "written") == scene);
    CHECK(write_scene(scene).ends_with(R"(
sphere { <0, 0, 0>, 1
  scale 2
  motion {
    key { time 0  scale 3  translate <1, 2, 3> }
    key { time 1  rotate <4, 5, 6> }
  }
  translate <7, 8, 9>
  motion {
    key { time 0 }
    key { time 3  scale <1, 2, 3> }
  }
}
)"));
    // A defined body keeps its motion, and transformations where it is used come after that.
    CHECK(with_eye("define ball sphere { <0,0,0>, 1 motion { key { time 0 } key { time 1 translate <1,0,0> } } }"
                   "ball { rotate <0,0,9> }") ==
          with_eye("sphere { <0,0,0>, 1 motion { key { time 0 } key { time 1 translate <1,0,0> } } rotate <0,0,9> }"));
}

TEST_CASE("mistakes in motions") {
    const auto check_motion = [](const std::string& keys, const std::string& fault) {
        check_fault("sphere { <0,0,0>, 1\nmotion { " + keys + " } }", fault);
        check_fault("light { position <1,2,3> color <1,1,1>\nmotion { " + keys + " } }", fault);
    };
    const std::string too_few = "3:1: 'motion' lacks keys: a motion needs at least 2";
    check_motion("", too_few);
    check_motion("key { time 1 }", too_few);
    check_motion("key { time 1 } key { translate <1,2,3> }", "3:25: 'key' lacks 'time' (or 'beat')");
    check_motion("key { time 1 }\nkey { time 1 }",
                 "4:7: times must increase: the key before, in line 3, is not earlier than this one");
    check_motion("key { time -1 } key { time 2 }", "3:21: 'time' of 'key' must be from 0 to 1e9, not '-1'");
    check_motion("key { time 0 scale 0 } key { time 2 }",
                 "3:29: 'scale' of 'key' is 0, which would leave nothing of it; 1 changes nothing");
    check_motion("key { time 0 scale <1,1,-1> }\nkey { time 2 scale <1,2,3> }",
                 "4:14: 'scale' would pass 0 on the way to this key: give it the sign of the key before, in line 3");
    check_motion("key { time 0 scale -1 }\nkey { time 2 }",
                 "4:1: 'scale' would pass 0 on the way to this key: give it the sign of the key before, in line 3");
    check_motion("key { time 0 position <0,0,0> } key { time 1 }",
                 "3:23: unknown word 'position' in 'key'; known here: time, beat, scale, rotate, translate, ease");
    check_motion("key { time 0 time 1 } key { time 2 }", "3:23: a second 'time'; the first is in line 3");
    check_motion("kye { time 0 }", "3:10: unknown word 'kye' in 'motion'; did you mean 'key'?");
    check_fault(
        "light { position <1,2,3> color <1,1,1> motion { key { time 0 } key { time 1 } }\nmotion { key { time 0 "
        "} key { time 1 } } }",
        "3:1: a second 'motion'; the first is in line 2");
    check_fault(
        "sphere { <0,0,0>, 1 motion { key { time 0 } key { time 1 scale 1e300 } } }",
        "2:21: invalid sphere: the transformations up to here at 1 s make it too large, too small or too far away "
        "(coordinates go up to 1e9)");
    check_fault(
        "light { position <1,2,3> color <1,1,1> motion { key { time 0 } key { time 2 scale <1,1,1e-13> } } }",
        "2:40: invalid light: at 2 s its transformations flatten it: one side shrinks more than 1e12 times as much as "
        "another");
    for (const std::string block :
         {"camera { position <0,0,0> ", "defaultmaterial { ", "background { ", "sphere { <0,0,0>, 1 material { "})
        CHECK(message(eye + block + "motion { key { time 0 } } }").find("unknown word 'motion' in '") != block.npos);
    TextLimits limits;
    limits.keys = 2;
    const std::string three = "sphere { <0,0,0>, 1 motion { key { time 0 } key { time 1 } key { time 2 } } }";
    CHECK_THROWS_WITH(parse_scene(eye + three, "x", limits), doctest::Contains("more than 2 keys"));
}
