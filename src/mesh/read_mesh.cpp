// Opens mesh files, tells which kind they are, and removes what has no surface.
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
    return path.size() >= ending.size() &&
           std::equal(ending.begin(), ending.end(), path.end() - static_cast<std::ptrdiff_t>(ending.size()),
                      [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? b - 'A' + 'a' : b); });
}

enum class Kind { ply, obj, stl };

Kind kind_of(const Source& source) {
    const std::string_view bytes = source.bytes;
    if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r") || ends_with(source.path, ".ply")) return Kind::ply;
    if (ends_with(source.path, ".obj")) return Kind::obj;
    if (is_binary_stl(bytes) || bytes.starts_with("solid") || ends_with(source.path, ".stl")) return Kind::stl;
    source.fail("this is no mesh that can be read: neither a PLY nor an STL file, and its name does not end in .obj");
}

/// Leaves out the triangles whose corners are not three different points.
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

/// Unused normals may be anything: programs write zeros for points that belong to no face.
void check_normals(const MeshData& mesh, const Source& source, Kind kind) {
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
            const std::string which = kind == Kind::ply
                                          ? "the normal of vertex " + std::to_string(i) + " (counted from 0)"
                                          : "normal " + std::to_string(i + 1) + " (the 'vn' lines, counted from 1)";
            source.fail(which + " is " + text_of(mesh.normals[i]) +
                        ", which is no direction; have the normals computed anew, or save the mesh without them");
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
    const Kind kind = kind_of(source);
    MeshData mesh = kind == Kind::ply ? read_ply(source) : kind == Kind::obj ? read_obj(source) : read_stl(source);
    remove_empty(mesh);
    mesh.points.shrink_to_fit(), mesh.triangles.shrink_to_fit();
    if (mesh.triangles.empty()) source.fail("there is no face in this file that has three different corners");
    check_normals(mesh, source, kind);
    return mesh;
}

}  // namespace strahl
