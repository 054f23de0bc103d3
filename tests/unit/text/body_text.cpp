// Tests where the numbers of bodies are found in a text, and that they are changed there.
#include "text/body_text.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "scene/leaves.h"
#include "tests/unit/scenes.h"
#include "tests/unit/text/random_texts.h"
#include "text/new_block.h"
#include "text/parse.h"
#include "text/text_items.h"
#include "text/write.h"

using namespace strahl;

namespace {

const std::string start = "camera { position <0,-9,2> look_at <0,0,0> up <0,0,-1> fov 20 }\n";

const BodyValue& value(const BodyText& body, const std::string& name) {
    const auto found = std::ranges::find(body.values, name, &BodyValue::name);
    REQUIRE(found != body.values.end());
    return *found;
}

BodyText body_of(const std::string& text, int body, int leaf = 0) {
    return body_text(text, parse_scene(text, "test"), body, leaf);
}

}  // namespace

TEST_CASE("a body is found behind others, whatever stands in their blocks and comments") {
    const std::string text = start +
                             "mesh { file \"a}b/*.ply\" } // }\r\n"
                             "sphere { <1,1,1>, 1 /* } *//* { */ material { rgb <1,1,1> } // }\n}\n"
                             "define ball sphere { <0,0,0>, 1 /*/ } */ }\n"
                             "ball { } ball{}light { color <1,1,1> }box { }\n";
    CHECK(items_of_body(text, 4).body.word == "box");
    CHECK(items_of_body(text, 3).body.word == "ball");
    CHECK(items_of_body(text, 1).body.word == "sphere");
    CHECK(items_of_body(text, 5).body.word == "");
    CHECK(item_of_light(text, 0).word == "light");
    for (const char* odd :
         {"sphere", "sphere {", "sphere { /* ", "sphere { // }", "sphere { \" }", "sphere }", "box { /"})
        CHECK(items_of_body(odd, 1).body.word == "");
}

TEST_CASE("numbers of a body are changed where they stand, and all else stays as it is written") {
    const std::string text = start +
                             "// red { sphere {\n"
                             "sphere { <1, 2.50, 3> /* not round */, 2  // a ball\n"
                             "  material { rgb <1, .2, .20> pow 7 }  rotate <0, 0, 90>\n"
                             "}\n";
    const BodyText body = body_of(text, 0);
    CHECK(body.kind == "sphere");
    CHECK(body.line == 3);
    CHECK(value(body, "centre").numbers == std::vector<double>{1, 2.5, 3});
    CHECK(value(body, "radius").range.low > 0);
    CHECK(value(body, "radius").source == "");
    CHECK(value(body, "rotate").numbers == std::vector<double>{0, 0, 90});
    CHECK(value(body, "rgb").color);
    CHECK(value(body, "ior").source == no_source);
    const std::string moved = with_numbers(text, value(body, "centre"), std::vector<double>{1, 2.5, -4});
    CHECK(moved == start +
                       "// red { sphere {\n"
                       "sphere { <1, 2.50, -4> /* not round */, 2  // a ball\n"
                       "  material { rgb <1, .2, .20> pow 7 }  rotate <0, 0, 90>\n"
                       "}\n");
    CHECK(with_numbers(text, value(body, "rgb"), std::vector<double>{1, .2, .3}).find("<1, .2, 0.3> pow") !=
          std::string::npos);
    const std::string glass = with_own_value(text, value(body, "ior"), std::vector<double>{1.5});
    CHECK(glass.find("pow 7  ior 1.5 }  rotate") != std::string::npos);
    CHECK(parse_scene(glass, "").materials[0].ior == 1.5);
    const std::string away = with_own_value(text, value(body, "translate"), std::vector<double>{0, 0, 5});
    CHECK(away.find("rotate <0, 0, 90>\n translate <0, 0, 5> }") != std::string::npos);
    CHECK(value(body_of(away, 0), "translate").slices.size() == 3);
}

