// Reads glTF 2.0 ("glTF 2.0 Specification", The Khronos Group, 2021): the nodes of a scene with their meshes, cameras
// and lights.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "files/error.h"
#include "files/words.h"
#include "import/models/formats.h"
#include "import/models/gltf_meshes.h"
#include "import/models/gltf_motion.h"
#include "num/bounding_box.h"
#include "num/vec_math.h"
#include "scene/kinds/mesh.h"

namespace strahl {
namespace {

constexpr std::size_t most_depth = 100;        // of nodes in nodes
constexpr std::size_t most_parts = 1'000'000;  // bodies, of instances each time
constexpr std::array<std::string_view, 20> known_extensions{"KHR_mesh_quantization",
                                                            "KHR_texture_transform",
                                                            "KHR_lights_punctual",
                                                            "KHR_materials_ior",
                                                            "KHR_materials_transmission",
                                                            "KHR_materials_volume",
                                                            "KHR_materials_unlit",
                                                            "KHR_materials_emissive_strength",
                                                            "KHR_materials_clearcoat",
                                                            "KHR_materials_sheen",
                                                            "KHR_materials_specular",
                                                            "KHR_materials_variants",
                                                            "KHR_materials_iridescence",
                                                            "KHR_materials_anisotropy",
                                                            "KHR_materials_dispersion",
                                                            "KHR_materials_diffuse_transmission",
                                                            "KHR_node_visibility",
                                                            "KHR_animation_pointer",
                                                            "KHR_xmp_json_ld",
                                                            "EXT_mesh_features"};

void check_extensions(const GltfFile& file) {
    const GltfValue required = file.root()["extensionsRequired"];
    for (std::size_t i = 0; i < required.size(); ++i) {
        const std::string name = required.at(i).text();
        const auto refuse = [&](const std::string& what) { required.at(i).fail(what + "; save it without"); };
        if (name == "KHR_draco_mesh_compression") refuse("Draco compression is not read");
        if (name.ends_with("_meshopt_compression")) refuse("meshopt compression is not read");
        if (name == "KHR_texture_basisu") refuse("pictures in Basis Universal are not read");
        if (std::ranges::find(known_extensions, name) == known_extensions.end())
            refuse("the extension " + strahl::quoted(name) + " is not read");
    }
}

class GltfReader {
  public:
    GltfReader(const std::string& path, const ReadPixels& read_pixels, double time)
        : time(time), file(path), meshes(file, read_pixels, model), motions(file, model.warnings) {}

    Model read();

  private:
    struct GltfNode {
        GltfPlace place;
        std::vector<MotionKey> keys;
        glm::dmat4 matrix{1};  // to the scene, as it rests
        /// Takes it to the scene at the beginning of the animation, and at the time that is read.
        std::array<glm::dmat4, 2> posed{glm::dmat4(1), glm::dmat4(1)};
        bool visited = false;
    };
    void find_places();
    void find_matrix(std::size_t node, const GltfNode& outer, std::size_t depth);
    void visit(std::size_t node, std::vector<Transformation> outer, std::size_t depth);
    void add_mesh(std::size_t number, const std::vector<Transformation>& steps);
    std::vector<GltfPart> bent_parts(std::size_t node, bool now);
    void add_camera(const GltfValue& own, const glm::dmat4& matrix);
    void add_light(const GltfValue& own, const glm::dmat4& matrix);
    std::vector<glm::dmat4> joints_of(const GltfValue& skin, bool now);
    std::vector<std::size_t> roots() const;
    void scale_lights();

