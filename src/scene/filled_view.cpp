#include "scene/filled_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strahl {

Camera filled_view(const Camera& camera, double aspect) {
    if (!camera.aspectratio) return camera;
    Camera wider = camera;
    wider.aspectratio.reset();
    constexpr double degree = std::numbers::pi / 180, widest = 89;
    const double factor = std::max(1., aspect / *camera.aspectratio);
    if (factor > 1)
        wider.fov = std::max(camera.fov, std::min(widest, std::atan(std::tan(camera.fov * degree) * factor) / degree));
    return wider;
}

}  // namespace strahl
