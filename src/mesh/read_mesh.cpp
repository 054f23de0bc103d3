// Opens mesh files, recognises their formats, and removes triangles without a surface.
#include "mesh/read_mesh.h"

#include <algorithm>
#include <iterator>

#include "files/regular_file.h"
#include "mesh/source.h"
#include "num/buffer.h"

namespace strahl {
namespace {

/// Does the path have this ending, in capitals or not?
bool ends_with(std::string_view path, std::string_view ending) {
    return path.size() >= ending.size() && same_word(path.substr(path.size() - ending.size()), ending);
}

enum class MeshFormat { ply, obj, stl };

MeshFormat format_of(const Source& source) {
    const std::string_view bytes = source.bytes;
    const bool begins_ply = bytes.size() > 3 && bytes.starts_with("ply") && is_space(bytes[3]);
    if (begins_ply || ends_with(source.path, ".ply")) return MeshFormat::ply;
    if (ends_with(source.path, ".obj")) return MeshFormat::obj;
    if (is_binary_stl(bytes) || begins_with(bytes, "solid") || ends_with(source.path, ".stl")) return MeshFormat::stl;
    source.fail("not a mesh: it is neither a PLY nor an STL file, and its name does not end in .obj");
}

/// Removes triangles whose corners are not three different points.
void remove_empty(MeshData& mesh, MeshLook* look) {
    const bool smooth = !mesh.corner_normals.empty(), placed = !mesh.corner_places.empty();
    const bool colored = look && !look->triangle_colors.empty();
    std::size_t kept = 0, run = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (; look && run < look->runs.size() && look->runs[run].first == i; ++run) look->runs[run].first = kept;
        const MeshData::Corners corners = mesh.triangles[i];
        const DVec3 &a = mesh.points[corners[0]], &b = mesh.points[corners[1]], &c = mesh.points[corners[2]];
        if (a == b || b == c || c == a) continue;
        mesh.triangles[kept] = corners;
        if (smooth) mesh.corner_normals[kept] = mesh.corner_normals[i];
        if (placed) mesh.corner_places[kept] = mesh.corner_places[i];
        if (colored) look->triangle_colors[kept] = look->triangle_colors[i];
        ++kept;
    }
    mesh.triangles.resize(kept);
    if (smooth) mesh.corner_normals.resize(kept);
    if (placed) mesh.corner_places.resize(kept);
    if (colored) look->triangle_colors.resize(kept);
}

}  // namespace

MeshData read_mesh(const std::string& path, const MeshLimits& limits, std::vector<std::string>* warnings,
                   MeshLook* look) {
    const RegularFile file(path);
    const auto fail = [&](const std::string& why) { throw FileError("cannot read '" + path + "': " + why); };
    if (file.size() == 0) fail("it is empty");
    if (file.size() > limits.most_bytes)
        fail("it is larger than " + std::to_string(limits.most_bytes) + " bytes; simplify the mesh, or split it");
    const Buffer<char> buffer = uninitialized_buffer<char>(file.size());
    const std::string_view bytes(buffer.get(), file.read(0, buffer.get(), file.size()));
    Losses losses;
    const Source source{path, is_binary_stl(bytes) ? bytes : utf8_text(bytes, path), limits, losses, look};
    const MeshFormat format = format_of(source);
    MeshData mesh = format == MeshFormat::ply   ? read_ply(source)
                    : format == MeshFormat::obj ? read_obj(source)
                                                : read_stl(source);
    remove_empty(mesh, look);
    mesh.points.shrink_to_fit(), mesh.triangles.shrink_to_fit();
    if (mesh.triangles.empty()) source.fail("there is no face in this file that has three different corners");
    if (warnings) std::ranges::move(losses.warnings(path), std::back_inserter(*warnings));
    return mesh;
}

}  // namespace strahl
