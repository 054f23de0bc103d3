// Evaluates motions: transformations that change with time.
#pragma once
#include <array>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "scene/motion/curve.h"
#include "scene/motion/transformation.h"

namespace strahl {

/// Sets the numbers that follow tracks with values. Factors of a scale are limited to 1e-4 to 1e4, or -1e4 to -1e-4.
void follow(MotionKey& key, const TrackValues& values);

/// The motion at a time in seconds: the first key before it, the last key after it, and at the time of a key exactly
/// that key. Between keys `translate` follows the curve that a camera does, factors stay between those of the two keys,
/// and rotations are unit quaternions on a curve of the same kind, which goes from each key to the next by less than
/// half a turn or by half a turn. Numbers that follow tracks are those of `tracks`.
MotionKey key_at(const Motion& motion, double time, const TrackValues& tracks = {});
/// Returns the transformations that a key or motions at a time stand for, without those that change nothing.
std::vector<Transformation> steps_of(const MotionKey& key);
std::vector<Transformation> at(const Motion& motion, double time, const TrackValues& tracks = {});
std::vector<Transformation> at(std::span<const Transformation> steps, double time, const TrackValues& tracks = {});
/// Replaces the contents of `still` by what `at` returns, and reuses its memory.
void set_at(std::vector<Transformation>& still, std::span<const Transformation> steps, double time,
            const TrackValues& tracks);
/// The times of the keys of all motions among them.
std::vector<double> key_times(std::span<const Transformation> steps);

/// The curve of rotations between two keys (M.-J. Kim, M.-S. Kim, S. Y. Shin, "A General Construction Scheme for Unit
/// Quaternion Curves with Simple High Order Derivatives", 1995), h being its share: the rotation of the first key
/// after those about `about` by their lengths times 1 - (1 - h)^3, h^2 (3 - 2 h) and h^3, in radians, the last one
/// first.
struct RotationCurve {
    Spline spline;
    glm::dquat start{1, 0, 0, 0};
    std::array<DVec3, 3> about{};
};
RotationCurve rotation_curve(const Window<MotionKey>& window);

}  // namespace strahl
