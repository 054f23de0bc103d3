// Capsules around bodies, by which thin bodies are told from small ones.
#pragma once
#include "num/bounding_box.h"

namespace strahl {

/// All points no further than `radius` from the line between two points.
struct Capsule {
    DVec3 from, to;
    double radius;
};

/// The capsule around a box, along its longest side.
Capsule capsule_around(const Box& box);

}  // namespace strahl
