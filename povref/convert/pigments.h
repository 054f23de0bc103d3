// Colours and patterns as POV-Ray pigments.
#pragma once
#include <string>

#include "scene/scene.h"

namespace strahl {

/// What stands in `pigment { }`. `more` follows each colour, such as " transmit 0.5".
std::string pigment_text(const Pigment& pigment, const std::string& more = "");

/// `normal { }`, or nothing.
std::string normal_text(const Bump& bump);

/// The functions that pigments of the scene call; empty if there are none.
std::string function_section(const Scene& scene);

}  // namespace strahl
