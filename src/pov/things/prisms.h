// Contours of prisms and lathes.
#pragma once
#include <span>
#include <vector>

#include "pov/things/surfaces.h"
#include "pov/things/warps.h"
#include "scene/kinds/contours.h"

namespace strahl::pov {

/// Returns the contours that the splines of a prism are, or that of a lathe, which goes on where it is closed.
std::vector<Contour> contours_of(SplineKind kind, std::span<const Point2> points, bool turned = false);
/// Returns the contour of a sor, whose squared radius is a cubic of the height between points, as cubic curves: these
/// are off by no more than 1e-8 of the largest radius. It is empty if heights of points are equal.
Contour contour_of_sor(std::span<const Point2> points, bool open);
/// Returns the moves to places by uv of a lathe, and of a sor: around it, and along the pieces of its spline, or by the
/// heights of those of a sor, whose flat ends are at -1 to 0 and at 1 to 2.
Moves places_of_lathe(SplineKind kind, std::span<const Point2> points);
Moves places_of_sor(std::span<const Point2> points);
/// Returns the contour of an ovus: of balls of two radii, the upper one's middle at the top of the lower one, and of an
/// arc that touches both, whose radius is twice the larger one. Its cubic curves are off by no more than 1e-8 of it.
Contour contour_of_ovus(double bottom, double top);
/// How far surfaces reach that have no end.
inline constexpr double endless = 1e4;
/// Returns the contours of the surface whose squared radius at the height h is `constant` + `linear` h + `square` h^2,
/// up to a distance `endless` from its middle, for a `square` that is not below 0: a paraboloid, which is exact, or a
/// hyperboloid, whose cubic curves are off by no more than 2e-8 of the radius.
std::vector<Contour> contours_of_quadric(double square, double linear, double constant);

}  // namespace strahl::pov
