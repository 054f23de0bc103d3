// Camera, input, flights and commands, without a window.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "num/vec_math.h"
#include "show/controls.h"
#include "show/framing.h"
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

TEST_CASE("keys push while they are down, each at once; a tap pushes once") {
    for (const auto& [key, direction] :
         {std::pair{Push::forward, DVec3(0, 0, 1)}, {Push::back, DVec3(0, 0, -1)}, {Push::left, DVec3(-1, 0, 0)}}) {
        Controls controls;
        CHECK(!controls.active(0));
        controls.press(key);
        controls.release(key);
        CHECK(controls.active(1.02));
        CHECK(controls.take(0.02).push == direction * 0.02);
        CHECK(!controls.active(1.03));
        CHECK(controls.take(0.02) == CameraInput{});
    }
    Controls controls;
    controls.press(Push::left);
    controls.press(Push::up);
    controls.faster = true;
    CHECK(controls.take(0.02).push == DVec3(-0.08, 0.08, 0));
    controls.press(Push::right);
    CHECK(controls.take(0.02).push.x == 0);
}

TEST_CASE("a drag is measured from where the button was pressed, and a click is none") {
    Pointer pointer;
    CHECK(!pointer.move(700, 500));
    pointer.press(10, 20);  // the window has become another one: the pointer did not move here
    CHECK(!pointer.move(11, 21));
    CHECK(!pointer.move(12, 22));
    CHECK(pointer.move(20, 24) == glm::dvec2(10, 4));
    CHECK(pointer.move(21, 24) == glm::dvec2(1, 0));
    pointer.release();
    CHECK(!pointer.move(90, 90));
    pointer.press(90, 90);
    CHECK(!pointer.move(91, 90));
}

TEST_CASE("a picture keeps its camera's proportions, or the view is widened to fill the window") {
    Camera camera{{0, -5, 0}, {0, 0, 0}, {0, 0, -1}, 30, 4. / 3};
    CHECK(framing(camera, 960, 720, false).area == ScreenArea{0, 0, 960, 720});
    CHECK(framing(camera, 1920, 1080, false).area == ScreenArea{240, 0, 1440, 1080});
    CHECK(framing(camera, 600, 900, false).area == ScreenArea{0, 225, 600, 450});
    CHECK(framing(camera, 1, 1000, false).area == ScreenArea{0, 499, 1, 1});
    for (const auto& [width, height] : {std::pair{1920, 1080}, {600, 900}, {960, 720}}) {
        const Framing full = framing(camera, width, height, true);
        CHECK(full.area == ScreenArea{0, 0, width, height});
        // Pixels are squares, and what was seen still is.
        const CameraFrame before = frame_of(camera, 1), after = frame_of(full.camera, double(width) / height);
        CHECK(after.tan_x / width == doctest::Approx(after.tan_y / height));
        CHECK(after.tan_x >= before.tan_x - 1e-12);
        CHECK(after.tan_y >= before.tan_y - 1e-12);
        CHECK(std::min(after.tan_x / before.tan_x, after.tan_y / before.tan_y) == doctest::Approx(1));
    }
    camera.aspectratio.reset();
    CHECK(framing(camera, 1920, 1080, false).area == ScreenArea{0, 0, 1920, 1080});
}

