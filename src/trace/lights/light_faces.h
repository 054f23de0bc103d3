// Faces of a grid of directions, and the parts of them that balls cover.
#pragma once
#include <vector>

#include "num/vec.h"

namespace strahl {

struct Slopes {
    double low, high;
};
/// Three perpendicular vectors of length 1; a face is around its axis.
struct Basis {
    DVec3 right, up, axis;
};
Basis basis_around(const DVec3& axis);
/// Returns the faces of a cube, the first around the axis of the basis.
std::vector<Basis> cube_around(const Basis& basis);

/// Returns the range of slopes x / z of a disc as seen from the origin, limited to +-limit; empty if low > high.
Slopes slopes_of(double x, double z, double radius, double limit);
/// Returns the steepest slope of a ball against the axis; infinite if the ball may reach behind the origin.
double steepest_slope(const DVec3& centre, double radius, const DVec3& axis);

}  // namespace strahl
