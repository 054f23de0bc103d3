// Flights and the path that hands edit, without a window; and their figures.
#include <doctest/doctest.h>

#include <cmath>

#include "num/vec_math.h"
#include "show/benchmark.h"
#include "show/session.h"
#include "text/parse.h"
#include "text/write.h"

using namespace strahl;

namespace {

const Camera camera{{5, -20, 18}, {0, 0, 0}, {0, 0, -1}, 25, {}};

double distance(const DVec3& a, const DVec3& b) { return length(a - b); }

std::shared_ptr<const Scene> scene_of(const std::string& more) {
    return std::make_shared<const Scene>(
        parse_scene("camera { position <5,-20,18> look_at <0,0,0> up <0,0,-1> fov 25 }\n" + more, "test"));
}

const std::string path_text =
    "flythrough { duration 4 key { time 0 position <1,0,0> look_at <0,0,0> }"
    " key { time 2 position <0,2,0> look_at <0,0,1> } key { time 4 position <-3,0,0> look_at <0,0,0> } }";

}  // namespace

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
    CHECK(distance(session.camera.position, there.position) < 1e-4);
    session.steer({.push = {1, 0, 0}}, 3);
    CHECK(note(Action::set_key) == "key at 1 s changed");
    CHECK(times() == "0 1000 2000 4000 ");
    CHECK(note(Action::delete_key) == "key at 1 s deleted");
    CHECK(session.editor.path() == *session.scene->flythrough);
    CHECK(note(Action::delete_key).starts_with("there is no key at 1 s"));
    CHECK(note(Action::undo) == "undone");
    CHECK(note(Action::undo) == "undone");
    CHECK(distance(session.editor.path().keys[1].position, there.position) < 1e-4);
    CHECK(note(Action::redo) == "redone");
    CHECK(distance(session.editor.path().keys[1].position, there.position) > 0.1);
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

TEST_CASE("values of a key are typed, and a drag of it is undone at once") {
    Session session(scene_of(path_text));
    const Flythrough before = session.editor.path();
    Keyframe key = before.keys[1];
    for (int i = 1; i <= 10; ++i) {
        key.time = 2 + 0.1 * i;
        CHECK(session.change_key(1, key, i > 1, 0).note == "");
        CHECK(session.time == doctest::Approx(key.time));
    }
    key.time = 9;  // not past the next one
    session.change_key(1, key, true, 0);
    CHECK(session.editor.path().keys[1].time == doctest::Approx(3.999));
    session.perform({Action::undo}, 0);
    CHECK(session.editor.path() == before);
    key = before.keys[2], key.position = {1, 1, 7}, key.fov = 30, key.time = 12;
    CHECK(session.change_key(2, key, false, 0).note == "");
    CHECK(session.editor.path().keys[2] == key);
    CHECK(session.editor.path().duration == 12);
    key.position = key.look_at;
    CHECK(session.change_key(2, key, false, 0).note.starts_with("the camera sees nothing there"));
    key.position = {1, 1, 7}, key.fov = 90;
    CHECK(session.change_key(2, key, false, 0).note == "a camera can't be like this");
    key.fov = NAN;
    CHECK(session.change_key(2, key, false, 0).note == "a camera can't be like this");
}

TEST_CASE("a flight by hand becomes a path of few keys that is nowhere farther from it than is said") {
    Session session(scene_of(""));
    CHECK(session.perform({Action::record}, 5).note.starts_with("recording"));
    std::vector<CameraMoment> flown;
    double now = 9;  // the rest before is not part of it
    const auto fly_on = [&](double seconds, const CameraInput& input) {
        session.observe(now);
        for (const double end = now + seconds; now < end;) {
            now += 1 / 60.;
            session.steer(input, now);
            session.observe(now);
            flown.push_back({now - 9, session.camera});
        }
    };
    fly_on(2, {.push = {0, 0, 0.01}});
    fly_on(2, {.push = {0.01, 0, 0.01}, .right = 0.01});
    now += 3;  // a rest in between is
    fly_on(2, {.push = {0, 0.01, 0}});
    const std::string note = session.perform({Action::record}, now + 9).note;
    const Flythrough path = session.editor.path();
    CAPTURE(note);
    CHECK(path.duration == doctest::Approx(9).epsilon(0.01));
    CHECK(path.keys.size() >= 5);
    CHECK(path.keys.size() < 20);
    for (const CameraMoment& moment : flown) {
        const Camera there = camera_at(path, camera, moment.time);
        CHECK(distance(there.position, moment.camera.position) < distance(camera.position, camera.look_at) / 100 + 1e-3);
    }
    CHECK(scene_of(write_flythrough(path))->flythrough == path);
    session.perform({Action::undo}, 99);
    CHECK(session.editor.path().keys.empty());
    session.perform({Action::record}, 100);
    CHECK(session.perform({Action::record}, 101).note == "nothing moved, nothing is recorded");
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

TEST_CASE("a flight that is played once ends after a round") {
    Session session(scene_of(""));
    session.once = true;
    session.perform({Action::play}, 0);
    CHECK(!session.follow(39.9));
    CHECK(session.follow(40.1));
    CHECK(!session.flying());
}

TEST_CASE("figures of a flight are those of its times and levels") {
    std::vector<ShownPicture> shown;
    double time = 5;
    for (int i = 0; i < 101; ++i) {
        shown.push_back({time, i < 51 ? finest_level : finest_level - 2, 1000});
        time += i == 40 ? 0.5 : i % 2 ? 0.01 : 0.02;
    }
    const Benchmark b = benchmark_of(shown);
    CHECK(b.pictures == 101);
    CHECK(b.seconds == doctest::Approx(1.98));
    CHECK(b.median == doctest::Approx(0.01));
    CHECK(b.p99 == doctest::Approx(0.02));
    CHECK(b.worst == doctest::Approx(0.5));
    CHECK(b.levels.size() == 2);
    CHECK(b.levels.at(finest_level) == doctest::Approx(51. / 101));
    CHECK(b.pixels_per_second == doctest::Approx(100000 / 1.98));
    const BenchmarkSetting setting{"a \"b\".rt", "float", "scalar", 640, 480, 20, 2, 60, 0.002};
    const std::string text = text_of(b, setting), json = json_of(b, setting);
    CHECK(text.find("median 10.00 ms, 99th percentile 20.00 ms, worst 500.00 ms") != std::string::npos);
    CHECK(text.find("all pixels in 50.5 %, 1/4 of the pixels in 49.5 %") != std::string::npos);
    CHECK(json.find("\"scene\": \"a \\\"b\\\".rt\"") != std::string::npos);
    CHECK(json.find("\"1/4\": 0.495") != std::string::npos);
    CHECK(benchmark_of({}).pictures == 0);
    CHECK(text_of(benchmark_of({}), setting) != "");
}
