// The solid patterns that POV-Ray's patterns are.
#pragma once
#include <optional>

#include "pov/things/textures.h"
#include "scene/solid/solid.h"

namespace strahl::pov {

/// Returns the solid pattern that has a pattern's values, if there is one, in the space behind all warps.
/// `bends`: it bends normals. `generator` is the scene's noise_generator.
std::optional<SolidPattern> solid_of(const Blend& blend, bool bends, int generator);

/// Returns a pattern whose values come from a function and stay as they are.
SolidPattern of_function(std::shared_ptr<const SolidFunction> function);

/// Makes the values that scene text has no words for, and keeps them in the pattern, so that its copies share them.
void keep_values(Blend& blend, bool bends, int generator);

/// Returns the turbulence of a pattern as a warp.
TurbulenceWarp turbulence_of(const Blend& blend);

}  // namespace strahl::pov
