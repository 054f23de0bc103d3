// Scenes in which bodies and lights move: finds what changes, and the scene at a given time.
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

/// All that changes with time in a scene except its camera: bodies and lights that move or have parts that do, and what
/// follows tracks.
struct Movers {
    explicit Movers(const Scene& scene);
    bool any() const { return !bodies.empty() || !lights.empty() || !materials.empty() || air; }
    std::vector<std::int32_t> bodies, lights, materials;  // their numbers
    bool air = false;                                     // the background or the fog
    double last_key = 0;                                  // in seconds, of motions and of the tracks that are followed
};
/// The tracks that numbers of a scene follow, without duplicates, in the order of the scene.
std::vector<std::string> followed_tracks(const Scene& scene);

/// A time of a scene: seconds, and the values of the tracks then. If the flythrough loops, the scene repeats with it.
struct SceneTime {
    double seconds = 0;
    TrackValues tracks;
};
/// `tracks` replace the scene's own.
SceneTime scene_time(const Scene& scene, double seconds, const std::vector<Track>* tracks = nullptr);

/// Set the bodies, or all the rest, of `now`, a copy of `scene`, to a time.
void move_bodies(Scene& now, const Scene& scene, std::span<const std::int32_t> bodies, const SceneTime& time);
void move_others(Scene& now, const Scene& scene, const Movers& movers, const SceneTime& time);

/// The scene at a time, in which nothing moves: bodies and lights have the transformations and numbers of that time.
/// The camera and the flythrough stay as they are.
Scene at(const Scene& scene, double time);
/// The scene with all numbers that follow tracks as at that time, also those of its camera; motions stay.
Scene without_tracks(const Scene& scene, double time);

/// The camera at a time of the scene's flythrough, or the scene's own camera at that time if there is none. Without a
/// time: its own camera at time 0.
Camera camera_at(const Scene& scene, std::optional<double> time);
/// The scene's own camera at a time; only tracks change it. `tracks` replace the scene's own.
Camera own_camera_at(const Scene& scene, double time, const std::vector<Track>* tracks = nullptr);

/// The flythrough of a scene; if it does not loop it lasts until the last key of motions and tracks. If only something
/// else moves: a flythrough without keys, on which the camera is free. Nothing if nothing moves.
std::optional<Flythrough> flight_of(const Scene& scene);
/// Returns flight_of(scene). Throws UsageError if nothing moves: `option` needs a scene that moves, and `file` is none.
Flythrough flight_for(const char* option, const Scene& scene, const std::string& file);

}  // namespace strahl
