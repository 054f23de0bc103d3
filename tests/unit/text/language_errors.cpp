// The scene language: how an error is shown, and the messages about words that are wrong, missing or one too many.
#include "tests/unit/text/language.h"

using namespace strahl;
using namespace strahl::language;

TEST_CASE("an error is quoted with a caret under it") {
    CHECK(message(eye + "sphere { <0,0,0>, 1 }\nshpere { <0,0,0>, 1 }\n") ==
          "x.rt:3:1: unknown word 'shpere'; did you mean 'sphere'?\n"
          "    shpere { <0,0,0>, 1 }\n"
          "    ^~~~~~");
    // Columns count characters; the caret is right after tabs, wide letters and combining marks.
    CHECK(message(eye + "/* \xC3\xA4\xE6\x97\xA5"
                        "a\xCC\x88 */\tsphere { <0,0,0>, -1 }") ==
          "x.rt:2:30: 'radius' of 'sphere' must be greater than 0 and at most 1e9, not '-1'\n"
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
    check_fault("sphere { <0,0,0>, 1 mood { color <1,1,1> } }",
                "2:21: unknown word 'mood' in 'sphere'; known here: material, motion, rotate, translate, scale");
}

TEST_CASE("words of POV-Ray and of materials in the wrong place get advice") {
    const auto in_body = [](const std::string& word, const std::string& advice) {
        check_fault("sphere { <0,0,0>, 1 " + word + " { } }",
                    "2:21: unknown word '" + word + "' in 'sphere'; " + advice);
    };
    for (const char* const word : {"color", "colour", "pigment", "texture", "rgbt"})
        in_body(word, "use 'material { rgb <r, g, b> }'");
    for (const char* const word : {"finish", "interior"}) in_body(word, "use 'material { ... }'");
    for (const char* const word : {"rgb", "diffuse", "ior", "normal", "pow"})
        in_body(word, "use 'material { " + std::string(word) + " ... }'");
    const auto in_material = [](const std::string& word, const std::string& advice) {
        check_fault("sphere { <0,0,0>, 1 material { " + word + " 1 } }",
                    "2:32: unknown word '" + word + "' in 'material'; " + advice);
    };
    for (const char* const word : {"color", "pigment"}) in_material(word, "use 'rgb'");
    in_material("finish", "leave it out: its values stand in 'material' itself");
    in_material("phong", "use 'specular'");
    in_material("transmit", "use 'refraction'");
    check_fault("light { position <0,0,0> rgb <1,1,1> }", "2:26: unknown word 'rgb' in 'light'; use 'color'");
    check_fault("sky_sphere { }", "2:1: unknown word 'sky_sphere'; use 'background'");
    CHECK(faults("camera { location <0,0,0> }")[0] == "x.rt:1:10: unknown word 'location' in 'camera'; use 'position'");
}

TEST_CASE("signs that mean something elsewhere get advice") {
    const std::string block = "a block expected, such as 'sphere { ... }', but found ";
    const std::string comment = "; a comment begins with //, and nothing ends with ';'";
    for (const char* const sign : {"#", ";"})
        check_fault(std::string(sign) + " a comment", "2:1: " + block + "'" + sign + "'" + comment);
    check_fault("#declare a = 1", "2:1: " + block +
                                      "'#'; 'define NAME material { ... }' and 'define NAME sphere { ... }' name a "
                                      "material and a body");
    const std::string colours = "; colours are numbers, as in rgb <1, 0, 0>";
    for (const char* const colour : {"f00", "ff0000", "00FF00ff"})
        check_fault("sphere { <0,0,0>, 1 material { #" + std::string(colour) + " } }",
                    "2:32: a word or '}' expected in 'material', but found '#'" + colours);
    check_fault("sphere { <0,0,0>, 1 material { rgb red } }",
                "2:36: unknown word 'red' for 'rgb' of 'material'" + colours);
    check_fault("ball { }", "2:1: unknown word 'ball'; use 'sphere'");
    check_fault("sphere { <0,0,0>, 1 } translate <1,0,0>",
                "2:23: unknown word 'translate'; it belongs inside the braces of a body");
    check_fault("track \"a\"",
                "2:1: unknown word 'track'; it stands in place of a number, as in translate <0, 0, track \"height\">");
    check_fault("key { }", "2:1: unknown word 'key'; it belongs in 'flythrough { ... }'");
    check_fault("mesh { \"a.obj\" }",
                "2:8: a word or '}' expected in 'mesh', but found '\"'; a mesh of a file is written mesh { file "
                "\"NAME\" }");
    check_fault("sphere { <0,0,0>, 1 material { rgb image \"a.png\" } }",
                "2:42: '{' expected after 'image', but found '\"'; an image is written image { \"NAME\" }");
    check_fault(
        "sphere { <0,0,0>, 1 rotate 45 }",
        "2:28: a vector <x, y, z> expected for 'rotate' of 'sphere', but found '45'; degrees about each axis, as in "
        "rotate <0, 0, 45>");
    check_fault("define gold { }",
                "2:13: 'material' or a body expected after 'gold', as in define gold material { ... "
                "}, but found '{'");
    check_fault("sphere { <0,0,0>, 1 material { rgb <1,1,1>; } }",
                "2:43: a word or '}' expected in 'material', but found ';'" + comment);
    const std::string word = "a word or '}' expected in 'sphere', but found ";
    check_fault("sphere { <0,0,0>, 2,5 }", "2:20: " + word + "','; decimals have a point, as in 2.5");
    check_fault(
        "sphere { <0,5, 0,5, 2>, 1 }",
        "2:17: '>' expected after the three numbers of a vector, but found ','; decimals have a point, as in 2.5");
    check_fault("sphere { <0,5 1 2>, 1 }",
                "2:15: ',' expected between the three numbers of a vector, but found '1'; decimals have a point, as in "
                "2.5");
    check_fault("sphere { <0,5 1>, 1 }", "2:15: ',' expected between the three numbers of a vector, but found '1'");
    check_fault("sphere { <0,5, 1, 2>, 1 }",
                "2:17: '>' expected after the three numbers of a vector, but found ','; "
                "decimals have a point, as in 2.5");
    const std::string result =
        "; expressions are calculated only in a text with a directive such as #declare; write the result";
    check_fault("sphere { <0,0,0>, 1+1 }", "2:20: " + word + "'+1'" + result);
    check_fault("sphere { <0,0,0>, 3-1 }", "2:20: " + word + "'-1'" + result);
    check_fault("sphere { <0,0,0>, 1 + 1 }", "2:21: " + word + "'+'" + result);
    check_fault("sphere { <0,0,0>, 1/2 }", "2:20: " + word + "'/'" + result);
    check_fault("sphere { <0,0,0>, (2) }", "2:19: a number expected for 'radius' of 'sphere', but found '('" + result);
    check_fault("sphere { <0,0,0>, sqrt(2) }",
                "2:19: a number expected for 'radius' of 'sphere', but found 'sqrt'" + result);
    // Mistakes of one sign too few or too many.
    check_fault("sphere { <0 -1,0>, 1 }", "2:13: ',' expected between the three numbers of a vector, but found '-1'");
    check_fault("sphere { <0,0,0>, 1, }", "2:20: " + word + "','");
}

TEST_CASE("other files than scenes are named") {
    const auto says = [](const std::string& bytes, const std::string& file, const std::string& fault) {
        CAPTURE(fault);
        CHECK(fault_of([&] { parse_scene(bytes, file); }, "no error") == fault);
    };
    const std::string dibs(60, '\0');
    says("\x89PNG\r\n\x1a\n", "a.rt", "a.rt is a picture, not a scene");
    says("\xFF\xD8\xFF\xE0", "a.rt", "a.rt is a picture, not a scene");
    says("BM" + dibs, "a.rt", "a.rt is a picture, not a scene");
    for (const char* const plain : {"P3\n2 2 255 0 0 0", "P6 2 2 255 ", "PF\n2 2\n-1\n", "P1\n# a comment"})
        says(plain, "a.rt", "a.rt is a picture, not a scene");
    says("RIFF....WAVEfmt ", "a.rt", "a.rt is a sound, not a scene");
    says(
        "\x7F"
        "ELF",
        "a.rt", "a.rt is a program, not a scene");
    says("v 0 0 0\n", "b.OBJ", "b.OBJ is a mesh, not a scene; a scene shows it by mesh { file \"b.OBJ\" }");
    says("ply\n", "b.ply", "b.ply is a mesh, not a scene; a scene shows it by mesh { file \"b.ply\" }");
    says("v\n", "b.nff", "b.nff is a scene of another program; convert it first: strahl import b.nff -o SCENE.rt");
    // A comment may begin a scene, and a scene may be called anything.
    CHECK(fault_of([&] { parse_scene("// P3\n" + eye, "BM"); }, "no error") == "no error");
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
    check_fault("light { color <1,1,1> }", "2:1: 'light' lacks 'position' (or 'direction')");
    check_fault("background { }", "2:1: 'background' lacks 'color'");
    check_fault("flythrough { }", "2:1: 'flythrough' lacks 'duration', keys: a path needs at least 2");
    check_fault("flythrough { duration 1 key { } key { time 1 position <0,0,0> look_at <1,0,0> } }",
                "2:25: 'key' lacks 'time' (or 'beat'), 'position', 'look_at'");
    check_fault("flythrough { duration 1 key { time 1 position <0,0,0> look_at <1,0,0> } }",
                "2:1: 'flythrough' lacks keys: a path needs at least 2");
    check_fault("sphere { }", "2:10: a vector <x, y, z> expected for 'centre' of 'sphere', but found '}'");
    check_fault("sphere { <0,0,0> }", "2:18: a number expected for 'radius' of 'sphere', but found '}'");
    check_fault("plane { <0,0,0>, <1,0,0> }",
                "2:26: a vector <x, y, z> expected for 'third point' of 'plane', but found '}'");
    check_fault("sphere { <0,0,0>, 1 material { pow } }",
                "2:36: a number expected for 'pow' of 'material', but found '}'");
    check_fault("light { position 5 color <1,1,1> }",
                "2:18: a vector <x, y, z> expected for 'position' of 'light', but found '5'");
}

TEST_CASE("syntax errors") {
    check_fault("sphere <0,0,0>, 1", "2:8: '{' expected after 'sphere', but found '<'");
    check_fault("sphere { <0 0,0>, 1 }", "2:13: ',' expected between the three numbers of a vector, but found '0'");
    check_fault("sphere { <0,0>, 1 }", "2:14: ',' expected between the three numbers of a vector, but found '>'");
    check_fault("sphere { <0,0,0,0>, 1 }", "2:16: '>' expected after the three numbers of a vector, but found ','");
    check_fault("sphere { <0,0,inf>, 1 }", "2:15: a number expected for 'centre' of 'sphere', but found 'inf'");
    check_fault("sphere { <0,0,-nan>, 1 }", "2:15: a number expected for 'centre' of 'sphere', but found '-nan'");
    check_fault("sphere { <0,0,0>, --1 }", "2:19: a number expected for 'radius' of 'sphere', but found '-'");
    check_fault("sphere { <0,0,0>, 1.2.3 }", "2:19: '1.2.3' is not a number");
    check_fault("sphere { <0,0,0>, 1e }", "2:19: '1e' is not a number");
    check_fault("sphere { <0,0,0>, 0x10 }", "2:19: '0x10' is not a number");
    check_fault("sphere { <0,0,0>, 1e999 }", "2:19: '1e999' is out of the range of numbers (4.9e-324 to 1.8e308)");
    check_fault("sphere { <0,0,0>, 1e-999 }", "2:19: '1e-999' is out of the range of numbers (4.9e-324 to 1.8e308)");
    check_fault("sphere { <0,0,0>, 1, }", "2:20: a word or '}' expected in 'sphere', but found ','");
    check_fault("sphere { <0,0,0>, 1 } }", "2:23: a block expected, such as 'sphere { ... }', but found '}'");
    check_fault("<1,2,3>", "2:1: a block expected, such as 'sphere { ... }', but found '<'");
    check_fault("sphere { <0,0,0>, 1", "2:1: '}' missing: this 'sphere' is never closed");
    check_fault("sphere { <0,0,0>, 1 material { pow 1 }", "2:1: '}' missing: this 'sphere' is never closed");
    check_fault("sphere { <0,0,0>, 1 material { pow 1", "2:21: '}' missing: this 'material' is never closed");
    check_fault("sphere { <0,0,0>, 1\nlight { position <0,0,0> color <1,1,1> }",
                "3:1: '}' missing: the 'sphere' of line 2 is still open");
    check_fault("sphere { <0,0,0>, 1 material { pow 1\nlight { position <0,0,0> color <1,1,1> }",
                "3:1: '}' missing: the 'material' of line 2 is still open");
    check_fault("sphere { <0,0,0>,", "2:18: a number expected for 'radius' of 'sphere', but the text ends");
    check_fault("/* sphere", "2:1: this comment is never closed: '*/' missing");
    check_fault("/", "2:1: a block expected, such as 'sphere { ... }', but found '/'");
    check_fault("\xC3\xA4 { }", "2:1: a block expected, such as 'sphere { ... }', but found '\xC3\xA4'");
    check_fault("sphere", "2:7: '{' expected after 'sphere', but the text ends");
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
          Faults{"x.rt:2:1: 'up' repeats 'sky' of line 1; give only one of them",
                 "x.rt:2:13: 'angle' repeats 'fov' of line 1; give only one of them"});
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
                 "x.rt:4:15: a number expected for 'centre' of 'sphere', but found 'zero'",
                 "x.rt:4:43: ',' expected between the three numbers of a vector, but found '>'",
                 "x.rt:4:53: 'diffuse' of 'material' must be from 0 to 1e9, not '-1'",
                 "x.rt:4:68: a vector <x, y, z> expected for 'translate' of 'sphere', but found '}'",
                 "x.rt:6:1: 'light' lacks 'position' (or 'direction'), 'color'"});
    std::string many;
    for (int i = 0; i < 20; ++i) many += "light { }\n";
    const Faults told = faults(eye + many);
    REQUIRE(told.size() == 11);
    CHECK(told[9] == "x.rt:11:1: 'light' lacks 'position' (or 'direction'), 'color'");
    CHECK(told[10] == "x.rt: there may be more; these are the first 10");
}
