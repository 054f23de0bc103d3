// Contours of prisms.
#pragma once
#include <span>
#include <vector>

#include "pov/things/surfaces.h"
#include "scene/kinds/contours.h"

namespace strahl::pov {

/// Returns the contours that the splines of a prism are.
std::vector<Contour> contours_of(SplineKind kind, std::span<const Point2> points);

}  // namespace strahl::pov
