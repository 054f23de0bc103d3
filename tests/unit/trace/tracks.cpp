// Numbers that follow tracks: their values, the language, the file of tracks, and pictures.
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "num/thread_pool.h"
#include "num/vec_math.h"
#include "scene/moving_scene.h"
#include "tests/unit/scenes.h"
#include "tests/unit/scratch.h"
#include "tests/unit/text/language.h"
#include "text/edit_path.h"
#include "text/reading/tracks_file.h"
#include "text/write.h"
#include "trace/tracer.h"

using namespace strahl;
using namespace strahl::language;

namespace {

/// Some of everything that can follow a track. Rows are a second long.
const std::string followers = R"(
camera { position <track "a" 0, -9, 1>  look_at <0, 0, 0>  sky <track "b", 0, 1>  angle track "c" 50 }
music { bpm 60  rows 1 }
background { color <.1, track "d" .2, .3> }
fog { distance track "e" 50  color <.1, .1, track "d" .3> }
light { position <3, track "f" -4, 5>  color <track "g" 1, 1, 1>
        spot { look_at <0, 0, track "f"> radius track "c" 50 falloff 60 } }
light { direction <track "b" 1, 1, -2>  color <.2, .2, track "d" .2> }
define gold material { rgb <1, track "g" .8, 0>  reflection track "h" .2 }
defaultmaterial { diffuse track "d" .5 }
define pair union {
  sphere { <0, 0, 0>, .5  translate <track "a", 0, 0> }
  sphere { <0, 0, 1>, .5  material { rgb <0, 0, 1>  refraction track "h" } }
  rotate <0, 0, track "i">
}
pair { material gold  scale track "j" 1 }
pair { material gold { rgb <1, 1, 1> }  scale <1, track "j" 1, 1>  translate <2, 0, 0> }
)";
/// `followers` with each of them set to a value by hand.
std::string with_values(double value) {
    std::string text;
    for (std::size_t at = 0; at < followers.size();) {
        const std::size_t next = std::min(followers.find("track \"", at), followers.size());
        text += followers.substr(at, next - at);
        if (next == followers.size()) break;
        text += std::to_string(value);
        at = followers.find_first_of(",>\n }", next + 9);  // after the name
        if (followers[at] == ' ' && (isdigit(followers[at + 1]) || strchr("-.", followers[at + 1])))
            at = followers.find_first_of(",>\n }", at + 1);
    }
    return text;
}
std::vector<Track> tracks_named(const char* names, std::vector<TrackKey> keys) {
    std::vector<Track> tracks;
    for (; *names; ++names) tracks.push_back({std::string(1, *names), keys});
    return tracks;
}
Frame picture(const Scene& scene, const Camera& camera, double time = 0) {
    return render(scene, {.camera = camera, .width = 60, .height = 45, .depth = 5, .time = time});
}

}  // namespace

TEST_CASE("between keys a track goes as the first of them says") {
    const auto at = [](Interpolation way, double row) {
        return value_at({"", {{2, 10, way}, {6, 30, Interpolation::step}}}, row);
    };
    for (const Interpolation way :
         {Interpolation::step, Interpolation::linear, Interpolation::smooth, Interpolation::ramp}) {
        CHECK(at(way, 2) == 10);
        CHECK(at(way, -1e9) == 10);
        CHECK(at(way, 6) == 30);
        CHECK(at(way, 1e9) == 30);
    }
    CHECK(at(Interpolation::step, 5.99) == 10);
    CHECK(at(Interpolation::linear, 3) == 15);
    CHECK(at(Interpolation::smooth, 3) == 10 + 20 * (.0625 * 2.5));
    CHECK(at(Interpolation::ramp, 3) == 10 + 20 * .0625);
    CHECK(at(Interpolation::ramp, 5.5) == 10 + 20 * .765625);
}

