// Names the materials of a converted scene after their appearance.
#pragma once
#include <string>
#include <vector>

#include "scene/material.h"

namespace strahl {

/// Returns one name per material, such as Red_Glass or Grey_Mirror_2. All are different, and none is a keyword of
/// POV-Ray.
std::vector<std::string> material_names(const std::vector<Material>& materials);

}  // namespace strahl
