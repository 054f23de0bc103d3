// Pictures on bodies: where they are, by their own maps and by uv, and as reliefs.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "num/decimal.h"
#include "tests/referee/random_pattern.h"
#include "tests/referee/referee.h"
#include "tests/unit/trace/flat_scene.h"

using namespace strahl;

TEST_CASE("an image bends normals by its brightness, in any scene") {
    // A ramp in red from 0 to 1/2 across 33 pixels, whose middles are 1/33 apart; POV-Ray's weight of red is .297.
    const auto ramp = [](const std::string&) {
        Pixels pixels{33, 1, false, {}, Color(.5, .9, .9)};
        for (int i = 0; i < 33; ++i)
            pixels.values.insert(pixels.values.end(), {static_cast<float>(i) / 64.f, .9f, .9f});
        return pixels;
    };
    for (const Precision precision : {Precision::float32, Precision::float64, Precision::extended})
        for (const std::string settings : {"", "assumed_gamma 1"})
            for (const std::string space : {"", "scale 5 translate <2.3, 0, 0>"}) {
                CAPTURE(std::string(name(precision)));
                CAPTURE(settings);
                CAPTURE(space);
                const Scene scene =
                    parse_scene("global_settings { " + settings +
                                    " }\ncamera { position <.4, 0, 9>  look_at <.4, 0, 0>  sky <0, 1, 0>  "
                                    "fov 1 }\nlight { direction <3, 0, -4>  color <1, 1, 1> }\nplane { " +
                                    floor_points +
                                    "  material { rgb <1, 1, 1>  ambient 0  diffuse 1  specular 0  reflection 0\n"
                                    "  bump image { \"ramp\"  height 2  " +
                                    space + " } } }",
                                "ramp", {}, ramp);
                const double slope = 2 * .297 * 33 / 64, wanted = (.8 + .6 * slope) / std::sqrt(1 + slope * slope);
                CHECK(picture(scene, precision, 1, 1).rgb[0] == doctest::Approx(wanted).epsilon(1e-4));
            }
}

