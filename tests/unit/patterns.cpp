// Patterns: where they are, what moves with what, and how far from the origin they still hold.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "num/decimal.h"
#include "tests/referee/random_pattern.h"
#include "tests/referee/random_scene.h"
#include "tests/referee/referee.h"
#include "tests/unit/levels.h"
#include "text/parse.h"
#include "trace/tracer.h"

using namespace strahl;

namespace {

/// A scene that shows colours as they are, seen along -z from above.
Scene flat(const std::string& bodies, double width = 8, const std::string& at = "0, 0, 0") {
    return parse_scene("global_settings { ambient_light <1, 1, 1> }\n"
                       "defaultmaterial { ambient 1  diffuse 0  reflection 0  specular 0 }\n"
                       "camera { position <0, 0, 100>  look_at <" + at + ">  sky <0, 1, 0>  fov " +
                           std::to_string(std::atan(width / 200) * 57.29577951308232) + " }\n" + bodies,
                       "flat");
}
Frame picture(const Scene& scene, Precision precision = Precision::float64, int width = 64, int height = 48) {
    return render(scene,
                  {.camera = scene.camera, .width = width, .height = height, .depth = scene.settings.max_trace_level},
                  precision, 2);
}
/// How many values differ by more than `tolerance`.
int different(const Frame& a, const Frame& b, double tolerance) {
    int count = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) count += !(std::abs(a.rgb[i] - b.rgb[i]) <= tolerance);
    return count;
}

const std::string marble =
    "marble { turbulence 1  octaves 4  colors { 0 <1, 0, 0> 1 <0, 1, .5> }  rotate <20, 30, 40> }";
const std::string floor_points = "<0, 0, 0>, <1, 0, 0>, <0, 1, 0>";

}  // namespace

TEST_CASE("a pattern moves with its body") {
    const std::string ball = "sphere { <0, 0, 0>, 2  material { rgb " + marble + " }";
    const Frame as_it_is = picture(flat(ball + " }"));
    const std::string turn = "  rotate <0, 0, 70>  scale <1.5, 1, 1>  translate <.3, .2, 0>";
    const Frame turned = picture(flat(ball + turn + " }"));
    CHECK(different(as_it_is, turned, .01) > 500);
    // The same by the pattern's own transformations.
    const std::string marble_turned = marble.substr(0, marble.size() - 1) + turn + " }";
    const Frame by_hand =
        picture(flat("sphere { <0, 0, 0>, 2" + turn + "  material { rgb " + marble + " } }"));
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
                // Of a whole cell all pixels have the same colour: few neighbours differ.
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
        const Frame there = picture(
            scene(slanted ? "translate <578000, -1156000, .3> " : "translate <578000, -1156000, 578000.3> "),
            Precision::float32);
        CHECK(different(here, there, 1e-3) < 40);
    }
}

TEST_CASE("float noise is double noise but for rounding") {
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
        const Scene few = random_scene(900 + seed, {.patterns = true});
        Scene many = few;
        // Too many for a bin each, and behind the camera.
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
                CHECK(lit({-3, 0, 4}, "rotate <0, 0, 180>") == doctest::Approx((.8 - .6 * height) * slope).epsilon(tolerance));
                CHECK(lit({-4, 0, -1}, "") == 0);
            }
}

TEST_CASE("bumps leave outlines and what is inside as they are") {
    const std::string balls = "light { position <9, 20, 30>  color <1, 1, 1> } union { sphere { <-1, 0, 0>, 2 } "
                              "sphere { <1, .5, 0>, 1.5 }  rotate <10, 20, 30>  material { ";
    const Frame smooth = picture(flat(balls + "diffuse 1  refraction .5  ior 1 } }"));
    const Frame bumpy = picture(flat(balls + "diffuse 1  refraction .5  ior 1  bump noise { height .3  scale .3 } } }"));
    const Frame flat_bumps = picture(flat(balls + "diffuse 1  refraction .5  ior 1  bump noise { height 0 } } }"));
    CHECK(different(smooth, bumpy, .01) > 500);
    CHECK(different(smooth, flat_bumps, 1e-12) == 0);
    for (std::size_t i = 0; i < smooth.rgb.size(); ++i) CHECK((smooth.rgb[i] > 0) == (bumpy.rgb[i] > 0));
}

