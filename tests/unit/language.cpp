// The scene language: valid scenes, and the messages and places of errors.
#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "text/parse.h"

using namespace strahl;

template <>
struct doctest::StringMaker<std::vector<std::string>> {
    static String convert(const std::vector<std::string>& lines) {
        std::string all;
        for (const std::string& line : lines) all += "\n" + line;
        return all.c_str();
    }
};

namespace {

const std::string eye = "camera { position <0,-9,0> look_at <0,0,0> up <0,0,-1> fov 25 }\n";

Scene parse(const std::string& text) { return parse_scene(text, "x.rt"); }
/// A scene with the camera in its first line, so that `text` starts in line 2.
Scene with_eye(const std::string& text) { return parse(eye + text); }

std::string message(const std::string& text, const TextLimits& limits = {}) {
    try {
        parse_scene(text, "x.rt", limits);
    } catch (const FileError& error) {
        return error.what();
    }
    return "no error";
}
std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> result(1);
    for (const char c : text)
        if (c == '\n')
            result.emplace_back();
        else
            result.back() += c;
    return result;
}
/// "unknown word 'x'; known here: ..." on the top level.
std::string unknown(const std::string& word) {
    const auto kinds = []<class... Kinds>(std::type_identity<std::variant<Kinds...>>) {
        return (... + (std::string(", ") + Kinds::name));
    };
    return "unknown word '" + word + "'; known here: camera, light" + kinds(std::type_identity<Shape>{}) +
           ", defaultmaterial, background, global_settings, flythrough";
}
/// The lines of a message that name a place, without quoted lines and carets.
std::vector<std::string> faults(const std::string& text) {
    std::vector<std::string> result;
    for (const std::string& line : lines(message(text)))
        if (!line.starts_with("    ")) result.push_back(line);
    return result;
}
using Faults = std::vector<std::string>;

/// Checks the only error of `text`, which follows a valid camera of one line.
void check_fault(const std::string& text, const std::string& fault) {
    CAPTURE(text);
    CHECK(faults(eye + text) == Faults{"x.rt:" + fault});
}

}  // namespace

TEST_CASE("the article's own listings") {
    const Scene scene = parse(R"(
camera
{
  position <5.0,-20.0,18.0>
  look_at < 0.0,0.0,0.0> //K.ziel
  up < 0,0,-1> //Kamera oben?
  fov 25.0 //Öffnungswinkel
  aspectratio 1.333333
  //Breite/Höhe des Bildschirms
}
light
{
  position <-5.0,0.0,10.0> //Ort
  color < 0.5,0.5,0.5> //L.Farbe
}
defaultmaterial
{
  rgb < 0.5, 0.5, 0.5> //RGB-Farbe
  reflection 0.5 // Reflexkoeff.
  refraction 0.0 // Transparenz
  diffuse 0.5 // Reflex.Koeffiz.
  ambient 0.0 // Reflex.Koeffiz.
  specular 1.0 // Koeffiz.für
  // spiegelnde Reflexion
  pow 50.0 // Potenz dafür
  ior 1.0 // Brechzahl-Material
}
sphere
{ < 1,2,3>, 4
  material
  { rgb <1,0,0> }
}
plane
{< 0.0, 0.0, 0.0 >,
 < 1.0, 0.0, 0.0 >,
 < 0.0, 1.0, 0.0 > }
)");
    CHECK(scene.camera == Camera{{5, -20, 18}, {0, 0, 0}, {0, 0, -1}, 25, 1.333333});
    CHECK(scene.lights == std::vector<Light>{{{-5, 0, 10}, {.5, .5, .5}}});
    Material red;
    red.rgb = {1, 0, 0};
    CHECK(scene.materials == std::vector<Material>{red, Material{}});
    REQUIRE(scene.primitives.size() == 2);
    CHECK(scene.primitives[0] == Primitive{Sphere{{1, 2, 3}, 4}, 0, {}});
    CHECK(scene.primitives[1] == Primitive{Plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 1, {}});
    CHECK(scene.settings == Settings{});
    CHECK(scene.background == Color(0));
    CHECK(!scene.flythrough);
}

