// Random scenes for the comparison with POV-Ray, each determined by its seed.
#pragma once
#include <cstdint>

#include "scene/scene.h"

namespace strahl {

/// A random scene (tests/referee/random_scene.h) of which no number is so small or so far away that POV-Ray's
/// tolerances decide the picture: bodies of any kind, composites in composites with materials of their own in their
/// parts, smooth meshes, fog, an eye in glass; far from the origin, larger or smaller, or with a plane at the horizon.
Scene scene_for_povray(std::uint64_t seed);

}  // namespace strahl
