// Puts the triangles of meshes into the planes in which POV-Ray has them.
#pragma once
#include "scene/kinds/mesh_data.h"

namespace strahl::pov {

/// Returns a mesh each of whose triangles has corners of its own, in the plane that POV-Ray keeps for it in single
/// precision. That is up to 1e-7 of its coordinates away, which bumps and fine patterns show.
MeshData in_single_planes(MeshData mesh);

}  // namespace strahl::pov
