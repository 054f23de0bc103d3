// Reduces a flight by hand to a path of few keys.
#pragma once
#include <vector>

#include "scene/camera.h"

namespace strahl {

/// The camera at a moment.
struct CameraMoment {
    double time = 0;  // seconds, strictly ascending
    Camera camera;
};

struct Thinned {
    Flythrough path;
    double error = 0;  // largest distance of position or look_at from the given moments
};
/// Returns a path through some of the moments, the first and the last among them, that is nowhere farther than
/// `tolerance` from the others: keys are added where it is farthest. Times count from the first moment. Needs at least
/// two moments.
Thinned thinned(const std::vector<CameraMoment>& moments, const Camera& scene_camera, double tolerance);

}  // namespace strahl
