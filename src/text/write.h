// From Scene to scene text.
#pragma once
#include <string>

#include "scene/scene.h"

namespace strahl {

/// Text that parses to an equal Scene, with numbers in their shortest exact form. Saved tracks are not part of it.
std::string write_scene(const Scene& scene);

/// Only the `camera { ... }` or `flythrough { ... }` block; the window prints these for pasting.
std::string write_camera(const Camera& camera, const std::vector<Follow>& follows = {});
std::string write_flythrough(const Flythrough& path);
/// "key { time 2  position ... }"
std::string write_key(const Keyframe& key);

}  // namespace strahl
