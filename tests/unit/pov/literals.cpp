// Numbers of bodies that stand in texts for POV-Ray.
#include "pov/literals.h"

#include <doctest/doctest.h>

#include "tests/unit/pov/opened.h"

using namespace strahl;

namespace {

/// Lists the numbers of a body: "radius 2; Gold, line 1: finish phong .5". Each must stand where its slices say.
std::string literals(const std::string& text, const std::string& body) {
    std::string all;
    for (const BodyValue& value : pov::literals_of(text, text.find(body))) {
        if (!all.empty()) all += "; ";
        if (!value.source.empty()) all += value.source + ": ";
        all += value.name;
        REQUIRE(value.slices.size() == value.numbers.size());
        for (std::size_t i = 0; i < value.slices.size(); ++i) {
            const auto [begin, end] = value.slices[i];
            all += (i > 0 ? ", " : " ") + text.substr(begin, end - begin);
        }
    }
    return all;
}

}  // namespace

TEST_CASE("numbers of a body are found by the words before them") {
    CHECK(literals("sphere { <0, -1.5, 2e-1>, .5 pigment { color rgb <1, .2, .1> } finish { phong .9 ambient 0 } "
                   "rotate <0, 30, 0> translate -2 }",
                   "sphere") ==
          "centre 0, -1.5, 2e-1; radius .5; pigment rgb 1, .2, .1; finish phong .9; finish ambient 0; rotate 0, 30, 0; "
          "translate -2");
    CHECK(literals("cone { 0, 1, <0, 2, 0>, 0 open texture { pigment { rgb .5 } scale 2 } }", "cone") ==
          "base 0; base's radius 1; cap 0, 2, 0; cap's radius 0; pigment rgb .5; texture scale 2");
    CHECK(literals("torus { 2, .25 }", "torus") == "torus 1 2; torus 2 .25");
    CHECK(literals("difference { sphere { 0, 1 } box { -1, 1 } translate <1, 2, 3> }", "difference") ==
          "sphere 1: centre 0; sphere 1: radius 1; box 2: corner -1; box 2: opposite corner 1; translate 1, 2, 3");
    CHECK(literals("union { difference { sphere { 0, 1 } torus { 2, 1 scale 3 } } }", "union") ==
          "sphere 1: centre 0; sphere 1: radius 1; torus 2: torus 1 2; torus 2: torus 2 1; torus 2: scale 3");
    std::string nested;
    for (int i = 0; i < 100'000; ++i) nested += "union { sphere { 0, 1 } ";
    CHECK(pov::literals_of(nested, 0).size() < 50);
    CHECK(literals("difference { sphere { 0, 1 } box { -1, 1 } }", "box") == "corner -1; opposite corner 1");
}

TEST_CASE("arguments of bodies have the ranges that they have in scene text") {
    const auto values = pov::literals_of("cone { 0, 1, <0, 2, 0>, 0 scale 2 }", 0);
    REQUIRE(values.size() == 5);
    CHECK(values[1].range.low == 0);
    CHECK(values[2].range.high == coordinates.high);
    CHECK(values[4].range.high == anything.high);
    CHECK(pov::literals_of("sphere { 0, 1 }", 0).at(1).range.low > 0);
}

TEST_CASE("numbers of a light are found likewise") {
    CHECK(literals("light_source { <5, 8, -6>, .5 }", "light") == "location 5, 8, -6; color .5");
    CHECK(literals("light_source { 0 color rgb <1, .9, .8> spotlight point_at <0, 1, 0> radius 20 falloff 30 "
                   "looks_like { sphere { 0, .1 } } translate 3 }",
                   "light") ==
          "location 0; rgb 1, .9, .8; point_at 0, 1, 0; radius 20; falloff 30; sphere 1: centre 0; "
          "sphere 1: radius .1; translate 3");
    const pov::OpenedPov two = opened(
        "camera { right -4/3*x }\n#declare L = light_source { 1, 1 }\nlight_source { L }\n"
        "light_source { 2, 0 }\nlight_source { 3, 1 }",
        false);
    REQUIRE(two.lines.lights.size() == 2);   // a black one is left out
    CHECK(two.lines.lights[0].number == 2);  // where its numbers stand
    CHECK(two.lines.lights[1].number == 5);
}

TEST_CASE("what is computed is left out, and does not count for another argument") {
    CHECK(literals("sphere { <0, 1, 2*3>, 4 translate 3*x rotate y*30 scale 1/2 }", "sphere") == "radius 4");
    CHECK(literals("sphere { x, 2 }", "sphere") == "radius 2");
    CHECK(literals("sphere { 2*x - y, 2 }", "sphere") == "radius 2");
    CHECK(literals("sphere { 0, max(1, 2) finish { phong (.5) } }", "sphere") == "centre 0");
    CHECK(literals("plane { y, -1 pigment { gradient x color_map { [0 rgb 1] [.5 rgb 0] } scale 3 } }", "plane") ==
          "plane 2 -1; pigment scale 3");
    CHECK(literals("sphere { 0, 1 #if (1) translate 2 #end }", "sphere") == "");
    CHECK(literals("sphere { 0, 1 translate 2 - 1 }", "sphere") == "centre 0; radius 1");
    CHECK(literals("sphere { /* 5 */ 0, 1 // 7\n }", "sphere") == "centre 0; radius 1");
    // No piece that is missing from the text makes the search fail.
    const std::string whole =
        "#declare A = <1, -2>; sphere { <0, -1, 2*(3)>, A[1] texture { A \"b\" pigment { rgb <1, 2> } } #if (1) 5 #end "
        "}";
    for (std::size_t begin = 0; begin < whole.size(); ++begin)
        for (std::size_t count = 0; begin + count <= whole.size(); ++count) {
            std::string text = whole;
            const std::size_t at = text.erase(begin, count).find("sphere");
            if (at != text.npos) CHECK_NOTHROW(pov::literals_of(text, at));
        }
    CHECK(literals("camera { location 1 }", "camera") == "");
    CHECK(pov::literals_of("sphere { 0, 1 }", 3).empty());
    CHECK(pov::literals_of("", 0).empty());
}

TEST_CASE("names that are declared once are followed") {
    const std::string text =
        "#declare R = 2.5;\n#declare Gold = texture { pigment { rgb <1, .8, .3> } finish { phong .5 } };\n"
        "#declare T = 1; #declare T = 2;\nsphere { 0, R texture { Gold } translate T }\nsphere { R, R*2 }";
    CHECK(literals(text, "sphere { 0") ==
          "centre 0; declare R, line 1: radius 2.5; declare Gold, line 2: pigment rgb 1, .8, .3; "
          "declare Gold, line 2: finish phong .5");
    CHECK(literals(text, "sphere { R") == "declare R, line 1: centre 2.5");
    // A declaration that names itself does not make the search endless.
    CHECK(literals("#declare A = texture { A finish { phong 1 } }; sphere { 0, 1 texture { A } }", "sphere").size() >
          9);
}

TEST_CASE("a changed number is that of the scene") {
    const std::string text = "camera { right -4/3*x }\nunion { sphere { <0, 1, 2>, 3 pigment { rgb <1, 0, 0> } } }";
    const pov::OpenedPov before = opened(text, false);
    REQUIRE(before.lines.bodies.size() == 1);
    REQUIRE(before.lines.bodies[0].at);
    const auto values = pov::literals_of(text, text.find("sphere"));
    REQUIRE(values.size() == 3);
    const std::string changed = with_numbers(text, values[0], std::array{0., -1.5, 2.});
    CHECK(changed.find("sphere { <0, -1.5, 2>, 3 pigment") != changed.npos);
    CHECK(shape<Sphere>(opened(changed, false).scene).centre == DVec3(0, -1.5, 2));
}
