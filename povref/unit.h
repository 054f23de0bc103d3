// The scale of a scene for POV-Ray, whose tolerances are lengths.
#pragma once
#include <string>
#include <vector>

#include "scene/scene.h"

namespace strahl {

/// POV-Ray ignores hits nearer than 1e-4, occluders nearer than 1e-3 to either end of a shadow ray, and everything
/// beyond 1e7. A scene in which these lengths are visible is scaled by `unit`, a round number.
struct Unit {
    double unit = 1;
    std::string fault;  // why a tolerance remains visible even so, or empty
};

/// The smallest unit with which the farthest point is at least 3e4 away from the camera (150 in a scene with planes,
/// whose horizon is at 1e7) and the smallest body has a size of at least 1, unless the farthest would be beyond 1e6.
/// Scenes that fulfil this already, and are not far larger, keep unit 1. `cameras` are all cameras of the scene.
Unit unit_for(const Scene& scene, const std::vector<Camera>& cameras);

}  // namespace strahl
