// Mistakes that people make in POV-Ray scenes: the message names the place and what was meant.
#include <doctest/doctest.h>

#include <fstream>
#include <string>
#include <vector>

#include "pov/open_pov.h"
#include "tests/unit/faults.h"
#include "tests/unit/scratch.h"

using namespace strahl;

namespace {

const std::string front_camera = "camera { location <0, 1, -5> look_at <0, 1, 0> }\n";

/// A library with two include files.
struct IncludeFolder : Scratch {
    IncludeFolder() {
        std::ofstream(*this / "colors.inc") << "#declare Red = rgb <1, 0, 0>;\n#declare Blue  = rgb z;\n";
        std::ofstream(*this / "woods.inc")
            << "#include \"colors.inc\"\n#declare T_Wood1 =\n texture { pigment { Red } }\n";
        std::ofstream(*this / "woods_old.inc")
            << "#declare T_Wood1 = texture { }\n#macro Log(r) sphere { 0, r } #end\n";
    }
    pov::OpenedPov open(const std::string& text) const {
        pov::InterpreterOptions options;
        options.file = *this / "x.pov", options.library = {*this / "."};
        return pov::open_pov(text, options, {});
    }
};

/// Returns the message about a text, from its line on: "2:37: ...".
std::string mistake_in(const std::string& text) {
    static const IncludeFolder library;
    std::string all = fault_of([&] { library.open(text); });
    if (const std::size_t at = all.find("x.pov:"); at != all.npos) all.erase(0, at + 6);
    return all;
}

void check_mistake(const std::string& text, const std::string& told) {
    const std::string all = mistake_in(front_camera + text);
    CHECK_MESSAGE(all.starts_with("2:"), text, " tells: ", all);
    CHECK_MESSAGE(says(all, told), text, " tells: ", all);
}

}  // namespace

TEST_CASE("POV-Ray: a name that an include file declares") {
    check_mistake("sphere { 0, 1 pigment { color Blue } }",
                  "2:31: unknown name 'Blue'; a colour expected; colors.inc declares it: #include \"colors.inc\"\n"
                  "    sphere { 0, 1 pigment { color Blue } }\n"
                  "                                  ^~~~");
    check_mistake("sphere { 0, 1 pigment { Red } }", "colors.inc declares it");
    check_mistake("sphere { 0, 1 texture { T_Wood1 } }", ": #include \"woods.inc\"");  // not the old one
    check_mistake("Log(2)", "woods_old.inc declares it");
    check_mistake("#include \"colors.inc\" sphere { 0, 1 pigment { Bleu } }", "did you mean 'Blue'?");
    check_mistake("#declare Ball = sphere { 0, 1 } ball { }", "did you mean 'Ball'?");
    CHECK(!says(mistake_in(front_camera + "sphere { 0, 1 texture { T_Wood } }"), "declares it"));
}

TEST_CASE("POV-Ray: a name that an include file would declare, if it was installed") {
    pov::InterpreterOptions options;
    options.file = "x.pov", options.library = {"/nowhere/include"};
    const auto told = [&](const std::string& text) { return fault_of([&] { pov::open_pov(text, options, {}); }); };
    CHECK(says(told("sphere { 0, 1 pigment { White } }"), "on Debian: apt install povray-includes"));
    CHECK(says(told("sphere { 0, 1 pigment { marbel } }"), "did you mean 'marble'?"));
}

TEST_CASE("POV-Ray: words of other programs, and misspelt ones") {
    check_mistake("ball { 0, 1 }", "did you mean 'sphere'?");
    check_mistake("cube { 0, 1 }", "did you mean 'box'?");
    check_mistake("light { 0, rgb 1 }", "did you mean 'light_source'?");
    check_mistake("camera { position 0 }", "unknown name 'position'; did you mean 'location'?");
    check_mistake("camera { lok_at 0 }", "did you mean 'look_at'?");
    check_mistake("sphere { 0, 1 finish { specluar 1 } }", "did you mean 'specular'?");
    check_mistake("sphere { 0, Radius }", "declare it first: #declare Radius = ...;");
    check_mistake("sphere { 0, Sin(1) }", "did you mean 'sin'?");
    check_mistake("sphere { 0, 1 texture { rgb 1 } }", "'rgb' does not belong here; it belongs in pigment { ... }");
    check_mistake("sphere { 0, 1 ior 1.5 }", "it belongs in interior { ... }");
    check_mistake("sphere { 0, 1 pigment { rgb #ff0000 } }", "colours are written rgb <1, 0, 0>");
    check_mistake("sphere { 0, 1 rotate y 45 }", "a rotation is one vector, as in rotate 45*y");
    check_mistake("isosurface { function { x^2 } }", "powers are written pow(x, 2)");
    check_mistake("#inlcude \"colors.inc\"",
                  "unknown name 'inlcude'; a body, a light or a declaration expected; did you mean 'include'?");
    check_mistake("#for (I, 1, 3) sphere { I, 1 } #next",
                  "unknown name 'next'; a body, a light or a declaration expected; there is no such directive; #end "
                  "ends loops, conditions and macros");
    check_mistake("#include colors.inc", "a string expected; file names stand in quotes: #include \"colors.inc\"");
    check_mistake("sphere { 0, 1 pigment { color = rgb 1 } }", "values follow their words without '='");
    CHECK(!says(mistake_in(front_camera + "#include \"qqqqq.inc\""), "did you mean"));
    CHECK(!says(mistake_in(front_camera + "#include \"parts.inc\""), "did you mean"));
    check_mistake("sphere { 0, 1 pigment { color 1, 0, 0 } }",
                  "',' does not belong here; a colour is written rgb <1, 0, 0>");
    check_mistake("camera { angle 180 }", "2:10: the angle of a perspective camera must be smaller than 180 degrees");
    check_mistake("#include \"colours.inc\"",
                  "did you mean 'colors.inc'?\n    #include \"colours.inc\"\n             ^~~~~~~~~~~~~");
    check_mistake("text { ttf \"a.ttf \"Text\" 1, 0 }", "is a '\"' missing before it?");
}

