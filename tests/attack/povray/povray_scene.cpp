#include "tests/attack/povray/povray_scene.h"

#include <cmath>
#include <memory>
#include <variant>

#include "tests/referee/dice.h"
#include "tests/referee/random_scene.h"

namespace strahl {
namespace {

/// Gives a mesh normals at its points.
void make_smooth(Mesh& mesh, Dice& dice) {
    MeshData data = *mesh.data;
    data.normals.clear();
    for (const DVec3& point : data.points) data.normals.push_back(point + dice.arrow(.1, .4));
    data.corner_normals = data.triangles;
    mesh.data = std::make_shared<const MeshData>(std::move(data));
}

/// Rounds a picture to values that its file for POV-Ray can hold: sixteenths of a floating-point picture, which POV-Ray
/// reads rounded to 11 bits, and steps of 16 bits.
template <class Owner>
void make_exact(Owner& owner) {
    const ImagePattern* const image = owner.pattern ? std::get_if<ImagePattern>(&owner.pattern->kind) : nullptr;
    if (!image) return;
    Pixels pixels = *image->pixels;
    const double steps = pixels.linear ? 16 : 65535;
    for (float& value : pixels.values) value = static_cast<float>(std::round(value * steps) / steps);
    ImagePattern exact = *image;
    exact.pixels = std::make_shared<const Pixels>(std::move(pixels));
    Pattern pattern = *owner.pattern;
    pattern.kind = std::move(exact);
    owner.pattern = std::make_shared<const Pattern>(std::move(pattern));
}

/// Multiplies all lengths and positions by `factor`, then moves everything.
void place(Scene& scene, double factor, const DVec3& by) {
    const auto placed = [&](const DVec3& p) { return p * factor + by; };
    for (Primitive& primitive : scene.primitives) {
        if (factor != 1) primitive.transformations.push_back(Scale{DVec3(factor)});
        if (by != DVec3(0)) primitive.transformations.push_back(Translate{by});
    }
    scene.camera.position = placed(scene.camera.position), scene.camera.look_at = placed(scene.camera.look_at);
    for (Light& light : scene.lights) {
        light.position = placed(light.position);
        if (light.spot) light.spot->look_at = placed(light.spot->look_at);
        if (light.area) light.area->u = light.area->u * factor, light.area->v = light.area->v * factor;
    }
    if (scene.fog) scene.fog->distance *= factor, scene.fog->altitude *= factor;
    if (scene.fog) scene.fog->offset = factor * scene.fog->offset + dot_product(normalize(scene.fog->up), by);
}

}  // namespace

Scene scene_for_povray(std::uint64_t seed) {
    Dice dice(seed);
    RandomScene what;
    what.transparent = dice.chance(.7), what.transformed = dice.chance(.8), what.lights = dice.chance(.5);
    what.patterns = dice.chance(.3), what.bumps = !what.transparent && dice.chance(.3);
    what.camera_inside = what.transparent && dice.chance(.3);
    what.any_kind = dice.chance(.5) ? .9 : .3, what.levels = 1 + dice.upto(2);
    Scene scene = random_scene(seed, what);
    for (Primitive& primitive : scene.primitives)
        if (Mesh* const mesh = std::get_if<Mesh>(&primitive.shape); mesh && dice.chance(.5)) make_smooth(*mesh, dice);
    make_exact(scene.background);
    for (Material& material : scene.materials) make_exact(material.rgb), make_exact(material.bump);
    if (dice.chance(.1)) {
        const double away = -std::pow(10., dice.in(3, 7));
        const Material floor{.rgb = dice.vector(0, 1), .reflection = 0, .diffuse = 1, .ambient = .2, .specular = 0};
        scene.primitives.push_back(
            {Plane{{0, 0, away}, {1, 0, away}, {0, 1, away}}, static_cast<int>(scene.materials.size()), {}});
        scene.materials.push_back(floor);
    }
    const double factor = dice.chance(.2) ? std::pow(10., dice.in(-6, 6)) : 1;
    const DVec3 by = dice.chance(.3) ? dice.direction() * factor * std::pow(10., dice.in(1, 5)) : DVec3(0);
    place(scene, factor, by);
    return scene;
}

}  // namespace strahl