    const double time;
    GltfFile file;
    Model model;
    GltfMeshes meshes;
    const GltfMotions motions;
    std::vector<GltfNode> nodes;
    std::map<std::int64_t, std::vector<GltfPart>> known;  // meshes without skin and weights of their own
    std::uint64_t triangles = 0;
};

std::vector<std::size_t> GltfReader::roots() const {
    const GltfValue root = file.root();
    std::vector<std::size_t> list;
    if (root["scenes"].size() > 0) {
        const GltfValue number = root["scene"];
        const GltfValue scene = number ? file.entry("scenes", number) : root["scenes"].at(0);
        for (std::size_t i = 0; i < scene["nodes"].size(); ++i)
            list.push_back(std::size_t(scene["nodes"].at(i).index(nodes.size())));
        return list;
    }
    std::set<std::size_t> inner;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const GltfValue children = file.entry("nodes", n)["children"];
        for (std::size_t i = 0; i < children.size(); ++i) inner.insert(std::size_t(children.at(i).index(nodes.size())));
    }
    for (std::size_t n = 0; n < nodes.size(); ++n)
        if (!inner.contains(n)) list.push_back(n);
    return list;
}

/// Finds where all nodes are: those of skins may come later than what they bend.
void GltfReader::find_matrix(std::size_t number, const GltfNode& outer, std::size_t depth) {
    GltfNode& node = nodes[number];
    const GltfValue own = file.entry("nodes", number), children = own["children"];
    if (node.visited) own.fail("is in two places of the tree of nodes, or in itself");
    if (depth > most_depth) own.fail("is in more than " + std::to_string(most_depth) + " other nodes");
    node.visited = true;
    node.matrix = outer.matrix * node.place.matrix();
    for (const bool now : {false, true})
        node.posed[now] = outer.posed[now] * motions.place(number, node.place, now ? time : 0).matrix();
    for (std::size_t i = 0; i < children.size(); ++i)
        find_matrix(std::size_t(children.at(i).index(nodes.size())), node, depth + 1);
}

void GltfReader::find_places() {
    nodes.resize(file.root()["nodes"].size());
    bool sheared = false;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        nodes[i].place = place_of(file.entry("nodes", i), sheared);
        nodes[i].keys = motions.keys(i, nodes[i].place);
        if (!nodes[i].keys.empty() || motions.weights(i, 0)) model.seconds = motions.seconds;
    }
    if (sheared) model.warnings.push_back(file.path + ": the shear of nodes is left out");
    for (const std::size_t root : roots()) find_matrix(root, GltfNode(), 0);
}

std::vector<glm::dmat4> GltfReader::joints_of(const GltfValue& skin, bool now) {
    std::vector<glm::dmat4> joints;
    const GltfValue list = skin["joints"], inverse = skin["inverseBindMatrices"];
    GltfNumbers numbers;
    if (inverse) numbers = file.numbers(inverse, 16);
    for (std::size_t i = 0; i < list.size(); ++i) {
        glm::dmat4 bound(1);
        for (int k = 0; k < 16 && i < numbers.count; ++k) bound[k / 4][k % 4] = numbers(i, std::size_t(k));
        joints.push_back(nodes[std::size_t(list.at(i).index(nodes.size()))].posed[now] * bound);
    }
    return joints;
}

/// Reads the mesh of a node as its skin and its morph targets bend it, at the time that is read or at the beginning.
std::vector<GltfPart> GltfReader::bent_parts(std::size_t number, bool now) {
    const GltfValue node = file.entry("nodes", number), mesh = file.entry("meshes", node["mesh"]);
    const GltfValue given = node["weights"] ? node["weights"] : mesh["weights"];
    std::vector<double> weights;
    for (std::size_t i = 0; i < given.size(); ++i) weights.push_back(given.at(i).number(0));
    return meshes.read(mesh, motions.weights(number, now ? time : 0).value_or(weights),
                       node["skin"] ? joints_of(file.entry("skins", node["skin"]), now) : std::vector<glm::dmat4>());
}

void GltfReader::add_mesh(std::size_t number, const std::vector<Transformation>& steps) {
    const GltfValue node = file.entry("nodes", number), mesh = file.entry("meshes", node["mesh"]);
    const bool skinned = bool(node["skin"]), bends = motions.weights(number, 0) || (skinned && motions.seconds > 0);
    std::vector<GltfPart> parts, first;
    if (skinned || bends || node["weights"]) {
        parts = bent_parts(number, true);
        if (bends && time > 0) first = bent_parts(number, false);
    } else {
        const auto [place, is_new] = known.try_emplace(node["mesh"].index(file.root()["meshes"].size()));
        if (is_new) place->second = bent_parts(number, true);
        parts = place->second;
    }
    model.changes |= bends;
    const std::string name = node["name"].text(mesh["name"].text());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const GltfPart& part = parts[i];
        triangles += part.mesh->triangles.size();
        if (triangles > MeshLimits{}.most_triangles || model.parts.size() == most_parts)
            node.fail("with it the model has more than " + std::to_string(MeshLimits{}.most_triangles) +
                      " triangles or a million bodies; simplify it");
        // The joints of a skin place it, not the steps of its node.
        model.parts.push_back({name, part.mesh, part.material, skinned ? std::vector<Transformation>() : steps,
                               first.size() == parts.size() ? first[i].mesh : nullptr});
    }
}

