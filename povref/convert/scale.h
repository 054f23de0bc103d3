// Chooses the scale of a scene for POV-Ray, whose tolerances are lengths.
#pragma once
#include <limits>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace strahl {

/// POV-Ray ignores hits nearer than 1e-4, occluders nearer than 1e-3 to either end of a shadow ray, and everything
/// beyond 1e7. A scene in which these lengths are visible is scaled by `factor`, a round number.
struct PovScale {
    double factor = 1;
    std::string fault;  // why a tolerance remains visible even so, or empty
};

/// Distances and sizes of bodies over all cameras and moments added.
struct SceneSizes {
    double farthest = 0;                                        // point of a body or light, from a camera
    double smallest = std::numeric_limits<double>::infinity();  // side of a body's box
    bool horizon = false;                                       // some body is endless
    void add(const Scene& scene, const std::vector<Camera>& cameras);
};

/// Returns the smallest factor with which the farthest point is at least 3e4 away from the camera (150 in a scene with
/// planes, whose horizon is at 1e7) and the smallest body has a size of at least 1, unless the farthest would be beyond
/// 1e6. Scenes that fulfil this already, and are not far larger, keep factor 1. `cameras` are all cameras of the scene.
PovScale scale_for(const SceneSizes& sizes);
inline PovScale scale_for(const Scene& scene, const std::vector<Camera>& cameras) {
    SceneSizes sizes;
    sizes.add(scene, cameras);
    return scale_for(sizes);
}

}  // namespace strahl