TEST_CASE("everything that the article does not have") {
    const Scene scene = parse(R"(
        background { color <.1, .2, .3> }
        global_settings { ambient_light <1, 2, 3> max_trace_level 256 assumed_gamma 1 }
        cylinder { <0,0,0>, <0,0,2>, .5 }
        camera { angle 50 sky <0,0,1> look_at <0,0,0> position <0,-9,0> }
        flythrough { loop duration 12
            key { time 0 position <0,-9,0> look_at <0,0,0> }
            key { look_at <0,0,1> position <1,-9,0> time 4 angle 90 sky <1,0,1> } })");
    CHECK(scene.background == Color(.1, .2, .3));
    CHECK(scene.settings == Settings{{1, 2, 3}, 256, true});
    CHECK(scene.primitives == std::vector<Primitive>{{Cylinder{{0, 0, 0}, {0, 0, 2}, .5}, 0, {}}});
    CHECK(scene.camera == Camera{{0, -9, 0}, {0, 0, 0}, {0, 0, -1}, 25, {}});
    CHECK(
        scene.flythrough ==
        Flythrough{12, true, {{0, {0, -9, 0}, {0, 0, 0}, {}, {}}, {4, {1, -9, 0}, {0, 0, 1}, 45., DVec3(-1, 0, -1)}}});
}

TEST_CASE("materials start from the default in force; no duplicates, in the order of use") {
    const Scene scene = with_eye(R"(
        sphere { <0,0,0>, 1 }
        defaultmaterial { diffuse .1 ior 2 }
        sphere { <0,0,0>, 2 material { diffuse .2 } }
        sphere { <0,0,0>, 3 }
        defaultmaterial { ambient 1 }
        sphere { <0,0,0>, 4 material { } }
        defaultmaterial { rgb <.5,.5,.5> reflection .5 refraction 0 diffuse .5 ambient -0 specular 1 pow 50 ior 1 }
        sphere { <0,0,0>, 5 }
        defaultmaterial { pow 3 })");
    const auto of = [&](int i) { return scene.materials[scene.primitives[i].material]; };
    CHECK(of(0) == Material{});
    CHECK((of(1).diffuse == .2 && of(1).ior == 2 && of(1).ambient == 0));
    CHECK((of(2).diffuse == .1 && of(2).ior == 2 && of(2).ambient == 0));
    CHECK((of(3).diffuse == .1 && of(3).ior == 2 && of(3).ambient == 1));  // the second default starts from the first
    CHECK(scene.primitives[4].material == 0);
    CHECK(scene.materials.size() == 4);
}

TEST_CASE("transformations keep their order, even with a material between them") {
    const Scene scene =
        with_eye("sphere { <0,0,0>, 1 scale 2 rotate <1,2,3> material { } translate <4,5,6> scale <1,2,-3> }");
    CHECK(scene.primitives[0].transformations ==
          std::vector<Transformation>{Scale{{2, 2, 2}}, Rotate{{1, 2, 3}}, Translate{{4, 5, 6}}, Scale{{1, 2, -3}}});
}

TEST_CASE("numbers as in C, commas, comments and white space") {
    const auto radius = [](const std::string& text) {
        return std::get<Sphere>(with_eye("sphere { <0,0,0>, " + text + " }").primitives.at(0).shape).radius;
    };
    CHECK(radius("1") == 1);
    CHECK(radius("+2.50") == 2.5);
    CHECK(radius(".5") == .5);
    CHECK(radius("1.") == 1);
    CHECK(radius("1e-3") == 1e-3);
    CHECK(radius("1E+3") == 1e3);
    CHECK(radius("0.1") == .1);
    CHECK(radius("1.7976931348623157e-300") == 1.7976931348623157e-300);
    const std::vector<Primitive> ball{{Sphere{{1, -2, 3}, 4}, 0, {}}};
    for (const char* const text :
         {"sphere{<1,-2,3>,4}", "sphere{<1,-2,3>4}", "sphere { <1 , -2 , 3> 4 }", "sphere\r\n{\t<1,\v-2,\f3>\r,4\r\n}",
          "sphere/**/{/* a * / */<1,-2,// }\n3>/**/4/*}*/}//", "// ä\nsphere{<1,-2,3>,4}\n/* /* */",
          "sphere{<1,-2,3>/***/4}"})
        CHECK(with_eye(text).primitives == ball);
    CHECK(parse("\xEF\xBB\xBF" + eye).lights.empty());  // a byte order mark
}

