// Reads the scene that a command names.
#pragma once
#include <optional>
#include <span>
#include <string>

#include "pov/open_scene.h"
#include "scene/scene.h"

namespace strahl {

/// Returns the name of a scene file for messages: "-" is standard input.
inline std::string shown_name(const std::string& path) { return path == "-" ? "standard input" : path; }

/// Reads a scene and its pictures from a file, or from standard input for "-". Tells the notes about it, see
/// OpenedScene. Throws FileError. A .pov is read as it is at the time.
OpenedScene load_opened(const std::string& path, OpeningOptions options, std::optional<double> time = {});
/// Returns the scene of load_opened() alone.
Scene load_scene(const std::string& path, OpeningOptions options, std::optional<double> time = {});

/// Prints warnings on standard error.
void print_warnings(std::span<const std::string> warnings);
void print_warnings(std::span<const Message> warnings);
/// Prints the notes about a scene: all, or the first ones.
void tell_notes(const OpenedScene& scene, bool all);

}  // namespace strahl
