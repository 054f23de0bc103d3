// Finds composites in which POV-Ray's rounding decides whether faces are seen.
#pragma once
#include <cstddef>
#include <vector>

#include "scene/scene.h"

namespace strahl::pov {

/// Do parts of a composite, or of one in it, have a face in one place, so that it is there or not as POV-Ray rounds the
/// place where a ray meets it? Flat faces are found, and spheres, cylinders and cones that are there twice. In a merge
/// through which light goes that is also so if parts only touch. Places that are hidden from the camera do not count.
bool rounding_decides(const Scene& scene, const Primitive& whole);

/// Returns the numbers of clear bodies with a face in a plane that is seen through them: POV-Ray's rounding decides
/// which of the two a ray meets first, but of a box on a plane, where that is always the plane.
std::vector<std::size_t> clear_bodies_on_planes(const Scene& scene);

}  // namespace strahl::pov
