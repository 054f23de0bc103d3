#include "import/models/gltf_meshes.h"

#include <algorithm>

#include "files/error.h"
#include "import/models/corner_colors.h"
#include "mesh/faces.h"

namespace strahl {

int GltfMeshes::material_number(const GltfValue& index, GltfMaterial& own) {
    const std::int64_t number = index.index(file.root()["materials"].size());
    const auto [place, is_new] = known.try_emplace(number);
    if (is_new) {
        place->second.first = static_cast<int>(model.materials.size());
        if (number < 0)
            place->second.second.material = plain_material();
        else
            place->second.second = materials.read(file.entry("materials", index));
        model.materials.push_back(place->second.second.material);
    }
    own = place->second.second;
    return place->second.first;
}

/// Adds morph targets to positions or normals.
void GltfMeshes::morph(const GltfValue& own, const std::vector<double>& weights, const char* attribute,
                       std::vector<DVec3>& values) {
    const GltfValue targets = own["targets"];
    for (std::size_t i = 0; i < std::min(targets.size(), weights.size()); ++i) {
        if (weights[i] == 0 || !targets.at(i)[attribute]) continue;
        const GltfNumbers moved = file.numbers(targets.at(i)[attribute], 3);
        if (moved.count != values.size()) targets.at(i).fail("has another number of points than the mesh");
        for (std::size_t k = 0; k < values.size(); ++k) values[k] += weights[i] * moved.vector(k);
    }
}

/// Moves points and normals with the joints of a skin.
void GltfMeshes::bend(const GltfValue& attributes, const std::vector<glm::dmat4>& joints, MeshData& mesh) {
    if (joints.empty() || !attributes["JOINTS_0"]) return;
    const GltfNumbers numbers = file.numbers(attributes["JOINTS_0"], 4),
                      shares = file.numbers(attributes["WEIGHTS_0"], 4);
    if (numbers.count != mesh.points.size() || shares.count != mesh.points.size())
        attributes["JOINTS_0"].fail("has another number of points than the mesh");
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        glm::dmat4 sum(0);
        double whole = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const double joint = numbers(i, k), share = shares(i, k);
            if (share == 0) continue;
            if (!(joint >= 0 && joint < double(joints.size())))
                attributes["JOINTS_0"].fail("names a joint that is not there");
            sum += share * joints[std::size_t(joint)], whole += share;
        }
        if (!(whole > 0)) continue;
        sum /= whole;
        mesh.points[i] = DVec3(sum * glm::dvec4(mesh.points[i], 1));
        if (!mesh.normals.empty()) mesh.normals[i] = glm::dmat3(sum) * mesh.normals[i];
    }
}