TEST_CASE("keys are put in by rows and taken out") {
    Track track;
    for (const int row : {5, 1, 9, 5}) set_key(track, {row, double(track.keys.size()), Interpolation::linear});
    CHECK(track.keys == std::vector<TrackKey>{{1, 1, Interpolation::linear},
                                              {5, 3, Interpolation::linear},
                                              {9, 2, Interpolation::linear}});
    delete_key(track, 5), delete_key(track, 6);
    CHECK(track.keys.size() == 2);
}

TEST_CASE("rows are counted by beats, and rounding does not miss one") {
    for (const double bpm : {60., 125., 130., 173.3})
        for (int row = 0; row < 5000; ++row) {
            const Music music{bpm, 7, {}};
            REQUIRE(music.row_at(music.time_of(row)) == row);
        }
    CHECK(Music{120, 8, {}}.time_of(32) == 2);
    CHECK(Music{120, 8, {}}.row_at(.7) == doctest::Approx(11.2));
    const Music late{120, 8, {}, 1.5};
    CHECK(late.time_of(32) == 3.5);
    CHECK(late.row_at(3.5) == 32);
    CHECK(late.row_at(1) == -8);
}

TEST_CASE("what follows tracks is written as it was read") {
    const Scene scene = parse(followers);
    CHECK(followed_tracks(scene).size() == 10);
    CHECK(parse(write_scene(scene)) == scene);
    CHECK(write_scene(scene).find("sky <track \"b\" 0, 0, 1>\n  angle track \"c\" 50\n") != std::string::npos);
    CHECK(scene.primitives[0].transformations.size() == 2);
    CHECK(scene.materials[std::size_t(scene.primitives[1].material)].follows.size() == 2);  // not its colour
    // Without tracks they are what the scene says.
    CHECK(followed_tracks(without_tracks(scene, 0)).empty());
    CHECK(without_tracks(scene, 0).camera == scene.camera);
    CHECK(without_tracks(scene, 3).lights[0].position == DVec3(3, -4, 5));
    CHECK(picture(scene, scene.camera) == picture(without_tracks(scene, 0), scene.camera));
}

TEST_CASE("a lens and a shutter follow tracks") {
    Scene scene = parse(R"(
camera { position <0, -9, 1>  look_at <0, 0, 0>  sky <0, 0, 1>  angle 50
         aperture track "a" 1  focus track "b" 5  blades track "c" 6  shutter track "d" .1 }
music { bpm 60  rows 1 })");
    CHECK(parse(write_scene(scene)) == scene);
    scene.tracks = {{"a", {{0, .5}}}, {"b", {{0, 7}}}, {"c", {{0, 9}}}, {"d", {{0, .25}, {4, .75}}}};
    const Camera camera = camera_at(scene, 5.);
    CHECK(camera.aperture == .5);
    CHECK(camera.focus == 7);
    CHECK(camera.blades == 9);
    CHECK(camera.shutter == .75);
    Scene eyes = parse(R"(
camera { position <0, -9, 1>  look_at <0, 0, 0>  sky <0, 0, 1>  angle 50
         shutter_share track "a" 1  side_by_side track "b" 5  convergence track "c" 6 })");
    CHECK(parse(write_scene(eyes)) == eyes);
    eyes.tracks = {{"a", {{0, .5}}}, {"b", {{0, 7}}}, {"c", {{0, 9}}}};
    const Camera two = camera_at(eyes, 5.);
    CHECK((two.shutter == .5 && two.shutter_in_frames && two.eye_distance == 7 && two.convergence == 9));
}