TEST_CASE("an error is quoted with a caret under it") {
    CHECK(message(eye + "sphere { <0,0,0>, 1 }\nshpere { <0,0,0>, 1 }\n") ==
          "x.rt:3:1: unknown word 'shpere'; did you mean 'sphere'?\n"
          "    shpere { <0,0,0>, 1 }\n"
          "    ^~~~~~");
    // Columns count characters; the caret is right after tabs, wide letters and combining marks.
    CHECK(message(eye + "/* \xC3\xA4\xE6\x97\xA5"
                        "a\xCC\x88 */\tsphere { <0,0,0>, -1 }") ==
          "x.rt:2:30: 'radius' of 'sphere' must be greater than 0 (at least 2.3e-308) and at most 1e15, not '-1'\n"
          "    /* \xC3\xA4\xE6\x97\xA5"
          "a\xCC\x88 */    sphere { <0,0,0>, -1 }\n"
          "                                    ^~");
    // No control character reaches the terminal.
    CHECK(message(eye + "/*\x1B[31m\xC2\x9B\xE2\x80\xAE*/ x\r\n") ==
          "x.rt:2:13: " + unknown("x") +
              "\n"
              "    /*\xEF\xBF\xBD[31m\xEF\xBF\xBD\xEF\xBF\xBD*/ x\n"
              "                ^");
}

TEST_CASE("long lines are shown around the error") {
    const std::string spheres(7000, ' ');
    const std::vector<std::string> told = lines(message(eye + spheres + "shpere" + spheres));
    REQUIRE(told.size() == 3);
    CHECK(told[0].starts_with("x.rt:2:7001: "));
    CHECK(told[1] == "    ..." + std::string(60, ' ') + "shpere" + std::string(34, ' ') + "...");
    CHECK(told[2] == "    " + std::string(63, ' ') + "^~~~~~");
    const std::vector<std::string> at_start = lines(message(eye + "shpere" + spheres));
    CHECK(at_start[1] == "    shpere" + std::string(94, ' ') + "...");
    const std::vector<std::string> word = lines(message(eye + std::string(1000, 'q')));
    CHECK(word[0].starts_with("x.rt:2:1: unknown word '" + std::string(40, 'q') + "...'; known here: camera"));
    CHECK(word[2] == "    ^" + std::string(99, '~'));
}

TEST_CASE("the nearest known word is offered") {
    check_fault("sphere { <0,0,0>, 1 material { reflexion 1 } }",
                "2:32: unknown word 'reflexion' in 'material'; did you mean 'reflection'?");
    check_fault("Light { position <0,0,0> color <1,1,1> }", "2:1: unknown word 'Light'; did you mean 'light'?");
    check_fault("light { position <0,0,0> colour <1,1,1> }",
                "2:26: unknown word 'colour' in 'light'; did you mean 'color'?");
    check_fault("psehre { <0,0,0>, 1 }", "2:1: unknown word 'psehre'; did you mean 'sphere'?");
    check_fault("sphere { <0,0,0>, 1 traslate <1,1,1> }",
                "2:21: unknown word 'traslate' in 'sphere'; did you mean 'translate'?");
    check_fault("light_source { }", "2:1: unknown word 'light_source'; did you mean 'light'?");
    check_fault("sphere { <0,0,0>, 1 trans <1,1,1> }",
                "2:21: unknown word 'trans' in 'sphere'; did you mean 'translate'?");
    check_fault("sphere { <0,0,0>, 1 pigment { color <1,1,1> } }",
                "2:21: unknown word 'pigment' in 'sphere'; known here: material, rotate, translate, scale");
}

