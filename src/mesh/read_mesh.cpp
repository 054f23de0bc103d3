// Opens mesh files, recognises their formats, and removes triangles without a surface.
#include "mesh/read_mesh.h"

#include <algorithm>
#include <cmath>

#include "files/regular_file.h"
#include "mesh/source.h"
#include "num/buffer.h"
#include "num/decimal.h"

namespace strahl {
namespace {

/// Has the path this ending, in capitals or not?
bool ends_with(std::string_view path, std::string_view ending) {
    return path.size() >= ending.size() && same_word(path.substr(path.size() - ending.size()), ending);
}

enum class MeshFormat { ply, obj, stl };

MeshFormat format_of(const Source& source) {
    const std::string_view bytes = source.bytes;
    const bool begins_ply = bytes.starts_with("ply\n") || bytes.starts_with("ply\r");
    if (begins_ply || ends_with(source.path, ".ply")) return MeshFormat::ply;
    if (ends_with(source.path, ".obj")) return MeshFormat::obj;
    if (is_binary_stl(bytes) || bytes.starts_with("solid") || ends_with(source.path, ".stl")) return MeshFormat::stl;
    source.fail("not a mesh: it is neither a PLY nor an STL file, and its name does not end in .obj");
}

/// Removes triangles whose corners are not three different points.
void remove_empty(MeshData& mesh) {
    const bool smooth = !mesh.corner_normals.empty(), placed = !mesh.corner_places.empty();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const MeshData::Corners corners = mesh.triangles[i];
        const DVec3 &a = mesh.points[corners[0]], &b = mesh.points[corners[1]], &c = mesh.points[corners[2]];
        if (a == b || b == c || c == a) continue;
        mesh.triangles[kept] = corners;
        if (smooth) mesh.corner_normals[kept] = mesh.corner_normals[i];
        if (placed) mesh.corner_places[kept] = mesh.corner_places[i];
        ++kept;
    }
    mesh.triangles.resize(kept);
    if (smooth) mesh.corner_normals.resize(kept);
    if (placed) mesh.corner_places.resize(kept);
}

/// Fails if a normal that is used has no direction. Unused ones may be anything: programs write zeros for points that
/// belong to no face.
void check_normals(const MeshData& mesh, const Source& source, MeshFormat format) {
    const auto usable = [](const DVec3& n) {
        const double most = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
        // Squares of these neither overflow nor vanish. A comparison with NaN is false.
        return most > 1e-100 && most < 1e100 && std::isfinite(n.x + n.y + n.z);
    };
    std::vector<char> checked(mesh.normals.size());
    for (const MeshData::Corners& corners : mesh.corner_normals)
        for (const std::int32_t i : corners) {
            if (checked[i]) continue;
            checked[i] = true;
            if (usable(mesh.normals[i])) continue;
            const std::string which = format == MeshFormat::ply
                                          ? "the normal of vertex " + std::to_string(i) + " (counted from 0)"
                                          : "normal " + std::to_string(i + 1) + " (the 'vn' lines, counted from 1)";
            source.fail(which + " is " + text_of(mesh.normals[i]) +
                        ", which has no direction; recompute the normals, or save the mesh without them");
        }
}

}  // namespace

MeshData read_mesh(const std::string& path, const MeshLimits& limits) {
    const RegularFile file(path);
    const auto fail = [&](const std::string& why) { throw FileError("cannot read '" + path + "': " + why); };
    if (file.size() == 0) fail("it is empty");
    if (file.size() > limits.most_bytes)
        fail("it is larger than " + std::to_string(limits.most_bytes) + " bytes; simplify the mesh, or split it");
    const Buffer<char> bytes = uninitialized_buffer<char>(file.size());
    const Source source{path, {bytes.get(), file.read(0, bytes.get(), file.size())}, limits};
    const MeshFormat format = format_of(source);
    MeshData mesh = format == MeshFormat::ply   ? read_ply(source)
                    : format == MeshFormat::obj ? read_obj(source)
                                                : read_stl(source);
    remove_empty(mesh);
    mesh.points.shrink_to_fit(), mesh.triangles.shrink_to_fit();
    if (mesh.triangles.empty()) source.fail("there is no face in this file that has three different corners");
    check_normals(mesh, source, format);
    return mesh;
}

}  // namespace strahl
