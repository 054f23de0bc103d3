// Bodies and lights that move: the scene as it is at a moment.
#pragma once
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/curve.h"
#include "scene/scene.h"

namespace strahl {

/// What a motion is at a time in seconds: before the first key as at that, after the last one as at that, and at the
/// time of a key exactly what that says. Between keys `translate` follows the curve that a camera does, factors stay
/// between those of the two keys, and rotations are unit quaternions on a curve of the same kind, which goes from each
/// key to the next by less than half a turn or by half a turn.
MotionKey key_at(const Motion& motion, double time);
/// The same as transformations, of which those that change nothing are left out.
std::vector<Transformation> steps_of(const MotionKey& key);
std::vector<Transformation> at(const Motion& motion, double time);
std::vector<Transformation> at(std::span<const Transformation> steps, double time);
/// The times of the keys of all motions among them.
std::vector<double> key_times(std::span<const Transformation> steps);

/// The curve of rotations between two keys (M.-J. Kim, M.-S. Kim, S. Y. Shin, "A General Construction Scheme for Unit
/// Quaternion Curves with Simple High Order Derivatives", 1995), h being its share: the rotation of the first key
/// after those about `about` by their lengths times 1 - (1 - h)^3, h^2 (3 - 2 h) and h^3, in radians, the last one
/// first.
struct RotationCurve {
    Spline spline;
    glm::dquat start{1, 0, 0, 0};
    std::array<DVec3, 3> about{};
};
RotationCurve rotation_curve(const Window<MotionKey>& window);

/// Does the body, or a part of it, have a motion?
bool moves(const Primitive& primitive);

/// The bodies and lights of a scene that move, or of which parts do.
struct Movers {
    explicit Movers(const Scene& scene);
    bool any() const { return !bodies.empty() || !lights.empty(); }
    std::vector<std::int32_t> bodies, lights;  // by number
    double last_key = 0;                       // seconds
};
/// Sets bodies or lights of `now`, a copy of `scene`, to a moment.
void move_bodies(Scene& now, const Scene& scene, std::span<const std::int32_t> bodies, double time);
void move_lights(Scene& now, const Scene& scene, std::span<const std::int32_t> lights, double time);

/// The scene of a moment, in which no body and no light moves: what is declared has the transformations of that moment.
/// A scene whose flythrough loops begins anew whenever that does. The camera and the flythrough are left as they are.
Scene at(const Scene& scene, double time);

/// The camera of a scene at a time of its flythrough, if it has one; without a time, or a flythrough, its own camera.
Camera camera_at(const Scene& scene, std::optional<double> time);

/// The flythrough of a scene, until the last key of its motions if it does not loop; for a scene of which only bodies
/// or lights move, one without keys, on which the camera is free. Nothing if nothing moves.
std::optional<Flythrough> flight_of(const Scene& scene);
/// The same of the scene in `file`. Throws UsageError if nothing moves, so that there is no use for an `option`.
Flythrough flight_for(const char* option, const Scene& scene, const std::string& file);

}  // namespace strahl
