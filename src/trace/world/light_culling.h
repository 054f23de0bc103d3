// Which of few bodies can be seen from a point, or be between a light and a body.
#pragma once
#include <algorithm>
#include <limits>
#include <vector>

#include "num/bounding_box.h"
#include "trace/world/world.h"

namespace strahl {

/// Of the numbers of what culls: they are rounded to T, and made in double.
template <class T>
inline constexpr double culling_unit = static_cast<double>(
    std::max<long double>(std::numeric_limits<T>::epsilon(), std::numeric_limits<double>::epsilon()));

/// A body's surroundings in world coordinates: a ball and a box, or for a plane normal . x = distance.
struct BoundingVolume {
    Box box;
    Ball ball;
    bool plane = false;
    DVec3 normal{0};
    double distance = 0;
};

/// Where a light is; of parallel light the unit direction towards it.
struct LightPlace {
    DVec3 point{0};
    bool parallel = false;
};

/// The body as seen from a light. Nothing of it is outside the cone, by more than coordinates may be off (`margin`).
template <class T>
LightCone<T> cone_of(const BoundingVolume& body, const LightPlace& light, double margin);

/// The bodies that may be between a light and points of bodies[body], itself included unless it is a plane.
BodySet occluders_of(const std::vector<BoundingVolume>& bodies, std::size_t body, const LightPlace& light,
                     double margin);

/// Is bodies[body] bounded and apart from all others, planes not crossing it either?
bool isolated(const std::vector<BoundingVolume>& bodies, std::size_t body, double margin);

}  // namespace strahl
