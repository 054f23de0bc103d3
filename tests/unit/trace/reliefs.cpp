// Bent normals: by pictures of normals, and by uv.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "num/decimal.h"
#include "num/vec_math.h"
#include "tests/referee/random_pattern.h"
#include "tests/referee/referee.h"
#include "tests/unit/trace/flat_scene.h"

using namespace strahl;

namespace {

constexpr Precision precisions[] = {Precision::float32, Precision::float64, Precision::extended};

/// A picture that is the same normal everywhere.
auto constant(const DVec3& normal) {
    const Color color = .5 * normal + DVec3(.5);
    return [color](const std::string&) {
        Pixels pixels{2, 2, false, {}, Color(1)};
        for (int i = 0; i < 12; ++i) pixels.values.push_back(static_cast<float>(color[i % 3]));
        return pixels;
    };
}
Pixels random_picture(const std::string&) { return made_up_pixels("8-7-4"); }

/// One pixel of a body of diffuse 1, from `eye` to a point of it, in parallel light that comes from `light`.
double lit(const std::string& body, const DVec3& normal, const DVec3& eye, const DVec3& point, const DVec3& light,
           Precision precision) {
    Scene scene = parse_scene(
        "camera { position <0, 0, 9>  look_at <0, 0, 0>  sky <.3, .8, .4>  fov 1 }\n"
        "light { direction <0, 0, -1>  color <1, 1, 1> }\n"
        "defaultmaterial { rgb <1, 1, 1>  diffuse 1  specular 0  reflection 0 }\n" +
            body,
        "lit", {}, constant(normal));
    scene.camera.position = eye, scene.camera.look_at = point, scene.lights[0].direction = -light;
    return picture(scene, precision, 1, 1).rgb[0];
}

const DVec3 tilted = normalize(DVec3(.3, -.2, .8));

/// Two triangles in the plane of z = 0, with corners at 0 and 2 and places `u` times x and `v` times y.
std::string square(double u, double v, const std::string& more) {
    const auto triangle = [&](const std::array<DVec3, 3>& corners) {
        std::string points, places;
        for (const DVec3& p : corners) {
            points += text_of(p) + " ";
            places += "<" + text_of(u * p.x) + ", " + text_of(v * p.y) + "> ";
        }
        return "triangle { " + points + "uv_vectors " + places + "}\n";
    };
    return "mesh { " + triangle({{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}}}) + triangle({{{0, 0, 0}, {2, 2, 0}, {0, 2, 0}}}) +
           more + " }\n";
}

}  // namespace

TEST_CASE("a picture of one normal tilts it along u and v, by every map") {
    struct Place {
        std::string body, map;
        DVec3 eye, point, u, v, normal;
    };
    const std::string plane = "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> ", ball = "sphere { <0, 0, 0>, 1 ";
    const DVec3 up(0, 0, 1), x(1, 0, 0), y(0, 1, 0);
    const double r = std::sqrt(.5);
    const Place places[] = {
        {plane, "", {.3, .4, 9}, {.3, .4, 0}, x, y, up},
        {plane, "scale <3, .5, 2> translate <9, 8, 7>", {.3, .4, 9}, {.3, .4, 0}, x, y, up},
        {plane, "rotate <0, 0, 90>", {.3, .4, 9}, {.3, .4, 0}, y, -x, up},
        {plane, "scale <-1, 1, 1>", {.3, .4, 9}, {.3, .4, 0}, -x, y, up},
        {plane, "", {.3, .4, -9}, {.3, .4, 0}, x, y, -up},                 // from behind
        {plane, "rotate <90, 0, 0>", {.3, .4, 9}, {.3, .4, 0}, x, y, up},  // v goes into the plane
        {ball, "map spherical", {0, 9, 9}, {0, r, r}, -x, {0, -r, r}, {0, r, r}},
        {ball, "map spherical", {9, 0, -9}, {r, 0, -r}, y, {r, 0, r}, {r, 0, -r}},
        {ball, "map spherical rotate <90, 0, 0>", {9, 9, 0}, {r, r, 0}, up, {r, -r, 0}, {r, r, 0}},
        {"cylinder { <0, 0, -1>, <0, 0, 1>, 1 ", "map cylindrical", {0, 9, .3}, {0, 1, .3}, -x, up, y},
        {square(1, 1, ""), "map uv", {.3, .4, 9}, {.3, .4, 0}, x, y, up},
        {square(-3, .2, ""), "map uv", {.3, .4, 9}, {.3, .4, 0}, -x, y, up},
        {square(1, 5, ""), "map uv rotate <0, 0, 90>", {.3, .4, 9}, {.3, .4, 0}, y, -x, up},
        {square(1, 2, ""), "map uv", {.3, .4, -9}, {.3, .4, 0}, x, y, -up},
    };
    for (const Precision precision : precisions)
        for (const auto& [body, map, eye, point, u, v, normal] : places) {
            CAPTURE(std::string(name(precision)));
            CAPTURE(body);
            CAPTURE(map);
            const std::string open = body.ends_with("}\n") ? body.substr(0, body.rfind('}')) : body;
            const auto scene = [&](const std::string& height) {
                return open + " material { normal image { \"n\" " + height + map + " } } }";
            };
            const auto bent = [&](double height) {
                return normalize(height * (tilted.x * u + tilted.y * v) + tilted.z * normal);
            };
            for (const DVec3& towards : {normal, normalize(normal + .3 * u), normalize(normal - .4 * v)}) {
                CHECK(lit(scene(""), tilted, eye, point, towards, precision) ==
                      doctest::Approx(dot_product(bent(1), towards)).epsilon(1e-5));
                CHECK(lit(scene("height 2 "), tilted, eye, point, towards, precision) ==
                      doctest::Approx(dot_product(bent(2), towards)).epsilon(1e-5));
            }
            CHECK(lit(scene(""), DVec3(0, 0, 1), eye, point, normal, precision) == doctest::Approx(1).epsilon(1e-5));
            CHECK(lit(scene(""), DVec3(0, 0, -1), eye, point, normal, precision) == doctest::Approx(1).epsilon(1e-5));
        }
}