TEST_CASE("missing parameters") {
    CHECK(faults("") == Faults{"x.rt:1:1: no camera: a scene needs one 'camera { ... }'"});
    CHECK(message("sphere { <0,0,0>, 1 }\n\n") ==
          "x.rt:1:22: no camera: a scene needs one 'camera { ... }'\n"
          "    sphere { <0,0,0>, 1 }\n"
          "                         ^");
    CHECK(faults(" camera { }") ==
          Faults{"x.rt:1:2: 'camera' lacks 'position', 'look_at', 'up' (or 'sky'), 'fov' (or 'angle')"});
    check_fault("light { position <0,0,0> }", "2:1: 'light' lacks 'color'");
    check_fault("light { color <1,1,1> }", "2:1: 'light' lacks 'position'");
    check_fault("background { }", "2:1: 'background' lacks 'color'");
    check_fault("flythrough { }", "2:1: 'flythrough' lacks 'duration', keys: it takes 2 to make a path");
    check_fault("flythrough { duration 1 key { } key { time 1 position <0,0,0> look_at <1,0,0> } }",
                "2:25: 'key' lacks 'time', 'position', 'look_at'");
    check_fault("flythrough { duration 1 key { time 1 position <0,0,0> look_at <1,0,0> } }",
                "2:1: 'flythrough' lacks keys: it takes 2 to make a path");
    check_fault("sphere { }", "2:10: a vector <x, y, z> expected for 'centre' of 'sphere', but here comes '}'");
    check_fault("sphere { <0,0,0> }", "2:18: a number expected for 'radius' of 'sphere', but here comes '}'");
    check_fault("plane { <0,0,0>, <1,0,0> }",
                "2:26: a vector <x, y, z> expected for 'third point' of 'plane', but here comes '}'");
    check_fault("sphere { <0,0,0>, 1 material { pow } }",
                "2:36: a number expected for 'pow' of 'material', but here comes '}'");
    check_fault("light { position 5 color <1,1,1> }",
                "2:18: a vector <x, y, z> expected for 'position' of 'light', but here comes '5'");
}

TEST_CASE("syntax errors") {
    check_fault("sphere <0,0,0>, 1", "2:8: '{' expected after 'sphere', but here comes '<'");
    check_fault("sphere { <0 0,0>, 1 }",
                "2:13: ',' expected between the three numbers of a vector, but here comes '0'");
    check_fault("sphere { <0,0>, 1 }", "2:14: ',' expected between the three numbers of a vector, but here comes '>'");
    check_fault("sphere { <0,0,0,0>, 1 }",
                "2:16: '>' expected after the three numbers of a vector, but here comes ','");
    check_fault("sphere { <0,0,inf>, 1 }", "2:15: a number expected for 'centre' of 'sphere', but here comes 'inf'");
    check_fault("sphere { <0,0,-nan>, 1 }", "2:15: a number expected for 'centre' of 'sphere', but here comes '-nan'");
    check_fault("sphere { <0,0,0>, --1 }", "2:19: a number expected for 'radius' of 'sphere', but here comes '-'");
    check_fault("sphere { <0,0,0>, 1.2.3 }", "2:19: '1.2.3' is not a number");
    check_fault("sphere { <0,0,0>, 1e }", "2:19: '1e' is not a number");
    check_fault("sphere { <0,0,0>, 0x10 }", "2:19: '0x10' is not a number");
    check_fault("sphere { <0,0,0>, 1e999 }",
                "2:19: '1e999' is outside of what a number can hold (4.9e-324 to 1.8e308)");
    check_fault("sphere { <0,0,0>, 1e-999 }",
                "2:19: '1e-999' is outside of what a number can hold (4.9e-324 to 1.8e308)");
    check_fault("sphere { <0,0,0>, 1, }", "2:20: a word or '}' expected in 'sphere', but here comes ','");
    check_fault("sphere { <0,0,0>, 1 } }", "2:23: a block expected, such as 'sphere { ... }', but here comes '}'");
    check_fault("<1,2,3>", "2:1: a block expected, such as 'sphere { ... }', but here comes '<'");
    check_fault("sphere { <0,0,0>, 1", "2:1: '}' missing: this 'sphere' is never closed");
    check_fault("sphere { <0,0,0>, 1 material { pow 1 }", "2:1: '}' missing: this 'sphere' is never closed");
    check_fault("sphere { <0,0,0>, 1 material { pow 1", "2:21: '}' missing: this 'material' is never closed");
    check_fault("sphere { <0,0,0>, 1\nlight { position <0,0,0> color <1,1,1> }",
                "3:1: '}' missing: the 'sphere' of line 2 is still open");
    check_fault("sphere { <0,0,0>, 1 material { pow 1\nlight { position <0,0,0> color <1,1,1> }",
                "3:1: '}' missing: the 'material' of line 2 is still open");
    check_fault("sphere { <0,0,0>,", "2:18: a number expected for 'radius' of 'sphere', but the text ends");
    check_fault("/* sphere", "2:1: this comment is never closed: '*/' missing");
    check_fault("/", "2:1: a block expected, such as 'sphere { ... }', but here comes '/'");
    check_fault("\xC3\xA4 { }", "2:1: a block expected, such as 'sphere { ... }', but here comes '\xC3\xA4'");
    check_fault("sphere", "2:7: '{' expected after 'sphere', but the text ends");
}

