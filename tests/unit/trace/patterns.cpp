// Patterns: where they are, what moves with what, and how far from the origin they still hold.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/referee/random_scene.h"
#include "tests/unit/trace/flat_scene.h"

using namespace strahl;

namespace {

const std::string marble =
    "marble { turbulence 1  octaves 4  colors { 0 <1, 0, 0> 1 <0, 1, .5> }  rotate <20, 30, 40> }";

}  // namespace

TEST_CASE("a pattern moves with its body") {
    const std::string ball = "sphere { <0, 0, 0>, 2  material { rgb " + marble + " }";
    const Frame as_it_is = picture(flat(ball + " }"));
    const std::string turn = "  rotate <0, 0, 70>  scale <1.5, 1, 1>  translate <.3, .2, 0>";
    const Frame turned = picture(flat(ball + turn + " }"));
    CHECK(different(as_it_is, turned, .01) > 500);
    // The pattern's own transformations have the same effect.
    const std::string marble_turned = marble.substr(0, marble.size() - 1) + turn + " }";
    const Frame by_hand = picture(flat("sphere { <0, 0, 0>, 2" + turn + "  material { rgb " + marble + " } }"));
    CHECK(different(turned, by_hand, 1e-12) == 0);
    const Frame inside_out = picture(flat("union { sphere { <0, 0, 0>, 2" + turn + "  material { rgb " + marble +
                                          " } } sphere { <50, 0, 0>, 1 } }"));
    CHECK(different(turned, inside_out, 1e-9) == 0);
    const Frame moved_whole = picture(flat("union { sphere { <0, 0, 0>, 2" + turn + " } sphere { <50, 0, 0>, 1 }" +
                                           "  material { rgb " + marble_turned + " } }"));
    CHECK(different(turned, moved_whole, 1e-9) == 0);
}

TEST_CASE("the pattern of a whole goes on through its parts") {
    const std::string parts = "box { <-3, -2, -1>, <0, 2, 1>  rotate <0, 0, 20> } box { <0, -2, -1>, <3, 2, 1> }";
    const Frame one = picture(flat("union { " + parts + "  material { rgb checker { <1, 1, 1>, <0, 0, 1> } } }"));
    const Frame each = picture(flat(
        "union { box { <-3, -2, -1>, <0, 2, 1>  rotate <0, 0, 20>  material { rgb checker { <1, 1, 1>, <0, 0, 1> } } }"
        "        box { <0, -2, -1>, <3, 2, 1>  material { rgb checker { <1, 1, 1>, <0, 0, 1> } } } }"));
    CHECK(different(one, each, .5) > 100);
    const Frame plain =
        picture(flat("box { <-5, -5, -1>, <5, 5, 1>  material { rgb checker { <1, 1, 1>, <0, 0, 1> } } }"));
    int inside = 0;
    for (std::size_t i = 0; i < one.rgb.size(); i += 3)
        if (one.rgb[i + 2] > 0) {
            ++inside;
            CHECK(one.rgb[i] == plain.rgb[i]);
        }
    CHECK(inside > 1000);
}

TEST_CASE("a chequered floor in a border of its cells is not speckled, in any precision") {
    for (const std::string scale : {"1", "3", "<.7, .7, 1>", "<1, 1, .3>"})
        for (const double height : {0., -3., 21.})
            for (const Precision precision : {Precision::float32, Precision::float64, Precision::extended}) {
                CAPTURE(scale);
                CAPTURE(height);
                CAPTURE(std::string(name(precision)));
                const std::string z = std::to_string(height);
                const std::string plane = "plane { <0, 0, " + z + ">, <1, 0, " + z + ">, <0, 1, " + z + ">";
                const Scene scene = flat(plane + "  material { rgb checker { <1, 1, 1>, <0, 0, 0>  scale " + scale +
                                         "  translate <.31, .17, " + z + "> } } }");
                const Frame frame = picture(scene, precision);
                // All pixels of a cell have the same colour, so few neighbours differ.
                int changes = 0, white = 0;
                for (int y = 0; y < 48; ++y)
                    for (int x = 1; x < 64; ++x) {
                        changes += frame.rgb[3 * (64 * y + x)] != frame.rgb[3 * (64 * y + x - 1)];
                        white += frame.rgb[3 * (64 * y + x)] == 1;
                    }
                CHECK(changes < 48 * 16);
                CHECK(white > 700);
                CHECK(white < 2300);
            }
}

