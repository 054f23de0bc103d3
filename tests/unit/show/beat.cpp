// Music and keys of tracks, as the window changes them, without a window.
#include <doctest/doctest.h>

#include <string>

#include "scene/moving_scene.h"
#include "show/session/body_editor.h"
#include "show/session/session.h"
#include "tests/unit/show/show_scene.h"
#include "text/light_text.h"
#include "text/music_text.h"
#include "text/reading/tracks_file.h"

using namespace strahl;

namespace {

constexpr Interpolation linear = Interpolation::linear;

Music music_of(const std::string& text) { return parse_scene(text, "").music; }

const BodyValue& value_of(const BodyText& body, const std::string& name) {
    for (const BodyValue& value : body.values)
        if (value.name == name) return value;
    FAIL("no value " << name);
    return body.values[0];
}

}  // namespace

TEST_CASE("music is added behind the camera, and changed in place") {
    const std::string added = with_music(scene_text, {125, 8, ""});
    CHECK(music_of(added) == Music{125, 8, ""});
    CHECK(added.find("fov 12 }\nmusic { bpm 125  rows 8 }\nlight") != added.npos);
    const std::string own = "music { rows 4 /* four */  bpm 60 // slow\n }\n" + scene_text;
    CHECK(with_music(own, music_of(own)) == own);
    CHECK(with_music(own, {61.5, 4, ""}) == "music { rows 4 /* four */  bpm 61.5 // slow\n }\n" + scene_text);
    CHECK(with_music(own, {60, 4, "", 1.25}) ==
          "music { rows 4 /* four */  bpm 60 // slow\n  offset 1.25 }\n" + scene_text);
    const std::string bare = "music {}\n" + scene_text;
    CHECK(music_of(with_music(bare, {90, 3, ""})) == Music{90, 3, ""});
    CHECK(with_music(bare, {}) == bare);
    // A sound is added, gets another name, and is removed; it would be looked for if the scene were read.
    const std::string with_sound = with_music(own, {60, 4, "a b.ogg"});
    CHECK(with_sound == "music { rows 4 /* four */  bpm 60 // slow\n  sound \"a b.ogg\" }\n" + scene_text);
    const std::string other = with_music(with_sound, {60, 4, "c.ogg"});
    CHECK(other.find("sound \"c.ogg\" }") != other.npos);
    CHECK(music_of(with_music(other, {60, 4, ""})) == Music{60, 4, ""});
}

TEST_CASE("keys of tracks change in place, and leave comments and other tracks as they are") {
    const std::string text =
        "// mine\ntrack \"a\" { 0 1 step  8 2 linear // here\n  16 3 smooth }\ntrack \"b\" {\n 0 5 step\n}\n";
    const auto keys = [&](Track track) {
        const std::string changed = with_keys(text, track);
        for (const Track& now : parse_tracks(changed, ""))
            if (now.name == track.name) CHECK(now == track);
        CHECK(parse_tracks(changed, "").size() == (track.name == "new" ? 3 : 2));
        return changed;
    };
    CHECK(keys(parse_tracks(text, "")[0]) == text);
    CHECK(keys({"a", {{0, 1, Interpolation::step}, {9, 2.5, linear}, {16, 3, Interpolation::smooth}}}) ==
          "// mine\ntrack \"a\" { 0 1 step  9 2.5 linear // here\n  16 3 smooth }\ntrack \"b\" {\n 0 5 step\n}\n");
    CHECK(keys({"a", {{0, 1, Interpolation::step}, {16, 3, Interpolation::smooth}}}) ==
          "// mine\ntrack \"a\" { 0 1 step // here\n  16 3 smooth }\ntrack \"b\" {\n 0 5 step\n}\n");
    CHECK(keys({"b", {{0, 5, Interpolation::step}, {4, -.5, linear}}}).ends_with("{\n 0 5 step\n  4 -0.5 linear\n}\n"));
    for (const int row : {1, 7, 12, 40}) {
        Track more = parse_tracks(text, "")[0];
        set_key(more, {row, 9, linear});
        keys(more);
        delete_key(more, 0), keys(more);
    }
    keys({"a", {{3, 1, linear}}});
    keys({"new", {{0, 1, linear}}});
    CHECK(parse_tracks(with_keys(text, {"a", {}}), "").size() == 1);
    CHECK(with_keys(text, {"none", {}}) == text);
    const Track first{"first", {{0, 1, linear}}};
    CHECK(parse_tracks(with_keys("", first), "") == std::vector{first});
    const std::string joined = "track \"x\"{0 1 step}";
    CHECK(parse_tracks(with_keys(joined, {"x", {{1, 1, linear}, {2, 2, linear}}}), "")[0].keys.size() == 2);
    CHECK(parse_tracks(with_keys("track \"x\"{}", first), "").size() == 2);
    CHECK(parse_tracks(with_keys("track \"x\"{}", {"x", {{1, 1, linear}}}), "")[0].keys.size() == 1);
}