TEST_CASE("a tilted normal shines, reflects and refracts as a tilted plane does, and leaves the depth as it is") {
    const auto traced = [&](const std::string& plane, Precision precision) {
        const Scene scene = parse_scene(
            "camera { position <1, -3, 4>  look_at <0, 0, 0>  sky <0, 0, 1>  fov .001 }\n"
            "light { position <2, 1, 3>  color <.7, .6, .5> }  light { direction <1, .5, -2>  color <.2, .3, .4> }\n"
            "background { color noise { octaves 3  colors { 0 <0, .1, .2>  1 <1, .8, .9> }  scale .3 } }\n"
            "defaultmaterial { rgb <.8, .7, .6>  diffuse .5  ambient .1  specular .6  pow 20  reflection .4 }\n" +
                plane,
            "tilted", {}, constant(tilted));
        return picture(scene, precision, 1, 1);
    };
    for (const std::string glass : {"", "refraction .4  ior 1.3"})
        for (const Precision precision : precisions) {
            CAPTURE(glass);
            CAPTURE(std::string(name(precision)));
            const DVec3 u = normalize(cross_product({0, 1, .3}, tilted)), v = cross_product(tilted, u);
            const Frame bent =
                traced("plane { " + floor_points + " material { " + glass + " normal image { \"n\" } } }", precision);
            const Frame turned = traced(
                "plane { <0, 0, 0>, " + text_of(u) + ", " + text_of(v) + " material { " + glass + " } }", precision);
            CHECK(different(bent, turned, precision == Precision::float32 ? 2e-4 : 1e-7) == 0);
        }
}

TEST_CASE("bumps by uv are those of the plane that the places are in") {
    const auto traced = [&](const std::string& relief, const std::string& place, double scale, Precision precision) {
        const Scene scene = parse_scene(
            "camera { position <1, -3, 4>  look_at <1, 1, 0>  sky <0, 0, 1>  fov 14 }\n"
            "light { position <3, 2, 3>  color <.7, .6, .5> }\n"
            "defaultmaterial { rgb <.8, .7, .6>  diffuse .7  specular .6  pow 20  reflection .1 }\n" +
                square(scale, scale, "material { bump " + relief + " } " + place),
            "uv", {}, random_picture);
        return picture(scene, precision, 24, 18);
    };
    for (const std::string& kind : {std::string("image { \"p\"  height .2"),
                                    std::string("noise { height .3  octaves 2"), std::string("marble { height .1")})
        for (const std::string place : {"", "rotate <10, 20, 30>", "scale 1.3 translate <.1, 0, .2>"})
            for (const Precision precision : precisions) {
                CAPTURE(kind);
                CAPTURE(place);
                CAPTURE(std::string(name(precision)));
                const std::string turned = " scale .6 rotate <0, 0, 25> translate <.2, .1, 0> }";
                const double tolerance = precision == Precision::float32 ? 3e-3 : 1e-9;
                const Frame in_space = traced(kind + turned, place, 1, precision);
                CHECK(different(in_space, traced(kind + " map uv " + turned, place, 1, precision), tolerance) < 12);
                // A picture twice as large, half as high in its units.
                CHECK(different(traced(kind + " scale 2 }", place, 1, precision),
                                traced(kind + " map uv }", place, .5, precision), tolerance) < 12);
                CHECK(different(in_space, traced("none", place, 1, precision), .01) > 100);
            }
}

