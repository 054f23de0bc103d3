// Names for the materials of an emitted scene, told from what they look like.
#pragma once
#include <string>
#include <vector>

#include "scene/material.h"

namespace strahl {

/// One name per material, such as Red_Glass or Grey_Mirror_2; all different, and none a word of POV-Ray's.
std::vector<std::string> material_names(const std::vector<Material>& materials);

}  // namespace strahl
