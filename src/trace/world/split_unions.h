// Unions as the bodies that they consist of, where that makes no difference but to the time it takes.
#pragma once
#include <vector>

#include "scene/scene.h"

namespace strahl {

/// Returns bodies that together are the same body: a union for each of its groups (union_groups.h), or a part that is
/// alone. Patterns stay where they are. Parts that have theirs from a union get materials of their own, which are
/// added; `copied` receives the number that each was copied from.
std::vector<Primitive> split_union(const Primitive& primitive, std::vector<Material>& materials,
                                   std::vector<int>* copied = nullptr);

/// The bodies and the materials that those of a scene with split unions were declared as; empty if it has no unions.
struct DeclaredAs {
    std::vector<int> bodies, materials;
};

/// Returns the scene with all its unions split but those that the eye is in, which sees no surfaces inside them.
Scene with_split_unions(Scene scene, DeclaredAs* declared = nullptr);

}  // namespace strahl