TEST_CASE("reliefs and patterns by uv are the referee's, on flat and smooth triangles") {
    const std::string corners = "<-1, 1, 0>, <1, 1, .3>, <0, -1, 1> ", mirrored = "<1, 1>, <1, 2>, <4, 4> ";
    const std::string mesh =
        "mesh { smooth_triangle { " + corners +
        "<0, 1, 1>, <.3, 1, 1>, <0, 0, 1> uv_vectors <-.2, .1>, <3, -1>, <1, 5> }\n"
        "  smooth_triangle { <1, 1, 1>, <-1, 1, 1>, <0, 2, 0> <0, 0, 1>, <0, .3, 1>, <0, .1, 1> uv_vectors " +
        mirrored + "}\n";
    const std::string flat = "mesh { triangle { " + corners +
                             "uv_vectors <-.2, .1>, <3, -1>, <1, 5> }\n"
                             "  triangle { <1, 1, 1>, <-1, 1, 1>, <0, 2, 0> uv_vectors " +
                             mirrored + "}\n";
    for (const std::string& body : {mesh, flat})
        for (const std::string material :
             {"normal image { \"r\" map uv  rotate <0, 0, 30>  scale <.4, .9, 1> }",
              "bump image { \"r\" map uv  height .1  rotate <0, 0, 30>  scale <.4, .7, 1> }  refraction .5",
              "bump noise { map uv  height .2  octaves 3  scale .6  rotate <20, 30, 40> }",
              "normal image { \"r\" map uv  height .3 }  bump gradient { height .3  map uv  axis <1, 1, 0>  translate "
              "<.3, 0, 0> }",
              "rgb checker { <1, .5, 0>, <0, .5, 1>  map uv  scale .4 }  normal image { \"r\" map spherical  height .5 "
              "}",
              "rgb marble { map uv  turbulence .5  colors { 0 <1, .5, 0>  1 <0, .5, 1> }  scale .8 }  refraction .3"}) {
            CAPTURE(body);
            CAPTURE(material);
            const Scene scene = parse_scene(
                "camera { position <3, 5, 6>  look_at <0, .4, .4>  sky <0, 0, 1>  fov 10 }\n"
                "light { position <9, 4, 9>  color <1, 1, 1> }\n"
                "plane { <0, 0, -1>, <1, 0, -1>, <0, 1, -1> }\nsphere { <0, 0, 3>, .2 }\n" +
                    body + "material { " + material + " ambient .2 }  scale <1, 1.2, .8>  rotate <0, 10, 0> }",
                "uv", {}, random_picture);
            const int width = 24, height = 18;
            const Frame own = picture(scene, Precision::float64, width, height);
            const Referee<long double> referee(scene, scene.camera, width, height, scene.settings.max_trace_level);
            int wrong = 0;
            for (int i = 0; i < width * height; ++i)
                wrong += !referee.explains(i % width, i / width, &own.rgb[3 * static_cast<std::size_t>(i)], 1e-8, 1e-6);
            CHECK(wrong == 0);
            CHECK(different(own, picture(scene, Precision::float32, width, height), .01) < 40);
        }
}

TEST_CASE("a union that falls apart leaves patterns by uv where they are") {
    std::string mesh = "mesh { ";
    for (const MeshData::Corners& corners : Mesh::tetrahedron()->triangles) {
        mesh += "triangle { ";
        for (const std::int32_t corner : corners) mesh += text_of(Mesh::tetrahedron()->points[corner]) + " ";
        mesh += "uv_vectors <0, 0>, <1, .2>, <.3, 1> }\n";
    }
    const std::string part = mesh + "translate <.5, .2, 0> rotate <0, 0, 20> ",
                      other = mesh + "translate <90, 0, 0> } ";
    const std::string material =
        "material { rgb image { \"p\" map uv }  normal image { \"p\" map uv }  "
        "bump image { \"p\" map uv  height .1 } } ";
    const auto traced = [&](const std::string& body) {
        return picture(
            parse_scene("camera { position <2, -3, 4>  look_at <.7, .5, .3>  sky <0, 0, 1>  fov 12 }\n"
                        "light { position <3, -2, 3>  color <1, 1, 1> }\n" +
                            body,
                        "parts", {}, random_picture));
    };
    CHECK(different(traced(part + material + "}"), traced("union { " + part + "} " + other + material + "}"), 1e-9) <
          12);
}
