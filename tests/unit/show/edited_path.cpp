// Editing of the path, without a window.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "show/window/path_marks.h"
#include "tests/unit/show/flight_scene.h"
#include "text/write.h"

using namespace strahl;

TEST_CASE("keys make a path that can be pasted and flown") {
    Session session(scene_of(""));
    session.perform({Action::play}, 0);  // around the scene, for a while
    session.perform({Action::play}, 1.8);
    session.perform({Action::reset}, 2);
    CHECK(session.perform({Action::add_key}, 2).note == "key 1 added at 0 s; a path needs two keys");
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
    // Flies from the start, even if another flight came before.
    CHECK(session.perform({Action::play}, 5).note == "flying from 0 s");
    CHECK(session.flight.path() == pasted->flythrough);
}

TEST_CASE("steps through a flight, and jumps to its ends and keys") {
    Session session(scene_of(path_text));
    const auto note = [&](Action action, int number = 0) { return session.perform({action, number}, 9).note; };
    CHECK(note(Action::step, 25) == "at 1 s");
    CHECK(session.flight.paused());
    CHECK(note(Action::step, 1) == "at 1.04 s");
    CHECK(note(Action::step, -50) == "at 0 s");
    CHECK(note(Action::to_end) == "at 4 s");
    CHECK(session.camera.position == DVec3(-3, 0, 0));
    CHECK(note(Action::to_key, -1) == "key 2 at 2 s");
    CHECK(session.camera.position == DVec3(0, 2, 0));
    CHECK(note(Action::to_key, 1) == "key 3 at 4 s");
    CHECK(note(Action::to_key, 1) == "no key after this moment");
    CHECK(note(Action::rewind) == "at 0 s");
    CHECK(session.camera.position == DVec3(1, 0, 0));
    CHECK(Session(scene_of("")).perform({Action::step, 1}, 0).note == "there is no path and no motion");
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
    CHECK(note(Action::delete_key).starts_with("no key at 1 s"));
    CHECK(note(Action::undo) == "undone: key at 1 s deleted");
    CHECK(note(Action::undo) == "undone: key at 1 s changed");
    CHECK(distance(session.editor.path().keys[1].position, there.position) < 1e-4);
    CHECK(note(Action::redo) == "redone: key at 1 s changed");
    CHECK(distance(session.editor.path().keys[1].position, there.position) > 0.1);
    CHECK(note(Action::add_key) == "key 5 added at 7 s");
    CHECK(session.editor.path().duration == 7);
    CHECK(note(Action::redo) == "nothing to redo");
    for (int i = 0; i < 3; ++i) CHECK(note(Action::undo).starts_with("undone: key "));
    CHECK(note(Action::undo) == "nothing to undo");
    CHECK(session.editor.path() == *session.scene->flythrough);
    // A new path replaces the scene's; undo brings that back.
    CHECK(note(Action::clear_path) == "new path");
    CHECK(note(Action::add_key) == "key 1 added at 0 s; a path needs two keys");
    note(Action::undo), note(Action::undo);
    session.perform({Action::rewind}, 10), session.perform({Action::pause}, 10);
    CHECK(session.flight.path() == session.scene->flythrough);
}

TEST_CASE("changes of text, path and tracks are undone in one order, also the last 500 of many") {
    Session session(scene_of(path_text));
    EditedText text;
    text.open("0");
    session.take_tracks("", true);
    const auto step = [&](bool back) {  // as the window does it
        if (text.next_step(back, session.edits) > session.next_step(back)) return *text.undo(back, session.edits);
        return session.perform({back ? Action::undo : Action::redo}, 0).note;
    };
    for (int i = 0; i < 700; ++i) session.perform({Action::add_key}, 0);
    text.change("1", {session.edits, "text 1"});
    for (int i = 0; i < 3; ++i) session.perform({Action::add_key}, 0);
    session.change_track({"z", {{0, 1, Interpolation::linear}}}, false, 0);
    text.change("2", {session.edits, "text 2"});
    CHECK(step(true) == "text 2");
    CHECK(step(true) == "undone: keys of the track z");
    for (int i = 706; i > 703; --i) CHECK(step(true).starts_with("undone: key " + std::to_string(i)));
    CHECK(step(true) == "text 1");
    CHECK(step(true).starts_with("undone: key 703"));
    CHECK(step(false).starts_with("redone: key 703"));
    CHECK(step(false) == "text 1");
    CHECK(step(false).starts_with("redone: key 704"));
    session.perform({Action::clear_path}, 0);
    CHECK(step(false) == "nothing to redo");  // neither of the path nor of what was taken back before
    CHECK(step(true) == "undone: new path");
    CHECK(step(false) == "redone: new path");
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
    CHECK(session.change_key(2, key, false, 0).note == "these values make no camera");
    key.fov = NAN;
    CHECK(session.change_key(2, key, false, 0).note == "these values make no camera");
    key.fov = 30, key.ease = 1.1;
    CHECK(session.change_key(2, key, false, 0).note == "these values make no camera");
    // A key that is set once more keeps its ease.
    key.ease = .5;
    CHECK(session.change_key(2, key, false, 0).note == "");
    session.camera.position = {1, 2, 7};
    session.perform({Action::set_key}, 0);
    CHECK(session.editor.path().keys[2].position.y == 2);
    CHECK(session.editor.path().keys[2].ease == .5);
}

TEST_CASE("a flight by hand becomes a path of few keys, within the distance that is reported") {
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
        CHECK(distance(there.position, moment.camera.position) <
              distance(camera.position, camera.look_at) / 100 + 1e-3);
    }
    CHECK(scene_of(write_flythrough(path))->flythrough == path);
    session.perform({Action::undo}, 99);
    CHECK(session.editor.path().keys.empty());
    session.perform({Action::record}, 100);
    CHECK(session.perform({Action::record}, 101).note == "nothing was recorded, because nothing moved");
}

