// The functions that POV-Ray's functions.inc names: function { internal(NUMBER) }.
#pragma once
#include <memory>

#include "pov/language/user_function.h"

namespace strahl::pov {

/// Returns a function by its number, null if there is none. `generator` is that of f_noise3d,
/// which a scene may set later.
std::shared_ptr<const FunctionThing> internal_function(int number, std::shared_ptr<const int> generator);

}  // namespace strahl::pov