void GltfReader::add_camera(const GltfValue& own, const glm::dmat4& matrix) {
    if (model.camera) return;
    Camera camera;
    const DVec3 forward = normalize(-DVec3(matrix[2]));
    double distance = 1;
    if (own["type"].text() == "orthographic") {
        camera.projection = Projection::orthographic;
        distance = std::clamp(std::abs(own["orthographic"]["xmag"].number(1)), 1e-6, 1e6);
        camera.fov = 45;
    } else {
        const GltfValue lens = own["perspective"];
        const double high = std::clamp(lens["yfov"].number(.8), .01, 3.), aspect = lens["aspectRatio"].number(4. / 3);
        camera.fov =
            std::clamp(std::atan(std::tan(high / 2) * std::clamp(aspect, .01, 100.)) * 180 / std::numbers::pi, .1, 85.);
    }
    camera.position = DVec3(matrix[3]);
    distance = std::max(distance, 1e-3 * length(camera.position));
    if (camera.projection == Projection::orthographic)
        camera.fov =
            std::atan(std::clamp(own["orthographic"]["xmag"].number(1), 1e-6, 1e6) / distance) * 180 / std::numbers::pi;
    camera.look_at = camera.position + distance * forward;
    camera.up = -normalize(DVec3(matrix[1]));
    const double far =
        std::max({std::abs(camera.position.x), std::abs(camera.position.y), std::abs(camera.position.z)});
    if (degenerate(camera) || !(far < 1e8)) return own.fail("is in no place from which it could see");
    model.camera = camera;
}

void GltfReader::add_light(const GltfValue& own, const glm::dmat4& matrix) {
    const std::string type = own["type"].text();
    const double strength = std::clamp(own["intensity"].number(1), 0., 1e9) / std::numbers::pi;
    Color color = own["color"].numbers<3>(Color(1));
    for (int c = 0; c < 3; ++c) color[c] = std::clamp(color[c], 0., 1.) * strength;
    const DVec3 forward = normalize(-DVec3(matrix[2]));
    Light light{.position = DVec3(matrix[3]), .color = color};
    if (!std::isfinite(forward.x + forward.y + forward.z)) return;
    if (type == "directional") {
        light.direction = forward;
    } else {
        // 2 / (1 + (d / f)^2) is nearly 2 f^2 / d^2 where d is far beyond f; the colour is divided by the 2 f^2 later.
        light.fade_distance = 1, light.fade_power = 2;
        if (type == "spot") {
            const double degrees = 180 / std::numbers::pi;
            const double outer =
                std::clamp(own["spot"]["outerConeAngle"].number(std::numbers::pi / 4) * degrees, .1, 90.);
            light.spot = Spot{.look_at = light.position + std::max(1., 1e-3 * length(light.position)) * forward,
                              .radius = std::clamp(own["spot"]["innerConeAngle"].number(0) * degrees, 0., outer),
                              .falloff = outer};
        }
    }
    model.lights.push_back(light);
}

/// Sets the strengths of lights, which are in units of light, so that the strongest gives the middle of the model a
/// light of 1.
void GltfReader::scale_lights() {
    if (model.lights.empty()) return;
    Box box;
    for (const ModelPart& part : model.parts) box.add(Mesh{part.at_first(), ""}.bounds(matrix(part.transformations)));
    const double near = std::max(1e-3 * length(box.size()), 1e-6);
    double most = 0;
    for (Light& light : model.lights) {
        const double distance = std::max(length(light.position - box.centre()), 10 * near);
        if (light.fades()) light.fade_distance = near, light.color /= 2 * near * near;
        const double factor = light.fades() ? 2 / (1 + distance * distance / (near * near)) : 1;
        most = std::max(most, factor * std::max({light.color.x, light.color.y, light.color.z}));
    }
    for (Light& light : model.lights)
        if (most > 0) light.color /= most;
}

void GltfReader::visit(std::size_t number, std::vector<Transformation> outer, std::size_t depth) {
    const GltfValue own = file.entry("nodes", number), children = own["children"];
    const GltfNode& node = nodes[number];
    std::vector<Transformation> steps =
        node.keys.empty() ? node.place.steps() : std::vector<Transformation>{Motion{node.keys}};
    steps.insert(steps.end(), outer.begin(), outer.end());
    if (own["mesh"]) add_mesh(number, steps);
    if (own["camera"]) add_camera(file.entry("cameras", own["camera"]), node.matrix);
    if (const GltfValue light = own["extensions"]["KHR_lights_punctual"]["light"]) {
        const GltfValue lights = file.root()["extensions"]["KHR_lights_punctual"]["lights"];
        add_light(lights.at(std::size_t(light.index(lights.size()))), node.matrix);
    }
    for (std::size_t i = 0; i < children.size(); ++i)
        visit(std::size_t(children.at(i).index(nodes.size())), steps, depth + 1);
}

Model GltfReader::read() {
    check_extensions(file);
    find_places();
    for (const std::size_t root : roots()) visit(root, {}, 0);
    if (model.parts.empty()) throw FileError(file.path + ": there are no triangles in this model");
    scale_lights();
    meshes.finish();
    return std::move(model);
}

}  // namespace

Model read_gltf(const std::string& path, const ReadPixels& read_pixels, double time) {
    return GltfReader(path, read_pixels, time).read();
}

}  // namespace strahl