TEST_CASE("values out of range") {
    check_fault("sphere { <0,0,0>, 0 }",
                "2:19: 'radius' of 'sphere' must be greater than 0 (at least 2.3e-308) and at most 1e15, not '0'");
    check_fault("sphere { <0,0,0>, 1e-310 }",
                "2:19: 'radius' of 'sphere' must be greater than 0 (at least 2.3e-308) and at most 1e15, not '1e-310'");
    check_fault("sphere { <0,-1.5e15,0>, 1 }", "2:13: 'centre' of 'sphere' must be from -1e15 to 1e15, not '-1.5e15'");
    check_fault("light { position <1e16,0,0> color <1,1,1> }",
                "2:19: 'position' of 'light' must be from -1e15 to 1e15, not '1e16'");
    check_fault("light { position <1,0,0> color <1,1,-1> }",
                "2:37: 'color' of 'light' must be from 0 to 1e9, not '-1'");
    check_fault("background { color <-.1,0,0> }", "2:21: 'color' of 'background' must be from 0 to 1e9, not '-.1'");
    check_fault("defaultmaterial { reflection 1.01 }",
                "2:30: 'reflection' of 'defaultmaterial' must be from 0 to 1, not '1.01'");
    check_fault("defaultmaterial { refraction -.1 }",
                "2:30: 'refraction' of 'defaultmaterial' must be from 0 to 1, not '-.1'");
    check_fault("defaultmaterial { rgb <0,0,-1> }", "2:28: 'rgb' of 'defaultmaterial' must be from 0 to 1e9, not '-1'");
    check_fault("defaultmaterial { specular 1.1e9 }",
                "2:28: 'specular' of 'defaultmaterial' must be from 0 to 1e9, not '1.1e9'");
    check_fault("defaultmaterial { pow -1 }", "2:23: 'pow' of 'defaultmaterial' must be from 0 to 1e9, not '-1'");
    check_fault("defaultmaterial { ior 0 }", "2:23: 'ior' of 'defaultmaterial' must be from 1e-9 to 1e9, not '0'");
    check_fault("global_settings { max_trace_level 0 }",
                "2:35: 'max_trace_level' of 'global_settings' must be a whole number from 1 to 256, not '0'");
    check_fault("global_settings { max_trace_level 257 }",
                "2:35: 'max_trace_level' of 'global_settings' must be a whole number from 1 to 256, not '257'");
    check_fault("global_settings { max_trace_level 2.5 }",
                "2:19: 'max_trace_level' must be a whole number from 1 to 256");
    check_fault("global_settings { ambient_light <1,1,-1> }",
                "2:38: 'ambient_light' of 'global_settings' must be from 0 to 1e9, not '-1'");
    CHECK(faults(eye + "global_settings { assumed_gamma 2.2 }")
              .at(0)
              .starts_with("x.rt:2:33: 'assumed_gamma' of 'global_settings' must be 1,"));
    CHECK(faults("camera { position <0,0,0> look_at <0,1,0> up <0,0,-1> fov 90 }") ==
          Faults{"x.rt:1:59: 'fov' of 'camera' must be greater than 0 and less than 90 degrees, not '90'"});
    CHECK(faults("camera { position <0,0,0> look_at <0,1,0> up <0,0,-1> fov 0 }") ==
          Faults{"x.rt:1:59: 'fov' of 'camera' must be greater than 0 and less than 90 degrees, not '0'"});
    CHECK(faults("camera { position <0,0,0> look_at <0,1,0> up <0,0,-1> angle 180 }") ==
          Faults{"x.rt:1:61: 'angle' of 'camera' must be greater than 0 and less than 180 degrees, not '180'"});
    CHECK(faults("camera { position <0,0,0> look_at <0,1,0> up <0,0,-1> fov 1 aspectratio 0 }") ==
          Faults{"x.rt:1:73: 'aspectratio' of 'camera' must be from 1e-9 to 1e9, not '0'"});
    CHECK(parse("camera { position <0,0,0> look_at <0,1,0> up <0,0,-1> fov 89.99999999999999 }").camera.fov < 90);
    // A wrong value does not hide a missing parameter.
    CHECK(faults("camera { position <0,0,0> look_at <0,1,0> fov 95 }") ==
          Faults{"x.rt:1:1: 'camera' lacks 'up' (or 'sky')",
                 "x.rt:1:47: 'fov' of 'camera' must be greater than 0 and less than 90 degrees, not '95'"});
}

