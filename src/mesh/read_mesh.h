// Reads meshes from PLY, OBJ and STL files.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh_look.h"
#include "scene/error.h"
#include "scene/kinds/mesh_data.h"

namespace strahl {

struct MeshLimits {
    std::uint64_t most_triangles = 20'000'000;
    std::uint64_t most_points = 60'000'000;
    std::uint64_t most_bytes = std::uint64_t(4) << 30;  // of the file
};

/// Reads a file of triangles: PLY (ascii or binary), STL (ascii or binary) or OBJ. The format is recognised by the
/// contents; OBJ, which has no mark of its own, by the ending of the name.
///
/// - Faces of more corners are split into triangles. A concave face may have at most 1000 corners.
/// - A triangle whose corners are not three different points has no surface and is left out, as is a face of fewer than
///   three corners. Slivers stay.
/// - STL has no shared points: there, corners of equal coordinates become one point.
/// - PLY and OBJ may give normals, which makes the mesh smooth. Faces that lack a normal at some corner, or have one
///   there that is zero or not a number, get the normal of their plane. STL's normals are ignored.
/// - Places in a picture: those of OBJ's `vt`, and in PLY the faces' lists `texcoord`, or the vertices' properties u
///   and v, s and t, or texture_u and texture_v. Faces that lack some of them, among others that have them, are at the
///   origin.
///
/// Every index is in range, every coordinate from -1e9 to 1e9, and every normal that a corner uses has a direction.
/// Only regular files are opened. Throws FileError, whose message says where in the file the error is and what to do.
/// `warnings` receives sentences on what of the file is not read as it stands.
/// `look` receives colours and names; without it they are ignored with a warning.
MeshData read_mesh(const std::string& path, const MeshLimits& limits = {}, std::vector<std::string>* warnings = nullptr,
                   MeshLook* look = nullptr);

}  // namespace strahl
