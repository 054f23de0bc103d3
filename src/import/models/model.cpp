#include "import/models/model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "files/words.h"
#include "import/models/formats.h"

namespace strahl {

bool ends_with_word(std::string_view path, std::string_view ending) {
    return path.size() > ending.size() && same_word(path.substr(path.size() - ending.size()), ending);
}

bool is_model(std::string_view path) {
    constexpr std::array<std::string_view, 5> endings{".obj", ".ply", ".stl", ".gltf", ".glb"};
    return std::ranges::any_of(endings, [&](std::string_view ending) { return ends_with_word(path, ending); });
}

Model read_model(const std::string& path, const ReadPixels& read_pixels, double time) {
    const bool gltf = ends_with_word(path, ".gltf") || ends_with_word(path, ".glb");
    return gltf ? read_gltf(path, read_pixels, time) : read_mesh_model(path, read_pixels);
}

Material plain_material(const Color& color) {
    Material material;
    material.rgb = color, material.reflection = 0, material.specular = .1, material.pow = 40;
    material.diffuse = 1, material.ambient = .1;
    return material;
}

void reflect_as_glass(Material& material) {
    material.reflection = 1, material.mirror = Color(1);
    material.fresnel = 1, material.facing = 0, material.conserve = 1;
}

double linear_light(double encoded) {
    return encoded <= .04045 ? encoded / 12.92 : std::pow((encoded + .055) / 1.055, 2.4);
}
Color linear_light(const Color& encoded) {
    const auto light = [](double own) { return std::min(linear_light(own), 1e9); };
    return {light(encoded.x), light(encoded.y), light(encoded.z)};
}

}  // namespace strahl