TEST_CASE("repeated words") {
    check_fault(eye, "2:1: a second 'camera'; the first is in line 1");
    check_fault("background { color <0,0,0> }\n\nbackground { color <0,0,0> }",
                "4:1: a second 'background'; the first is in line 2");
    check_fault("global_settings { }\nglobal_settings { }", "3:1: a second 'global_settings'; the first is in line 2");
    check_fault("light { position <0,0,0>\ncolor <1,1,1> position <0,0,0> }",
                "3:15: a second 'position'; the first is in line 2");
    check_fault("sphere { <0,0,0>, 1 material { }\nmaterial { } }", "3:1: a second 'material'; the first is in line 2");
    check_fault("defaultmaterial { pow 1 pow 1 }", "2:25: a second 'pow'; the first is in line 2");
    const std::string path =
        "flythrough { duration 1 key { time 0 position <0,0,0> look_at <1,0,0> } key { time 1 position <0,0,0> look_at "
        "<1,0,0> } }\n";
    check_fault(path + path, "3:1: a second 'flythrough'; the first is in line 2");
    check_fault(
        "flythrough { loop loop duration 1 key { time 0 position <0,0,0> look_at <1,0,0> } key { time 1 position "
        "<0,0,0> look_at <1,0,0> } }",
        "2:19: a second 'loop'; the first is in line 2");
    CHECK(faults("camera { position <0,0,0> look_at <0,1,0> sky <0,0,1> fov 1\nup <0,0,-1> angle 2 }") ==
          Faults{"x.rt:2:1: 'up' says again what 'sky' in line 1 says; only one of them may stand",
                 "x.rt:2:13: 'angle' says again what 'fov' in line 1 says; only one of them may stand"});
}

TEST_CASE("invalid bodies and cameras") {
    check_fault("plane { <0,0,0>, <1,1,1>, <3,3,3> }", "2:1: this plane is none: the three points lie on one line");
    check_fault("cylinder { <1,2,3>, <1,2,3>, 1 }", "2:1: this cylinder is none: base and cap are the same point");
    check_fault("sphere { <0,0,0>, 1 scale 0 }",
                "2:27: 'scale' of 'sphere' is 0, which would leave nothing of it; 1 changes nothing");
    check_fault("sphere { <0,0,0>, 1 scale <1,0,1> }",
                "2:27: 'scale' of 'sphere' is 0, which would leave nothing of it; 1 changes nothing");
    check_fault("sphere { <0,0,0>, 1 scale 1e200 scale 1e200 }",
                "2:33: up to here the transformations of this sphere scale it out of the range of numbers");
    check_fault("sphere { <0,0,0>, 1 scale 1e-200 scale 1e-200 }",
                "2:34: up to here the transformations of this sphere scale it out of the range of numbers");
    check_fault("sphere { <0,0,0>, 1 scale <1,1,1e-13> }",
                "2:21: up to here the transformations of this sphere flatten it: one side shrinks more than 1e12 times "
                "as much as another");
    check_fault("sphere { <1e10,0,0>, 1 scale 1e6 }",
                "2:24: up to here the transformations of this sphere make it too large, too small or too far away "
                "(coordinates go up to 1e15)");
    check_fault("sphere { <0,0,0>, 1e10 scale 1e6 }",
                "2:24: up to here the transformations of this sphere make it too large, too small or too far away "
                "(coordinates go up to 1e15)");
    check_fault(
        "cylinder { <0,0,0>, <0,0,1>, 1 scale 1e-30 translate <1,1,1> }",
        "2:44: up to here the transformations of this cylinder leave nothing of it: base and cap are the same point");
    CHECK(with_eye("sphere { <0,0,0>, 1 scale 1e-200 scale 1e200 scale <1e6,1,1> }").primitives.size() == 1);
    CHECK(faults("camera { position <1,2,3> look_at <1,2,3> up <0,0,-1> fov 1 }") ==
          Faults{"x.rt:1:1: this camera sees nothing: position and look_at are the same point"});
    CHECK(faults("camera { position <1,2,3> look_at <1,2,0> up <0,0,-1> fov 1 }") ==
          Faults{"x.rt:1:1: this camera sees nothing: up is parallel to the direction from position to look_at"});
}