std::optional<GltfPart> GltfMeshes::read_primitive(const GltfValue& own, const std::vector<double>& weights,
                                                   const std::vector<glm::dmat4>& joints) {
    const GltfValue attributes = own["attributes"];
    if (own["extensions"]["KHR_draco_mesh_compression"] && !attributes["POSITION"])
        own.fail("Draco compression is not read; save it without");
    const std::uint64_t mode = own["mode"].count(4, 6);
    if (mode < 4) {
        source.lose({"left out ", "primitive", " of points or lines"}, [&] { return own.place(); });
        return {};
    }
    if (!attributes["POSITION"]) return {};
    MeshData mesh;
    const auto vectors = [&](const char* name) {
        const GltfNumbers numbers = file.numbers(attributes[name], 3);
        std::vector<DVec3> list(numbers.count);
        for (std::size_t i = 0; i < list.size(); ++i) list[i] = numbers.vector(i);
        return list;
    };
    mesh.points = vectors("POSITION");
    source.check_points(mesh.points.size());
    morph(own, weights, "POSITION", mesh.points);
    if (attributes["NORMAL"]) {
        mesh.normals = vectors("NORMAL");
        if (mesh.normals.size() != mesh.points.size())
            attributes["NORMAL"].fail("has another number of points than the mesh");
        morph(own, weights, "NORMAL", mesh.normals);
    }
    bend(attributes, joints, mesh);
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        if (!Source::in_range(mesh.points[i]))
            attributes["POSITION"].fail("point " + std::to_string(i) + " (counted from 0) " +
                                        Source::fault(mesh.points[i]));

    GltfMaterial looks;
    int number = material_number(own["material"], looks);
    const std::string set = "TEXCOORD_" + std::to_string(looks.places);
    if (looks.pictured && attributes[set.c_str()]) {
        const GltfNumbers places = file.numbers(attributes[set.c_str()], 2);
        if (places.count != mesh.points.size())
            attributes[set.c_str()].fail("has another number of points than the mesh");
        for (std::size_t i = 0; i < places.count; ++i) {
            const MeshData::Place place{places(i, 0), 1 - places(i, 1)};
            if (const DVec3 point{place[0], place[1], 0}; !Source::in_range(point))
                attributes[set.c_str()].fail("point " + std::to_string(i) + " (counted from 0) " +
                                             Source::fault(point));
            mesh.places.push_back(place);
        }
    }
    std::vector<std::int32_t> corners;
    if (const GltfValue index = own["indices"]) {
        const GltfNumbers numbers = file.numbers(index, 1);
        corners.reserve(numbers.count);
        for (const double corner : numbers.values) {
            if (!(corner >= 0 && corner < double(mesh.points.size())))
                index.fail("names point " + std::to_string(static_cast<std::int64_t>(corner)) + "; there are " +
                           std::to_string(mesh.points.size()));
            corners.push_back(static_cast<std::int32_t>(corner));
        }
    } else {
        corners.resize(mesh.points.size());
        for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::int32_t>(i);
    }
    Faces faces(source, mesh);
    Face face;
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        face.points = {corners[a], corners[b], corners[c]};
        const auto point = [&](std::size_t k) { return mesh.points[std::size_t(face.points[k])]; };
        if (point(0) == point(1) || point(1) == point(2) || point(2) == point(0)) return;
        if (!mesh.normals.empty()) face.normals = face.points;
        faces.add(
            face, [&] { return own.place(); }, [&](const std::string& message) { own.fail("a face" + message); });
    };
    if (mode == 4)
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3) add(i, i + 1, i + 2);
    else if (mode == 5)
        for (std::size_t i = 0; i + 2 < corners.size(); ++i) add(i + i % 2, i + 1 - i % 2, i + 2);
    else
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) add(0, i, i + 1);
    faces.finish();
    if (mesh.triangles.empty()) return {};
    if (attributes["COLOR_0"]) {
        if (looks.pictured) {
            source.lose({"left out colours at the corners of ", "mesh", " with pictures"}, [&] { return own.place(); });
        } else {
            const GltfNumbers colors = file.numbers(attributes["COLOR_0"], 3);
            if (colors.count != mesh.points.size())
                attributes["COLOR_0"].fail("has another number of points than the mesh");
            const Color factor = looks.material.rgb.color;
            std::vector<MeshLook::Rgb> list(colors.count);
            for (std::size_t i = 0; i < list.size(); ++i)
                for (std::size_t c = 0; c < 3; ++c) list[i][c] = MeshLook::share(colors(i, c) * factor[int(c)], 0);
            Material colored = looks.material;
            colored.rgb = color_corners(mesh, {.colors = list, .linear = true});
            number = static_cast<int>(model.materials.size());
            model.materials.push_back(std::move(colored));
        }
    }
    return GltfPart{std::make_shared<const MeshData>(std::move(mesh)), number};
}

std::vector<GltfPart> GltfMeshes::read(const GltfValue& mesh, const std::vector<double>& weights,
                                       const std::vector<glm::dmat4>& joints) {
    const GltfValue list = mesh["primitives"];
    std::vector<GltfPart> parts;
    for (std::size_t i = 0; i < list.size(); ++i)
        if (auto part = read_primitive(list.at(i), weights, joints)) parts.push_back(std::move(*part));
    return parts;
}

void GltfMeshes::finish() {
    for (std::string& warning : losses.warnings(file.path)) model.warnings.push_back(std::move(warning));
    model.files = file.files;
    model.files.insert(model.files.end(), materials.files.begin(), materials.files.end());
}

}  // namespace strahl
