// Puts the camera into the text of a scene and leaves the rest of the text as it is.
#pragma once
#include <optional>
#include <string>

#include "scene/camera.h"

namespace strahl {

/// Returns `text`, a scene without errors, with the place, the direction and the angle of this camera, as a key of a
/// flythrough has them, in the words that its block uses. A block that the text lacks is added at the beginning.
/// Nothing if numbers to be changed do not stand there, or follow tracks.
std::optional<std::string> with_camera(const std::string& text, const Keyframe& view);

/// Returns `text`, likewise, in which this point is in focus. A camera without a lens gets one with this aperture.
/// Nothing if the text has no block for its camera, or what changes follows tracks.
std::optional<std::string> with_focus_on(const std::string& text, const DVec3& point, double aperture);

}  // namespace strahl
