// Reads the scene that a command names.
#pragma once
#include <string>

#include "scene/scene.h"

namespace strahl {

/// Returns the name of a scene file for messages: "-" is standard input.
inline std::string shown_name(const std::string& path) { return path == "-" ? "standard input" : path; }

/// Reads a scene and its pictures from a file, or from standard input for "-". Throws FileError.
Scene load_scene(const std::string& path);

}  // namespace strahl