TEST_CASE("a value says which block it comes from, and can become the body's own") {
    const std::string text = start +
                             "define glass material { refraction .8 ior 1.5 }\n"
                             "define dark material glass { rgb <.1, .1, .1> }\n"
                             "defaultmaterial { diffuse .7  ambient .15 }\n"
                             "defaultmaterial dark\n"
                             "sphere { <0,0,0>, 1 material glass }\n"
                             "sphere { <3,0,0>, 1 material dark { ior 2 } }\n"
                             "difference { sphere { <0,0,0>, 2 } box { <0,0,0>, <2,2,2> material { pow 9 } rotate 0 } "
                             "material { specular .3 } translate <0,0,1> }\n"
                             "define pair union { sphere { <0,0,0>, 1 } sphere { <1,0,0>, 1 material { pow 3 } } }\n"
                             "pair { material { reflection .25 } }\n";
    const std::string valid = std::string(text).replace(text.find("rotate 0"), 8, "rotate <0,0,0>");
    const auto source = [&](int body, int leaf, const std::string& name) {
        return value(body_of(valid, body, leaf), name).source;
    };
    CHECK(source(0, 0, "ior") == "define glass, line 2");
    CHECK(source(0, 0, "diffuse") == "defaultmaterial, line 4");
    CHECK(source(0, 0, "rgb") == "define dark, line 3");
    CHECK(source(0, 0, "pow") == no_source);
    CHECK(source(1, 0, "ior") == "");
    CHECK(source(1, 0, "refraction") == "define glass, line 2");
    CHECK(body_of(valid, 2, 1).kind == "box in difference");
    CHECK(source(2, 1, "pow") == "");
    CHECK(source(2, 1, "specular") == "difference, line 8");
    CHECK(value(body_of(valid, 2, 1), "translate of difference").numbers[2] == 1);
    CHECK(source(3, 1, "pow") == "define pair, line 9");
    CHECK(source(3, 1, "reflection") == "pair, line 10");
    CHECK(value(body_of(valid, 3, 1), "specular").own_at == 0);  // own in all uses, or in none

    const auto own = [&](int body, int leaf, const char* name) {
        const std::string changed =
            with_own_value(valid, value(body_of(valid, body, leaf), name), std::vector<double>{.5});
        return changed;
    };
    CHECK(own(0, 0, "refraction").find("material glass { refraction 0.5 } }") != std::string::npos);
    CHECK(own(1, 0, "refraction").find("dark { ior 2  refraction 0.5 } }") != std::string::npos);
    CHECK(own(2, 0, "pow").find("sphere { <0,0,0>, 2  material { pow 0.5 } } box") != std::string::npos);
    for (int body = 0; body < 3; ++body) static_cast<void>(parse_scene(own(body, 0, "pow"), ""));
    const std::string shared = with_numbers(valid, value(body_of(valid, 0), "ior"), std::vector<double>{1.25});
    const Scene scene = parse_scene(shared, "");
    CHECK(scene.materials[scene.primitives[0].material].ior == 1.25);
    CHECK(scene.materials[scene.primitives[1].material].ior == 2);
}

TEST_CASE("what is no number, or follows a track, is left alone") {
    const std::string text = start +
                             "sphere { <0,0,0>, 1 material { rgb checker { <1,0,0>, <0,1,0> } diffuse track \"d\" .5 } "
                             "translate <track \"x\", 0, 1> }\n";
    const BodyText body = body_of(text, 0);
    CHECK(value(body, "rgb").fixed == "a pattern");
    CHECK(value(body, "diffuse").fixed == "follows \"d\"");
    CHECK(value(body, "translate").fixed == "follows \"x\"");
    // For a body without a text, as those of POV-Ray's scenes, nothing stands anywhere.
    const BodyText read = body_text("", parse_scene(text, ""), 0, 0);
    CHECK(read.line == 0);
    CHECK(value(read, "reflection").numbers[0] == .5);
    for (const BodyValue& own : read.values) CHECK(own.fixed != "");
    CHECK(body_text("", parse_scene(text, ""), 0, 1).kind == "");  // no such leaf
    for (const char* broken : {"sphere {", "sphere { <1,", "define", "define a", "}", "sphere } {", "material \"", "<"})
        CHECK(items_of_body(broken, 0).body.end.empty());
    std::string deep;
    for (int i = 0; i < 100000; ++i) deep += "union { ";
    CHECK(items_of_body(deep, 0).body.word.empty());
}

