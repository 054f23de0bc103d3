#include "mesh/faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

namespace strahl {
namespace {

constexpr MeshData::Corners nothing{Face::none, Face::none, Face::none};

double largest(const DVec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Does it have a direction that can be computed with? Squares of its coordinates must neither overflow nor vanish.
bool is_direction(const DVec3& n) {
    const double most = largest(n);  // a comparison with NaN is false
    return most > 1e-100 && most < 1e100 && std::isfinite(n.x + n.y + n.z);
}
bool is_place(const MeshData::Place& place) { return std::isfinite(place[0] + place[1]); }

/// Appends the numbers of these corners for each triangle. Triangles before that have none get `nothing`.
void append(std::vector<MeshData::Corners>& numbers, std::size_t before, const std::vector<std::int32_t>& own,
            std::span<const FaceSplitter::Triangle> triangles) {
    numbers.resize(before, nothing);
    for (const auto& [a, b, c] : triangles) numbers.push_back({own[a], own[b], own[c]});
}

}  // namespace

bool Faces::all_directions() const { return std::ranges::all_of(mesh.normals, is_direction); }

bool Faces::has_normals(const Face& face, const Source::Where& where) const {
    if (std::ranges::count(face.normals, Face::none) == std::ssize(face.normals)) return false;
    if (std::ranges::count(face.normals, Face::none) > 0) {
        source.lose({"made ", "face", " flat that lacked normals at some corners"}, where);
        return false;
    }
    if (std::ranges::all_of(face.normals, [&](std::int32_t i) { return is_direction(mesh.normals[i]); })) return true;
    source.lose({"made ", "face", " flat with normals that are zero or not numbers"}, where);
    return false;
}

bool Faces::has_places(const Face& face, const Source::Where& where) const {
    if (std::ranges::count(face.places, Face::none) == std::ssize(face.places)) return false;
    const auto usable = [&](std::int32_t i) { return i != Face::none && is_place(mesh.places[i]); };
    if (std::ranges::all_of(face.places, usable)) return true;
    source.lose({"put ", "face", " at <0, 0> in pictures that lacked places at some corners"}, where);
    return false;
}

void Faces::add(const Face& face, const Source::Where& where, const std::function<void(const std::string&)>& fail) {
    if (face.points.size() < 3) return source.lose({"skipped ", "face", " of fewer than three corners"}, where);
    const std::size_t before = mesh.triangles.size();
    source.check_triangles(before + face.points.size() - 2);
    const std::span<const FaceSplitter::Triangle> triangles = splitter.split(mesh.points, face.points);
    if (triangles.empty())
        fail(" has " + counted(face.points.size(), "corner") + " and is not convex; such a face may have at most " +
             std::to_string(FaceSplitter::most_concave) + " corners, so split it");
    for (const auto& [a, b, c] : triangles) mesh.triangles.push_back({face.points[a], face.points[b], face.points[c]});
    if (has_normals(face, where)) append(mesh.corner_normals, before, face.normals, triangles);
    if (has_places(face, where)) append(mesh.corner_places, before, face.places, triangles);
}

/// Gives triangles without normals that of their plane.
void Faces::flatten() {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.corner_normals[i] != nothing) continue;
        const auto& [a, b, c] = mesh.triangles[i];
        const DVec3 u = mesh.points[b] - mesh.points[a], v = mesh.points[c] - mesh.points[a];
        const double size = largest(u) * largest(v);
        const DVec3 normal = size > 0 ? glm::cross(u / largest(u), v / largest(v)) : DVec3(0);
        // A sliver so thin that its normal is lost in rounding is only ever seen from the side.
        mesh.normals.push_back(is_direction(normal) ? normal : DVec3(0, 0, 1));
        mesh.corner_normals[i].fill(static_cast<std::int32_t>(mesh.normals.size() - 1));
    }
}

void Faces::finish() {
    if (mesh.corner_normals.empty()) {
        mesh.normals.clear();
    } else {
        mesh.corner_normals.resize(mesh.triangles.size(), nothing);
        flatten();
    }
    if (mesh.corner_places.empty()) return;
    mesh.corner_places.resize(mesh.triangles.size(), nothing);
    const auto origin = static_cast<std::int32_t>(mesh.places.size());
    for (MeshData::Corners& corners : mesh.corner_places)
        if (corners == nothing) corners.fill(origin), mesh.places.resize(origin + 1);
}

}  // namespace strahl
