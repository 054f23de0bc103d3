// The boxes that POV-Ray puts around bodies, which scenes ask for by min_extent() and max_extent().
#pragma once
#include "num/bounding_box.h"
#include "pov/things/objects.h"

namespace strahl::pov {

/// Returns the box of a body as POV-Ray has it: where it moves a box, and not the body, around what it moved.
Box extent_of(const ObjectThing& object);

}  // namespace strahl::pov