TEST_CASE("patterns that repeat are as good far away as here") {
    const char* const kinds[]{
        "checker { <1, .2, .2>, <.1, .1, .9> %}",
        "brick { <.8, .8, .7>, <.7, .2, .1>  brick_size <8, 4, 4>  scale .25 %}",
        "gradient { axis <1, .5, 0>  colors { 0 <0, 0, 1> .5 <1, 1, 0> 1 <1, 0, 0> } %}",
        "noise { octaves 3  colors { 0 <0, 0, 0> 1 <1, 1, 1> } %}",
        "marble { turbulence .7  colors { 0 <0, 0, 0> 1 <1, 1, 1> } %}",
    };
    for (const std::string kind : kinds) {
        CAPTURE(kind);
        const auto with = [&](const std::string& more) {
            const std::size_t mark = kind.find('%');
            return kind.substr(0, mark) + more + kind.substr(mark + 1);
        };
        const auto scene = [&](const std::string& more) {
            return flat("plane { " + floor_points + "  material { rgb " + with(more) + " } }");
        };
        const bool slanted = kind.starts_with("gradient");
        // 289 * 2000 is a multiple of all their periods but the slanted one's.
        const Frame here = picture(scene("translate <0, 0, .3> "), Precision::float32);
        const Frame there =
            picture(scene(slanted ? "translate <578000, -1156000, .3> " : "translate <578000, -1156000, 578000.3> "),
                    Precision::float32);
        CHECK(different(here, there, 1e-3) < 40);
    }
}

TEST_CASE("float noise is double noise up to rounding") {
    const std::string noise = "noise { octaves 2  colors { 0 <0, 0, 0> 1 <1, 1, 1> } }";
    for (const double width : {8., 80., 800.}) {
        CAPTURE(width);
        const Scene scene =
            flat("plane { " + floor_points + "  material { rgb " + noise + " } }", width, "0.1, 0.2, 0");
        const Frame single = picture(scene, Precision::float32), twice = picture(scene, Precision::float64);
        double most = 0, low = 1, high = 0;
        for (std::size_t i = 0; i < single.rgb.size(); ++i) {
            most = std::max(most, std::abs(single.rgb[i] - twice.rgb[i]));
            low = std::min(low, twice.rgb[i]), high = std::max(high, twice.rgb[i]);
        }
        CHECK(most < 3e-6 * width);
        CHECK(low < .25);
        CHECK(high > .75);
    }
}

TEST_CASE("few bodies and many are coloured alike") {
    for (int seed = 0; seed < 60; ++seed) {
        CAPTURE(seed);
        Scene few = random_scene(900 + seed, {.patterns = true});
        few.settings.max_trace_level = 6;  // each glass doubles the rays
        Scene many = few;
        // Adds so many bodies behind the camera that items have no bins of their own.
        const DVec3 behind = few.camera.position + few.camera.position;
        for (int i = 0; i < 70; ++i)
            many.primitives.push_back({Sphere{behind + DVec3(.01 * i, 0, 0), .001}, few.primitives[0].material, {}});
        const Frame alone = picture(few, Precision::float64, 24, 18);
        CHECK(different(alone, picture(many, Precision::float64, 24, 18), 1e-7) < 12);
    }
}

TEST_CASE("bumps are as steep as their height says, and no light comes from behind") {
    for (const Precision precision : {Precision::float32, Precision::float64, Precision::extended})
        for (const double height : {0., .4, 1.})
            for (const std::string space : {"", "scale 5 ", "scale <1, 3, 1> ", "translate <1e9, 0, 0> "}) {
                CAPTURE(std::string(name(precision)));
                CAPTURE(height);
                CAPTURE(space);
                const auto lit = [&](const DVec3& towards, const std::string& more) {
                    Scene scene = flat("light { direction <0, 0, -1>  color <1, 1, 1> } plane { " + floor_points +
                                           "  material { rgb <1, 1, 1>  ambient 0  diffuse 1  bump gradient { height " +
                                           std::to_string(height) + "  " + space + "} } " + more + " }",
                                       8, ".3, .2, 0");
                    scene.lights[0].direction = -towards;
                    return picture(scene, precision, 1, 1).rgb[0];
                };
                const double slope = 1 / std::sqrt(1 + height * height), tolerance = 1e-4;
                CHECK(lit({0, 0, 1}, "") == doctest::Approx(slope).epsilon(tolerance));
                CHECK(lit({-3, 0, 4}, "") == doctest::Approx((.8 + .6 * height) * slope).epsilon(tolerance));
                CHECK(lit({-3, 0, 4}, "rotate <0, 0, 180>") ==
                      doctest::Approx((.8 - .6 * height) * slope).epsilon(tolerance));
                CHECK(lit({-4, 0, -1}, "") == 0);
            }
}