TEST_CASE("where images are") {
    // Four pixels, two by two: red and green above, blue and white below.
    const auto four = [](const std::string&) {
        return Pixels{2, 2, false, {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, Color(1)};
    };
    const auto seen = [&](const std::string& body, const DVec3& from, const DVec3& to, Precision precision) {
        Scene scene = parse_scene("global_settings { ambient_light <1, 1, 1> }\n"
                                  "defaultmaterial { ambient 1  diffuse 0  reflection 0  specular 0 }\n"
                                  "camera { position <0, 0, 9>  look_at <0, 0, 0>  sky <0, 1, 0>  fov 1 }\n" + body,
                                  "four", {}, four);
        scene.camera.position = from, scene.camera.look_at = to, scene.camera.up = {.3, .4, -.5};
        const Frame frame = picture(scene, precision, 1, 1);
        return Color(frame.rgb[0], frame.rgb[1], frame.rgb[2]);
    };
    for (const Precision precision : {Precision::float32, Precision::float64, Precision::extended}) {
        CAPTURE(std::string(name(precision)));
        const auto check = [&](const std::string& body, const DVec3& from, const DVec3& to, const Color& wanted) {
            CAPTURE(body);
            const Color color = seen(body, from, to, precision);
            for (int c = 0; c < 3; ++c) CHECK(color[c] == doctest::Approx(wanted[c]).epsilon(1e-5));
        };
        const auto plane = [&](const std::string& more, double x, double y, const Color& wanted) {
            check("plane { " + floor_points + "  material { rgb image { \"four\" " + more + " } } }", {x, y, 9}, {x, y, 0},
                  wanted);
        };
        for (const double x : {.25, 5.25, -.75}) plane("", x, .75, {1, 0, 0}), plane("", x, -.75, {0, 0, 1});
        plane("", .75, .75, {0, 1, 0});
        plane("", .75, .25, {1, 1, 1});
        plane("", .5, .5, {.5, .5, .5});
        plane("", .5, .75, {.5, .5, 0});
        plane("", 0, .75, {.5, .5, 0});  // edges join
        plane("scale <2, 1, 1> ", .5, .75, {1, 0, 0});
        plane("once <.1, .2, .3> ", .1, .9, {1, 0, 0});  // and do not
        plane("once <.1, .2, .3> ", -.01, .9, {.1, .2, .3});
        plane("once <.1, .2, .3> ", .9, 1.01, {.1, .2, .3});
        const auto ball = [&](const std::string& map, const DVec3& from, const Color& wanted) {
            check("sphere { <0, 0, 0>, 1  material { rgb image { \"four\" map " + map + " } } }", 9. * from, {0, 0, 0},
                  wanted);
        };
        // A quarter of a turn from x is the middle of the left pixels, three quarters are that of the right ones.
        const DVec3 north(0, .70710678118654752, .70710678118654752), south(0, .70710678118654752, -.70710678118654752);
        ball("spherical", north, {1, 0, 0});
        ball("spherical", {0, -north.y, north.z}, {0, 1, 0});
        ball("spherical", south, {0, 0, 1});
        ball("spherical", {0, -south.y, south.z}, {1, 1, 1});
        ball("spherical", {0, 1, 0}, {.5, 0, .5});
        ball("spherical", {north.y, 0, north.z}, {.5, .5, 0});
        ball("spherical rotate <0, 0, 90> ", {-north.y, 0, north.z}, {1, 0, 0});
        ball("cylindrical scale <1, 1, 2> translate <0, 0, -1> ", {0, .86602540378443865, .5}, {1, 0, 0});
        ball("cylindrical scale <1, 1, 2> translate <0, 0, -1> ", {0, -.86602540378443865, -.5}, {1, 1, 1});
    }
}

TEST_CASE("an image by uv is where the places of its mesh's corners say") {
    // Places that are x and y of the corners make it a planar image, which the body's transformations take along.
    const auto random = [](const std::string&) { return made_up_pixels("8-7-4"); };
    const auto scene = [&](const std::string& map, bool smooth, const std::string& bodies) {
        std::string mesh;
        for (const MeshData::Corners& corners : Mesh::tetrahedron()->triangles) {
            std::string points, places;
            for (const std::int32_t corner : corners) {
                const DVec3 p = 2. * Mesh::tetrahedron()->points[corner] - DVec3(.5, .4, .3);
                points += text_of(p) + " ";
                places += "<" + text_of(p.x) + ", " + text_of(p.y) + ">";
            }
            mesh += (smooth ? "smooth_triangle { " + points : "triangle { ") + points + " uv_vectors " + places + " }\n";
        }
        return parse_scene("camera { position <3, 5, 6>  look_at <0, 0, 0>  sky <0, 0, 1>  fov 12 }\n"
                           "light { position <9, 4, 9>  color <1, 1, 1> }\n"
                           "defaultmaterial { ambient .5  reflection .3  refraction .4  ior 1.2 }\n"
                           "plane { <0, 0, -2>, <1, 0, -2>, <0, 1, -2>  material { refraction 0 } }\n"
                           "define body mesh { " + mesh + "material { rgb image { \"r\" map " + map + "  scale .7 } } }\n" +
                               bodies, "uv", {}, random);
    };
    std::string many;
    for (int i = 0; i < 70; ++i) many += "sphere { <0, 0, -9>, .1 }\n";
    const std::string turned = "body { rotate <20, 30, 40>  scale <1, 1.2, .8>  translate <.1, .2, 0> } ";
    for (const std::string& bodies :
         {std::string("body { }"), turned + "body { translate <1, 1, .3> }", many + turned,
          "sphere { <0, 0, -1>, .3 } union { sphere { <0, 0, 1.2>, .5 } " + turned + "}"})
        for (const bool smooth : {false, true})
            for (const Precision precision : {Precision::float32, Precision::float64, Precision::extended}) {
                CAPTURE(bodies);
                CAPTURE(smooth);
                CAPTURE(std::string(name(precision)));
                const auto traced = [&](const std::string& map) {
                    return picture(scene(map, smooth, bodies), precision, 24, 18);
                };
                const Frame by_uv = traced("uv");
                CHECK(different(by_uv, traced("planar"), precision == Precision::float32 ? 1e-3 : 1e-9) < 12);
                CHECK(different(by_uv, traced("planar translate <.2, 0, 0>"), .01) > 100);
            }
}

TEST_CASE("an image by uv is the referee's") {
    const auto random = [](const std::string&) { return made_up_pixels("8-7-4"); };
    const Scene scene = parse_scene(
        "camera { position <3, 5, 6>  look_at <0, 0, 0>  sky <0, 0, 1>  fov 12 }\n"
        "light { position <9, 4, 9>  color <1, 1, 1> }\n"
        "plane { <0, 0, -1>, <1, 0, -1>, <0, 1, -1> }\n"
        "mesh { smooth_triangle { <-1, 1, 0>, <1, 1, .3>, <0, -1, 1>  <0, 1, 1>, <.3, 1, 1>, <0, 0, 1>\n"
        "                         uv_vectors <-.2, .1>, <3, -1>, <1, 5> }\n"
        "       triangle { <1, 1, 1>, <-1, 1, 1>, <0, 2, 0>  uv_vectors <1, 1>, <1, 2>, <4, 4> }\n"
        "       material { rgb image { \"r\" map uv  rotate <0, 0, 30>  scale .4 }  refraction .5 }  scale <1, 1.2, .8> }",
        "uv", {}, random);
    const int width = 24, height = 18;
    const Frame own = picture(scene, Precision::float64, width, height);
    const Referee<long double> referee(scene, scene.camera, width, height, scene.settings.max_trace_level);
    for (int i = 0; i < width * height; ++i)
        CHECK(referee.explains(i % width, i / width, &own.rgb[3 * static_cast<std::size_t>(i)], 1e-9, 1e-6));
}

TEST_CASE("images in float are those in double but for rounding, and no pixel is none") {
    const auto random = [](const std::string&) { return made_up_pixels("8-7-4"); };
    for (const std::string map : {"planar", "spherical", "cylindrical", "planar once <1, 0, 0>"})
        for (const std::string more : {"scale .7", "translate <1e15, -1e15, 1e15>", "scale 1e-300"}) {
            CAPTURE(map);
            CAPTURE(more);
            const Scene scene = parse_scene("global_settings { ambient_light <1, 1, 1> }\n"
                                            "defaultmaterial { ambient 1  diffuse 0  reflection 0  specular 0 }\n"
                                            "camera { position <3, 5, 4>  look_at <0, 0, 0>  sky <0, 0, 1>  fov 12 }\n"
                                            "sphere { <0, 0, 0>, 1  material { rgb image { \"r\" map " + map + "  " + more +
                                                " } } }\nbox { <-2, -2, -2>, <2, 2, -1>  material { rgb image { \"r\" } } }",
                                            "ball", {}, random);
            const Frame single = picture(scene, Precision::float32), twice = picture(scene);
            CHECK(std::ranges::all_of(single.rgb, [](double v) { return v >= 0 && v <= 1; }));
            CHECK(std::ranges::all_of(twice.rgb, [](double v) { return v >= 0 && v <= 1; }));
            if (more.starts_with("scale .")) CHECK(different(single, twice, 1e-4) < 12);
        }
}

TEST_CASE("numbers without sense make no pixel that is none") {
    const std::string floor = "plane { " + floor_points + "  material { rgb ";
    for (const std::string kind :
         {"checker { <1, 1, 1>, <.5, .5, .5> ",
          "brick { <1, 1, 1>, <.5, .5, .5>  brick_size <1e-9, 1e9, 1>  mortar 1e9 ",
          "noise { octaves 10  lambda 1e9  colors { 0 <1, 1, 1> .5 <0, 0, 0> .5 <1, 0, 0> } ",
          "wood { turbulence 1e9  lambda 1e-9  colors { 0 <1, 1, 1> 1 <0, 0, 0> } "})
        for (const std::string more : {"", "scale 1e-300 ", "translate <1e15, -1e15, 1e15> ", "scale 1e300 "})
            for (const Precision precision : {Precision::float32, Precision::float64, Precision::extended}) {
                CAPTURE(kind);
                CAPTURE(more);
                const Frame frame = picture(flat(floor + kind + more + "} } }"), precision, 16, 12);
                CHECK(std::ranges::all_of(frame.rgb, [](double v) { return v >= 0 && v <= 1; }));
            }
}
