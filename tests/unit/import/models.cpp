// Models of triangles: their parts, their colours, and the stage on which they are shown.
#include "tests/unit/import/models.h"

#include <cmath>

#include "num/vec_math.h"
#include "scene/leaves.h"

using namespace strahl;
using namespace strahl::importing;

namespace {

const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// The colour of a pattern by uv at a corner of a triangle: that of the pixel in whose middle the corner is.
Color color_at(const ModelPart& part, const Material& material, std::size_t triangle, std::size_t corner) {
    const auto& image = std::get<ImagePattern>(material.rgb.pattern->kind);
    const auto [u, v] = part.mesh->places[std::size_t(part.mesh->place_numbers()[triangle][corner])];
    const double x = u * image.pixels->width - .5, y = (1 - v) * image.pixels->height - .5;
    CHECK(std::abs(x - std::round(x)) < 1e-9);
    const auto first = 3 * (std::size_t(std::round(y)) * std::size_t(image.pixels->width) + std::size_t(std::round(x)));
    const auto& values = image.pixels->values;
    CHECK(image.pixels->linear);
    const Color color(values[first], values[first + 1], values[first + 2]);
    // As encoded in the file, up to rounding.
    const auto encoded = [](double v) { return v <= .0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - .055; };
    return {encoded(color.x), encoded(color.y), encoded(color.z)};
}
/// Are these colours the same, up to rounding in float?
bool same(const Color& a, const Color& b) { return length(a - b) < 1e-6; }

}  // namespace

TEST_CASE("models: files are known by their endings") {
    for (const char* name : {"a.obj", "b/a.PLY", "a.stl", "a.gltf", "a.GLB"}) CHECK(is_model(name));
    for (const char* name : {"a.rt", "obj", ".obj", "a.obj.rt", "-", ""}) CHECK(!is_model(name));
}

TEST_CASE("models: all of a model is seen, and it stands on the floor") {
    Models models;
    models.put("a.obj", tetrahedron).put("long.obj", "v 0 0 0\nv 900 0 0\nv 900 1 0\nf 1 2 3\n");
    for (const char* name : {"a.obj", "long.obj"})
        for (const double aspect : {.5, 1., 4. / 3, 3.}) {
            CAPTURE(name);
            CAPTURE(aspect);
            const Model model = models.read(name);
            const Scene scene = staged(model, aspect);
            double widest = 0;
            std::vector<Camera> cameras{scene.camera};
            for (const Keyframe& key : scene.flythrough->keys) cameras.push_back(camera_of(key, scene.camera));
            for (const Camera& camera : cameras) {
                const CameraFrame frame = frame_of(camera, aspect);
                double most = 0;
                for (const DVec3& point : model.parts[0].mesh->points) {
                    const DVec3 way = point - camera.position;
                    const double far = dot_product(way, frame.forward);
                    REQUIRE(far > 0);
                    most = std::max({most, std::abs(dot_product(way, frame.right)) / far / frame.tan_x,
                                     std::abs(dot_product(way, frame.down)) / far / frame.tan_y});
                }
                CHECK(most < .85);
                widest = std::max(widest, most);
            }
            CHECK(widest > .7);
            REQUIRE(scene.primitives.size() == 2);
            const auto& floor = std::get<Plane>(scene.primitives[1].shape);
            CHECK(floor.a.y < 0);
            CHECK(floor.a.y > -1);
        }
}

TEST_CASE("models: the floor in the light is as bright as the background") {
    const Scene scene = staged(Models().put("a.obj", tetrahedron).read("a.obj"), 1);
    const auto& floor = std::get<Plane>(scene.primitives.back().shape);
    const Material& material = scene.materials[std::size_t(scene.primitives.back().material)];
    const DVec3 up = normalize(cross_product(floor.b - floor.a, floor.c - floor.a));
    CHECK(up.y == doctest::Approx(1));
    double light = material.ambient;
    for (const Light& own : scene.lights)
        light += material.diffuse * own.color.x * dot_product(up, -normalize(*own.direction));
    CHECK(light == doctest::Approx(scene.background.color.x));
}

TEST_CASE("models: the bodies of STL files stand on z, all others on y") {
    Models models;
    models.put("a.stl",
               "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
               "endfacet\nendsolid\n");
    CHECK(models.read("a.stl").up == DVec3(0, 0, 1));
    CHECK(models.put("a.obj", tetrahedron).read("a.obj").up == DVec3(0, 1, 0));
}

