// The light that a rectangle of which nothing is hidden sends to a point, in closed form.
#pragma once
#include <cmath>
#include <type_traits>

#include "num/vec.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns the mean of the unit vectors from the origin to the rectangle [x1, x2] x [y1, y2] at the height h >= 0: the
/// integrals of x / r, y / r and h / r in closed form.
template <class E>
Vec3<E> mean_direction(const E (&x)[2], const E (&y)[2], E h) {
    E r[2][2];
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) r[i][j] = std::sqrt(x[i] * x[i] + y[j] * y[j] + h * h);
    // The integral of 1 / r along an edge, from b1 to b2 at the squared distance p.
    const auto along = [](E b1, E r1, E b2, E r2, E p) {
        const auto sum = [p](E b, E r) { return b < 0 ? p / (r - b) : b + r; };
        return p > 0 ? std::log(sum(b2, r2) / sum(b1, r1)) : E(0);
    };
    Vec3<E> total{0};
    for (int i = 0; i < 2; ++i) {
        const E sign = i == 1 ? 1 : -1, p = x[i] * x[i] + h * h, q = y[i] * y[i] + h * h;
        const E along_y = along(y[0], r[i][0], y[1], r[i][1], p), along_x = along(x[0], r[0][i], x[1], r[1][i], q);
        total.x += sign * (y[1] * r[i][1] - y[0] * r[i][0] + p * along_y) / 2;
        total.y += sign * (x[1] * r[1][i] - x[0] * r[0][i] + q * along_x) / 2;
        total.z += sign * h * (x[i] * along_y + y[i] * along_x);
        for (int j = 0; h > 0 && j < 2; ++j) total.z -= (i == j ? h : -h) * h * std::atan(x[i] * y[j] / (h * r[i][j]));
    }
    return scale(1 / ((x[1] - x[0]) * (y[1] - y[0])), total);
}

/// Returns the mean of n.l over the rectangle with the edges u and v around `middle`, as seen from the origin; all of
/// it is above the surface. For a small one it is summed up at 4 by 4 points of Gauss and Legendre, for there the
/// closed form would cancel. The closed form is off by a unit of E for each time that one edge is as long as the other,
/// so the result is kept from being negative.
template <class T>
T mean_cosine(const Vec3<T>& normal, const Vec3<T>& middle, const Vec3<T>& u, const Vec3<T>& v) {
    const T width_squared = dot(u, u), height_squared = dot(v, v);
    if (dot(middle, middle) > T(1000) * max(width_squared, height_squared)) {
        constexpr T points[4]{T(-.861136311594052575), T(-.339981043584856265), T(.339981043584856265),
                              T(.861136311594052575)};
        constexpr T weights[4]{T(.173927422568726929), T(.326072577431273071), T(.326072577431273071),
                               T(.173927422568726929)};
        T sum(0);
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) {
                const Vec3<T> way = fma(points[i] / 2, u, fma(points[j] / 2, v, middle));
                sum += weights[i] * weights[j] * (dot(normal, way) / sqrt(dot(way, way)));
            }
        return sum;
    }
    using E = std::conditional_t<std::is_same_v<T, float>, double, T>;
    const auto wide = [](const Vec3<T>& a) { return Vec3<E>(E(a.x), E(a.y), E(a.z)); };
    const auto length = [](const Vec3<E>& a) { return std::sqrt(dot(a, a)); };
    const Vec3<E> to = wide(middle), w = cross(wide(u), wide(v)), n = wide(normal);
    const Vec3<E> axes[3]{scale(1 / length(wide(u)), wide(u)), scale(1 / length(wide(v)), wide(v)),
                          scale((dot(w, to) < 0 ? -1 : 1) / length(w), w)};
    // A strip as narrow as rounding would vanish. One a millionth of its distance wide has the same mean.
    const E x = dot(to, axes[0]), y = dot(to, axes[1]), least = E(5e-7) * length(to);
    const E half_x = max(length(wide(u)) / 2, least), half_y = max(length(wide(v)) / 2, least);
    const Vec3<E> mean = mean_direction({x - half_x, x + half_x}, {y - half_y, y + half_y}, dot(to, axes[2]));
    E cosine(0);
    for (int c = 0; c < 3; ++c) cosine += mean[c] * dot(n, axes[c]);
    return static_cast<T>(max(cosine, E(0)));
}

}  // namespace strahl::inline STRAHL_LEVEL
