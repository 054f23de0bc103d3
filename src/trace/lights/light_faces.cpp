#include "trace/lights/light_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "num/vec_math.h"

namespace strahl {

Basis basis_around(const DVec3& axis) {
    const DVec3 other = std::abs(axis.x) < .6 ? DVec3(1, 0, 0) : DVec3(0, 1, 0);
    const DVec3 right = normalize(cross_product(axis, other));
    return {right, cross_product(axis, right), axis};
}
std::vector<Basis> cube_around(const Basis& basis) {
    const auto& [right, up, axis] = basis;
    return {{right, up, axis},  {right, up, -axis}, {up, axis, right},
            {up, axis, -right}, {axis, right, up},  {axis, right, -up}};
}

Slopes slopes_of(double x, double z, double radius, double limit) {
    const double squared = x * x + z * z, inner = radius * radius;
    if (squared < 1.001 * inner) return {-limit, limit};
    Slopes slopes;
    if (z > 1.01 * radius) {
        const double root = radius * std::sqrt(squared - inner), per = 1 / (z * z - inner);
        slopes = {(x * z - root) * per, (x * z + root) * per};
    } else {
        const double middle = std::atan2(x, z), half = std::asin(radius / std::sqrt(squared)), most = std::atan(limit);
        if (middle - half > most || middle + half < -most) return {limit, -limit};
        slopes = {middle - half > -most ? std::tan(middle - half) : -limit,
                  middle + half < most ? std::tan(middle + half) : limit};
    }
    return {std::max(slopes.low, -limit), std::min(slopes.high, limit)};
}

double steepest_slope(const DVec3& centre, double radius, const DVec3& axis) {
    const double z = dot_product(axis, centre);
    if (!(z > 1.1 * radius)) return std::numeric_limits<double>::infinity();
    const double off = std::sqrt(std::max(0., dot_product(centre, centre) - z * z));
    return (off + radius) / (z - radius);
}

}  // namespace strahl