TEST_CASE("the first beat is repeated in all others") {
    const Track beat{"beat", {{0, 1, linear}, {3, .5, linear}, {5, 9, linear}, {20, 7, linear}}};
    CHECK(repeated(beat, 4, 11).keys ==
          std::vector<TrackKey>{
              {0, 1, linear}, {3, .5, linear}, {4, 1, linear}, {7, .5, linear}, {8, 1, linear}, {20, 7, linear}});
    CHECK(repeated(beat, 4, 0).keys == beat.keys);
    CHECK(repeated({"none", {}}, 4, 100).keys.empty());
}

TEST_CASE("numbers of bodies and lights follow tracks, and none any more") {
    const Scene scene = *shown_scene();
    const auto check = [&](const std::string& text, const std::vector<std::string>& tracks) {
        const Scene now = parse_scene(text, "");
        CHECK(followed_tracks(now) == tracks);
        return text;
    };
    const BodyText body = body_text(scene_text, scene, 0, 0), light = light_text(scene_text, scene, 0);
    CHECK(!value_of(body, "radius").follows);
    CHECK(check(with_track(scene_text, value_of(body, "translate"), 2, "z"), {"z"})
              .find("translate <0, 0, track \"z\" 0>") != std::string::npos);
    CHECK(check(with_track(scene_text, value_of(body, "rgb"), 1, "green"), {"green"})
              .find("rgb <1,track \"green\" .2,.2>") != std::string::npos);
    check(with_track(scene_text, value_of(body, "ambient"), 0, "glow"), {"glow"});
    const std::string flash = check(with_track(scene_text, value_of(light, "color"), -1, "flash"), {"flash"});
    const Scene flashing = parse_scene(flash, "");
    const BodyText followed = light_text(flash, flashing, 0);
    CHECK(value_of(followed, "color").fixed == "follows \"flash\"");
    CHECK(without_tracks(flash, value_of(followed, "color")) == scene_text);
    // Another one in its place; a number that is not written is 0.
    check(with_track(flash, value_of(followed, "color"), 0, "red"), {"red", "flash"});
    const std::string bare = scene_text + "sphere { <0,0,1>, 1 translate <track \"x\", 1, track \"z\" 2> }";
    const Scene bare_scene = parse_scene(bare, "");
    const BodyText bare_body = body_text(bare, bare_scene, 3, 0);
    CHECK(without_tracks(bare, value_of(bare_body, "translate")).ends_with("translate <0, 1, 2> }"));
}

TEST_CASE("keys of tracks are shown, written, undone between other changes, and kept when the file changes") {
    Session session(shown_scene("sphere { <0,0,1>, 1 translate <0, 0, track \"z\"> }"));
    const std::string file = "track \"z\" { 0 0 linear }\ntrack \"other\" { 0 1 step }\n";
    CHECK(!session.take_tracks(file, true));
    CHECK(!session.tracks);
    const Track z{"z", {{0, 0, linear}, {32, 2, linear}}};
    session.change_track(z, false, 1);
    REQUIRE(session.tracks);
    CHECK(session.tracks->at(0) == z);
    CHECK(session.path_to_fly()->duration == session.scene->music.time_of(32));
    CHECK(session.track_keys.changes() == std::vector{z});
    Track moved = z;
    moved.keys[1].value = 3;
    session.change_track(moved, true, 1);  // one drag
    CHECK(session.perform({Action::undo}, 1).note == "undone: keys of the track z");
    CHECK(session.track_keys.changes().empty());
    CHECK(session.perform({Action::redo}, 1).note == "redone: keys of the track z");
    CHECK(session.track_keys.track("z") == moved);
    // Others change another track; then this one is written.
    const std::string theirs = "track \"z\" { 0 0 linear }\ntrack \"other\" { 0 4 step }\n";
    CHECK(!session.take_tracks(theirs, false));
    CHECK(session.track_keys.track("other").keys[0].value == 4);
    CHECK(session.track_keys.track("z") == moved);
    CHECK(!session.take_tracks(with_keys(theirs, moved), false));
    CHECK(!session.track_keys.changed());
    CHECK(*session.tracks == session.track_keys.tracks());
    session.change_track({"z", {}}, false, 1);
    CHECK(session.track_keys.changes() == std::vector{Track{"z", {}}});
    CHECK(!session.track_keys.unwritten().empty());
}
