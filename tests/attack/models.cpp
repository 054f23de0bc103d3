// Spoilt models and files of materials, and whether what is read of them can be shown.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "files/regular_file.h"
#include "import/models/mtl.h"
#include "import/models/stage.h"
#include "tests/attack/file_attack.h"
#include "tests/attack/mutator.h"
#include "tests/unit/import/gltf_text.h"

using namespace strahl;
using namespace strahl::importing;

namespace {

const std::string materials =
    "newmtl a\nKd .1 .2 .3\nKs .5 .5 .5\nKe 1 0 0\nTf 0 1 0\nNs 96\nd .25\nNi 1.5\nillum 7\nnewmtl b\nTr .25\nmap_Kd "
    "-s 2 "
    "3 1 -o .5 -clamp on w.png\nbump -bm 2 b.png\nnorm n.png\nmap_d d.png\n";

/// Files with all that is read of glTF, each of them as text and as one binary file.
std::vector<std::string> valid_models() {
    const std::string more =
        R"("animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}},
 {"sampler": 1, "target": {"node": 1, "path": "rotation"}}, {"sampler": 2, "target":
 {"node": 2, "path": "weights"}}], "samplers": [{"input": 3, "output": 0}, {"input": 3, "output": 4, "interpolation":
 "STEP"}, {"input": 3, "output": 3}]}], "cameras": [{"type": "perspective", "perspective": {"yfov": 1}},
 {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 2}}], "skins": [{"joints": [1, 2]}],
 "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 10}, {"type": "spot", "spot":
 {"innerConeAngle": 0.2}}]}}, "materials": [{"alphaMode": "MASK", "doubleSided": true, "emissiveFactor": [1, 1, 0],
 "normalTexture": {"index": 0, "scale": 2}, "pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0, 0.5],
 "metallicFactor": 0.2, "roughnessFactor": 0.1, "baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform":
 {"offset": [1, 2], "rotation": 1, "scale": [2, 2]}}}}, "extensions": {"KHR_materials_transmission":
 {"transmissionFactor": 0.5}, "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 1,
 "attenuationColor": [1, 0.5, 0]}, "KHR_materials_ior": {"ior": 1.4}}}], "textures": [{"source": 0, "sampler": 0}],
 "samplers": [{"magFilter": 9728}], "images": [{"uri": "a.png"}], "scene": 0, "scenes": [{"nodes": [0, 3]}])";
    const std::string nodes =
        R"({"mesh": 0, "children": [1, 2], "matrix": [0, 3, 0, 0, -1, 0, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1]}, {"camera": 0,
 "rotation": [0, 0, 0.7, 0.7], "mesh": 0}, {"mesh": 0, "skin": 0, "scale": [2, 2, -2], "weights": [0.5]},
 {"camera": 1, "extensions": {"KHR_lights_punctual": {"light": 1}}})";
    const std::string primitive =
        R"("attributes": {"POSITION": 0, "NORMAL": 0, "TEXCOORD_0": 1, "COLOR_0": 5, "JOINTS_0": 5, "WEIGHTS_0": 5},
 "indices": 2, "material": 0, "mode": 4, "targets": [{"POSITION": 0}])";
    std::string rich = triangle(nodes, more, primitive);
    const auto put = [&](const std::string& old, const std::string& newer) {
        rich.replace(rich.find(old), old.size(), newer);
    };
    put("\"type\": \"SCALAR\"}]", R"("type": "SCALAR"}, {"componentType": 5126, "count": 3, "type": "SCALAR", "sparse":
 {"count": 2, "indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 0}}},
 {"componentType": 5126, "count": 3, "type": "VEC4"}, {"bufferView": 0, "componentType": 5121, "count": 3,
 "type": "VEC4", "normalized": true}])");
    std::string inside = rich;
    const std::string uri = R"(, "uri": ")" + uri_of(data) + "\"";
    inside.erase(inside.find(uri), uri.size());
    return {rich, glb(inside, data), triangle(), materials, rich, glb(inside, data)};
}