TEST_CASE("pictures are those of the values at the moment") {
    Scene scene = parse(followers);
    scene.tracks = tracks_named("abcdefghij", {{0, .25, Interpolation::linear}, {4, .75, Interpolation::step}});
    const auto still_at = [](double value) { return parse(with_values(value)); };
    for (const double time : {0., 1., 2.5, 4., 9.}) {
        CAPTURE(time);
        const Scene still = still_at(.25 + std::min(time, 4.) / 8);
        const Camera camera = camera_at(scene, time);
        CHECK(length(camera.position - still.camera.position) == 0);
        CHECK(camera == still.camera);
        CHECK(picture(scene, camera, time) == picture(still, still.camera));
        CHECK(picture(without_tracks(scene, time), camera) == picture(still, still.camera));
        CHECK(picture(at(scene, time), camera) == picture(still, still.camera));
        CHECK(!Movers(at(scene, time)).any());
    }
    // Asks one tracer for moment after moment, also by other tracks than the scene's.
    Tracer tracer(scene, Precision::float64);
    ThreadPool pool(2);
    const auto other =
        std::make_shared<const std::vector<Track>>(tracks_named("abcdefghij", {{0, .5, Interpolation::step}}));
    const Camera camera = still_at(.5).camera;
    for (const auto& [time, tracks] : {std::pair(0., other), {2., nullptr}, {2., other}, {4., other}, {2., nullptr}}) {
        const View view{.camera = camera, .width = 60, .height = 45, .depth = 5, .time = time, .tracks = tracks};
        const Frame frame{60, 45, values_of(tracer, view, {.columns = 60, .rows = 45}, pool)};
        CHECK(frame == picture(still_at(.5), camera));
    }
}

TEST_CASE("numbers stay within what they may be, whatever an editor sends") {
    Scene scene = parse(followers);
    for (const double value : {0., -1., 1e9, -2e9, 1e-300}) {
        scene.tracks = tracks_named("abcdefghij", {{0, value, Interpolation::step}});
        const Scene now = at(scene, 0);
        CHECK(!degenerate(camera_at(scene, 0.)));
        CHECK(camera_at(scene, 0.).fov > 0);
        CHECK(camera_at(scene, 0.).fov < 90);
        CHECK(now.fog->distance > 0);
        CHECK(std::abs(now.lights[0].color.x) <= 1e9);
        CHECK(now.lights[0].spot->falloff >= now.lights[0].spot->radius);
        for (const Material& material : now.materials) CHECK((material.reflection >= 0 && material.reflection <= 1));
        const double factor = now.primitives[0].transformations.empty()
                                  ? 1
                                  : std::get<Scale>(now.primitives[0].transformations.back()).by.x;
        CHECK((std::fabs(factor) >= 1e-4 && std::fabs(factor) <= 1e4));
        for (const double light : picture(scene, parse(followers).camera).rgb) REQUIRE(std::isfinite(light));
    }
}

TEST_CASE("a scene lasts until the last key of the tracks that it follows") {
    Scene scene = with_eye("music { bpm 60 rows 2 } sphere { <0,0,0>, 1 translate <track \"x\", 0, 0> }");
    CHECK(flight_of(scene)->duration == 0);
    scene.tracks = {{"x", {{0, 0, {}}, {10, 0, {}}}}, {"y", {{90, 1, {}}}}};
    CHECK(flight_of(scene)->duration == 5);
    scene.music.offset = 1;
    CHECK(flight_of(scene)->duration == 6);
    scene.tracks[0].keys = {{0, 0, Interpolation::linear}, {10, 5, {}}};
    const auto place = [&](double time) { return at(scene, time).primitives[0].transformations; };
    for (const double time : {0., .5, 1.}) CHECK(place(time).empty());
    CHECK(place(3) == std::vector<Transformation>{Translate{{2, 0, 0}}});
    CHECK(flight_of(with_eye("light { position <0,0,9> color <track \"x\",1,1> }")));
    CHECK(flight_of(parse("camera { position <0,-9,0> look_at <0,0,0> up <0,0,-1> fov track \"x\" 9 }"))->keys.empty());
}