TEST_CASE("POV-Ray: braces") {
    CHECK(says(mistake_in("camera {\n  location 0\nlight_source { 0, rgb 1 }\n"),
               "3:1: 'camera {' of line 1 is not closed before 'light_source'\n"));
    check_mistake("sphere { 0, 1 pigment { rgb 1 finish { phong 1 } }",
                  "'pigment {' of line 2 is not closed before 'finish'");
    check_mistake("sphere { 0, 1", "2:8: this '{' is not closed: '}' expected before the end of the scene");
    CHECK(says(mistake_in("union { sphere { 0, 1 }\n camera { } }"),
               "2:2: 'union {' of line 1 is not closed before 'camera'\n"));
    check_mistake("difference { box { 0, 1 } scale 2 box { 0, 1 } }", "parts come before textures and transformations");
    check_mistake("sphere { 0, 1 } }", "the block before it, which line 2 begins, is closed already");
    check_mistake("sphere { 0, 1 } translate x",
                  "but found 'translate'; it belongs inside the braces of the block before it, which line 2 begins");
    check_mistake("#declare Ball = sphere { 0, 1 } Ball { }", "a declared body is placed by object { NAME ... }");
    check_mistake("sphere { 0, 1 };", "';' ends only declarations");
}

TEST_CASE("POV-Ray: arguments") {
    check_mistake("sphere { 1, <0, 1, 0> }",
                  "2:13: a number expected, but this has 3 components; the order is sphere { <centre>, radius }");
    check_mistake("cylinder { 0, 1, <0, 1, 0> }", "the order is cylinder { <one end>, <other end>, radius }");
    check_mistake("cone { 0, y, 1, 0 }", "the order is cone {");
    check_mistake("plane { 0, y }", "the order is plane { <normal>, distance }");
    check_mistake("torus { 0*x, 1 }", "the order is torus { major radius, minor radius }");
    check_mistake("box { 0 pigment { rgb 1 } }", "the order is box { <corner>, <opposite corner> }");
    check_mistake("sphere { 0, 1, 2 }", "',' does not belong here; the order is sphere");
    check_mistake("light_source { color rgb 1 <0, 1, 0> }", "the order is light_source { <place>, colour }");
    check_mistake("sphere { <0, 1, 0, 1 pigment { rgb 1 } }",
                  "2:10: this '<' is not closed: '>' expected before 'pigment'");
    check_mistake(
        "camera { location x look_at x }",
        "'look_at' and 'location' must differ\n    camera { location x look_at x }\n                        ^~~~~~~");
    for (const char* comma : {"sphere { <0,9 0,15 0,1>, 1 }", "sphere { <0,5, 1,5, 2>, 1 }", "sphere { 0, 0,5 }",
                              "sphere { 0, 1 finish { phong 0,8 } }", "sphere { <0,5 1 0>, 1 }"})
        check_mistake(comma, "decimals have a point, as in 0.5");
    CHECK(!says(mistake_in(front_camera + "sphere { 0,1,0>, 1 }"), "decimals"));
}

TEST_CASE("POV-Ray: what is read, but hardly meant, is a warning") {
    const IncludeFolder library;
    const auto told = [&](const std::string& text, const std::string& warning) {
        const auto warnings = library.open(text).warnings;
        REQUIRE(warnings.size() == 1);
        CHECK_MESSAGE(says(warnings[0].told(), warning), text, " tells: ", warnings[0].told());
    };
    told("sphere { 0, 1 pigment { rgb 1 } }", "x.pov:1: no camera: POV-Ray's is used");
    told(front_camera + "sphere { 0, 1 color rgb 1 }", "x.pov:2: a colour outside of a pigment has no effect");
    told(front_camera + "#declare A = 1", "';' is missing after this declaration");
    told(front_camera + "sphere { 0, 1 scale 0 }", "a scale of 0 is taken for 1");
}
