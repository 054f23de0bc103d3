// One body with a degenerate value, in a pose that is hard for it.
#pragma once
#include <cstdint>
#include <string>

#include "scene/scene.h"

namespace strahl {

struct DegenerateScene {
    Scene scene;
    std::string words;     // the kind of the body, its pose and how the eye looks at it
    double condition = 1;  // its largest coordinate over the smallest length of the body
};

/// Makes the scene of a seed. The body is of any kind; its radii are equal, its sides next to nothing, its corners
/// nearly on a line: all that the language allows. It is turned, scaled, mirrored and moved, and the eye is near it,
/// far from it, in it, or looks along its axis. A ball beside it casts a shadow on it and is mirrored by it.
DegenerateScene degenerate_scene(std::uint64_t seed);

}  // namespace strahl