TEST_CASE("tracks that nothing follows are named, with the one that was meant") {
    Scene scene = with_eye("sphere { <0,0,0>, 1 translate <track \"height\", 0, 0> }");
    const TrackKey key{0, 1, {}};
    scene.tracks = {{"height", {key}}, {"hieght", {key}}, {"other", {key}}, {"empty", {}}};
    CHECK(unfollowed_tracks(scene) == std::vector<std::string>{"track 'hieght' is followed by nothing; did you mean "
                                                               "'height'?",
                                                               "track 'other' is followed by nothing"});
}

TEST_CASE("mistakes in what follows tracks") {
    check_fault(
        "sphere { <0,0,0>, track \"x\" 1 }",
        "2:19: 'radius' of 'sphere' cannot follow a track; numbers of lights, materials, the camera, the fog, the "
        "background's colour and the transformations of bodies can");
    check_fault(
        "fog { distance track \"x\" color <0,0,0> }",
        "2:16: 'distance' of 'fog' cannot be 0: give its value for a track without keys, as in 'track \"x\" 1'");
    check_fault("light { position <0,0,9> color <1,1,trakc \"x\"> }",
                "2:37: unknown word 'trakc' before a name in quotes; did you mean 'track'?");
    check_fault("light { position <0,0,9> color <1,1,track x> }",
                "2:43: the name of a track in quotes expected, but found 'x'");
    check_fault("light { position <0,0,9> color <1,1,track \"\"> }", "2:37: this track has no name");
    check_fault("light { position <0,0,9> color <1,1,track \"x\" -2e9> }",
                "2:47: 'color' of 'light' must be from -1e9 to 1e9, not '-2e9'");
    check_fault("music { rows 1.5 }", "2:14: 'rows' of 'music' must be a whole number from 1 to 256, not '1.5'");
    check_fault("music { offset -1 }", "2:16: 'offset' of 'music' must be from 0 to 1e9, not '-1'");
    check_fault("music { bpm 0 }", "2:13: 'bpm' of 'music' must be from 1e-9 to 1e9, not '0'");
    check_fault("music { }\nmusic { }", "3:1: a second 'music'; the first is in line 2");
    check_fault(
        "sphere { <0,0,0>, 1 material { rgb checker { <1,1,1>, <track \"x\",0,0> } } }",
        "2:56: 'second colour' of 'checker' cannot follow a track; numbers of lights, materials, the camera, the "
        "fog, the background's colour and the transformations of bodies can");
}

TEST_CASE("keys can stand at beats of the music") {
    const std::string music = "music { bpm 90 }\n";
    const auto scene = [&](const std::string& first, const std::string& second) {
        return with_eye(music + "flythrough { duration 9 key { " + first +
                        " position <0,-9,0> look_at <0,0,0> } key { " + second +
                        " position <0,9,0> look_at <0,0,1> } }\nsphere { <0,0,0>, 1 motion { key { " + first +
                        " } key { " + second + " scale 2 } } }");
    };
    CHECK(scene("beat 3", "beat 4.5") == scene("time 2", "time 3"));
    const std::string late = "music { bpm 90 offset .5 }\nsphere { <0,0,0>, 1 motion { key { ";
    CHECK(with_eye(late + "beat 0 } key { beat 3 scale 2 } } }") ==
          with_eye(late + "time .5 } key { time 2.5 scale 2 } } }"));
    const std::string keys = "} key { time 9 scale 2 } } }";
    check_fault("sphere { <0,0,0>, 1 motion { key { beat 1 " + keys,
                "2:36: the length of a beat is unknown: put 'music { bpm 120 }' above");
    check_fault(music + "sphere { <0,0,0>, 1 motion { key { beat 1 time 2 " + keys,
                "3:43: 'time' repeats 'beat' of line 3; give only one of them");
    check_fault(music + "sphere { <0,0,0>, 1 motion { key { beat 15 " + keys.substr(0, 8) + "beat 3 scale 2 } } }",
                "3:52: times must increase: the key before, in line 3, is not earlier than this one");
    check_fault("music { bpm 1e-9 }\nsphere { <0,0,0>, 1 motion { key { beat 1e9 " + keys,
                "3:36: this beat is later than 1e9 seconds");
    check_fault("sphere { <0,0,0>, 1 motion { key { " + keys, "2:30: 'key' lacks 'time' (or 'beat')");
}

