// Camera, input, flights and commands, without a window.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "num/vec_math.h"
#include "show/controls.h"
#include "show/session.h"
#include "text/parse.h"
#include "text/write.h"

using namespace strahl;

namespace {

const Camera camera{{5, -20, 18}, {0, 0, 0}, {0, 0, -1}, 25, {}};

double distance(const DVec3& a, const DVec3& b) { return length(a - b); }
const DVec3 sky{0, 0, 1};

std::shared_ptr<const Scene> scene_of(const std::string& more) {
    return std::make_shared<const Scene>(
        parse_scene("camera { position <5,-20,18> look_at <0,0,0> up <0,0,-1> fov 25 }\n" + more, "test"));
}
const std::string path_text =
    "flythrough { duration 4 key { time 0 position <1,0,0> look_at <0,0,0> }"
    " key { time 2 position <0,2,0> look_at <0,0,1> } key { time 4 position <-3,0,0> look_at <0,0,0> } }";

}  // namespace

TEST_CASE("flying keeps the direction, and goes where the picture's axes point") {
    const CameraFrame frame = frame_of(camera, 1);
    for (int axis = 0; axis < 3; ++axis) {
        CameraInput input;
        input.push[axis] = 2;
        const Camera moved = fly(camera, input);
        const DVec3 way = moved.position - camera.position;
        const DVec3 expected = axis == 0 ? frame.right : axis == 1 ? sky : frame.forward;
        CHECK(distance(way, expected * 2.) < 1e-12);
        CHECK(distance(moved.look_at - moved.position, camera.look_at - camera.position) < 1e-12);
    }
    CHECK(fly(camera, {}) == camera);
}

TEST_CASE("turning keeps the position, the distance to look_at, and a level horizon") {
    const CameraFrame before = frame_of(camera, 1);
    const Camera turned = fly(camera, {.right = 0.1, .upwards = 0.05});
    const CameraFrame after = frame_of(turned, 1);
    CHECK(turned.position == camera.position);
    CHECK(turned.up == camera.up);
    CHECK(std::abs(distance(turned.position, turned.look_at) - distance(camera.position, camera.look_at)) < 1e-9);
    CHECK(dot_product(after.forward, before.right) > 0.01);
    CHECK(after.forward.z > before.forward.z + 0.03);
    CHECK(std::abs(std::asin(after.forward.z) - std::asin(before.forward.z) - 0.05) < 1e-9);
    // Straight up is never reached, and the way back is the same.
    Camera up = camera;
    for (int i = 0; i < 100; ++i) up = fly(up, {.upwards = 0.1});
    CHECK(degenerate(up) == nullptr);
    CHECK(std::abs(std::asin(frame_of(up, 1).forward.z) * 180 / std::numbers::pi - 89) < 1e-6);
    CHECK(distance(fly(turned, {.right = -0.1, .upwards = -0.05}).look_at, camera.look_at) < 1e-9);
}

TEST_CASE("orbiting keeps look_at, and the distance unless pushed") {
    const double away = distance(camera.position, camera.look_at);
    const CameraFrame frame = frame_of(camera, 1);
    const Camera right = orbit(camera, {.push = {0.1, 0, 0}});
    CHECK(right.look_at == camera.look_at);
    CHECK(dot_product(right.position - camera.position, frame.right) > 0.5);
    CHECK(std::abs(distance(right.position, right.look_at) - away) < 1e-9);
    CHECK(orbit(camera, {.push = {0, 0.1, 0}}).position.z > camera.position.z + 0.5);
    const Camera near = orbit(camera, {.push = {0, 0, std::log(2)}});
    CHECK(std::abs(distance(near.position, near.look_at) - away / 2) < 1e-9);
    Camera all_around = camera;
    for (int i = 0; i < 8; ++i) all_around = orbit(all_around, {.right = std::numbers::pi / 4});
    CHECK(distance(all_around.position, camera.position) < 1e-9);
    // At any distance the camera stays valid.
    Camera nearest = camera;
    for (int i = 0; i < 1000; ++i) nearest = orbit(nearest, {.push = {0, 0, 1}});
    CHECK(degenerate(nearest) == nullptr);
}

TEST_CASE("keys push while they are down; a tap pushes once") {
    Controls controls;
    CHECK(!controls.active(0));
    controls.press(Push::forward, 1);
    CHECK(!controls.release(Push::forward, 1.01));
    CHECK(controls.active(1.02));
    CHECK(controls.take(0.02, 1.02).push == DVec3(0, 0, 0.02));
    CHECK(!controls.active(1.03));
    CHECK(controls.take(0.02, 1.04) == CameraInput{});

    controls.press(Push::left, 2);
    controls.press(Push::up, 2);
    controls.faster = true;
    CHECK(controls.take(0.02, 2.5).push == DVec3(-0.08, 0.08, 0));
    controls.press(Push::right, 2.5);
    CHECK(controls.take(0.02, 2.5).push.x == 0);
}

