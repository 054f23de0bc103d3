// The numbers of a body that stand in the text of a scene of POV-Ray, for changing them in place.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "text/body_text.h"

namespace strahl::pov {

/// Returns the numbers and vectors in the block of a body or a light whose word stands at a place, in its parts, and in
/// what it names that is declared once, with the words before them. Those of a declaration have that as their source.
/// Numbers that are computed are not among them: operands, arguments of functions and maps, and all of a block with
/// directives.
std::vector<BodyValue> literals_of(const std::string& text, std::size_t at);

}  // namespace strahl::pov
