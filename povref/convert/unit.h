// The scale of a scene for POV-Ray, whose tolerances are lengths.
#pragma once
#include <limits>
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

/// How far apart and how large things are, for all cameras and moments added.
struct Sizes {
    double farthest = 0;  // of what is seen, from a camera
    double smallest = std::numeric_limits<double>::infinity();
    bool horizon = false;  // some body is endless
    void add(const Scene& scene, const std::vector<Camera>& cameras);
};

/// The smallest unit with which the farthest point is at least 3e4 away from the camera (150 in a scene with planes,
/// whose horizon is at 1e7) and the smallest body has a size of at least 1, unless the farthest would be beyond 1e6.
/// Scenes that fulfil this already, and are not far larger, keep unit 1. `cameras` are all cameras of the scene.
Unit unit_for(const Sizes& sizes);
inline Unit unit_for(const Scene& scene, const std::vector<Camera>& cameras) {
    Sizes sizes;
    sizes.add(scene, cameras);
    return unit_for(sizes);
}

}  // namespace strahl
