// Gives open meshes the inside that POV-Ray sees by their inside_vector.
#pragma once
#include <optional>
#include <utility>

#include "scene/kinds/mesh.h"

namespace strahl::pov {

/// Returns two bodies whose intersection has the surface of an open mesh, and inside what POV-Ray takes for it: the
/// points from which a ray along `up` meets an odd number of triangles. The second one's surfaces are not there:
/// through them one looks into the first. None if more than two triangles or open sides meet in one place.
std::optional<std::pair<Mesh, Mesh>> closed_along(const MeshData& open, const DVec3& up);

}  // namespace strahl::pov
