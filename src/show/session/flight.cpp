// Makes an orbit for scenes that have no path.
#include "show/session/flight.h"

#include <numbers>

#include "show/session/camera_control.h"

namespace strahl {

Flythrough orbit_path(const Camera& camera, const Camera& scene_camera) {
    Camera start = scene_camera;
    start.position = camera.position;
    if (degenerate(start)) start = scene_camera;
    constexpr int keys = 48;  // the curve through them is a circle to a hundred-thousandth
    Flythrough path{.duration = 40, .loop = true, .keys = {}};
    for (int i = 0; i < keys; ++i) {
        const Camera there = orbit(start, {.right = 2 * std::numbers::pi * i / keys});
        path.keys.push_back({path.duration * i / keys, there.position, there.look_at, {}, {}});
    }
    return path;
}

}  // namespace strahl
