// Unions as the bodies that they consist of, where that makes no difference but to the time it takes.
#pragma once
#include <vector>

#include "scene/scene.h"

namespace strahl {

/// The same body as one or more. A union, with the unions in it, becomes groups of parts that share no points with each
/// other, each a union by itself, or a part alone. An opaque group of one look, or of more than `most_opaque` simple
/// bodies, becomes single parts: only an eye inside of it could tell, and of several looks those at faces in one plane.
///
/// A union whose parts move stays whole. Patterns stay where they are. Parts that have theirs from a union get
/// materials of their own, which are added.
std::vector<Primitive> split_union(const Primitive& primitive, std::vector<Material>& materials);
inline constexpr int most_opaque = 64;

/// The scene with all its unions split.
Scene with_split_unions(Scene scene);

}  // namespace strahl
