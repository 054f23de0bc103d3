// Finds which parts of a union rays must meet together, and which can be traced as bodies of their own.
#pragma once
#include <vector>

#include "scene/scene.h"

namespace strahl {

/// A part of a union, or of a union in it, that is not a union itself.
struct UnionPart {
    Primitive primitive;                     // with the transformations of all unions around it but the outermost one's
    std::vector<Transformation> to_pattern;  // from its own space to that of its material's pattern
};
using UnionGroup = std::vector<UnionPart>;

/// Divides a union into groups of parts: different groups share no points. An opaque group of one look, or of more than
/// `most_opaque` simple bodies, is divided into groups of one part: only an eye inside of it could tell, and of several
/// looks those at faces in one plane. Returns no groups if the body must stay whole: if it is not a union, if its parts
/// move or refract differently, or if all belong together.
std::vector<UnionGroup> union_groups(const Primitive& whole, const std::vector<Material>& materials);
inline constexpr int most_opaque = 64;

/// Returns how many simple bodies the largest group has, or the body itself if it must stay whole.
int most_leaves_together(const Primitive& whole, const std::vector<Material>& materials);

}  // namespace strahl