TEST_CASE("the key back is either a tap or a push") {
    Controls controls;
    controls.press(Push::back, 1);
    CHECK(controls.take(0.02, 1.1) == CameraInput{});
    CHECK(controls.release(Push::back, 1.15));
    CHECK(controls.take(0.02, 1.16) == CameraInput{});
    CHECK(!controls.active(1.16));

    controls.press(Push::back, 2);
    CHECK(controls.take(0.02, 2.3).push.z == -0.02);
    CHECK(!controls.release(Push::back, 2.4));

    controls.press(Push::right, 3);
    controls.press(Push::back, 3);
    CHECK(controls.take(0.02, 3.01).push == DVec3(0.02, 0, -0.02));
    CHECK(!controls.release(Push::back, 3.02));
    CHECK(!controls.release(Push::back, 3.03));  // was not down
}

TEST_CASE("a turn of the mouse is taken once") {
    Controls controls;
    controls.drag(0.1, -0.2, 1);
    controls.drag(0.1, 0, 1.01);
    CHECK(controls.active(1.05));
    CHECK(controls.take(0.02, 1.05) == CameraInput{.right = 0.2, .upwards = -0.2});
    CHECK(controls.take(0.02, 1.06) == CameraInput{});
    CHECK(!controls.active(1.2));
}

TEST_CASE("a flight follows the clock at any frame rate and can be paused") {
    Session session(scene_of(path_text));
    session.perform({Action::play}, 10);
    CHECK(session.under_way());
    session.follow(12);
    CHECK(session.camera == camera_at(*session.scene->flythrough, session.scene->camera, 2));
    const Answer paused = session.perform({Action::pause}, 13);
    CHECK(paused.note == "paused at 3 s");
    CHECK(!session.follow(20));
    CHECK(session.camera == camera_at(*session.scene->flythrough, session.scene->camera, 3));
    session.perform({Action::pause}, 30);
    session.follow(30.5);
    CHECK(session.camera == camera_at(*session.scene->flythrough, session.scene->camera, 3.5));
    CHECK(session.follow(31.5));  // over
    CHECK(!session.flying());
    CHECK(session.camera.position == DVec3(-3, 0, 0));
    session.perform({Action::play}, 40);  // from its beginning again
    CHECK(session.camera.position == DVec3(1, 0, 0));
    session.steer({.right = 0.1}, 40.5);
    CHECK(!session.flying());
    CHECK(session.camera.position == DVec3(1, 0, 0));
    session.perform({Action::play}, 50);  // where it was left
    CHECK(session.flight_time(50) == 0.5);
}

TEST_CASE("a flight can start at any moment") {
    Session session(scene_of(path_text));
    CHECK(session.go_to(2.5, 7));
    CHECK(session.paused());
    CHECK(session.camera == camera_at(*session.scene->flythrough, session.scene->camera, 2.5));
    CHECK(!Session(scene_of("")).go_to(1, 0));
}

TEST_CASE("what moves plays without a flythrough, and the camera is free meanwhile") {
    Session session(scene_of("sphere { <0,0,0>, 1 motion { key { time 1 } key { time 5 translate <1,0,0> } } }"));
    CHECK(session.time == 0);
    session.perform({Action::play}, 10);
    session.follow(12.5);
    CHECK(session.time == 2.5);
    CHECK(session.camera == camera);
    session.steer({.push = {1, 0, 0}}, 13);
    CHECK(session.under_way());
    const Camera there = session.camera;
    session.follow(14);
    CHECK(session.time == 4);
    CHECK(session.camera == there);
    CHECK(there != camera);
    CHECK(session.perform({Action::pause}, 14.25).note == "paused at 4.25 s");
    CHECK(session.time == 4.25);
    session.perform({Action::pause}, 20);
    CHECK(session.follow(21));  // over
    CHECK(!session.flying());
    CHECK(session.camera == there);
    CHECK(session.go_to(1.5, 30));
    CHECK(session.time == 1.5);
    CHECK(session.paused());
}