TEST_CASE("a path that is edited keeps the keys that stand at beats") {
    const std::string head = eye + "flythrough { duration 9\n", tail = "}\nsphere { <0,0,0>, 1 }\n";
    const std::string music = "music { bpm 90 }\n",
                      first = "  key { beat 3 position <0,-9,0> look_at <0,0,0> } // mine\n",
                      second = "  key { beat 6 position <0,9,0> look_at <0,0,1> }\n";
    const std::string text = music + head + first + second + tail;
    Flythrough path = *parse(text).flythrough;
    CHECK(path.keys[0].time == 2);
    path.keys[1].time = 5;
    CHECK(with_path(text, path) ==
          music + head + first + "  key { time 5  position <0, 9, 0>  look_at <0, 0, 1> }\n" + tail);
}

TEST_CASE("the tracks of a scene are in a file beside it") {
    CHECK(tracks_path("a.b/demo.rt") == "a.b/demo.tracks");
    CHECK(tracks_path("a.b/demo") == "a.b/demo.tracks");
    const std::vector<Track> tracks{
        {"camera:zoom", {{0, 1.25, Interpolation::smooth}, {7, -3e-7, Interpolation::ramp}}},
        {"none", {}},
        {"b", {{1000000000, 0, Interpolation::step}}}};
    CHECK(parse_tracks(write_tracks(tracks), "") == tracks);

    const Scratch folder;
    const std::string scene = eye + "light { position <0,0,9> color <track \"b\",1,1> }";
    CHECK(parse_scene(scene, folder / "x.rt").tracks.empty());
    std::ofstream(folder / "x.tracks") << write_tracks(tracks);
    CHECK(parse_scene(scene, folder / "x.rt").tracks == tracks);
    CHECK(parse_scene(eye, folder / "x.rt").tracks.empty());  // nobody asks for them
    std::ofstream(folder / "x.tracks") << "track \"b\" { 0 1 }";
    CHECK_THROWS_AS(parse_scene(scene, folder / "x.rt"), FileError);
    std::filesystem::remove(folder / "x.tracks");
    REQUIRE(::mkfifo((folder / "x.tracks").c_str(), 0600) == 0);
    CHECK_THROWS_AS(parse_scene(scene, folder / "x.rt"), FileError);
}

TEST_CASE("mistakes in a file of tracks") {
    const auto check_tracks = [](const std::string& text, const Faults& expected) {
        CAPTURE(text);
        std::string what = "no error";
        try {
            parse_tracks(text, "x.tracks");
        } catch (const FileError& error) {
            what = error.what();
        }
        Faults found;
        for (const std::string& line : lines(what))
            if (!line.starts_with("    ")) found.push_back(line);
        CHECK(found == expected);
    };
    check_tracks("track \"x\" { 0 1 step", {"x.tracks:1:1: '}' missing: this 'track' is never closed"});
    check_tracks("track \"x\" { 0 1 smoth  2 1  4 2 ramp }",
                 {"x.tracks:1:17: unknown word 'smoth' after a key; did you mean 'smooth'?",
                  "x.tracks:1:24: this key lacks the interpolation after it: 'step', 'linear', 'smooth' or 'ramp'"});
    check_tracks("track \"x\" { 2 1 step\n2 1 step }",
                 {"x.tracks:2:1: rows must increase: the key before is in row 2"});
    check_tracks("track \"x\" { -1 1 step 1.5 1 step 1e10 1 step 0 1e10 step }",
                 {"x.tracks:1:13: 'row' of 'track' must be a whole number from 0 to 1e9, not '-1'",
                  "x.tracks:1:23: 'row' of 'track' must be a whole number from 0 to 1e9, not '1.5'",
                  "x.tracks:1:34: 'row' of 'track' must be a whole number from 0 to 1e9, not '1e10'",
                  "x.tracks:1:48: 'value' of 'track' must be from -1e9 to 1e9, not '1e10'"});
    check_tracks("trakc \"x\" { }\ntrack \"y\" { }\ntrack \"y\" { }",
                 {"x.tracks:1:1: unknown word 'trakc' in a file of tracks; did you mean 'track'?",
                  "x.tracks:3:8: a second track of this name"});
    check_tracks("track x { }", {"x.tracks:1:7: the name of a track in quotes expected, but found 'x'"});
    check_tracks("\xFF", {"x.tracks:1:1: not UTF-8; save the file in that encoding"});
    check_tracks("track \"x\" { word }", {"x.tracks:1:13: a number expected for 'row' of 'track', but found 'word'"});
}

