// Shared by the tests of cones: the engine's crossings, and those in 113 bits.
#pragma once
#include <algorithm>
#include <cmath>

#include "scene/kinds/cone.h"
#include "tests/referee/cone.h"
#include "tests/stability/naive.h"
#include "tests/stability/stage.h"

namespace strahl::stability {

template <class T>
ConeKernel<T> kernel(const Cone& cone) {
    return ConeKernel<T>::frustum(cone.base, cone.axis(), cone.base_radius, cone.cap_radius, cone.height());
}
template <class T>
Span<T> ours(const Cone& cone, const Vec3<T>& o, const Vec3<T>& d) {
    return kernel<T>(cone).span(Ray<T>{o, d, T(-1)}, T(-1));
}
using naive::unit;

/// Returns the t at which the ray first meets the cone, in 113 bits, or infinity.
inline double exact(const Cone& cone, const DVec3& o, const DVec3& d) {
    Quadruple nearest = INFINITY;
    for (const auto& crossing : referee::crossings<Quadruple>(cone, {o, d}, -1))
        if (crossing.t > 0) nearest = std::min(nearest, crossing.t);
    return static_cast<double>(nearest);
}
/// Returns the cone grown by `by` on all sides.
inline Cone grown(const Cone& cone, double by) {
    const DVec3 a = cone.axis();
    const double slope = (cone.cap_radius - cone.base_radius) / cone.height(), out = by * std::hypot(1, slope);
    return {cone.base - by * a, std::max(0., cone.base_radius + out - by * slope), cone.cap + by * a,
            std::max(0., cone.cap_radius + out + by * slope)};
}

}  // namespace strahl::stability
