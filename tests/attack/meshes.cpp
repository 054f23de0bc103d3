// Spoilt mesh files, and whether what is read of them keeps what read_mesh.h promises.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mesh/read_mesh.h"
#include "tests/attack/file_attack.h"
#include "tests/attack/mutated_mesh.h"

using namespace strahl;

namespace {

void read(const std::string& path) {
    const MeshData mesh = read_mesh(path);
    const auto promise = [](bool kept) {
        if (!kept) throw std::logic_error("a broken mesh");
    };
    promise(!mesh.triangles.empty());
    promise(mesh.corner_normals.empty() || mesh.corner_normals.size() == mesh.triangles.size());
    for (const DVec3& p : mesh.points) promise(std::abs(p.x) <= 1e9 && std::abs(p.y) <= 1e9 && std::abs(p.z) <= 1e9);
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto last = static_cast<std::int32_t>(mesh.points.size()) - 1;
        promise(std::min({a, b, c}) >= 0 && std::max({a, b, c}) <= last);
        promise(mesh.points[a] != mesh.points[b] && mesh.points[b] != mesh.points[c] &&
                mesh.points[c] != mesh.points[a]);
    }
    promise(mesh.corner_places.empty() || mesh.corner_places.size() == mesh.triangles.size());
    if (const MeshData::Corners* const numbers = mesh.place_numbers())
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (const std::int32_t k : numbers[i]) {
                promise(k >= 0 && k < static_cast<std::int32_t>(mesh.places.size()));
                promise(std::abs(mesh.places[k][0]) <= 1e9 && std::abs(mesh.places[k][1]) <= 1e9);
            }
    for (const MeshData::Corners& corners : mesh.corner_normals)
        for (const std::int32_t i : corners) {
            promise(i >= 0 && i < static_cast<std::int32_t>(mesh.normals.size()));
            const DVec3& n = mesh.normals[i];
            const double square = n.x * n.x + n.y * n.y + n.z * n.z;
            promise(square > 0 && std::isfinite(square));
        }
}

}  // namespace

int main(int count, char** arguments) {
    return run_attack({"mesh", {"", ".obj"}, valid_meshes, mutated_mesh, read}, count, arguments);
}
