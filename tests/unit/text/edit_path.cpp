// Paths that are written into the text of a scene.
#include "text/edit_path.h"

#include <doctest/doctest.h>

#include <utility>

#include "tests/unit/text/random_texts.h"
#include "text/camera_text.h"
#include "text/parse.h"
#include "text/text_items.h"
#include "text/write.h"

using namespace strahl;

TEST_CASE("a path is written into a scene, and all else stays as it is") {
    const std::string before = "// My scene: { not a block, \"\nsphere { <0,0,0>,1 }  /* flythrough { */\n";
    const std::string camera = "camera { position <0,-9,1> look_at <0,0,0> sky <0,0,1> angle 40 } // eye\n";
    const std::string block =
        "flythrough { duration 8 // seconds\n\tloop\n\n"
        "    key { time 0 position <1.50,0,0> look_at <0,0,0> }  // start\n"
        "    key{time 2.0 position <2,0,0> look_at <0,0,0>}  // turn\n"
        "    // and home:\n    key { time 5  position <3,0,0>  look_at <0,0,0>  fov 30 }\n}";
    const std::string after = "\n// the end\nplane { <0,0,0>, <1,0,0>, <0,1,0> }";
    const std::string text = before + camera + block + after;
    const Flythrough path = *parse_scene(text, "test").flythrough;
    CHECK(with_path(text, path) == text);

    const auto changed = [&](const Flythrough& newer, const std::string& from, const std::string& to) {
        std::string expected = text;
        expected.replace(expected.find(from), from.size(), to);
        CHECK(with_path(text, newer) == expected);
        CHECK(parse_scene(expected, "test").flythrough == newer);
    };
    Flythrough newer = path;
    newer.keys[1].position.x = 7;
    changed(newer, "key{time 2.0 position <2,0,0> look_at <0,0,0>}",
            "key { time 2  position <7, 0, 0>  look_at <0, 0, 0> }");
    newer = path, newer.keys[1].time = 3;  // a key that is moved to another time takes its comment along
    changed(newer, "key{time 2.0 position <2,0,0> look_at <0,0,0>}",
            "key { time 3  position <2, 0, 0>  look_at <0, 0, 0> }");
    newer = path, newer.keys[1].ease = .5;
    changed(newer, "key{time 2.0 position <2,0,0> look_at <0,0,0>}",
            "key { time 2  position <2, 0, 0>  look_at <0, 0, 0>  ease 0.5 }");
    newer = path, newer.duration = 12;
    changed(newer, "duration 8", "duration 12");
    newer = path, newer.loop = false;
    changed(newer, "\n\tloop", "");
    newer = path, newer.keys.insert(newer.keys.begin() + 2, {4, {1, 1, 1}, {0, 0, 0}, {}, {}});
    changed(newer, "look_at <0,0,0>}", "look_at <0,0,0>}\n    key { time 4  position <1, 1, 1>  look_at <0, 0, 0> }");
    newer = path, newer.keys.erase(newer.keys.begin() + 1);
    changed(newer, "key{time 2.0 position <2,0,0> look_at <0,0,0>}", "");  // the comment stays on its line
    newer = path, newer.keys.pop_back();
    changed(newer, "\n    key { time 5  position <3,0,0>  look_at <0,0,0>  fov 30 }", "");
    newer = path, newer.keys.erase(newer.keys.begin() + 1);
    newer.loop = false, newer.duration = 6, newer.keys[0].position.x = 9;
    newer.keys.push_back({6, {4, 4, 4}, {0, 0, 0}, {}, {}});
    CHECK(parse_scene(with_path(text, newer), "test").flythrough == newer);
    CHECK(with_path(text, newer).starts_with(before + camera));
    CHECK(with_path(text, newer).ends_with("}" + after));

    // Adds a block where there is none, and removes one that is no longer wanted.
    CHECK(with_path(before + camera, path) == before + camera + "\n" + write_flythrough(path, {true, true}));
    CHECK(with_path(text, {}) == before + camera.substr(0, camera.size() - 1) + after);
    CHECK(with_path(before + camera, {}) == before + camera);
}

TEST_CASE("keys are written in the words of the scene's camera") {
    const Keyframe key{1, {1, 2, 3}, {0, 0, 0}, 20, DVec3{0, 0, -1}};
    const Flythrough path{1, false, {{0, {0, 0, 0}, {1, 1, 1}, {}, {}}, key}};
    const std::string start = "camera { position <0,-9,1>  look_at <0,0,0>  ";
    for (const auto& [words, written] : {std::pair("sky <0,0,1>  angle 40 }", "sky <0, 0, 1>  angle 40"),
                                         {"up <0,0,-1> fov 9}", "up <0, 0, -1>  fov 20"},
                                         {"sky <0,0,1>  fov 4 } // angle", "sky <0, 0, 1>  fov 20"}}) {
        const std::string text = "// camera { angle\n" + start + words + "\n";
        const std::string changed = with_path(text, path);
        CHECK(changed.find(written) != std::string::npos);
        CHECK(parse_scene(changed, "test").flythrough == path);
        const Scene scene = parse_scene(text, "test");
        CHECK(parse_scene(write_camera(scene.camera, {}, eye_words(text)), "test").camera == scene.camera);
    }
}

