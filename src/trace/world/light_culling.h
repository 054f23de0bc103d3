// Finds which of few bodies can be between a light and a body, and how lights see them.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "num/bounding_box.h"
#include "trace/world/world.h"

namespace strahl {

/// The rounding unit of numbers used for culling, which are computed in double and rounded to T.
template <class T>
inline constexpr double culling_unit = static_cast<double>(
    std::max<long double>(std::numeric_limits<T>::epsilon(), std::numeric_limits<double>::epsilon()));

/// A body's surroundings in world coordinates: a ball and a box, or for a plane normal . x = distance. Those of other
/// unbounded bodies are infinite.
struct BoundingVolume {
    Box box;
    Ball ball;
    bool plane = false;
    DVec3 normal{0};
    double distance = 0;
    bool bounded() const { return !plane && std::isfinite(ball.radius); }
};

/// The place of a light, or the unit direction towards parallel light.
struct LightPlace {
    DVec3 point{0};
    bool parallel = false;
};

/// Returns a cone in which a light sees the body, whose coordinates may be off by `margin`.
template <class T>
LightCone<T> cone_of(const BoundingVolume& body, const LightPlace& light, double margin);

/// Unit vectors across parallel light, and the one towards it.
struct LightAxes {
    DVec3 u{0}, v{0}, towards{0};
};
/// Returns axes along which the shadows of these bodies have small rectangles: of those along the shadow of an axis of
/// the world the best, as bodies often stand or lie along one.
LightAxes axes_across(const std::vector<BoundingVolume>& bodies, const DVec3& towards);

/// Returns the shadows in parallel light of bodies whose coordinates may be off by `margin`.
template <class T>
ParallelShadows<T> shadows_of(const std::vector<BoundingVolume>& bodies, const LightAxes& axes, double margin);

/// Returns the bodies that may be between a light and points of bodies[body], itself included unless it is a plane.
BodySet occluders_of(const std::vector<BoundingVolume>& bodies, std::size_t body, const LightPlace& light,
                     double margin);

/// Returns whether bodies[body] is bounded and apart from all others, and no plane crosses it.
bool isolated(const std::vector<BoundingVolume>& bodies, std::size_t body, double margin);

}  // namespace strahl
