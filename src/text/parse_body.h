// Parses the text of one body anew, in place of the whole scene.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "scene/scene.h"
#include "text/reading/scene_files.h"

namespace strahl {

/// Returns the scene with another body in place of one of its bodies: what parse_scene() would make of the whole text
/// in which the body's block is `block`. `context` is the text of the definitions and defaults before it, and `file`
/// that of the scene. Returns nothing if that is uncertain, or an error: for bodies that follow tracks or name beats,
/// or whose materials are those of others too. Takes a twentieth of the time in a scene of 10,000 bodies.
std::optional<Scene> with_body(const Scene& scene, int body, const std::string& context, const std::string& block,
                               std::string_view file, const ReadPixels& read_pixels);

}  // namespace strahl