TEST_CASE("a view becomes the camera of a text, in its words; the rest stays") {
    const std::string text =
        "// mine\ncamera { position <1, 2, 3> /* eye */ look_at <0, 0, 0> sky <0, 0, 1>\n angle 40 }\n";
    const Keyframe view{0, {4, 5, 6.5}, {1, 0, 0}, {}, {}};
    CHECK(with_camera(text, view) ==
          "// mine\ncamera { position <4, 5, 6.5> /* eye */ look_at <1, 0, 0> sky <0, 0, 1>\n angle 40 }\n");
    const Keyframe other{0, {4, 5, 6.5}, {1, 0, 0}, 25, DVec3(0, 1, 0)};
    CHECK(with_camera(text, other) ==
          "// mine\ncamera { position <4, 5, 6.5> /* eye */ look_at <1, 0, 0> sky <0, -1, 0>\n angle 50 }\n");
    const std::string bare = "camera { position <1, 2, 3> look_at <0, 0, 0> }\n";
    const auto added = with_camera(bare, other);
    REQUIRE(added);
    const Camera camera = parse_scene(*added, "").camera;
    CHECK((camera.up == DVec3(0, 1, 0) && camera.fov == 25 && camera.position.z == 6.5));
    CHECK(!with_camera("camera { position <track \"x\", 2, 3> look_at <0, 0, 0> }\n", view));
}

TEST_CASE("the point in focus takes the place of the one before, or of a distance; a camera without a lens gets one") {
    const DVec3 point(1, 2.5, 3);
    const auto focused = [&](const std::string& words) {
        return with_focus_on("camera { fov 9" + words + " }\nsphere { <0,0,0>, 1 }\n", point, .1).value_or("nothing");
    };
    const std::string rest = "\nsphere { <0,0,0>, 1 }\n";
    CHECK(focused("") == "camera { fov 9  aperture 0.1  focus_on <1, 2.5, 3> }" + rest);
    CHECK(focused(" aperture 0") == "camera { fov 9 aperture 0.1  focus_on <1, 2.5, 3> }" + rest);
    CHECK(focused(" aperture .2 focus 7 blades 5") ==
          "camera { fov 9 aperture .2 focus_on <1, 2.5, 3> blades 5 }" + rest);
    CHECK(focused(" focus_on <7, 8, 9> aperture .2") == "camera { fov 9 focus_on <1, 2.5, 3> aperture .2 }" + rest);
    CHECK(focused(" aperture track \"a\" .2") == "nothing");
    CHECK(focused(" aperture .2 focus track \"f\" 7") == "nothing");
    CHECK(!with_focus_on("sphere { <0,0,0>, 1 }", point, .1));
}

TEST_CASE("blocks are found by braces where they are found by reading") {
    const std::string_view words[] = {"camera", "global_settings", "background", "fog", "flythrough", "light"};
    const std::string_view comments[] = {"// { \" }\n", "/* } \" { camera */", " /**/ ", "\n"};
    std::mt19937 random(7);
    int found = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        std::string text = write_scene(RandomScenes(seed).scene());
        for (std::size_t at = 0; (at = text.find_first_of(" \n", at)) != text.npos;) {
            const std::string_view comment = comments[random() % 4];
            if (random() % 4 == 0) text.insert(at, comment), at += comment.size();
            ++at;
        }
        for (const std::string_view word : words) {
            const TextItem item = item_of_block(text, word);
            CHECK(block_of(text, word) == (item.end.empty() ? std::string_view() : whole_block(item)));
            found += !item.end.empty();
        }
    }
    CHECK(found > 600);
}

TEST_CASE("a path and a view are written into a scene whose text has directives") {
    const std::string path = "flythrough { duration 2 * Long key { time 0 position <0,-3,0> look_at <0,0,0> } }";
    const std::string text =
        "#declare Long = 4;\n#macro Two() sphere { 0, 1 } #end\n"
        "camera { position <0,-9,1> look_at <0,0,0> sky <0,0,1> angle 40 }\nTwo()\n";
    CHECK(eye_words(text).sky);
    Flythrough newer;
    newer.duration = 5, newer.keys = {{1, {7, 8, 9}, {0, 0, 0}, {}, {}}};
    const std::string block = write_flythrough(newer, eye_words(text));
    CHECK(with_path(text + path + "\n// the end\n", newer) == text + block + "// the end\n");
    CHECK(with_path(text + path, std::nullopt) + "\n" == text);
    Keyframe view = newer.keys[0];
    view.look_at = {1, 2, 3};
    std::string moved = text;
    moved.replace(moved.find("<0,-9,1> look_at <0,0,0>"), 24, "<7,8,9> look_at <1,2,3>");
    CHECK(with_camera(text, view) == moved);
    // Bodies of a loop or a macro are not numbered as they stand in the text.
    CHECK(items_of_body(text, 0).body.word.empty());
    CHECK(item_of_light("light { position 1 } #if (1) light { position 2 } #end", 0).word == "light");
    CHECK(item_of_light("light { position 1 } #if (1) light { position 2 } #end", 1).word.empty());
}
