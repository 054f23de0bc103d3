// Directives in scene text: the scenes that they make, and where errors are.
#include "pov/expand.h"

#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "pov/open_scene.h"
#include "tests/unit/faults.h"
#include "tests/unit/scratch.h"

using namespace strahl;

namespace {

const std::string eye = "camera { position <0,-9,0> look_at <0,0,0> up <0,0,-1> fov 25 }\n";

Scene expanded(const std::string& text, const std::string& path = "x.rt") {
    return open_scene(eye + text, path, {}, {}).scene;
}

}  // namespace

TEST_CASE("directives make the scene that the same text without them makes") {
    const Scene row = expanded(R"(
#declare Size = .5;
#macro Ball(Place, Tint)
  sphere { Place, Size  material { rgb Tint * .5  pow 60  specular pow(.5, 2) } }
#end
#for (I, 0, 2)
  Ball(<2 * I - 2, 0, sin(pi / 2)>, <1, I / 2, 0>)
#end
#if (Size > 1) light { position <0, 0, 9> color <1, 1, 1> } #else light { position 9 * z color <1, 1, 1> } #end
)");
    CHECK(row == expanded("sphere { <-2, 0, 1>, .5 material { rgb <.5, 0, 0> pow 60 specular .25 } }"
                          "sphere { <0, 0, 1>, .5 material { rgb <.5, .25, 0> pow 60 specular .25 } }"
                          "sphere { <2, 0, 1>, .5 material { rgb <.5, .5, 0> pow 60 specular .25 } }"
                          "light { position <0, 0, 9> color <1, 1, 1> }"));
    // The words of tracks, names in quotes, and `define` stay what they are.
    const Scene moving = expanded(R"(
#declare N = 3;
define Red material { rgb <1, 0, 0> }
sphere { <0, 0, 0>, N - 2  material Red { diffuse track "x" .25 } translate <track "y" 1, N, 3> }
)");
    CHECK(moving == expanded("define Red material { rgb <1, 0, 0> }"
                             "sphere { <0, 0, 0>, 1 material Red { diffuse track \"x\" .25 } "
                             "translate <track \"y\" 1, 3, 3> }"));
}

TEST_CASE("texts have directives only outside of comments and quotes") {
    CHECK(pov::has_directives("#declare A = 1;"));
    CHECK(pov::has_directives("/* a */ // b\n\"c\" #if (1) #end"));
    CHECK_FALSE(pov::has_directives("// #declare A = 1;"));
    CHECK_FALSE(pov::has_directives("/* # */ mesh { file \"a#b.ply\" } //#"));
    CHECK(pov::has_directives("a # \tif (1)"));
    CHECK_FALSE(pov::has_directives("# a comment\n#"));
    CHECK_FALSE(pov::has_directives("/* #"));
    CHECK_FALSE(pov::has_directives("\"#"));
}

TEST_CASE("errors of texts with directives are where they are written") {
    const auto message = [](const std::string& text) {
        return fault_of([&] { expanded("#declare A = 1;\n" + text); }, "no error");
    };
    CHECK(message("#for (I, 1, 3)\n  shpere { <0, 0, I>, 1 }\n#end").starts_with("x.rt:4:3: unknown word 'shpere'"));
    CHECK(message("sphere { <0, 0, 0>, -A }").starts_with("x.rt:3:21: 'radius' of 'sphere' must be greater than 0"));
    CHECK(message("#if (A) sphere { <0, 0, 0>, A }").find("'#end' expected") != std::string::npos);
    CHECK(message("#declare B = sphere { 0, 1 }").find("x.rt:3") == 0);
    pov::InterpreterOptions few_steps;
    few_steps.file = "x.rt", few_steps.limits.steps = 10000;
    const std::string endless =
        fault_of([&] { pov::expand("#declare i = 0; #while (1) #declare i = i + 1; #end", few_steps); }, "no error");
    CHECK(endless.find("x.rt:1") == 0);
    CHECK(endless.find("does not end") != std::string::npos);
    const Scratch folder;
    std::ofstream(folder / "balls.inc")
        << "#macro Two(R)\n  sphere { <0, 0, 0>, R }\n  sphere { <3, 0, 0>, 0*R }\n#end\n";
    const std::string included =
        fault_of([&] { expanded("#include \"balls.inc\"\nTwo(1)", folder / "x.rt"); }, "no error");
    CHECK(included.find("balls.inc:3:23: 'radius' of 'sphere'") != std::string::npos);
    const std::string one = eye + "#include \"balls.inc\"\nsphere { <1, 0, 0>, 1 }";
    CHECK(open_scene(one, folder / "x.rt", {}, {}).files.size() == 2);
    const std::string wide("#\0d\0e\0c\0l\0", 10), said = "this text is in UTF-16; save the file as UTF-8";
    std::ofstream(folder / "wide.inc") << wide;
    CHECK(fault_of([&] { expanded("#include \"wide.inc\"", folder / "x.rt"); }, "").ends_with("wide.inc: " + said));
    CHECK(fault_of([&] { open_scene(wide, "x.pov", {}, {}); }, "") == "x.pov: " + said);
}
