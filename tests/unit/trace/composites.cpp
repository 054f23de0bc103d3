// Composites of meshes that rays cross often, and of many meshes; faces of several parts in one place.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "tests/referee/dice.h"
#include "tests/unit/levels.h"
#include "text/parse.h"
#include "trace/tracer.h"

namespace strahl {
namespace {

/// Adds the box around the origin with edges of length 2 * half, moved, to a mesh; triangles face outwards.
void add_box(MeshData& mesh, const DVec3& centre, const DVec3& half) {
    const auto first = static_cast<std::int32_t>(mesh.points.size());
    for (int i = 0; i < 8; ++i)
        mesh.points.push_back(centre + half * DVec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    for (const auto& [a, b, c, d] :
         {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        mesh.triangles.push_back({first + a, first + b, first + c});
        mesh.triangles.push_back({first + a, first + c, first + d});
    }
}

/// A block of tinted glass on a floor, with walls of air in it, which are meshes or boxes.
Scene pierced(const std::vector<Primitive>& holes) {
    std::vector<Primitive> parts{{Cuboid{{-4.3, -1, -1}, {4.3, 1, 1}}, 0, {}}};
    parts.insert(parts.end(), holes.begin(), holes.end());
    Scene scene;
    scene.camera.position = {-9, -3.1, 2.3}, scene.camera.look_at = {0, .1, -.2}, scene.camera.fov = 15;
    scene.lights.push_back({.position = {-30, -7, 11}});
    scene.materials = {{.rgb = {Color{1, .97, .98}}, .reflection = 0, .refraction = .98, .diffuse = .1, .ior = 1.01},
                       {.reflection = 0, .diffuse = .8}};
    scene.primitives = {{Difference{std::make_shared<const std::vector<Primitive>>(parts)}, 0, {}},
                        {Plane{{0, 0, -1.5}, {1, 0, -1.5}, {0, 1, -1.5}}, 1, {}}};
    return scene;
}

}  // namespace

TEST_CASE("rays that start in a prism, but do not reach what it cuts there, do not take it for endless") {
    const Scene scene = parse_scene(R"(
        camera { position <0, 1, -3> look_at <0, 0, 0> up <0, 0, 1> fov 45 }
        background { color <.35, .26, .1> }
        box { <-1.25, 0, -1.5>, <1.95, 2, 2> }
        difference {
          sphere { <-1.4, 2, -2>, 1.43 rotate <270, 0, 90> }
          prism { -2.14, .25  contour { <1, 0> curve <1, 1>, <0, 1> curve <-1, 1>, <-1, 0> curve <-1, -1>, <0, -1>
                                        curve <1, -1>, <1, 0> } }
        })",
                                    "text");
    const View view{.camera = scene.camera, .width = 280, .height = 180, .depth = 2};
    const Frame scalar = render(scene, view, Precision::float64, 1, Simd::scalar);
    for (const Simd simd : fused_levels()) CHECK(render(scene, view, Precision::float64, 1, simd) == scalar);
}

TEST_CASE("a ray that starts in the plane of another part's face, beside it, does not meet that part") {
    // The underside of a mirror on a pillar, seen beside the pillar: the mirrored rays pass that.
    const Cylinder round{{0, 0, -2}, {0, 0, 0}, .5};
    const Cone taper{{0, 0, -2}, .1, {0, 0, 0}, .5};
    const Cuboid square{{-.5, -.5, -2}, {.5, .5, 0}};
    for (const Shape& pillar : {Shape(round), Shape(taper), Shape(square)}) {
        Scene scene;
        scene.camera.position = {.7, -4, -3.5}, scene.camera.look_at = {.7, -.5, 0}, scene.camera.fov = 2;
        scene.background = {0, 0, 1};
        scene.materials = {{.reflection = 1, .diffuse = 0, .ambient = 0, .specular = 0},
                           {.rgb = {Color{1, 0, 0}}, .reflection = 0, .diffuse = 0, .ambient = 1, .specular = 0}};
        scene.primitives = {{Union{std::make_shared<const std::vector<Primitive>>(
                                 std::vector<Primitive>{{Cuboid{{-3, -3, 0}, {3, 3, 1}}, 0, {}}, {pillar, 1, {}}})},
                             0,
                             {}}};
        scene.settings.ambient_light = Color(1);
        for (const Precision precision : {Precision::float32, Precision::float64, Precision::extended}) {
            const Frame seen = render(scene, {.camera = scene.camera, .width = 8, .height = 6}, precision);
            for (std::size_t i = 0; i < seen.rgb.size(); ++i) CHECK(seen.rgb[i] == (i % 3 == 2 ? 1 : 0));
        }
    }
}

TEST_CASE("of faces in one place a part that is not there is never shown") {
    // A cube of which only a piece in its middle is left, and two equal cubes that are declared after it.
    const Cuboid cube{{-1, -1, -1}, {1, 1, 1}}, piece{{.4, -.5, -.5}, {2, .6, .7}};
    const auto share = [](std::vector<Primitive> parts) {
        return std::make_shared<const std::vector<Primitive>>(std::move(parts));
    };
    Scene scene;
    scene.camera.position = {.3, -9, .2}, scene.camera.look_at = {.3, 0, .2}, scene.camera.fov = 5;
    for (const Color& rgb : {Color{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
        scene.materials.push_back({.rgb = {rgb}, .reflection = 0, .diffuse = 0, .ambient = 1, .specular = 0});
    scene.settings.ambient_light = Color(1);
    scene.primitives = {
        {Union{share({{Intersection{share({{cube, 0, {}}, {piece, 0, {}}})}, 0, {}}, {cube, 1, {}}, {cube, 2, {}}})},
         0,
         {}}};
    const Frame seen = render(scene, {.camera = scene.camera, .width = 16, .height = 12});
    for (std::size_t i = 0; i < seen.rgb.size(); ++i) CHECK(seen.rgb[i] == (i % 3 == 1 ? 1 : 0));
}

TEST_CASE("a body pierced by meshes looks like one pierced by boxes, however often a ray crosses them") {
    constexpr int walls = 40;
    std::vector<Primitive> boxes, meshes;
    MeshData all;
    for (int i = 0; i < walls; ++i) {
        const DVec3 centre{.2 * i - 3.9, .02 * (i % 5), .01 * (i % 3)}, half{.05, .83, .79};
        boxes.push_back({Cuboid{centre - half, centre + half}, 0, {}});
        MeshData own;
        add_box(own, centre, half), add_box(all, centre, half);
        meshes.push_back({Mesh{std::make_shared<const MeshData>(own), ""}, 0, {}});
    }
    const Scene expected = pierced(boxes);
    const View view{.camera = expected.camera, .width = 32, .height = 24, .depth = 90};
    const Frame frame = render(expected, view);
    for (const std::vector<Primitive>& holes : {{{Mesh{std::make_shared<const MeshData>(all), ""}, 0, {}}}, meshes}) {
        const Frame pierced_by_meshes = render(pierced(holes), view);
        double most = 0;
        for (std::size_t i = 0; i < frame.rgb.size(); ++i)
            most = std::max(most, std::abs(frame.rgb[i] - pierced_by_meshes.rgb[i]));
        CHECK(most < 1e-9);
    }
}

TEST_CASE("a body cut by prisms over convex polygons looks like one cut by boxes") {
    Dice dice(11);
    std::vector<Primitive> boxes, prisms;
    for (int i = 0; i < 30; ++i) {
        const double x = dice.in(.02, .4), y = dice.in(.02, 1), z = dice.in(.002, 1);
        const std::vector<Transformation> place{Rotate{dice.vector(-180, 180)},
                                                Translate{dice.vector(-1, 1) * DVec3(4, 1, 1)}};
        boxes.push_back({Cuboid{{-x, -y, -z}, {x, y, z}}, 0, place});
        Contour outline{{x, y}, {}};
        for (const Contour::Point& corner : {Contour::Point{-x, y}, {-x, -y}, {x, -y}})
            outline.strokes.push_back({corner, corner, {}});
        const auto figure = std::make_shared<const ContourData>(std::vector<Contour>{outline});
        REQUIRE(figure->is_convex_polygon());
        prisms.push_back({Prism{-z, z, figure}, 0, place});
    }
    const Scene expected = pierced(boxes);
    const View view{.camera = expected.camera, .width = 64, .height = 24, .depth = 30};
    const Frame frame = render(expected, view), cut_by_prisms = render(pierced(prisms), view);
    double most = 0;
    for (std::size_t i = 0; i < frame.rgb.size(); ++i)
        most = std::max(most, std::abs(frame.rgb[i] - cut_by_prisms.rgb[i]));
    CHECK(most < 1e-9);
}

TEST_CASE("prisms whose planes are beyond all numbers share none with other parts") {
    for (const std::string scale : {"1e-155", "1e-271"}) {
        const std::string figure = "contour { <1, 0>  line <0, 1>  line <-1, -1> }";
        const Scene scene = parse_scene(
            "camera { position <0, -10, 4>  look_at <0, 0, 1>  sky <0, 0, 1>  angle 40 }\n"
            "difference { union { prism { 2.3, 1e9  " +
                figure +
                "  rotate <0, 270, 90> }\n"
                "                     prism { -1, 2  " +
                figure + " }  scale " + scale +
                "  scale <-17, 1, -2> }\n"
                "             sphere { <0, 1, .6>, 2 } }\n",
            "tiny");
        const Frame seen = render(scene, {.camera = scene.camera, .width = 8, .height = 6});
        for (const double value : seen.rgb) CHECK(value == 0);
    }
}

TEST_CASE("a clear ball cut in two by a face that nothing shows looks whole") {
    // Rays that leave one half also start on the other half's face, before it or behind it as rounding has it.
    Dice dice(4711);
    const auto number = [&](double low, double high) { return std::to_string(dice.in(low, high)); };
    const auto point = [&](double reach) {
        const DVec3 at = dice.vector(-reach, reach);
        return "<" + std::to_string(at.x) + ", " + std::to_string(at.y) + ", " + std::to_string(at.z) + ">";
    };
    const std::string stage =
        "camera { position <1, -2, -7>  look_at <0, 0, 0>  sky <0, 1, 0>  angle 18 }\n"
        "background { color <.2, .3, .9> }\n"
        "light { position <-40, 50, -30>  color <1, 1, 1>  shadowless }\nglobal_settings { max_trace_level 7 }\n";
    const std::string tint = "material { rgb <1, .6, .3, 0, .4>  reflection 0  diffuse .6  ambient .1  specular 0 }",
                      ball = "sphere { <0, 0, 0>, 1 }";
    const Scene uncut = parse_scene(stage + "sphere { <0, 0, 0>, 1  " + tint + " }", "ball");
    const View view{.camera = uncut.camera, .width = 48, .height = 36, .depth = 7};
    const Frame whole = render(uncut, view);
    for (int i = 0; i < 12; ++i) {
        const std::string radius = number(.3, .8);
        const std::string bodies[]{"cylinder { " + point(.3) + ", " + point(4) + ", " + radius,
                                   "sphere { " + point(.9) + ", " + radius,
                                   "cone { " + point(.5) + ", " + radius + ", " + point(4) + ", 0",
                                   "box { <-.6, -.5, -.4>, <.3, 2, .5>  rotate " + point(180),
                                   "torus { <0, 0, 0>, <0, 0, 1>, .8, .4  rotate " + point(180),
                                   "superellipsoid { .4, .7  scale " + radius};
        const std::string knife = bodies[i % std::size(bodies)] + "  material { rgb <1, 1, 1, 0, 1> } }";
        const Scene cut = parse_scene(
            stage + "difference { " + ball + knife + tint + " }\nintersection { " + ball + knife + tint + " }",
            "halves");
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            const Frame halves = render(cut, view, precision);
            int other = 0;
            for (std::size_t k = 0; k < whole.rgb.size(); ++k) other += std::abs(whole.rgb[k] - halves.rgb[k]) > 1e-3;
            CAPTURE(knife);
            CHECK(other == 0);
        }
    }
}

}  // namespace strahl