TEST_CASE("models: a mesh of one material keeps the name of its file in scenes") {
    Models models;
    models.put("a.obj", tetrahedron).put("two.obj", tetrahedron + "g other\nf 2 1 3\n");
    CHECK(std::get<Mesh>(staged(models.read("a.obj"), 1).primitives[0].shape).file == "a.obj");
    const Scene two = staged(models.read("two.obj"), 1);
    REQUIRE(two.primitives.size() == 3);
    CHECK(std::get<Mesh>(two.primitives[0].shape).file.empty());
}

TEST_CASE("models: colours of points are at the corners of triangles") {
    const Model model =
        Models()
            .put("a.ply",
                 "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
                 "float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face "
                 "2\nproperty list uchar int vertex_indices\nend_header\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 "
                 "1 0 0 0 255\n1 1 0 51 102 0\n3 0 1 2\n3 2 1 3\n")
            .read("a.ply");
    CHECK(model.warnings.empty());
    const ModelPart& part = model.parts.at(0);
    const Material& material = model.materials.at(0);
    CHECK(same(color_at(part, material, 0, 0), Color(1, 0, 0)));
    CHECK(same(color_at(part, material, 0, 1), Color(0, 1, 0)));
    CHECK(same(color_at(part, material, 0, 2), Color(0, 0, 1)));
    CHECK(same(color_at(part, material, 1, 0), Color(0, 0, 1)));
    CHECK(length(color_at(part, material, 1, 2) - Color(.2, .4, 0)) < 1e-6);
    // Between the corners bilinear pixels give what is linear: the fourth one of a cell goes on beyond the triangle.
    const auto& pixels = *std::get<ImagePattern>(material.rgb.pattern->kind).pixels;
    const auto [u, v] = part.mesh->places[std::size_t(part.mesh->place_numbers()[0][0])];
    const auto column = std::size_t(u * pixels.width), row = std::size_t((1 - v) * pixels.height);
    const std::size_t fourth = 3 * ((row + 1) * std::size_t(pixels.width) + column + 1);
    CHECK(Color(pixels.values[fourth], pixels.values[fourth + 1], pixels.values[fourth + 2]) == Color(-1, 1, 1));
}

TEST_CASE("models: colours of faces, and of the points of an OBJ file") {
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face "
        "2\n"
        "property list uchar int vertex_indices\nproperty float red\nproperty float green\nproperty float blue\n"
        "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
    Models models;
    const Model faces = models.put("a.ply", head + "3 0 1 2 .5 0 0\n4 0 1 3 2 0 .25 2\n").read("a.ply");
    CHECK(same(color_at(faces.parts[0], faces.materials[0], 0, 1), Color(.5, 0, 0)));
    for (const std::size_t triangle : {1, 2})
        CHECK(same(color_at(faces.parts[0], faces.materials[0], triangle, 2), Color(0, .25, 1)));
    const Model points =
        models.put("a.obj", "v 0 0 0 .5 0 0\nv 1 0 0 0 .25 0\nv 0 1 0 1 0 0 1\nf 1 2 3\n").read("a.obj");
    CHECK(same(color_at(points.parts[0], points.materials[0], 0, 0), Color(.5, 0, 0)));
    CHECK(same(color_at(points.parts[0], points.materials[0], 0, 1), Color(0, .25, 0)));
    CHECK(same(color_at(points.parts[0], points.materials[0], 0, 2), Color(0, 0, 1)));
    // Colours at some points only are none.
    const Model some = models.put("some.obj", "v 0 0 0 .5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").read("some.obj");
    CHECK(!some.materials[0].rgb.pattern);
}

TEST_CASE("models: the colours of STL files") {
    std::string bytes = "COLOR=";
    bytes += "\x80\x40\x20\xFF";
    bytes.resize(80, ' ');
    bytes += std::string("\2\0\0\0", 4);
    const std::uint16_t own[]{31 << 10, 0x8000};  // blue; that of the body
    for (const std::uint16_t color : own) {
        for (const float value : {0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, float(color != 0x8000)})
            bytes.append(reinterpret_cast<const char*>(&value), 4);
        bytes.append(reinterpret_cast<const char*>(&color), 2);
    }
    const Model model = Models().put("a.stl", bytes).read("a.stl");
    CHECK(same(color_at(model.parts[0], model.materials[0], 0, 0), Color(0, 0, 1)));
    CHECK(length(color_at(model.parts[0], model.materials[0], 1, 0) - Color(128, 64, 32) / 255.) < 1e-6);
}
