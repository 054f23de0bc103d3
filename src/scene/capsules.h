// Finds capsules around the bodies of a scene.
#pragma once
#include <glm/mat4x4.hpp>
#include <vector>

#include "scene/kinds/capsule.h"
#include "scene/scene.h"

namespace strahl {

/// Returns capsules that together contain the body, in the scene's coordinates. There are none for unbounded bodies,
/// nor for meshes, whose triangles are small where they bend.
std::vector<Capsule> capsules_of(const Primitive& primitive, const glm::dmat4& outer = glm::dmat4(1));

}  // namespace strahl
