// Scenes in which bodies and lights move: the scene as it is at a moment.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/motion/motion.h"
#include "scene/scene.h"

namespace strahl {

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
