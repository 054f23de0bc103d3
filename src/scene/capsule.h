// Capsules around bodies: what tells a thin body from a small one.
#pragma once
#include <glm/mat4x4.hpp>
#include <vector>

#include "num/box.h"

namespace strahl {

struct Primitive;

/// All points no further than `radius` from the way between two points.
struct Capsule {
    DVec3 from, to;
    double radius;
};

/// The capsule around a box, along its longest side.
Capsule capsule_around(const Box& box);

/// Capsules that together contain the body, in the scene's coordinates. Unbounded bodies have none, nor have meshes,
/// whose triangles are small where they bend.
std::vector<Capsule> capsules_of(const Primitive& primitive, const glm::dmat4& outer = glm::dmat4(1));

}  // namespace strahl
