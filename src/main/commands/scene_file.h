// Reads the scene that a command names.
#pragma once
#include <string>

#include "pov/open_scene.h"
#include "scene/scene.h"

namespace strahl {

/// Returns the name of a scene file for messages: "-" is standard input.
inline std::string shown_name(const std::string& path) { return path == "-" ? "standard input" : path; }

/// Returns the path of an installed scene to show where none is named. Throws UsageError if it is not there.
std::string example_scene();

/// Reads a scene and its pictures from a file, or from standard input for "-". Of a scene of POV-Ray it tells, on
/// standard error, what is approximated or left out. Throws FileError.
Scene load_scene(const std::string& path, const OpeningOptions& options);

/// Tells what is approximated or left out in a scene of POV-Ray: all, or the first notes.
void tell_notes(const OpenedScene& scene, bool all);

}  // namespace strahl