TEST_CASE("without a flythrough the flight orbits the scene") {
    Session session(scene_of(""));
    session.perform({Action::play}, 0);
    CHECK(distance(session.camera.position, camera.position) < 1e-9);
    const double away = length(camera.position);
    for (double t = 0; t < 40; t += 0.37) {
        session.follow(t);
        CHECK(session.camera.look_at == camera.look_at);
        CHECK(std::abs(length(session.camera.position) / away - 1) < 1e-4);
        CHECK(std::abs(session.camera.position.z - 18) < 1e-9);
    }
    session.follow(20);
    CHECK(distance(session.camera.position, {-5, 20, 18}) < 1e-3);
    session.follow(400);
    CHECK(session.under_way());
    CHECK(distance(session.camera.position, camera.position) < 1e-6);
}

TEST_CASE("recorded keys make a path that can be pasted and flown") {
    Session session(scene_of(""));
    CHECK(session.perform({Action::record}, 0).print == "");
    session.steer({.push = {0, 0, 0.1}}, 1);
    CHECK(session.perform({Action::record}, 1).print != "");
    session.perform({Action::reset}, 2);
    const std::string text = session.perform({Action::record}, 2).print;
    const auto pasted = scene_of(text);
    REQUIRE(pasted->flythrough);
    CHECK(pasted->flythrough->keys.size() == 3);
    CHECK(pasted->flythrough->loop);  // it came back to where it began
    CHECK(pasted->flythrough->duration == 6);
    session.perform({Action::play}, 5);
    CHECK(session.flight_path() == pasted->flythrough);
}

TEST_CASE("cameras are stored, recalled and printed") {
    Session session(scene_of(""));
    session.perform({Action::store, 3}, 0);
    session.steer({.push = {1, 2, 3}, .right = 0.5}, 1);
    const Camera there = session.camera;
    CHECK(session.perform({Action::recall, 4}, 1).note.find("Shift+4") != std::string::npos);
    CHECK(session.camera == there);
    const std::string text = session.perform({Action::print_camera}, 1).print;
    CHECK(parse_scene(text, "test").camera == there);
    session.perform({Action::recall, 3}, 1);
    CHECK(session.camera == camera);
}

TEST_CASE("depth and resolution stay within their limits") {
    Session session(scene_of("global_settings { max_trace_level 2 }"));
    CHECK(session.depth() == 2);
    for (int i = 0; i < 5; ++i) session.perform({Action::shallower}, 0);
    CHECK(session.depth() == 1);
    for (int i = 0; i < 300; ++i) session.perform({Action::deeper}, 0), session.perform({Action::coarser}, 0);
    CHECK(session.depth() == 256);
    CHECK(session.finest == 0);
    for (int i = 0; i < 20; ++i) session.perform({Action::finer}, 0);
    CHECK(session.finest == finest_level);
}

TEST_CASE("after a change of the file the camera stays, unless the file's camera changed") {
    Session session(scene_of(""));
    session.steer({.push = {1, 0, 0}}, 0);
    const Camera there = session.camera;
    session.replace(scene_of("sphere { <0,0,0>, 1 }"), false);
    CHECK(session.camera == there);
    CHECK(session.scene->primitives.size() == 1);
    auto other = std::make_shared<Scene>(*session.scene);
    other->camera.fov = 30;
    session.replace(other, false);
    CHECK(session.camera == other->camera);
    session.steer({.push = {1, 0, 0}}, 0);
    session.replace(scene_of(""), true);  // another file
    CHECK(session.camera == camera);
}

TEST_CASE("a flight continues along the changed path") {
    Session session(scene_of(path_text));
    session.perform({Action::play}, 0);
    auto other = std::make_shared<Scene>(*session.scene);
    other->flythrough->keys[1].position = {0, 5, 0};
    session.replace(other, false);
    CHECK(session.under_way());
    session.follow(2);
    CHECK(session.camera.position == DVec3(0, 5, 0));
    session.replace(scene_of(""), false);
    CHECK(!session.flying());
}

TEST_CASE("a pause is at a time with few digits") {
    Session session(scene_of(path_text));
    session.perform({Action::play}, 0);
    CHECK(session.perform({Action::pause}, 1.23456).note == "paused at 1.235 s");
    CHECK(session.camera == camera_at(*session.scene->flythrough, session.scene->camera, 1.235));
}

TEST_CASE("a recorded path is dropped when one is pasted into the file") {
    Session session(scene_of(""));
    for (int i = 0; i < 2; ++i) {
        session.perform({Action::record}, i);
        session.steer({.push = {1, 0, 0}}, i);
    }
    session.replace(scene_of(path_text), false);
    session.perform({Action::play}, 5);
    CHECK(session.flight_path() == session.scene->flythrough);
}
