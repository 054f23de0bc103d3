// Reads the scene that a command names.
#pragma once
#include <string>

#include "scene/scene.h"

namespace strahl {

/// Returns the name of a scene file for messages: "-" is standard input.
inline std::string shown_name(const std::string& path) { return path == "-" ? "standard input" : path; }

/// Returns the path of an installed scene to show where none is named. Throws UsageError if it is not there.
std::string example_scene();

/// Reads a scene and its pictures from a file, or from standard input for "-". Throws FileError.
Scene load_scene(const std::string& path);

}  // namespace strahl