TEST_CASE("all leaves of scenes are found, and changing a number changes only that") {
    const auto look = [](const std::string& text, const Scene& scene) {
        const int bodies = std::min(40, static_cast<int>(scene.primitives.size()));
        for (int i = 0; i < bodies; ++i) {
            int leaves = 0;
            for_each_leaf(scene.primitives[i], [&](const Primitive& leaf, const glm::dmat4&) {
                const BodyText body = body_text(text, scene, i, leaves++);
                REQUIRE(body.line > 0);
                std::visit([&](const auto& kind) { CHECK(body.kind.starts_with(kind.name)); }, leaf.shape);
                const Material& material = scene.materials[leaf.material];
                CHECK(value(body, "pow").numbers[0] == material.pow);
                CHECK(value(body, "reflection").numbers[0] == material.reflection);
                if (!material.rgb.pattern) {
                    const auto& rgb = value(body, "rgb").numbers;
                    CHECK(DVec3(rgb[0], rgb[1], rgb[2]) == material.rgb.color);
                }
                if (const Sphere* const sphere = std::get_if<Sphere>(&leaf.shape))
                    CHECK(value(body, "radius").numbers[0] == sphere->radius);
            });
        }
    };
    for (const char* name : {"article", "demo", "beat", "carved", "motion", "die"}) {
        const std::string path = std::string(STRAHL_SOURCE) + "/scenes/" + name + ".rt";
        CAPTURE(path);
        look(read_text(path), read_scene(name));
    }
    for (unsigned seed = 0; seed < 60; ++seed) {
        const std::string text = write_scene(RandomScenes(seed).scene());
        CAPTURE(text);
        try {
            look(text, parse_scene(text, "", {}, made_up_pixels));
        } catch (const FileError&) {  // a body transformed out of range
        }
    }
}

TEST_CASE("a material of the list replaces the body's own, and changes no other body") {
    const std::string text = start +
                             "define red material { rgb <1, 0, 0> }\n"
                             "define ball sphere { <0,0,0>, 1  material red }\n"
                             "sphere { <0,0,0>, 1 /* bare */ }\n"
                             "sphere { <0,0,0>, 1  material red { pow 7 } /* own */ }\n"
                             "sphere { <0,0,0>, 1  material red }\n"
                             "difference { box { <0,0,0>, <1,1,1> } sphere { <0,0,0>, 1 } material { rgb <0,1,0> } }\n"
                             "ball { }\nball { material red }\n";
    const Scene before = parse_scene(text, "test");
    for (const MaterialPreset& preset : material_presets)
        for (int i = 0; i < std::ssize(before.primitives); ++i) {
            CAPTURE(preset.name);
            CAPTURE(i);
            const BodyText body = body_of(text, i);
            REQUIRE(body.material);
            const std::string changed = with_material(text, body, preset, 2);
            const Scene after = parse_scene(changed, "test");
            const auto material = [](const Scene& scene, int number) {
                const Primitive& own = scene.primitives[std::size_t(number)];
                const Primitive* leaf = nullptr;  // the first
                for_each_leaf(own, [&](const Primitive& part, const glm::dmat4&) { leaf = leaf ? leaf : &part; });
                return scene.materials[std::size_t(leaf->material)];
            };
            for (int other = 0; other < std::ssize(before.primitives); ++other)
                if (other != i) CHECK(material(after, other) == material(before, other));
            CHECK(material(after, i) != material(before, i));
            CHECK(changed.find("/* bare */") != std::string::npos);
            CHECK(changed.find("/* own */") != std::string::npos);
            if (std::string(preset.name) == "matt")
                CHECK(material(after, i).rgb.color == material(before, i).rgb.color);
            // A material that is given once more replaces the first.
            CHECK(with_material(changed, body_of(changed, i), preset, 2) == changed);
        }
    // A part of a definition gets no material of its own: all uses of the definition would have it.
    CHECK(
        !body_of(start + "define two union { sphere { <0,0,0>, 1 } sphere { <3,0,0>, 1 } }\ntwo { }\n", 0, 0).material);
}
