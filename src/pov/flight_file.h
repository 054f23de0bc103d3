// The flight of a scene of POV-Ray: a block `flythrough { ... }` in the file NAME.flight beside NAME.pov.
#pragma once
#include <optional>
#include <string>

#include "scene/scene.h"

namespace strahl::pov {

/// Returns the path of the flight's file.
std::string flight_path(const std::string& scene);

/// Reads the text of a flight, in the coordinates of the .pov. Nothing if there is no path in it. Throws FileError,
/// also for anything but a flythrough.
std::optional<Flythrough> parse_flight(const std::string& text, const std::string& path);

/// Returns the flight in the coordinates of the scene, which is the mirror image in z of the .pov if `mirrored`. Throws
/// FileError if the camera sees nothing at one of its keys.
Flythrough flight_in(const Scene& scene, bool mirrored, Flythrough flight, const std::string& path);

/// Returns `text`, which may be empty, with this path in place of the one in it, or with none. Comments stay.
std::string with_flight(const std::string& text, const std::optional<Flythrough>& path, bool mirrored);

}  // namespace strahl::pov
