// How large a scene must be for POV-Ray: its tolerances are lengths, ours are none.
#pragma once
#include <string>
#include <vector>

#include "scene/scene.h"

namespace strahl {

/// POV-Ray counts no hit nearer than 1e-4, no shadow caster nearer than 1e-3 to either end of its ray, and nothing
/// beyond 1e7. A scene in which these lengths can be seen is made larger or smaller by `unit`, a round number.
struct Unit {
    double unit = 1;
    std::string fault;  // why even that unit leaves a tolerance visible, or empty
};

/// The smallest unit under which the farthest thing is at least 3e4 away from the camera (150 in a scene with planes,
/// whose horizon is at 1e7) and the smallest body measures at least 1, but no more than keeps the farthest within 1e6.
/// Scenes that are so already, and not far larger, keep unit 1. `cameras` are all from which the scene is seen.
Unit unit_for(const Scene& scene, const std::vector<Camera>& cameras);

}  // namespace strahl
