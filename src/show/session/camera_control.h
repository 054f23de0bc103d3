// Flying and orbiting: functions from camera to camera.
#pragma once
#include <glm/vec2.hpp>

#include "scene/camera.h"

namespace strahl {

/// A movement of the camera that the user asks for.
struct CameraInput {
    DVec3 push{0};                  // to the right of the picture, up, and into it
    double right = 0, upwards = 0;  // turns in radians
    bool around = false;            // look_at, in any style
    glm::dvec2 pan{0};              // what is seen at look_at, to the right and down, in widths of the picture
    bool operator==(const CameraInput&) const = default;
};

/// Moves position and look_at together, so that what is seen at look_at follows the drag `pan`.
Camera pan(const Camera& camera, const glm::dvec2& pan);

/// Moves position and look_at together. `push` is in units of the scene; turns to the right are about `up`. The view is
/// never steeper than 89 degrees (or than it was).
Camera fly(const Camera& camera, const CameraInput& input);

/// Moves around look_at. `push` to the right and up is in radians; into the picture it is a share of the distance.
Camera orbit(const Camera& camera, const CameraInput& input);

/// Turns the camera around look_at: 1 looks from the front, along the world's axis that is across the camera's `up` and
/// x; 3 from the right, 7 from above, 9 from the side opposite to its own. These are keys of a number pad.
Camera seen_from(const Camera& camera, int side);

/// Returns a speed, in units per second, that suits the scene: it reaches look_at in three seconds.
double default_speed(const Camera& camera);

}  // namespace strahl
