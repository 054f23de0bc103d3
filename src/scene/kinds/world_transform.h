// The transformation from a primitive's own space into the world's.
#pragma once
#include <cmath>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "num/bounding_box.h"
#include "num/vec_math.h"

namespace strahl {

/// The box around a transformed box. Rounding keeps order, so the least sums are those of the least terms, added in the
/// order of transform_point.
inline Box transformed(const Box& local, const glm::dmat4& m) {
    Box along[3];
    for (int i = 0; i < 3; ++i) along[i].add(DVec3(m[i]) * local.low[i]), along[i].add(DVec3(m[i]) * local.high[i]);
    const DVec3 moved(m[3]);
    return {(along[0].low + along[1].low) + (along[2].low + moved),
            (along[0].high + along[1].high) + (along[2].high + moved)};
}

/// The half-space on the side of a plane that its unit normal points away from. `point` is on the plane.
struct HalfSpace {
    DVec3 point{0}, normal{0, 0, 1};
};

/// world = (matrix * (own, 1) - origin) * scale.
struct WorldTransform {
    glm::dmat4 matrix{1};
    double similarity = 1;  // the factor by which `matrix` scales lengths, or 0 if it does not keep shapes similar
    DVec3 origin{0};
    double scale = 1;

    bool similar() const { return similarity > 0; }
    DVec3 point(const DVec3& p) const { return place(transform_point(matrix, p)); }
    /// Shifts and scales a point that `matrix` has been applied to.
    DVec3 place(const DVec3& p) const { return (p - origin) * scale; }
    double length(double x) const { return x * similarity * scale; }
    /// The unit vector along a transformed direction.
    DVec3 direction(const DVec3& v) const {
        const DVec3 turned = glm::dmat3(matrix) * v;
        return turned / std::sqrt(dot_product(turned, turned));
    }
};

template <class T>
Vec3<T> cast(const DVec3& v) {
    return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}
/// Converts a unit vector to one of T's digits: in long double the length of double's is 1 to half of the digits alone,
/// and whether a point is on a body would depend on how it was computed.
template <class T>
Vec3<T> cast_unit(const DVec3& v) {
    const Vec3<T> u = cast<T>(v);
    if constexpr (std::numeric_limits<T>::digits <= std::numeric_limits<double>::digits)
        return u;
    else
        return T(1) / std::sqrt(u.x * u.x + u.y * u.y + u.z * u.z) * u;
}

}  // namespace strahl
