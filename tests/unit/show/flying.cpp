// Camera, input and commands, without a window.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "num/vec_math.h"
#include "show/session/framing.h"
#include "show/session/handles.h"
#include "show/window/controls.h"
#include "tests/unit/show/flight_scene.h"

using namespace strahl;

TEST_CASE("flying keeps the direction, and goes where the picture's axes point") {
    const CameraFrame frame = frame_of(camera, 1);
    for (int axis = 0; axis < 3; ++axis) {
        CameraInput input;
        input.push[axis] = 2;
        const Camera moved = fly(camera, input);
        const DVec3 way = moved.position - camera.position;
        const DVec3 expected = axis == 0 ? frame.right : axis == 1 ? DVec3(0, 0, 1) : frame.forward;
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
    // The camera stops one degree before straight up; turning back by the same angles ends at the same view.
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

TEST_CASE("views from the sides keep look_at, the distance and a level horizon, whatever is up") {
    const double away = distance(camera.position, camera.look_at);
    for (const DVec3& up : {DVec3(0, 0, 1), DVec3(0, 1, 0), DVec3(1, 0, 0), DVec3(0, -1, 0)}) {
        Camera own = camera;
        own.up = DVec3(0) - up;
        const auto direction = [&](const Camera& c) { return normalize(c.look_at - c.position); };
        const Camera front = seen_from(own, 1), right = seen_from(own, 3), above = seen_from(own, 7);
        for (const Camera& seen : {front, right, above, seen_from(right, 9)}) {
            CHECK(seen.look_at == own.look_at);
            CHECK(seen.up == own.up);
            CHECK(std::abs(distance(seen.position, seen.look_at) - away) < 1e-9);
        }
        CHECK(std::abs(dot_product(direction(front), up)) < 1e-12);
        CHECK(distance(frame_of(front, 1).right, DVec3(0) - direction(right)) < 1e-9);
        CHECK(dot_product(direction(above), up) < -.999);
        CHECK(distance(direction(seen_from(right, 9)), DVec3(0) - direction(right)) < 1e-9);
        CHECK(distance(seen_from(front, 1).position, front.position) < 1e-9);
    }
}

TEST_CASE("the wheel changes the distance, or with Ctrl the speed; the middle button turns around what is seen") {
    Session session(scene_of(""));
    CHECK(session.turn_wheel(1, true, 0).note.starts_with("speed "));
    CHECK(session.camera == camera);
    session.steer({.right = .3, .around = true}, 1);
    CHECK(session.camera.look_at == camera.look_at);
    CHECK(distance(session.camera.position, camera.position) > .1);
    const double before = distance(session.camera.position, camera.look_at);
    session.turn_wheel(1, false, 3);
    CHECK(distance(session.camera.position, camera.look_at) == doctest::Approx(before * std::exp(-.15)));
    session.turn_wheel(-1, false, 4);
    CHECK(distance(session.camera.position, camera.look_at) == doctest::Approx(before));
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

TEST_CASE("sticks of a gamepad push and turn in proportion, and rest near their middle") {
    Controls controls;
    controls.tilt({0.1, -0.1, 0.14}, 0.1, -0.1);
    CHECK(!controls.active(1));
    CHECK(controls.take(0.02) == CameraInput{});
    controls.tilt({1, 0, -1}, -1, 0);
    CHECK(controls.active(1));
    CHECK(controls.take(0.02).push == DVec3(0.02, 0, -0.02));
    CHECK(controls.take(0.02).right == doctest::Approx(-0.03));
    controls.tilt({0.5, 0, 0}, 0, 0);
    CHECK(controls.take(0.02).push.x > 0);
    CHECK(controls.take(0.02).push.x < 0.01);
    controls.tilt({0, 0, 0}, 0, 0);
    CHECK(!controls.active(1));
}

TEST_CASE("a drag is measured from where the button was pressed, and a click is not a drag") {
    Pointer pointer;
    CHECK(!pointer.move(700, 500));
    pointer.leave();
    pointer.press({10, 20});  // the window has become another one: the pointer did not move here
    CHECK(!pointer.move(11, 21));
    CHECK(!pointer.move(12, 22));
    CHECK(pointer.move(20, 24) == glm::dvec2(10, 4));
    CHECK(pointer.move(21, 24) == glm::dvec2(1, 0));
    pointer.release();
    CHECK(!pointer.move(90, 90));
    pointer.press({90, 90});
    CHECK(!pointer.move(91, 90));
    pointer.release();
    // Events that waited: when the program hears of the press the pointer is at the drag's end already.
    pointer.press({131, 110});
    CHECK(pointer.move(111, 100) == glm::dvec2(20, 10));
    CHECK(pointer.move(131, 110) == glm::dvec2(20, 10));
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
        // Pixels are squares, and all that was visible still is.
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
    controls.drag(0.1, -0.2, false, 1);
    controls.drag(0.1, 0, true, 1.01);
    CHECK(controls.active(1.05));
    CHECK(controls.active(9));  // it is not lost, however late it is taken
    CHECK(controls.take(0.02) == CameraInput{.right = 0.2, .upwards = -0.2, .around = true});
    CHECK(controls.take(0.02) == CameraInput{});
    CHECK(!controls.active(1.2));
}

TEST_CASE(
    "a drag with Shift and the middle button carries what is seen along; the wheel ends a flight, but not with Ctrl") {
    Controls controls;
    controls.pan({.25, .125}, 1);
    const CameraInput input = controls.take(.02);
    CHECK(input == CameraInput{.pan = {.25, .125}});
    CHECK(controls.take(.02) == CameraInput{});
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        View before{.camera = camera, .width = 400, .height = 400};
        before.camera.aspectratio.reset(), before.camera.projection = projection;
        View after = before;
        after.camera = pan(before.camera, input.pan);
        const auto place = place_in(after, before.camera.look_at);
        REQUIRE(place);
        CHECK(place->x == doctest::Approx(300));
        CHECK(place->y == doctest::Approx(250));
        CHECK(length(after.camera.look_at - after.camera.position) ==
              doctest::Approx(length(before.camera.look_at - before.camera.position)));
    }
    Session session(
        scene_of("flythrough { duration 9 key { time 0 position <1,2,3> look_at <4,9,5> }"
                 " key { time 9 position <2,2,3> look_at <4,9,5> } }"));
    session.perform({Action::play}, 0);
    CHECK(session.turn_wheel(1, true, 1).note.find("1.25 times its speed") != std::string::npos);
    CHECK(session.flight.under_way());
    const double distance = length(session.camera.look_at - session.camera.position);
    session.turn_wheel(1, false, 2);
    CHECK(!session.flight.under_way());
    CHECK(length(session.camera.look_at - session.camera.position) < distance);
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
    CHECK(session.finest == sharpened_level);
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
    const Camera far = session.camera;
    auto wide = std::make_shared<Scene>(*session.scene);  // read again for a wider picture
    wide->camera.fov = 40, wide->camera.aspectratio = 2;
    session.replace_reread(wide);
    CHECK((session.camera.fov == 40 && session.camera.aspectratio == 2));
    CHECK((session.camera.position == far.position && session.camera.look_at == far.look_at));
    wide = std::make_shared<Scene>(*session.scene);  // at another moment the camera is elsewhere
    wide->camera.position += DVec3(1, 2, 3);
    session.replace_reread(wide);
    CHECK(session.camera == wide->camera);
    session.steer({.push = {1, 0, 0}}, 0);
    session.replace(scene_of(""), true);  // another file
    CHECK(session.camera == camera);
}

TEST_CASE(
    "a lens that changes in the file leaves the view; moments of a shutter are kept until what they show changes") {
    const std::string moving = "sphere { <0,0,0>, 1 motion { key { time 0 } key { time 2 translate <1,0,0> } } }";
    const auto with = [&](const std::string& words) {
        return std::make_shared<const Scene>(parse_scene(
            "camera { position <5,-20,18> look_at <0,0,0> up <0,0,-1> fov 25 " + words + " }\n" + moving, "test"));
    };
    Session session(with(""));
    session.steer({.push = {1, 0, 0}}, 0);
    const Camera flown = session.camera;
    session.replace(with("aperture .5 focus 3 shutter .5"), false);
    CHECK(session.camera.position == flown.position);
    CHECK((session.camera.aperture == .5 && session.camera.focus == 3 && session.camera.shutter == .5));
    const auto moments = session.view(40, 30).moments;
    REQUIRE(moments);
    CHECK(moments->size() == 128);
    CHECK(session.view(40, 30).moments == moments);
    session.steer({.push = {1, 0, 0}}, 1);
    const auto others = session.view(40, 30).moments;
    CHECK(others != moments);
    CHECK(others->at(0).camera.position == session.camera.position);
    session.go_to(1, 2);
    CHECK(session.view(40, 30).moments->at(0).time > .7);
    session.replace(with("aperture .5 focus 3"), false);
    CHECK(!session.view(40, 30).moments);
}
