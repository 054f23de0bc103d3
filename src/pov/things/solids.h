// The solid patterns that POV-Ray's patterns are.
#pragma once
#include <optional>

#include "pov/things/textures.h"
#include "scene/solid.h"

namespace strahl::pov {

/// Returns the solid pattern that has a pattern's values, if there is one; a poly_wave is a ramp. `bends`: it bends
/// normals. `generator` is the scene's noise_generator.
std::optional<SolidPattern> solid_of(const Blend& blend, bool bends, int generator);

}  // namespace strahl::pov
