// Converts colours and patterns to POV-Ray pigments.
#pragma once
#include <string>

#include "scene/scene.h"

namespace strahl {

/// Returns the content of `pigment { }`. `more` follows each colour, such as " transmit 0.5".
std::string pigment_text(const Pigment& pigment, const std::string& more = "");

/// Returns `normal { }`, or an empty text.
std::string normal_text(const Bump& bump);

/// Returns the functions that pigments of the scene call; empty if there are none.
std::string function_section(const Scene& scene);

}  // namespace strahl
