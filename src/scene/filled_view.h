// The view of a camera, widened to fill a picture of other proportions.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/camera.h"

namespace strahl {

/// Returns the camera without its aspectratio, for a picture of `aspect` = width / height: it shows all that the camera
/// shows, in the right proportions, and more above and below or to both sides, up to 89 degrees from the middle, or 360
/// if its sides are angles.
inline Camera filled_view(const Camera& camera, double aspect) {
    if (!camera.aspectratio) return camera;
    Camera wider = camera;
    wider.aspectratio.reset();
    constexpr double degree = std::numbers::pi / 180, widest = 89;
    const double factor = std::max(1., aspect / *camera.aspectratio);
    if (factor > 1 && angular(camera.projection))
        wider.fov = std::min(360., camera.fov * factor);
    else if (factor > 1)
        wider.fov = std::max(camera.fov, std::min(widest, std::atan(std::tan(camera.fov * degree) * factor) / degree));
    return wider;
}

}  // namespace strahl
