// Computes how flying and orbiting move a camera.
#include "show/session/camera_control.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "num/vec_math.h"
#include "text/reading/parameter.h"

namespace strahl {
namespace {

struct Axes {
    DVec3 forward, level, right, up;  // `level` is the horizontal part of forward
    double elevation;                 // radians
};
Axes axes_of(const Camera& camera) {
    const DVec3 up = DVec3(0) - normalize(camera.up);
    const DVec3 forward = frame_of(camera, 1).forward;
    const DVec3 right = frame_of(camera, 1).right;
    return {forward, cross_product(up, right), right, up, std::asin(std::clamp(dot_product(forward, up), -1., 1.))};
}

/// The viewing direction after a turn.
DVec3 turned(const Axes& axes, double right, double upwards) {
    const double steepest = std::max(std::numbers::pi * 89 / 180, std::abs(axes.elevation));
    const double rise = std::clamp(axes.elevation + upwards, -steepest, steepest);
    const DVec3 level = axes.level * std::cos(right) + axes.right * std::sin(right);
    return level * std::cos(rise) + axes.up * std::sin(rise);
}

/// `moved`, or `camera` if `moved` is degenerate, too far from the origin or too near to look_at.
Camera checked(const Camera& moved, const Camera& camera) {
    const double reach = std::max(length(moved.position), length(moved.look_at));
    const bool sound =
        reach <= largest_coordinate && length(moved.look_at - moved.position) > 1e-9 * reach && !degenerate(moved);
    return sound ? moved : camera;
}

}  // namespace

Camera pan(const Camera& camera, const glm::dvec2& pan) {
    const CameraFrame frame = frame_of(camera, 1);
    const double distance = length(camera.look_at - camera.position);
    const double half = angular(camera.projection) ? std::min(frame.tan_x, 1.) : frame.tan_x;
    // The width that an orthographic camera sees does not depend on the distance.
    const double width = 2 * half * (camera.projection == Projection::orthographic ? 1 : distance);
    const DVec3 step = -width * (pan.x * frame.right + pan.y * frame.down);
    Camera moved = camera;
    moved.position += step, moved.look_at += step;
    return checked(moved, camera);
}

Camera fly(const Camera& camera, const CameraInput& input) {
    if (input == CameraInput{}) return camera;
    const Axes axes = axes_of(camera);
    const DVec3 step = axes.right * input.push.x + axes.up * input.push.y + axes.forward * input.push.z;
    Camera moved = camera;
    moved.position += step;
    // Without a turn the direction is kept exactly.
    moved.look_at =
        input.right == 0 && input.upwards == 0
            ? camera.look_at + step
            : moved.position + turned(axes, input.right, input.upwards) * length(camera.look_at - camera.position);
    return checked(moved, camera);
}

Camera orbit(const Camera& camera, const CameraInput& input) {
    if (input == CameraInput{}) return camera;
    const Axes axes = axes_of(camera);
    const double distance = length(camera.look_at - camera.position) * std::exp(-input.push.z);
    Camera moved = camera;
    // Moving to the right around a point turns the view to the left.
    moved.position = camera.look_at - turned(axes, input.right - input.push.x, input.upwards - input.push.y) * distance;
    return checked(moved, camera);
}

Camera seen_from(const Camera& camera, int side) {
    const Axes axes = axes_of(camera);
    const DVec3 x = std::abs(axes.up.x) < .9 ? DVec3(1, 0, 0) : DVec3(0, 1, 0);
    const DVec3 right = normalize(x - dot_product(x, axes.up) * axes.up), front = cross_product(axes.up, right);
    constexpr double steep = std::numbers::pi * 89 / 180;
    const DVec3 direction = side == 1   ? front
                            : side == 3 ? DVec3(0) - right
                            : side == 7 ? std::cos(steep) * front - std::sin(steep) * axes.up
                                        : DVec3(0) - axes.forward;
    Camera moved = camera;
    moved.position = camera.look_at - direction * length(camera.look_at - camera.position);
    return checked(moved, camera);
}

double default_speed(const Camera& camera) { return length(camera.look_at - camera.position) / 3; }

}  // namespace strahl
