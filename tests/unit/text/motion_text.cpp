// Tests that keys of motions are moved, added and removed in a text, and that nothing else changes there.
#include "text/motion_text.h"

#include <doctest/doctest.h>

#include <string>

#include "scene/motion/motion.h"
#include "text/parse.h"

using namespace strahl;

namespace {

const std::string
    with_music =
        "music { bpm 120  rows 4  offset 1 }\ncamera { position <0,-9,2> look_at <0,0,0> up <0,0,-1> fov 20 }\n",
    moved_light =
        "light { position <0,0,9> color <1,1,1>  motion { key { time 0 } key { time 2 translate "
        "<1,0,0> } } }  // a lamp\n",
    moved_ball =
        "sphere { <0,0,0>, 1\n  motion {\n    key { time 1 }  // here\n    key { time 3  translate "
        "<2,0,0> }\n    key { beat 8  translate <4,0,0> }\n  }\n}\n";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    REQUIRE(text.find(what) != text.npos);
    return text.replace(text.find(what), what.size(), by);
}

}  // namespace

TEST_CASE("motions are those of bodies and lights that have keys") {
    const Scene scene =
        parse_scene(with_music + moved_light + "sphere { <0,0,0>, 1 translate <track \"a\" 0, 0, 0> }\n" + moved_ball +
                        "sphere { <0,0,0>, 1 motion { key { time 0 } key { time 1 scale 2 } } translate <1,0,0> motion "
                        "{ key { time "
                        "5 } key { time 6 rotate <0,0,9> } } }",
                    "test");
    const std::vector<SceneMotion> all = motions_of(scene);
    REQUIRE(all.size() == 4);
    CHECK(all[0].what == TopBlock::light);
    CHECK(all[0].name == "light 1");
    CHECK(all[0].times == std::vector{0., 2.});
    CHECK(all[1].name == "sphere 2");
    CHECK(all[1].times == std::vector{1., 3., 5.});
    CHECK(all[2].from_last == 1);
    CHECK(all[3].from_last == 0);
    CHECK(all[3].times == std::vector{5., 6.});
}

TEST_CASE("a key is moved between those beside it, in seconds or in beats as it is written") {
    const std::string text = with_music + moved_light + moved_ball;
    const Scene scene = parse_scene(text, "test");
    const std::vector<SceneMotion> all = motions_of(scene);
    REQUIRE(all.size() == 2);
    const auto moved = [&](const SceneMotion& motion, std::size_t key, double seconds) {
        return with_key_time(text, scene, motion, key, seconds);
    };
    CHECK(moved(all[1], 1, 2.4567) == replaced(text, "time 3", "time 2.46"));
    CHECK(moved(all[1], 1, 99) == replaced(text, "time 3", "time 4.99"));
    CHECK(moved(all[1], 1, -99) == replaced(text, "time 3", "time 1.01"));
    CHECK(moved(all[1], 2, 7.25) == replaced(text, "beat 8", "beat 12.5"));
    CHECK(moved(all[0], 0, -1) == text);
    CHECK(moved(all[0], 1, 2.5) == replaced(text, "time 2", "time 2.5"));
    CHECK(moved(all[1], 3, 1) == text);
}

TEST_CASE("a key is added where the motion is then, and removed") {
    const std::string text = with_music + moved_light + moved_ball;
    const Scene scene = parse_scene(text, "test");
    const SceneMotion lamp = motions_of(scene)[0], sphere = motions_of(scene)[1];
    const std::string more = with_motion_key(text, scene, sphere, 4);
    CHECK(more == replaced(text, "    key { beat", "    key { time 4  translate <3, 0, 0> }\n    key { beat"));
    CHECK(with_motion_key(text, scene, sphere, 9) ==
          replaced(text, "translate <4,0,0> }", "translate <4,0,0> }\n    key { time 9  translate <4, 0, 0> }"));
    CHECK(with_motion_key(text, scene, sphere, 3.004) == text);
    CHECK(with_motion_key(text, scene, lamp, 5) ==
          replaced(text, "<1,0,0> } }", "<1,0,0> } key { time 5  translate <1, 0, 0> } }"));
    const Scene changed = parse_scene(more, "test");
    CHECK(without_motion_key(more, motions_of(changed)[1], 2) == text);
    CHECK(without_motion_key(text, sphere, 0) == replaced(text, "    key { time 1 }", ""));
    CHECK(without_motion_key(text, lamp, 0) == text);
}

TEST_CASE("motions of definitions stay as they are, and so do texts that are not those of the scene") {
    const std::string text = with_music +
                             "define mover sphere { <0,0,0>, 1 motion { key { time 0 } key { time 1 scale 2 } "
                             "key { time 2 } } }\nmover { }\n";
    const Scene scene = parse_scene(text, "test");
    const SceneMotion motion = motions_of(scene).at(0);
    for (const std::string& other : {text, with_music, std::string(), with_music + "sphere {"}) {
        CHECK(with_key_time(other, scene, motion, 1, 1.5) == other);
        CHECK(with_motion_key(other, scene, motion, 1.5) == other);
        CHECK(without_motion_key(other, motion, 1) == other);
    }
}
