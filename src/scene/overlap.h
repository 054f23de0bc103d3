// Finds where bodies are, and whether transparent ones share space.
#pragma once
#include "scene/scene.h"

namespace strahl {

/// Returns a box around the transformed primitive; infinite if its kind is not bounded.
Box world_bounds(const Primitive& primitive);
/// Returns the box if the world is transformed once more.
Box transformed_bounds(const Primitive& primitive, const glm::dmat4& to_world);
/// Returns the box of a transformed shape.
Box transformed_bounds(const Shape& shape, const glm::dmat4& to_world);
/// Returns how far from a point the primitive and all of its parts reach along an axis of the world, as far as they are
/// bounded; 0 if nothing is. A part may reach further than what others leave of it.
double reach_from(const DVec3& point, const Primitive& primitive);
/// Returns the half-space that a primitive of an unbounded kind is; nothing for other kinds.
std::optional<HalfSpace> half_space(const Primitive& primitive);

/// Returns whether a point of the world is inside the primitive.
bool contains(const Primitive& primitive, const DVec3& p);

/// Returns whether two transparent bodies of the scene may have points in common. If certainly not, a ray is inside one
/// at most, and the side from which it meets a surface tells whether it enters.
bool transparent_bodies_overlap(const Scene& scene);

}  // namespace strahl
