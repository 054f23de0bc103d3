// Paths that are not in a file: orbits and recorded ones.
#include "show/flight.h"

#include <numbers>

#include "show/camera_control.h"

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

Flythrough with_key(Flythrough path, const Camera& camera, const Camera& scene_camera, double seconds) {
    Keyframe key{path.keys.empty() ? 0 : path.keys.back().time + seconds, camera.position, camera.look_at, {}, {}};
    if (camera.fov != scene_camera.fov) key.fov = camera.fov;
    if (camera.up != scene_camera.up) key.up = camera.up;
    path.loop = path.keys.size() > 1 && key.position == path.keys[0].position && key.look_at == path.keys[0].look_at;
    path.keys.push_back(key);
    path.duration = key.time;
    return path;
}

}  // namespace strahl
