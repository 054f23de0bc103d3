// Scene in, scene text out.
#pragma once
#include <string>

#include "scene/scene.h"

namespace strahl {

/// Text that parses to an equal Scene (numbers in their shortest exact form).
std::string write_scene(const Scene& scene);

/// Only the `camera { ... }` or `flythrough { ... }` block, as the window prints them for pasting.
std::string write_camera(const Camera& camera);
std::string write_flythrough(const Flythrough& path);

}  // namespace strahl