class ModelMutator : Mutator {
  public:
    using Mutator::Mutator;
    std::string mutated() {
        file = any();
        for (std::size_t i = 1 + below(4); i > 0 && !file.empty(); --i) {
            const std::size_t at = below(file.size()), length = 1 + below(std::min<std::size_t>(file.size() - at, 30));
            if (const std::size_t digit = file.find_first_of("0123456789", at); below(3) > 0 && digit != file.npos) {
                // Replaces a number by another one.
                const std::size_t end = std::min(file.find_first_not_of("0123456789.", digit), file.size());
                file.replace(digit, end - digit, numbers[below(std::size(numbers))]);
            } else if (below(3) == 0) {
                file.replace(at, below(6), words[below(std::size(words))]);
            } else {
                change_bytes(static_cast<Change>(below(5)), at, length, [&] { return below(file.size()); });
            }
        }
        return file;
    }

  private:
    static constexpr const char* numbers[]{
        "0",   "1",    "2",    "3",    "4",   "5",    "6",    "7",    "-1",   "1e30", "4294967296", "2147483648",
        "0.5", "5120", "5121", "5122", "255", "5123", "5125", "5126", "1e-9", "100",  "1e9",        "3000000"};
    static constexpr const char* words[]{"\"VEC3\"", "\"VEC2\"",  "\"SCALAR\"", "\"MAT4\"", "null", "{}",     "[]",
                                         "true",     "\"nodes\"", "\"STEP\"",   "[[[[[[[[", "\"",   "newmtl", "illum",
                                         "map_Kd",   "-s",        "\n",         "\\u0000",  "%",    "nan"};
};

std::string mutated_model(const std::vector<std::string>& valid, std::uint64_t number) {
    return ModelMutator(valid, number).mutated();
}

FilePixels any_pixels(const std::string&) {
    FilePixels pixels(Pixels{2, 2, false, {1, 1, 1, 1, 0, 1, 0, 1, 0, .5, 0, 0}, Color(1)});
    pixels.opacity = {1, 0, 1, 0};
    return pixels;
}

void promise(bool kept, const char* what) {
    if (!kept) throw std::logic_error(what);
}

void read_materials(const std::string& path) {
    const RegularFile file(path);
    std::vector<std::string> warnings;
    Textures textures(any_pixels, warnings);
    for (const MtlMaterial& own : parse_mtl(file.bytes(0, file.size()), path, warnings)) {
        const Material material = material_of(own, path, "a.mtl", textures);
        for (const double value :
             {material.diffuse, material.reflection, material.refraction, material.ior, material.pow, material.specular,
              material.rgb.color.x, material.glow.x, material.bump.height})
            promise(std::abs(value) <= 1e20, "a value out of range");
    }
}

void read(const std::string& path) {
    if (path.ends_with(".mtl")) return read_materials(path);
    const Model model = read_model(path, any_pixels, .7);
    promise(!model.parts.empty(), "an empty model");
    for (const ModelPart& part : model.parts) {
        const MeshData& mesh = *part.mesh;
        promise(part.material >= 0 && part.material < std::ssize(model.materials), "no such material");
        promise(!mesh.triangles.empty(), "a mesh without triangles");
        promise(mesh.corner_normals.empty() || mesh.corner_normals.size() == mesh.triangles.size(), "too few normals");
        promise(mesh.corner_places.empty() || mesh.corner_places.size() == mesh.triangles.size(), "too few places");
        const MeshData::Corners* const places = mesh.place_numbers();
        const auto within = [](const MeshData::Corners& corners, std::size_t all) {
            return std::ranges::all_of(corners, [&](std::int32_t k) { return k >= 0 && std::size_t(k) < all; });
        };
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            promise(within(mesh.triangles[i], mesh.points.size()), "no such point");
            promise(mesh.corner_normals.empty() || within(mesh.corner_normals[i], mesh.normals.size()),
                    "no such normal");
            promise(!places || within(places[i], mesh.places.size()), "no such place");
        }
        for (const DVec3& p : mesh.points)
            promise(std::abs(p.x) <= 1e9 && std::abs(p.y) <= 1e9 && std::abs(p.z) <= 1e9, "a point out of range");
    }
    const Scene scene = staged(model, 1);
    promise(!degenerate(scene.camera), "a degenerate camera");
    promise(std::isfinite(scene.camera.position.x + scene.camera.look_at.y + scene.camera.fov), "no camera");
    for (const Light& light : scene.lights)
        promise(std::isfinite(light.color.x + light.position.x) && light.color.x >= 0 && light.color.x <= 1e30,
                "no light");
}

}  // namespace

int main(int count, char** arguments) {
    return run_attack({"model", {".gltf", ".mtl"}, valid_models, mutated_model, read}, count, arguments);
}
