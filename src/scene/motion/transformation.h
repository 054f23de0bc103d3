// Rotations, translations, scalings and motions of a primitive, kept in the order written.
#pragma once
#include <glm/mat4x4.hpp>
#include <span>
#include <variant>
#include <vector>

#include "num/vec.h"
#include "scene/motion/track.h"

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
/// A key of a motion: at this time the body is scaled, then rotated, then moved so.
struct MotionKey {
    double time = 0;  // seconds
    DVec3 translate{0}, rotate{0}, scale{1};
    std::vector<Follow> follows{};  // numbers of it that follow tracks; only if it is the only key
    double ease = 0;                // by what share the movement is slower here, see eased()
    bool operator==(const MotionKey&) const = default;
};
/// A transformation that changes with time, see scene/motion/motion.h. Either there are two or more keys, whose times
/// increase strictly and of which no component of the scale changes its sign; or there is one key with numbers that
/// follow tracks.
struct Motion {
    std::vector<MotionKey> keys;
    bool operator==(const Motion&) const = default;
};
using Transformation = std::variant<Rotate, Translate, Scale, Motion>;

/// The product of all steps: column vectors, world = matrix * (local, 1). Multiples of 90 degrees are exact. A motion
/// counts as it is at time 0.
glm::dmat4 matrix(std::span<const Transformation> steps);

/// The factor by which lengths grow if all steps keep angles (|x| = |y| = |z| in every Scale), else 0. A motion is as
/// at time 0.
double similarity(std::span<const Transformation> steps);

}  // namespace strahl
