// Hands on the camera: flying and orbiting, as functions from camera to camera.
#pragma once
#include "scene/camera.h"

namespace strahl {

/// What the hands want of the camera in one moment.
struct Hands {
    DVec3 push{0};                  // to the right of the picture, up, and into it
    double right = 0, upwards = 0;  // turns in radians
    bool operator==(const Hands&) const = default;
};

/// Position and look_at go together; `push` is in units of the scene, `up` the axis of turns to the right. It never
/// looks steeper than 89 degrees (or than it did).
Camera fly(const Camera& camera, const Hands& hands);

/// Goes around look_at: `push` to the right and up are radians too, into the picture is a share of the way there.
Camera orbit(const Camera& camera, const Hands& hands);

/// A speed in units per second that suits the scene: what is looked at is reached in three seconds.
double natural_speed(const Camera& camera);

}  // namespace strahl
