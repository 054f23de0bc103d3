// Puts music and the keys of tracks into texts, and leaves the rest of these as it is written.
#pragma once
#include <string>

#include "scene/motion/track.h"

namespace strahl {

/// Returns `text`, a scene without errors, with this music. A block that the text lacks is added behind the camera.
std::string with_music(const std::string& text, const Music& music);

/// Returns `text`, that of a file of tracks without errors, in which this track has these keys. A track without keys is
/// removed, and one that the text lacks is added at the end.
std::string with_keys(const std::string& text, const Track& track);

}  // namespace strahl