TEST_CASE("scenes/beat.rt is cut to its music") {
    const Scene scene = read_scene("beat");
    const Music& music = scene.music;
    std::vector<std::string> followed = followed_tracks(scene), names;
    for (const Track& track : scene.tracks) names.push_back(track.name);
    std::ranges::sort(followed), std::ranges::sort(names);
    CHECK(followed == names);

    // The flight lasts as long as the sound, eight bars. Ogg's last page tells the number of samples.
    const std::string sound = bytes_of(STRAHL_SOURCE "/scenes/beat.ogg");
    const std::size_t page = sound.rfind("OggS");
    REQUIRE(page != sound.npos);
    std::uint64_t samples = 0;
    for (std::size_t i = 14; i-- > 6;) samples = samples << 8 | static_cast<unsigned char>(sound.at(page + i));
    CHECK(flight_of(scene)->duration == music.time_of(256));
    CHECK(static_cast<double>(samples) == 44100 * music.time_of(256));

    // On a beat the ball is on the floor, and the drum's light alone makes the picture redder than half a beat later.
    Scene drummed = scene;
    std::erase_if(drummed.tracks, [](const Track& track) { return track.name != "drum"; });
    const auto red = [](const Frame& frame) {
        double sum = 0;
        for (std::size_t i = 0; i < frame.rgb.size(); i += 3) sum += frame.rgb[i];
        return sum;
    };
    for (int beat = 0; beat <= 28; ++beat) {
        CAPTURE(beat);
        const double on = music.time_of(8 * beat), off = music.time_of(8 * beat + 4);
        const Camera camera = camera_at(scene, on);
        CHECK(*scene_time(scene, on).tracks.find("bounce") == 0);
        CHECK(*scene_time(scene, off).tracks.find("bounce") > 1);
        CHECK(red(picture(drummed, camera, on)) > 1.02 * red(picture(drummed, camera, off)));
    }

    // The camera is cut at bars, and between them it moves steadily.
    DVec3 before = camera_at(scene, 0.).position;
    for (int row = 1; row <= 256; ++row) {
        CAPTURE(row);
        const DVec3 eye_now = camera_at(scene, music.time_of(row)).position;
        const bool cut = row == 64 || row == 96 || row == 128 || row == 192 || row == 224;
        CHECK((length(eye_now - before) > 3) == cut);
        CHECK((length(eye_now - before) < 1) != cut);
        before = eye_now;
    }

    // Each track changes the picture.
    for (std::size_t i = 0; i < scene.tracks.size(); ++i) {
        CAPTURE(scene.tracks[i].name);
        Scene other = scene;
        for (TrackKey& key : other.tracks[i].keys) key.value += .1;
        const double time = music.time_of(104);
        CHECK(picture(other, camera_at(other, time), time) != picture(scene, camera_at(scene, time), time));
    }
}
