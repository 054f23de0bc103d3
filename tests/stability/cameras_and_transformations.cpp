// Cameras and transformations that are invalid, and some that are just valid.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "scene/camera.h"
#include "tests/stability/naive.h"
#include "tests/stability/stage.h"
#include "tests/unit/faults.h"
#include "text/parse.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

std::string fault(const std::string& text) {
    return fault_of([&] { parse_scene(text, "scene.rt"); });
}
const std::string camera = "camera { position <0,-6,0> look_at <0,0,0> sky <0,0,1> fov 20 }\n";

}  // namespace

TEST_CASE("a degenerate camera is an error with its line, not a frame of NaN") {
    const DVec3 none = DVec3(0) / std::sqrt(naive::times(DVec3(0), DVec3(0)));
    CHECK(std::isnan(none.x));  // up x forward, normalised
    for (const char* text : {
             "camera { position <0,10,0> look_at <0,10,0> sky <0,0,1> fov 20 }",
             "camera { position <0,10,0> look_at <0,0,0> sky <0,1,0> fov 20 }",
             "camera { position <0,10,0> look_at <0,0,0> sky <0,-3,0> fov 20 }",
             "camera { position <0,10,0> look_at <0,0,0> up <0,1e-300,0> fov 20 }",
             "camera { position <0,10,0> look_at <0,0,0> up <0,0,0> fov 20 }",
             "camera { position <0,10,0> look_at <0,0,0> sky <0,0,1> fov 0 }",
             "camera { position <0,10,0> look_at <0,0,0> sky <0,0,1> fov 90 }",
             "camera { position <0,10,0> look_at <0,0,0> sky <0,0,1> fov -10 }",
             "camera { position <0,10,0> look_at <0,0,0> sky <0,0,1> angle 180 }",
             "camera { position <0,10,0> look_at <0,0,0> sky <0,0,1> fov nan }",
             "camera { position <0,1e16,0> look_at <0,0,0> sky <0,0,1> fov 20 }",
         }) {
        CAPTURE(std::string(text));
        CHECK(fault(text).starts_with("scene.rt:1:"));
    }
}

TEST_CASE("invalid bodies and transformations are errors with their line") {
    CHECK(fault(camera) == "");
    for (const char* text : {
             "sphere { <0,0,0>, 0 }",
             "sphere { <0,0,0>, -1 }",
             "sphere { <0,0,0>, 1e-320 }",
             "sphere { <0,0,1e300>, 1 }",
             "sphere { <0,0,0>, 1 scale <1,0,1> }",
             "sphere { <0,0,0>, 1 scale 0 }",
             "plane { <0,0,0>, <1,1,1>, <2,2,2> }",
             "plane { <0,0,0>, <0,0,0>, <0,1,0> }",
             "plane { <0,0,0>, <1,0,0>, <1,1e-18,0> }",
             "cylinder { <1,2,3>, <1,2,3>, 1 }",
             "cylinder { <0,0,0>, <0,0,1>, 0 }",
             "sphere { <0,0,0>, 1 scale 1e300 scale 1e300 }",
             "sphere { <0,0,0>, 1 scale 1e-300 scale 1e-300 }",
         }) {
        CAPTURE(std::string(text));
        CHECK(fault(camera + text).starts_with("scene.rt:2:"));
    }
}

TEST_CASE("axes stay at right angles for any camera that a file may contain") {
    Dice dice;
    for (int i = 0; i < 2000; ++i) {
        const double far = std::pow(10, dice(-12, 14));
        Camera camera{dice.direction() * far, dice.direction() * far, {}, 20, {}};
        const DVec3 view = camera.look_at - camera.position;
        // Makes `up` anything from almost parallel to the view to much longer.
        camera.up = view / naive::length(view) + dice.direction() * std::pow(10, dice(-9, 1));
        camera.up = camera.up * std::pow(10, dice(-200, 14));
        if (degenerate(camera)) continue;
        const auto [right, down, forward, tan_x, tan_y] = frame_of(camera, 1.5);
        for (const DVec3& axis : {right, down, forward}) CHECK(std::abs(naive::length(axis) - 1) < 1e-14);
        CHECK(std::abs(naive::times(right, down)) < 1e-14);
        CHECK(std::abs(naive::times(right, forward)) < 1e-14);
        CHECK(std::abs(naive::times(down, forward)) < 1e-14);
    }
}

TEST_CASE("a lens of almost 90 degrees, and one of almost 0") {
    for (const double fov : {89.999999, 1e-9}) {
        Scene scene = still_life();
        scene.camera.fov = fov;
        for (const Precision precision : precisions) CHECK(not_finite(shoot(scene, precision)) == 0);
    }
}

TEST_CASE("neighbouring pixels of a narrow lens have different rays in double") {
    // 1920 pixels over .001 degrees, askew: float has no such directions.
    const DVec3 view{.36, .48, .8};
    const auto distinct = [&](auto zero, double fov) {
        using T = decltype(zero);
        const CameraFrame frame = frame_of({DVec3(0), view, {0, 0, -1}, fov / 2, {}}, 1.5);
        int different = 1;
        Vec3<T> last(T(0));
        for (int x = 928; x < 992; ++x) {
            const T u = static_cast<T>((2. * x + 1) / 1920 - 1);
            const Vec3<T> d = naive::to<T>(frame.forward) + naive::to<T>(frame.right * frame.tan_x) * u;
            different += x > 928 && d != last;
            last = d;
        }
        return different;
    };
    CHECK(distinct(0.f, 10) == 64);
    CHECK(distinct(0.f, .0001) < 16);
    CHECK(distinct(0., .0001) == 64);
    CHECK(distinct(0., 1e-9) > 60);
}

TEST_CASE("transformations that cancel do not move bodies") {
    const Scene plain = still_life();
    Scene turned = plain;
    for (Primitive& primitive : turned.primitives)
        for (const Transformation& step :
             {Transformation(Rotate{{0, 0, 90}}), Transformation(Scale{DVec3(4)}),
              Transformation(Translate{{8, -4, 2}}), Transformation(Translate{{-8, 4, -2}}),
              Transformation(Scale{DVec3(.25)}), Transformation(Rotate{{0, 0, -90}})})
            primitive.transformations.push_back(step);
    for (const Precision precision : precisions)
        CHECK(shoot(plain, precision, {48, 36}) == shoot(turned, precision, {48, 36}));
}