TEST_CASE("invalid flythroughs") {
    const auto path = [](const std::string& head, const std::string& first, const std::string& second) {
        return "flythrough { " + head + "\nkey { position <0,0,0> look_at <1,0,0> time " + first +
               " }\nkey { position <0,0,0> look_at <1,1,0> time " + second + " } }";
    };
    CHECK(with_eye(path("duration 2", "0", "2")).flythrough->keys.size() == 2);
    check_fault(path("duration 2", "1", "1"),
                "4:40: times must rise: the key before, in line 3, is not earlier than this one");
    check_fault(path("duration 2", "0", "2.5"), "4:40: this is after the end, which 'duration' in line 2 sets");
    check_fault(
        path("duration 0", "0", "1"),
        "2:23: 'duration' of 'flythrough' must be greater than 0 (at least 2.3e-308) and at most 1e15, not '0'");
    check_fault(path("duration 2", "-1", "1"), "3:45: 'time' of 'key' must be from 0 to 1e15, not '-1'");
    check_fault(path("loop duration 2", "0", "2"),
                "4:40: at this time the loop is at its first key again: make this key the same as that in line 3, or "
                "'duration' longer");
    check_fault(path("duration 2", "0 tmie 3", "0"), "3:47: unknown word 'tmie' in 'key'; did you mean 'time'?");
    check_fault("key { time 1 }", "2:1: " + unknown("key"));
    CHECK(
        faults(eye + "flythrough { duration 2 key { time 0 position <0,0,0> look_at <0,0,0> }\nkey { time 1 position "
                     "<0,0,0> look_at <0,0,1> } }") ==
        Faults{
            "x.rt:2:25: the camera sees nothing at this key: position and look_at are the same point",
            "x.rt:3:1: the camera sees nothing at this key: up is parallel to the direction from position to look_at"});
}

TEST_CASE("several errors are reported at once, each once, in the order of the text") {
    CHECK(faults("camera { positon <0,-9,0> lok_at <0,0,0> up <0,0,-1> fov 25 }\n"
                 "shpere { <0,0,0>, 1 }\n"
                 "palne { <0,0,0>, { } }\n"
                 "sphere { <0,0,zero>, 1 material { rgb <1,1> diffuse -1 } translate }\n"
                 "light { position <0,0,0> color <1,1,1> }\n"
                 "light { }") ==
          Faults{"x.rt:1:10: unknown word 'positon' in 'camera'; did you mean 'position'?",
                 "x.rt:1:27: unknown word 'lok_at' in 'camera'; did you mean 'look_at'?",
                 "x.rt:2:1: unknown word 'shpere'; did you mean 'sphere'?",
                 "x.rt:3:1: unknown word 'palne'; did you mean 'plane'?",
                 "x.rt:4:15: a number expected for 'centre' of 'sphere', but here comes 'zero'",
                 "x.rt:4:43: ',' expected between the three numbers of a vector, but here comes '>'",
                 "x.rt:4:53: 'diffuse' of 'material' must be from 0 to 1e9, not '-1'",
                 "x.rt:4:68: a vector <x, y, z> expected for 'translate' of 'sphere', but here comes '}'",
                 "x.rt:6:1: 'light' lacks 'position', 'color'"});
    std::string many;
    for (int i = 0; i < 20; ++i) many += "light { }\n";
    const Faults told = faults(eye + many);
    REQUIRE(told.size() == 11);
    CHECK(told[9] == "x.rt:11:1: 'light' lacks 'position', 'color'");
    CHECK(told[10] == "x.rt: there may be more; these are the first 10");
}

