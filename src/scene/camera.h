// The camera: position, direction, angle of view, and its path.
#pragma once
#include <optional>
#include <vector>

#include "num/vec.h"

namespace strahl {

/// The world is right-handed; +x of camera space is to the right of the picture, +y down it (row 0 is the top row).
struct Camera {
    DVec3 position{0};
    DVec3 look_at{0};
    DVec3 up{0, 0, -1};                 // the direction that points *down* the picture; `sky` in scenes is its negative
    double fov = 25;                    // degrees between the viewing axis and the left or right edge, 0 < fov < 90
    std::optional<double> aspectratio;  // picture width / height; without it the picture's own
    bool operator==(const Camera&) const = default;
};

/// The orthonormal axes of a camera: `right` and `down` the picture, `forward` into it; and the picture plane's
/// half sizes at distance 1. The ray through the picture point (sx, sy) in [-1,1]^2 (left to right, top to bottom) has
/// the direction forward + sx * tan_x * right + sy * tan_y * down.
struct CameraFrame {
    DVec3 right, down, forward;
    double tan_x, tan_y;
};
/// `aspect` is used where the camera has no aspectratio of its own. Requires position != look_at and up not parallel
/// to the viewing direction (see `degenerate`).
CameraFrame frame_of(const Camera& camera, double aspect);

/// Why the camera is degenerate ("position equals look_at", "up is parallel to ..."), or nullptr if it is not.
const char* degenerate(const Camera& camera);

/// A key of a flythrough: a time in seconds and the camera then. Values that are not given are those of the scene's
/// camera.
struct Keyframe {
    double time = 0;
    DVec3 position{0};
    DVec3 look_at{0};
    std::optional<double> fov;
    std::optional<DVec3> up;
    bool operator==(const Keyframe&) const = default;
};

/// The camera at a key; `scene_camera` supplies what the key does not give.
Camera camera_of(const Keyframe& key, const Camera& scene_camera);

/// A path through keys on a centripetal Catmull-Rom spline; times increase strictly.
struct Flythrough {
    double duration = 0;  // seconds, at least the last key's time
    bool loop = false;    // the path is a closed curve that returns to its first key after `duration`
    std::vector<Keyframe> keys;
    bool operator==(const Flythrough&) const = default;
};

/// The camera at `time` seconds: before the first key that of the first key, after the last key that of the last. A
/// path that loops repeats every `duration`, also before its first key. At the time of a key it is exactly the key's
/// camera. Between keys position and look_at follow smooth curves, fov and up stay between the values of the two keys,
/// and where the result would be degenerate it takes its axes from a moment before or after.
Camera camera_at(const Flythrough& path, const Camera& scene_camera, double time);

}  // namespace strahl
