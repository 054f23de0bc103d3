// Vector arithmetic in double and long double, for everything but the kernels.
//
// `dot` and `cross` of lanes.h fuse multiplications and additions; these round every step. The names differ so that
// neither replaces the other by accident, which would change the last bits of pictures.
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <glm/mat4x4.hpp>

#include "num/vec.h"

namespace strahl {

template <std::floating_point T>
T dot_product(const Vec3<T>& a, const Vec3<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <std::floating_point T>
Vec3<T> cross_product(const Vec3<T>& a, const Vec3<T>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Squares may overflow or underflow, but it takes a tenth of the time of length().
template <std::floating_point T>
T quick_length(const Vec3<T>& v) {
    return std::sqrt(dot_product(v, v));
}
/// Length 1, as far as quick_length() is right.
template <std::floating_point T>
Vec3<T> quick_unit(const Vec3<T>& v) {
    return 1 / quick_length(v) * v;
}
/// Squares neither overflow nor underflow.
inline double length(const DVec3& v) { return std::hypot(v.x, v.y, v.z); }

/// Length 1; not finite if `v` is zero. The largest component is divided out first, or denormal vectors would lose
/// their direction.
inline DVec3 normalize(const DVec3& v) {
    const double largest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    const DVec3 w = v / largest;
    return w / length(w);
}

/// Returns the sine of the angle between a unit vector and axis i. The root of 1 - v[i]^2 would lose small ones.
inline double sine_to_axis(const DVec3& v, int i) {
    const double a = v[(i + 1) % 3], b = v[(i + 2) % 3];
    return std::sqrt(a * a + b * b);
}

/// The point `p` under an affine transformation.
inline DVec3 transform_point(const glm::dmat4& m, const DVec3& p) { return DVec3(m * glm::dvec4(p, 1)); }

}  // namespace strahl
