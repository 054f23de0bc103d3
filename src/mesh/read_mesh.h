// Meshes from files: PLY, OBJ and STL.
#pragma once
#include <cstdint>
#include <string>

#include "scene/error.h"
#include "scene/kinds/mesh_data.h"

namespace strahl {

struct MeshLimits {
    std::uint64_t most_triangles = 20'000'000;
    std::uint64_t most_points = 60'000'000;
    std::uint64_t most_bytes = std::uint64_t(4) << 30;  // of the file
};

/// Reads a file of triangles: PLY (ascii or binary), STL (ascii or binary) or OBJ. Which it is its content says; OBJ
/// has no mark of its own, so it is told by the ending.
///
/// - Faces of more corners are split into triangles. A concave one may have 1000 corners at most.
/// - A triangle whose corners are not three different points has no surface and is left out, as is a face of fewer than
///   three corners. Slivers stay.
/// - STL has no shared points: there, corners of equal coordinates become one point.
/// - Smooth or flat: PLY and OBJ may give normals; what OBJ leaves without them among faces that have them gets the
///   normal of its plane. STL's normals are ignored.
/// - Places in a picture: those of OBJ's `vt`, and in PLY the vertices' properties u and v, s and t, or texture_u and
///   texture_v. OBJ's faces without any among others that have some are at the origin.
///
/// Every index is in range, every coordinate from -1e9 to 1e9, and every normal that a corner uses has a direction.
/// Only regular files are opened. Throws FileError, which says where in the file the fault is and what to do.
MeshData read_mesh(const std::string& path, const MeshLimits& limits = {});

}  // namespace strahl
