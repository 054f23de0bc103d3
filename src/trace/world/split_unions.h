// Unions as the bodies that they consist of, where that makes no difference but to the time it takes.
#pragma once
#include <vector>

#include "scene/scene.h"

namespace strahl {

/// Returns bodies that together are the same body: a union for each of its groups (union_groups.h), or a part that is
/// alone. Patterns stay where they are. Parts that have theirs from a union get materials of their own, which are
/// added.
std::vector<Primitive> split_union(const Primitive& primitive, std::vector<Material>& materials);

/// Returns the scene with all its unions split but those that the eye is in, which sees no surfaces inside them.
Scene with_split_unions(Scene scene);

}  // namespace strahl
