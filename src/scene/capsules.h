// Capsules around the bodies of a scene.
#pragma once
#include <glm/mat4x4.hpp>
#include <vector>

#include "scene/kinds/capsule.h"
#include "scene/scene.h"

namespace strahl {

/// Capsules that together contain the body, in the scene's coordinates. Unbounded bodies have none, nor have meshes,
/// whose triangles are small where they bend.
std::vector<Capsule> capsules_of(const Primitive& primitive, const glm::dmat4& outer = glm::dmat4(1));

}  // namespace strahl