TEST_CASE("files that are not text") {
    CHECK(faults("// \xE4\n") == Faults{"x.rt:1:4: not UTF-8; save the file in that encoding"});
    CHECK(faults(std::string("camera \0{", 9)) == Faults{"x.rt:1:8: a byte 0 in the text; is this a scene file?"});
    for (const char* const bytes : {"\xFF\xFE", "\x80", "\xC0\x80", "\xC3", "\xE0\x80\x80", "\xED\xA0\x80",
                                    "\xF4\x90\x80\x80", "\xF8\x88\x80\x80\x80", "\xE2\x82"})
        CHECK(faults(std::string("\n// ") + bytes).at(0).starts_with("x.rt:2:4: not UTF-8"));
    CHECK(parse(eye + "// \xC2\x80 \xE2\x82\xAC \xEF\xBF\xBF \xF0\x9F\x98\x80 \xF4\x8F\xBF\xBF").lights.empty());
}

TEST_CASE("hostile text is rejected quickly") {
    // Nesting, repetition, and long words or numbers take no longer than reading them.
    for (const std::string piece :
         {"{", "}", "<", "sphere {", "/*/", "//", "camera", "a", "9", "-", ".", ",", "material {", "key {"}) {
        std::string text = "sphere { <0,0,0>, 1 ";
        for (int i = 0; i < 100000; ++i) text += piece;
        CHECK(message(text).starts_with("x.rt:1:"));
        CHECK(message(text.substr(20)).starts_with("x.rt:1:"));
        CHECK(message(text).size() < 5000);
    }
    TextLimits limits;
    limits.primitives = 2, limits.lights = 1, limits.transformations = 3, limits.keys = 2;
    const std::string ball = "sphere { <0,0,0>, 1 }\n", lamp = "light { position <0,0,0> color <1,1,1> }\n";
    CHECK(message(eye + ball + ball, limits) == "no error");
    CHECK(message(eye + ball + ball + ball, limits).starts_with("x.rt:4:1: more than 2 primitives"));
    CHECK(message(eye + lamp + lamp, limits).starts_with("x.rt:3:1: more than 1 lights"));
    CHECK(message(eye + "sphere { <0,0,0>, 1 scale 1 scale 1 scale 1 scale 1 }", limits)
              .starts_with("x.rt:2:45: more than 3 transformations of one primitive"));
    std::string keys;
    for (const char* const time : {"0", "1", "2"})
        keys += "\nkey { position <0,0,0> look_at <0,1,0> time " + std::string(time) + " }";
    CHECK(message(eye + "flythrough { duration 9" + keys + "}", limits).starts_with("x.rt:5:1: more than 2 keys"));
}

TEST_CASE("lines may end in a carriage return, in a line feed, or in both") {
    for (const std::string end : {"\r", "\n", "\r\n"}) {
        CAPTURE(end.size());
        std::string text = eye;
        for (const char* line : {"// a ball", "sphere { <1,2,3>, 4 } // and another one", "sphere { <1,2,3>, 5 }"})
            text += line + end;
        CHECK(parse(text).primitives.size() == 2);
        const Faults told = faults(text + "// below it" + end + "sphere { <1,2,3>, -6 }" + end);
        REQUIRE(told.size() == 1);
        CHECK(told[0].starts_with("x.rt:6:19: "));
    }
}

TEST_CASE("files") {
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("strahl-language-test-" + std::to_string(getpid()) + ".rt");
    std::ofstream(path) << eye;
    CHECK(read_text(path.string()) == eye);
    CHECK_THROWS_WITH_AS(read_text(path.string(), 10),
                         (path.string() + ": larger than 10 bytes; is this a scene file?").c_str(), FileError);
    std::filesystem::remove(path);
    CHECK_THROWS_WITH_AS(read_text(path.string()),
                         (path.string() + ": can't be read: No such file or directory").c_str(), FileError);
    CHECK_THROWS_WITH_AS(read_text("/"), "/: can't be read: Is a directory", FileError);
    CHECK_THROWS_AS(read_text("/dev/zero", 1 << 22), FileError);
}
