// Parses scene text.
#pragma once
#include <span>
#include <string_view>

#include "files/error.h"
#include "scene/scene.h"
#include "text/reading/messages.h"
#include "text/reading/scene_files.h"
#include "text/reading/text_limits.h"

namespace strahl {

/// Parses scene text (UTF-8). `file` is only the name used in messages. Throws FileError whose what() lists up to 10
/// errors, each as "file:line:column: message", the line itself, and a caret under the error. Columns count characters.
/// Without `read_pixels` it is an error to name a picture. `read` receives the names of files in the text, and
/// warnings. If the text was made of others, messages are about these.
Scene parse_scene(std::string_view text, std::string_view file, const TextLimits& limits = {},
                  const ReadPixels& read_pixels = {}, FilesRead* read = nullptr,
                  std::span<const TextOrigin> origins = {});

/// A camera for text that is part of a scene and parsed without the rest.
inline constexpr std::string_view stand_in_camera =
    "camera { position <0,0,0> look_at <0,1,0> sky <.31,.27,.9> fov 20 }\n";

}  // namespace strahl
