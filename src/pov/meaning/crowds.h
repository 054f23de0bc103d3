// Keeps composites to as many bodies as rays can meet together.
#pragma once
#include <vector>

#include "scene/scene.h"

namespace strahl::pov {

/// Changes a composite of more than `most_leaves` connected bodies: drops what a difference takes away where its first
/// part is not, and if that does not suffice the last bodies. Returns whether it dropped any that matter.
bool limit_crowd(Primitive& whole, const std::vector<Material>& materials);

}  // namespace strahl::pov
