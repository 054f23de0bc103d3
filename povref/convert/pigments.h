// Converts colours and patterns to POV-Ray pigments.
#pragma once
#include <functional>
#include <string>

#include "scene/scene.h"

namespace strahl {

/// Returns a pattern with a map, such as color_map, of what own(stop) says, or a list of items of this kind: not of
/// pictures.
std::string pattern_text(const Pattern& pattern, const std::string& map, const std::string& item,
                         const std::function<std::string(const ColorStop&)>& own);
/// Returns the content of `pigment { }`. `more` follows each colour, such as " transmit 0.5".
std::string pigment_text(const Pigment& pigment, const std::string& more = "");

/// Returns `normal { }`, or an empty text.
std::string normal_text(const Bump& bump);

/// Returns the functions that pigments of the scene call; empty if there are none.
std::string function_section(const Scene& scene);

}  // namespace strahl
