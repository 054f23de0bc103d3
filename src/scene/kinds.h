// The list of shape kinds: everything that treats shapes alike (parser, writer, world, export, tests) derives from it.
#pragma once
#include <variant>

#include "scene/cylinder.h"
#include "scene/plane.h"
#include "scene/sphere.h"

namespace strahl {

using Shape = std::variant<Sphere, Plane, Cylinder>;

}  // namespace strahl