TEST_CASE("a path can be read again after any edits") {
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
            session.editor.change(retimed(path, number, random(12000) / 1000.), {session.edits, "random"});
            session.path_changed(i);
        }
        if (path.keys.size() < 2) continue;
        const auto pasted = scene_of(write_flythrough(path));
        REQUIRE(pasted->flythrough == path);
    }
}

TEST_CASE("a new path in the file replaces the edited one, and undo brings that back") {
    Session session(scene_of(""));
    for (int i = 0; i < 2; ++i) {
        session.perform({Action::add_key}, i);
        session.steer({.push = {1, 0, 0}}, i);
    }
    const Flythrough edited = session.editor.path();
    CHECK(session.editor.changed());
    CHECK(!session.replace(scene_of("sphere { <0,0,0>, 1 }"), false));  // still without a path
    CHECK(session.editor.path() == edited);
    CHECK(session.replace(scene_of(path_text), false));
    CHECK(session.editor.unwritten() == std::vector{edited});
    session.perform({Action::play}, 5);
    CHECK(session.flight.path() == session.scene->flythrough);
    CHECK(!session.editor.changed());
    session.perform({Action::undo}, 6);
    CHECK(session.editor.path() == edited);
    CHECK(session.editor.unwritten() == std::vector{edited});  // once, although it was replaced and is back
    CHECK(!session.replace(scene_of(write_flythrough(edited)), false));
    CHECK(session.editor.unwritten().empty());
}

TEST_CASE("a path that is not written is asked about once, and none made by hand is forgotten") {
    Session session(scene_of(path_text));
    session.perform({Action::add_key}, 1);
    const Flythrough first = session.editor.path();
    session.perform({Action::clear_path}, 2);
    session.perform({Action::add_key}, 3);  // a single key, which cannot be written, is asked about and kept as well
    const Flythrough second = session.editor.path();
    session.perform({Action::record}, 4);
    session.steer({.push = {1, 0, 0}}, 5), session.observe(5);
    session.steer({.push = {1, 0, 0}}, 6), session.observe(6);
    CHECK(session.end_recording(7).note.starts_with("recorded"));
    CHECK(!session.recording());
    CHECK(session.end_recording(8).note == "");
    CHECK(session.editor.unwritten() == std::vector{first, second, session.editor.path()});
    session.replace(scene_of(write_flythrough(first)), false);  // written by hand into the file
    CHECK(session.editor.unwritten().size() == 2);
}

TEST_CASE("a path is closed and opened, and its end is dragged") {
    const Flythrough path = *scene_of(path_text)->flythrough;
    REQUIRE(!path.loop);
    const Flythrough closed = looped(path, 3);
    CHECK(closed.loop);
    CHECK(closed.duration == path.duration + 3);
    CHECK(closed.keys == path.keys);
    CHECK(looped(closed, 3) == path);
    CHECK(lasting(path, 9.0004).duration == 9);
    CHECK(lasting(path, 1).duration == path.keys.back().time);
    CHECK(lasting(closed, 1).duration > path.keys.back().time);
    CHECK(looped({}, 3) == Flythrough{});
    // A path that ends where it begins needs no way back.
    Flythrough round = path;
    round.keys.back() = round.keys.front(), round.keys.back().time = path.duration;
    CHECK(looped(round, 3).duration == path.duration);

    Session session(scene_of(path_text));
    session.change_path(closed, "path closed", false, 0);
    session.change_path(lasting(closed, 8), "end of the path", true, 0);
    CHECK(session.path_to_fly()->duration == 8);
    session.perform({Action::undo}, 0);
    CHECK(session.editor.path() == path);
}

TEST_CASE("a flight is seen from outside: the camera stays, and moves without ending it") {
    Session session(scene_of(path_text));
    session.go_to(2, 0);
    CHECK(session.bound());
    session.perform({Action::outside}, 0);
    CHECK(!session.bound());
    const Camera before = session.camera;
    session.go_to(4, 0);
    CHECK(session.camera == before);
    CHECK(session.time == 4);
    session.steer({.push = {0, 0, -1}}, 0);
    CHECK(session.camera != before);
    CHECK(session.flight.flying());
    CHECK(session.flight_camera().position == DVec3(-3, 0, 0));
    const PathMarks marks =
        path_marks(session.editor.path(), session.scene->camera, 4, {.camera = before, .width = 160, .height = 120});
    CHECK(marks.keys.size() <= 3);
    session.perform({Action::outside}, 0);
    CHECK(session.camera.position == DVec3(-3, 0, 0));
}

TEST_CASE("the path is drawn where it is seen") {
    const Flythrough path = *scene_of(path_text)->flythrough;
    Camera above;
    above.position = {0, 0, 20}, above.look_at = {0, 0, 0}, above.up = {0, -1, 0};
    const View view{.camera = above, .width = 200, .height = 200};
    const PathMarks marks = path_marks(path, above, 2, view);
    REQUIRE(marks.keys.size() == path.keys.size());
    REQUIRE(marks.lines.size() == 1);
    REQUIRE(marks.now);
    CHECK(glm::length(*marks.now - marks.keys[1]) < 1e-9);
    CHECK(glm::length(marks.lines[0].front() - marks.keys[0]) < 1e-9);
    CHECK(glm::length(marks.lines[0].back() - marks.keys[2]) < 1e-9);
    Camera away = above;
    away.look_at = {0, 0, 40};
    const PathMarks none = path_marks(path, above, {}, {.camera = away, .width = 200, .height = 200});
    CHECK(none.keys.empty());
    CHECK(none.lines.empty());
    CHECK(!none.now);
}
