// Warns of what is allowed in a scene but probably a mistake.
#pragma once
#include <string>
#include <vector>

#include "scene/scene.h"

namespace strahl {

/// Returns warnings about a scene at the moment 0: no light, a camera that sees no body, and colours of 100 and more.
/// The camera is said to see nothing only if that is certain.
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace strahl
