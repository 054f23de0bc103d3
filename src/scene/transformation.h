// Rotations, translations and scalings of a primitive, kept in the order written.
#pragma once
#include <glm/mat4x4.hpp>
#include <span>
#include <variant>

#include "num/vec.h"

namespace strahl {

/// Turns about x, then y, then z, in degrees, right-handed (counter-clockwise seen from the tip of the axis).
struct Rotate {
    DVec3 degrees{0};
    bool operator==(const Rotate&) const = default;
};
struct Translate {
    DVec3 by{0};
    bool operator==(const Translate&) const = default;
};
/// No component is 0. Negative components mirror.
struct Scale {
    DVec3 by{1};
    bool operator==(const Scale&) const = default;
};
using Transformation = std::variant<Rotate, Translate, Scale>;

/// The product of all steps: column vectors, world = matrix * (local, 1). Multiples of 90 degrees are exact.
glm::dmat4 matrix(std::span<const Transformation> steps);

/// The factor by which lengths grow if all steps keep angles (|x| = |y| = |z| in every Scale), else 0.
double similarity(std::span<const Transformation> steps);

}  // namespace strahl
