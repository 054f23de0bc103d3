// A flythrough put into the text of a scene, of which all else stays as it is.
#pragma once
#include <optional>
#include <string>

#include "scene/camera.h"

namespace strahl {

/// `text`, a scene without errors, with this path as its flythrough, or with none. Keys that the text has already, and
/// comments, stay as they are written; so does everything outside of the block. A block that the text lacks is added at
/// its end.
std::string with_path(const std::string& text, const std::optional<Flythrough>& path);

}  // namespace strahl
