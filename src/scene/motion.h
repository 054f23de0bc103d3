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
/// key to the next by less than half a turn or by half a turn. Numbers that follow tracks are those of `tracks`.
MotionKey key_at(const Motion& motion, double time, const TrackValues& tracks = {});
/// The same as transformations, of which those that change nothing are left out.
std::vector<Transformation> steps_of(const MotionKey& key);
std::vector<Transformation> at(const Motion& motion, double time, const TrackValues& tracks = {});
std::vector<Transformation> at(std::span<const Transformation> steps, double time, const TrackValues& tracks = {});
/// The same in place of what is in `still`, whose memory is used again.
void set_at(std::vector<Transformation>& still, std::span<const Transformation> steps, double time,
            const TrackValues& tracks);
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

/// What changes with time in a scene, but for its camera: bodies and lights that move or of which parts do, and what
/// follows tracks.
struct Movers {
    explicit Movers(const Scene& scene);
    bool any() const { return !bodies.empty() || !lights.empty() || !materials.empty() || air; }
    std::vector<std::int32_t> bodies, lights, materials;  // by number
    bool air = false;                                     // the background or the fog
    double last_key = 0;                                  // seconds, of motions and of the tracks that are followed
};
/// The tracks that numbers of a scene follow, without duplicates, in the order of the scene.
std::vector<std::string> followed_tracks(const Scene& scene);

/// A moment: seconds, and the values of the tracks. A scene whose flythrough loops begins anew whenever that does.
struct SceneTime {
    double seconds = 0;
    TrackValues tracks;
};
/// `tracks` are in place of the scene's own.
SceneTime scene_time(const Scene& scene, double seconds, const std::vector<Track>* tracks = nullptr);

/// Sets bodies, or all the rest, of `now`, a copy of `scene`, to a moment.
void move_bodies(Scene& now, const Scene& scene, std::span<const std::int32_t> bodies, const SceneTime& time);
void move_others(Scene& now, const Scene& scene, const Movers& movers, const SceneTime& time);

/// The scene of a moment, in which nothing moves: what is declared has the transformations and numbers of that moment.
/// The camera and the flythrough are left as they are.
Scene at(const Scene& scene, double time);
/// The scene with all that follows tracks as at that time, also its camera; motions stay.
Scene without_tracks(const Scene& scene, double time);

/// The camera of a scene at a time of its flythrough, if it has one; else its own camera at that time. Without a time
/// it is its own at time 0.
Camera camera_at(const Scene& scene, std::optional<double> time);
/// Its own camera at a time, which only tracks change. `tracks` are in place of the scene's own.
Camera own_camera_at(const Scene& scene, double time, const std::vector<Track>* tracks = nullptr);

/// The flythrough of a scene, until the last key of its motions and tracks if it does not loop; for a scene that has
/// none but in which something else moves, one without keys, on which the camera is free. Nothing if nothing moves.
std::optional<Flythrough> flight_of(const Scene& scene);
/// The same of the scene in `file`. Throws UsageError if nothing moves, so that there is no use for an `option`.
Flythrough flight_for(const char* option, const Scene& scene, const std::string& file);

}  // namespace strahl
