// The motions of a scene, and changes of their keys in the scene's text. The rest of the text stays as it is written.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "text/place_body.h"

namespace strahl {

/// A motion of a body or a light of the top level.
struct SceneMotion {
    TopBlock what = TopBlock::body;
    int number = 0;               // of the body or the light
    int from_last = 0;            // number of motions of the body that follow this one
    std::string name{};           // "sphere 3"
    std::vector<double> times{};  // of its keys, in seconds
};
/// Returns the motions of lights and bodies, 100 at most: those with keys, which follow no tracks. Motions of parts are
/// not among them.
std::vector<SceneMotion> motions_of(const Scene& scene);

// These return the text as it is if the motion does not stand in the block of the body or the light itself, as those of
// definitions do. `scene` is that of the text.

/// Returns the text in which a key is at another time, in steps of 1/100 s or of a beat and between the keys beside it.
std::string with_key_time(const std::string& text, const Scene& scene, const SceneMotion& motion, std::size_t key,
                          double seconds);
/// Returns the text with another key, of what the motion is at this time.
std::string with_motion_key(const std::string& text, const Scene& scene, const SceneMotion& motion, double seconds);
/// Returns the text without a key, unless only two are left.
std::string without_motion_key(const std::string& text, const SceneMotion& motion, std::size_t key);

}  // namespace strahl