TEST_CASE("bumps leave outlines and what is inside as they are") {
    const std::string balls =
        "light { position <9, 20, 30>  color <1, 1, 1> } union { sphere { <-1, 0, 0>, 2 } "
        "sphere { <1, .5, 0>, 1.5 }  rotate <10, 20, 30>  material { ";
    const Frame smooth = picture(flat(balls + "diffuse 1  refraction .5  ior 1 } }"));
    const Frame bumpy =
        picture(flat(balls + "diffuse 1  refraction .5  ior 1  bump noise { height .3  scale .3 } } }"));
    const Frame flat_bumps = picture(flat(balls + "diffuse 1  refraction .5  ior 1  bump noise { height 0 } } }"));
    CHECK(different(smooth, bumpy, .01) > 500);
    CHECK(different(smooth, flat_bumps, 1e-12) == 0);
    for (std::size_t i = 0; i < smooth.rgb.size(); ++i) CHECK((smooth.rgb[i] > 0) == (bumpy.rgb[i] > 0));
}

TEST_CASE("a pattern among the colours of another is where that one is") {
    const auto floor = [](const std::string& pattern, const std::string& more = "") {
        return flat("light { position <9, 20, 30>  color <1, 1, 1> } plane { " + floor_points + "  material { rgb " +
                    pattern + "  diffuse 1 } }" + more);
    };
    const std::string wood = "wood { turbulence .3  colors { 0 <.1, .2, .9>  1 <1, .5, 0> }  scale 2 ";
    const std::string moves = "rotate <10, 20, 30>  translate <1, 2, 3> } ";
    for (const Precision precision : {Precision::float32, Precision::float64, Precision::extended}) {
        const Frame once = picture(floor(wood + moves), precision);
        const Frame nested = picture(floor("checker { " + wood + "}, " + wood + "} " + moves), precision);
        CHECK(different(once, nested, precision == Precision::float32 ? 1e-3 : 1e-9) == 0);
        const Frame other = picture(floor("checker { " + wood + "}, <.5, .5, .5> " + moves), precision);
        CHECK(different(once, other, .01) > 500);
        // A finish of POV-Ray's does not change that.
        const Frame finished =
            picture(floor("checker { " + wood + "}, " + wood + "} " + moves + " metallic 1"), precision);
        CHECK(different(once, finished, precision == Precision::float32 ? 1e-3 : 1e-9) == 0);
    }
    // Before the background a coat hides its share.
    const Frame sky =
        picture(flat("background { color <.5, 1, 0>  coat <.25, .5, 1, .5, .25>  coat <0, 0, 1, 0, 1> }"));
    const Color wanted(.25 * .25 + .5 * (.5 * .25 + .25), .25 * .5 + 1 * (.5 * .5 + .25), .25 * 1 + 0);
    for (int c = 0; c < 3; ++c) CHECK(sky.rgb[c] == doctest::Approx(wanted[c]));
}

TEST_CASE("senseless numbers leave every pixel a number") {
    const std::string floor = "plane { " + floor_points + "  material { rgb ";
    for (const std::string kind : {"checker { <1, 1, 1>, <.5, .5, .5> ",
                                   "brick { <1, 1, 1>, <.5, .5, .5>  brick_size <1e-9, 1e9, 1>  mortar 1e9 ",
                                   "noise { octaves 10  lambda 1e9  colors { 0 <1, 1, 1> .5 <0, 0, 0> .5 <1, 0, 0> } ",
                                   "wood { turbulence 1e9  lambda 1e-9  colors { 0 <1, 1, 1> 1 <0, 0, 0> } "})
        for (const std::string more : {"", "scale 1e-300 ", "translate <1e9, -1e9, 1e9> ", "scale 1e300 "})
            for (const Precision precision : {Precision::float32, Precision::float64, Precision::extended}) {
                CAPTURE(kind);
                CAPTURE(more);
                const Frame frame = picture(flat(floor + kind + more + "} } }"), precision, 16, 12);
                CHECK(std::ranges::all_of(frame.rgb, [](double v) { return v >= 0 && v <= 1; }));
            }
}

TEST_CASE("the eye looks through several surfaces in one place that it does not see") {
    const std::string eye =
        "camera { position <0, 0, 9>  look_at <0, 0, 0>  sky <0, 1, 0>  fov 10 }\n"
        "light { position <3, 4, 30>  color <1, 1, 1> }\n";
    const std::string wall =
        "plane { <0, 0, -1>, <1, 0, -1>, <0, 1, -1> material { rgb <.9, .5, .2>  reflection 0 } }\n";
    const std::string unseen = " material { rgb <1, 1, 1>  seen 0  shadow 0 } }\n";
    const std::string bodies = "box { <-1, -1, 0>, <1, 1, 1>" + unseen + "box { <-1, -1, 1>, <1, 1, 2>" + unseen +
                               "box { <-2, -2, 1>, <2, 2, 2>" + unseen;
    for (const Precision precision : {Precision::float32, Precision::float64, Precision::extended}) {
        const Frame with = picture(parse_scene(eye + wall + bodies, "unseen"), precision);
        const Frame without = picture(parse_scene(eye + wall, "wall"), precision);
        CHECK(different(with, without, 1e-4) == 0);
    }
}
