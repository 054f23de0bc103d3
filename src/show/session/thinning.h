// A flight by hand as a path of few keys.
#pragma once
#include <vector>

#include "scene/camera.h"

namespace strahl {

/// Where the camera was.
struct CameraMoment {
    double time = 0;  // seconds; these rise strictly
    Camera camera;
};

struct Thinned {
    Flythrough path;
    double error = 0;  // the farthest that position or look_at are from where they were, at the moments given
};
/// A path through some of the moments, the first and the last among them, that is nowhere farther than `tolerance` from
/// the others: it gets a key where it is farthest, until that holds. Times count from the first moment. At least two
/// moments.
Thinned thinned(const std::vector<CameraMoment>& moments, const Camera& scene_camera, double tolerance);

}  // namespace strahl
