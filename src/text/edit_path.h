// Puts a flythrough into the text of a scene and leaves the rest of the text as it is.
#pragma once
#include <optional>
#include <string>

#include "scene/camera.h"
#include "text/write.h"

namespace strahl {

/// Returns the words of the camera in `text`, a scene without errors.
EyeWords eye_words(const std::string& text);

/// Returns `text`, a scene without errors, with this path as its flythrough, or with none. Comments and keys that the
/// text has already stay as they are written, and so does everything outside the block. A block that the text lacks is
/// added at the end. Keys are written in the words of the camera in the text, or in these.
std::string with_path(const std::string& text, const std::optional<Flythrough>& path,
                      std::optional<EyeWords> given = {});

}  // namespace strahl