TEST_CASE("where images are") {
    // Four pixels, two by two: red and green above, blue and white below.
    const auto four = [](const std::string&) {
        return Pixels{2, 2, false, {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, Color(1)};
    };
    const auto seen = [&](const std::string& body, const DVec3& from, const DVec3& to, Precision precision) {
        Scene scene = parse_scene(
            "global_settings { ambient_light <1, 1, 1> }\n"
            "defaultmaterial { ambient 1  diffuse 0  reflection 0  specular 0 }\n"
            "camera { position <0, 0, 9>  look_at <0, 0, 0>  sky <0, 1, 0>  fov 1 }\n" +
                body,
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
            check("plane { " + floor_points + "  material { rgb image { \"four\" " + more + " } } }", {x, y, 9},
                  {x, y, 0}, wanted);
        };
        for (const double x : {.25, 5.25, -.75}) plane("", x, .75, {1, 0, 0}), plane("", x, -.75, {0, 0, 1});
        plane("", .75, .75, {0, 1, 0});
        plane("", .75, .25, {1, 1, 1});
        plane("", .5, .5, {.5, .5, .5});
        plane("", .5, .75, {.5, .5, 0});
        plane("", 0, .75, {.5, .5, 0});  // edges join
        plane("scale <2, 1, 1> ", .5, .75, {1, 0, 0});
        for (const double x : {.01, .49, -.51}) plane("sharp ", x, .51, {1, 0, 0}), plane("sharp ", x, .49, {0, 0, 1});
        plane("sharp ", -.01, .75, {0, 1, 0});
        plane("sharp once <.1, .2, .3> ", .99, .99, {0, 1, 0});
        plane("sharp once <.1, .2, .3> ", 1.01, .99, {.1, .2, .3});
        plane("once <.1, .2, .3> ", .1, .9, {1, 0, 0});  // edges do not join
        plane("once <.1, .2, .3> ", -.01, .9, {.1, .2, .3});
        plane("once <.1, .2, .3> ", .9, 1.01, {.1, .2, .3});
        // Beyond its edges the picture goes on with their colours, or as its mirror image.
        for (const char* const wrap : {"wrap clamp ", "wrap clamp mirror ", "wrap mirror "}) {
            plane(wrap, 0, .75, {1, 0, 0}), plane(wrap, 1, .75, {0, 1, 0});
            plane(wrap, .25, 1, {1, 0, 0}), plane(wrap, .5, .75, {.5, .5, 0}), plane(wrap, -.25, .75, {1, 0, 0});
        }
        plane("wrap clamp ", 1.75, .25, {1, 1, 1}), plane("wrap clamp ", -7.3, 8, {1, 0, 0});
        plane("wrap mirror ", 1.75, .25, {0, 0, 1}), plane("wrap mirror ", -1.5, 8.75, {.5, .5, 0});
        plane("wrap clamp repeat ", 7, -.25, {0, 1, 0}), plane("wrap repeat clamp ", 1.25, -3, {0, 0, 1});
        plane("sharp wrap mirror ", 1.25, -.25, {1, 1, 1});
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

TEST_CASE("a sharp image shows one row of pixels on a face that lies on a border of its pixels") {
    const auto checks = [](const std::string&) {
        Pixels pixels{4, 4, false, {}, Color(1)};
        for (int i = 0; i < 48; ++i) pixels.values.push_back((i / 3 % 4 + i / 12) % 2 ? 1.f : 0.f);
        return pixels;
    };
    for (const Precision precision : {Precision::float32, Precision::float64, Precision::extended})
        for (const char* const turn : {"<10, 20, 30>", "<-25, 35, 15>", "<0, 30, 0>"})
            for (const char* const shift : {"-1", "0", ".5"}) {
                CAPTURE(std::string(name(precision)));
                CAPTURE(turn);
                Scene scene = parse_scene(
                    "global_settings { ambient_light <1, 1, 1> }\ncamera { position <9, 0, 0>  look_at <0, 0, 0>  "
                    "sky <0, 1, 0>  fov 1 }\nbox { <-1, -1, -1>, <1, 1, 1>  rotate " +
                        std::string(turn) + "  material { rgb image { \"checks\" sharp  scale 2  translate <" + shift +
                        ", .25, 0> }\n  ambient 1  diffuse 0  reflection 0  specular 0 } }",
                    "border", {}, checks);
                // Looks straight at the middle of the face where x is 1, in whose height is the middle of a pixel.
                const glm::dmat4 m = matrix(scene.primitives[0].transformations);
                scene.camera.position = transform_point(m, {9, 0, .1}),
                scene.camera.look_at = transform_point(m, {1, 0, .1});
                const Frame frame = picture(scene, precision, 24, 18);
                CHECK(std::ranges::count(frame.rgb, frame.rgb[0]) == std::ptrdiff_t(frame.rgb.size()));
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
            mesh +=
                (smooth ? "smooth_triangle { " + points : "triangle { ") + points + " uv_vectors " + places + " }\n";
        }
        return parse_scene(
            "camera { position <3, 5, 6>  look_at <0, 0, 0>  sky <0, 0, 1>  fov 12 }\n"
            "light { position <9, 4, 9>  color <1, 1, 1> }\n"
            "defaultmaterial { ambient .5  reflection .3  refraction .4  ior 1.2 }\n"
            "plane { <0, 0, -2>, <1, 0, -2>, <0, 1, -2>  material { refraction 0 } }\n"
            "define body mesh { " +
                mesh + "material { rgb image { \"r\" map " + map + "  scale .7 } } }\n" + bodies,
            "uv", {}, random);
    };
    std::string many;
    for (int i = 0; i < 70; ++i) many += "sphere { <0, 0, -9>, .1 }\n";
    const std::string turned = "body { rotate <20, 30, 40>  scale <1, 1.2, .8>  translate <.1, .2, 0> } ";
    for (const std::string& bodies : {std::string("body { }"), turned + "body { translate <1, 1, .3> }", many + turned,
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
        "       material { rgb image { \"r\" map uv  rotate <0, 0, 30>  scale .4 }  refraction .5 }  scale <1, 1.2, "
        ".8> }",
        "uv", {}, random);
    const int width = 24, height = 18;
    const Frame own = picture(scene, Precision::float64, width, height);
    const Referee<long double> referee(scene, scene.camera, width, height, scene.settings.max_trace_level);
    for (int i = 0; i < width * height; ++i)
        CHECK(referee.explains(i % width, i / width, &own.rgb[3 * static_cast<std::size_t>(i)], 1e-9, 1e-6));
}

TEST_CASE("images in float are those in double up to rounding, and every pixel is a number") {
    const auto random = [](const std::string&) { return made_up_pixels("8-7-4"); };
    for (const std::string map : {"planar", "spherical", "cylindrical", "planar once <1, 0, 0>"})
        for (const std::string more : {"scale .7", "translate <1e9, -1e9, 1e9>", "scale 1e-300"}) {
            CAPTURE(map);
            CAPTURE(more);
            const Scene scene = parse_scene(
                "global_settings { ambient_light <1, 1, 1> }\n"
                "defaultmaterial { ambient 1  diffuse 0  reflection 0  specular 0 }\n"
                "camera { position <3, 5, 4>  look_at <0, 0, 0>  sky <0, 0, 1>  fov 12 }\n"
                "sphere { <0, 0, 0>, 1  material { rgb image { \"r\" map " +
                    map + "  " + more + " } } }\nbox { <-2, -2, -2>, <2, 2, -1>  material { rgb image { \"r\" } } }",
                "ball", {}, random);
            const Frame single = picture(scene, Precision::float32), twice = picture(scene);
            CHECK(std::ranges::all_of(single.rgb, [](double v) { return v >= 0 && v <= 1; }));
            CHECK(std::ranges::all_of(twice.rgb, [](double v) { return v >= 0 && v <= 1; }));
            if (more.starts_with("scale .")) CHECK(different(single, twice, 1e-4) < 12);
        }
}
