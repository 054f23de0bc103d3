// Writes scenes as text.
#pragma once
#include <string>

#include "scene/scene.h"

namespace strahl {

/// The words in which a camera or a key says its direction up and its angle of view.
struct EyeWords {
    bool sky = false, angle = false;  // instead of `up`, `fov`
};

/// Returns text that parses to an equal Scene, with numbers in their shortest exact form. The keys of tracks are not in
/// it: they have a file of their own.
std::string write_scene(const Scene& scene);

/// Returns only the block `camera { ... }` or `flythrough { ... }`, which the window prints for pasting.
std::string write_camera(const Camera& camera, const std::vector<Follow>& follows = {}, EyeWords words = {});
std::string write_flythrough(const Flythrough& path, EyeWords words = {});
/// "music { bpm 120  rows 8 }"
std::string write_music(const Music& music);
/// "key { time 2  position ... }"
std::string write_key(const Keyframe& key, EyeWords words = {});

}  // namespace strahl
