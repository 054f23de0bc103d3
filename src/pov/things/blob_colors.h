// Blends the pigments of a blob's lumps.
#pragma once
#include <memory>
#include <vector>

#include "pov/language/user_function.h"
#include "scene/kinds/blob/lump.h"

namespace strahl::pov {

/// Returns a function of a point with five results: the mean of the lumps' colours, each weighted by its field there.
/// As in POV-Ray a colour of less than `least` is left out.
std::shared_ptr<const FunctionThing> blob_colors(const std::vector<Lump>& lumps,
                                                 const std::vector<std::shared_ptr<const FunctionThing>>& colors,
                                                 double least);

}  // namespace strahl::pov