TEST_CASE("a turn of the mouse is taken once") {
    Controls controls;
    controls.drag(0.1, -0.2, 1);
    controls.drag(0.1, 0, 1.01);
    CHECK(controls.active(1.05));
    CHECK(controls.take(0.02) == CameraInput{.right = 0.2, .upwards = -0.2});
    CHECK(controls.take(0.02) == CameraInput{});
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
    session.follow(40.5);
    CHECK(session.steer({.right = 0.1}, 40.5).note == "flight ended at 0.5 s; F continues");
    CHECK(!session.flying());
    CHECK(session.steer({.right = 0.1}, 40.6).note == "");
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

TEST_CASE("keys make a path that can be pasted and flown") {
    Session session(scene_of(""));
    session.perform({Action::play}, 0);  // around the scene, for a while
    session.perform({Action::play}, 1.8);
    session.perform({Action::reset}, 2);
    CHECK(session.perform({Action::add_key}, 2).note == "key 1 added at 0 s; a path needs two");
    CHECK(session.perform({Action::copy_path}, 2).text == "");
    session.steer({.push = {0, 0, 0.1}}, 3);
    CHECK(session.perform({Action::add_key}, 3).note == "key 2 added at 3 s");
    session.perform({Action::reset}, 4);
    session.perform({Action::add_key}, 4);
    const auto pasted = scene_of(session.perform({Action::copy_path}, 4).text);
    REQUIRE(pasted->flythrough);
    CHECK(pasted->flythrough->keys.size() == 3);
    CHECK(pasted->flythrough->loop);  // it came back to where it began
    CHECK(pasted->flythrough->duration == 6);
    // From its start, whatever was flown before.
    CHECK(session.perform({Action::play}, 5).note == "flying from 0 s");
    CHECK(session.flight_path() == pasted->flythrough);
}

TEST_CASE("one steps through a flight, and goes to its ends and keys") {
    Session session(scene_of(path_text));
    const auto note = [&](Action action, int number = 0) { return session.perform({action, number}, 9).note; };
    CHECK(note(Action::step, 25) == "at 1 s");
    CHECK(session.paused());
    CHECK(note(Action::step, 1) == "at 1.04 s");
    CHECK(note(Action::step, -50) == "at 0 s");
    CHECK(note(Action::to_end) == "at 4 s");
    CHECK(session.camera.position == DVec3(-3, 0, 0));
    CHECK(note(Action::to_key, -1) == "key 2 at 2 s");
    CHECK(session.camera.position == DVec3(0, 2, 0));
    CHECK(note(Action::to_key, 1) == "key 3 at 4 s");
    CHECK(note(Action::to_key, 1) == "there is no key after");
    CHECK(note(Action::rewind) == "at 0 s");
    CHECK(session.camera.position == DVec3(1, 0, 0));
    CHECK(Session(scene_of("")).perform({Action::step, 1}, 0).note == "there is no path, and nothing moves");
}

TEST_CASE("keys are set, deleted and added, with undo and redo") {
    Session session(scene_of(path_text));
    const auto note = [&](Action action, int number = 0) { return session.perform({action, number}, 9).note; };
    const auto times = [&] {
        std::string text;
        for (const Keyframe& key : session.editor.path().keys) text += std::to_string(int(1000 * key.time)) + " ";
        return text;
    };
    session.go_to(1, 0);
    session.steer({.push = {1, 0, 0}}, 1);
    const Camera there = session.camera;
    CHECK(note(Action::set_key) == "key at 1 s set");
    CHECK(times() == "0 1000 2000 4000 ");
    session.go_to(1, 2);
    CHECK(session.camera.position == there.position);
    session.steer({.push = {1, 0, 0}}, 3);
    CHECK(note(Action::set_key) == "key at 1 s changed");
    CHECK(times() == "0 1000 2000 4000 ");
    CHECK(note(Action::delete_key) == "key at 1 s deleted");
    CHECK(session.editor.path() == *session.scene->flythrough);
    CHECK(note(Action::delete_key).starts_with("there is no key at 1 s"));
    CHECK(note(Action::undo) == "undone");
    CHECK(note(Action::undo) == "undone");
    CHECK(session.editor.path().keys[1].position == there.position);
    CHECK(note(Action::redo) == "redone");
    CHECK(session.editor.path().keys[1].position != there.position);
    CHECK(note(Action::add_key) == "key 5 added at 7 s");
    CHECK(session.editor.path().duration == 7);
    CHECK(note(Action::redo) == "there is nothing to redo");
    for (int i = 0; i < 3; ++i) CHECK(note(Action::undo) == "undone");
    CHECK(note(Action::undo) == "there is nothing to undo");
    CHECK(session.editor.path() == *session.scene->flythrough);
    // A new path replaces that of the scene, which stays within reach.
    CHECK(note(Action::clear_path) == "a new path");
    CHECK(note(Action::add_key) == "key 1 added at 0 s; a path needs two");
    note(Action::undo), note(Action::undo);
    session.perform({Action::rewind}, 10), session.perform({Action::pause}, 10);
    CHECK(session.flight_path() == session.scene->flythrough);
}

TEST_CASE("a path that was edited can be read again, whatever was done") {
    std::uint32_t state = 1;
    const auto random = [&](int n) { return static_cast<int>((state = state * 1664525 + 1013904223) >> 8) % n; };
    Session session(scene_of(path_text));
    const Action actions[] = {Action::add_key, Action::set_key, Action::delete_key, Action::undo,
                              Action::redo,    Action::reset,   Action::rewind,     Action::to_end};
    for (int i = 0; i < 3000; ++i) {
        session.perform({actions[random(8)]}, i);
        session.perform({Action::step, random(200) - 100}, i);
        if (random(3) == 0) session.perform({Action::to_key, random(2) * 2 - 1}, i);
        if (random(2) == 0) session.steer({.push = {random(9) / 9., 0, random(5) / 9.}}, i);
        if (random(300) == 0) session.perform({Action::clear_path}, i);
        const Flythrough& path = session.editor.path();
        if (!path.keys.empty() && random(2) == 0) {
            const auto number = std::size_t(random(int(path.keys.size())));
            session.editor.change(retimed(path, number, random(12000) / 1000.));
            session.path_changed(i);
        }
        if (path.keys.size() < 2) continue;
        const auto pasted = scene_of(write_flythrough(path));
        REQUIRE(pasted->flythrough == path);
    }
}

TEST_CASE("the wheel changes the speed of what moves the camera") {
    Session session(scene_of(path_text));
    const double speed = session.speed;
    CHECK(session.change_speed(2, 0).note.starts_with("speed "));
    CHECK(session.speed == 2 * speed);
    session.perform({Action::play}, 10);
    session.follow(11);
    CHECK(session.change_speed(0.5, 11).note == "flight at 0.5 times its speed");
    CHECK(session.speed == 2 * speed);
    CHECK(session.flight_time(11) == 1);
    session.follow(13);
    CHECK(session.flight_time(13) == 2);
}

TEST_CASE("cameras are stored, recalled and copied") {
    Session session(scene_of(""));
    session.perform({Action::store, 3}, 0);
    session.steer({.push = {1, 2, 3}, .right = 0.5}, 1);
    const Camera there = session.camera;
    CHECK(session.perform({Action::recall, 4}, 1).note.find("Shift+4") != std::string::npos);
    CHECK(session.camera == there);
    const std::string text = session.perform({Action::copy_camera}, 1).text;
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

TEST_CASE("a path that the file gets replaces the edited one, which can be had back") {
    Session session(scene_of(""));
    for (int i = 0; i < 2; ++i) {
        session.perform({Action::add_key}, i);
        session.steer({.push = {1, 0, 0}}, i);
    }
    const Flythrough edited = session.editor.path();
    CHECK(session.editor.changed());
    session.replace(scene_of("sphere { <0,0,0>, 1 }"), false);  // still without a path
    CHECK(session.editor.path() == edited);
    session.replace(scene_of(path_text), false);
    session.perform({Action::play}, 5);
    CHECK(session.flight_path() == session.scene->flythrough);
    CHECK(!session.editor.changed());
    session.perform({Action::undo}, 6);
    CHECK(session.editor.path() == edited);
}
