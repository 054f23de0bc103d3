// Finds where a ray meets bodies, for scenes that ask while they are read.
#pragma once
#include <vector>

#include "scene/scene.h"

namespace strahl::pov {

/// Finds the nearest hit at least 1e-4 away, as POV-Ray does, with its outward normal. Returns false if there is none.
bool nearest_hit(const std::vector<Primitive>& bodies, const DVec3& from, const DVec3& direction, DVec3& hit,
                 DVec3& normal);

}  // namespace strahl::pov
