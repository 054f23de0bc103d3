// A scene as Tachyon 0.99 reads it: bench_tachyon SCENE WIDTH HEIGHT > FILE.dat
//
// Term by term the same as far as Tachyon goes. It has no refraction (rays go straight through glass), shadows of glass
// are grey, a glass body also reflects within, and past the last generation it sees the background instead of nothing.
// Coordinates are read as floats. Tachyon must be called with -shade_phong; it prefers J. Blinn's highlights otherwise.
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "files/read_file.h"
#include "tests/bench/flat.h"
#include "text/parse.h"

namespace {

using namespace strahl;

void put(const char* words, const DVec3& v, const char* after = "\n") {
    std::printf("%s %.9g %.9g %.9g%s", words, v.x, v.y, v.z, after);
}

/// Tachyon counts pixels from 1: number i of n looks through left + i / n * (right - left), half past the middle.
/// Tachyon's right is the left of a right-handed world: the picture plane is turned over instead.
void put_camera(const Camera& camera, int width, int height, int depth) {
    const CameraFrame frame = frame_of(camera, static_cast<double>(width) / height);
    const double right = 2 * frame.tan_x / width, up = 2 * frame.tan_y / height;
    std::printf("CAMERA\nPROJECTION PERSPECTIVE\nZOOM 1\nASPECTRATIO 1\nANTIALIASING 0\nRAYDEPTH %d\n", depth);
    put("CENTER", camera.position);
    put("VIEWDIR", frame.forward);
    put("UPDIR", -frame.down);
    std::printf("FRUSTUM %.9g %.9g %.9g %.9g\nEND_CAMERA\n", frame.tan_x + right / 2, -frame.tan_x + right / 2,
                -frame.tan_y - up / 2, frame.tan_y - up / 2);
}

void put_material(int number, const Material& m, const DVec3& ambient_light) {
    std::printf("TEXDEF m%d AMBIENT %.9g DIFFUSE %.9g SPECULAR %.9g OPACITY %.9g PHONG PLASTIC %.9g PHONG_SIZE %.9g",
                number, m.ambient * ambient_light.x, m.diffuse, m.reflection, 1 - m.refraction, m.specular, m.pow);
    put(" COLOR", m.rgb.color, " TEXFUNC 0\n");
}

/// Tachyon's cylinders are tubes: the ends are discs of their own.
void put_cylinder(const bench::Body<Cylinder>& body) {
    const Cylinder& c = body.shape;
    put("FCYLINDER BASE", c.base, "");
    put(" APEX", c.cap, "");
    std::printf(" RAD %.9g m%d\n", c.radius, body.material);
    for (const bool cap : {false, true}) {
        put("RING CENTER", cap ? c.cap : c.base, "");
        put(" NORMAL", cap ? c.axis() : -c.axis(), "");
        std::printf(" INNER 0 OUTER %.9g m%d\n", c.radius, body.material);
    }
}

void put_scene(const Scene& scene, int width, int height) {
    const bench::FlatScene flat = bench::flatten(scene);
    std::printf("BEGIN_SCENE\nRESOLUTION %d %d\n", width, height);
    put_camera(scene.camera, width, height, scene.settings.max_trace_level);
    put("BACKGROUND", scene.background.color);
    for (const Light& light : scene.lights) {
        put("LIGHT CENTER", light.position, "");
        put(" RAD 1e-9 COLOR", light.color);
    }
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        put_material(static_cast<int>(i), scene.materials[i], scene.settings.ambient_light);
    for (const auto& body : flat.planes) {
        put("PLANE CENTER", body.shape.a, "");
        put(" NORMAL", body.shape.normal(), "");
        std::printf(" m%d\n", body.material);
    }
    for (const auto& body : flat.spheres) {
        put("SPHERE CENTER", body.shape.centre, "");
        std::printf(" RAD %.9g m%d\n", body.shape.radius, body.material);
    }
    for (const auto& body : flat.cylinders) put_cylinder(body);
    for (const auto& body : flat.meshes)
        for (const auto& [a, b, c] : body.shape.triangles) {
            put("TRI V0", body.shape.points[a], "");
            put(" V1", body.shape.points[b], "");
            put(" V2", body.shape.points[c], "");
            std::printf(" m%d\n", body.material);
        }
    std::puts("END_SCENE");
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 4) throw std::invalid_argument("bench_tachyon SCENE WIDTH HEIGHT > FILE.dat");
    put_scene(parse_scene(read_text(argv[1]), argv[1]), std::atoi(argv[2]), std::atoi(argv[3]));
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
