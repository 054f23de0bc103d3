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
/// A moment of a motion: what is scaled, then turned, then moved so at that time.
struct MotionKey {
    double time = 0;  // seconds
    DVec3 translate{0}, rotate{0}, scale{1};
    std::vector<Follow> follows{};  // only of a motion of one key: its numbers that follow tracks
    bool operator==(const MotionKey&) const = default;
};
/// A transformation that changes with time, see scene/motion/motion.h. Either times rise strictly, there are two keys or more,
/// and no component of a scale changes its sign; or there is one key, numbers of which follow tracks.
struct Motion {
    std::vector<MotionKey> keys;
    bool operator==(const Motion&) const = default;
};
using Transformation = std::variant<Rotate, Translate, Scale, Motion>;

/// The product of all steps: column vectors, world = matrix * (local, 1). Multiples of 90 degrees are exact. A motion
/// is as at time 0.
glm::dmat4 matrix(std::span<const Transformation> steps);

/// The factor by which lengths grow if all steps keep angles (|x| = |y| = |z| in every Scale), else 0. A motion is as
/// at time 0.
double similarity(std::span<const Transformation> steps);

}  // namespace strahl
