// Boxes that contain all hits of a body.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "num/ray.h"
#include "scene/kinds/world_transform.h"

namespace strahl {

/// The box around a body, for kernels whose own space is stretched. If one side of a body is so short that rounding
/// exceeds it, their formulas find crossings on rays that pass far away. Whether bounding volumes rule these out
/// depends on the rays beside them, so crossings outside this box do not count.
template <class T>
struct HitBox {
    Vec3<T> middle, half;

    /// The hit box for a box in the world, larger by what the rounding of its numbers to T may cost, and by what that
    /// of points before they are placed cost; `local` is the box in the body's own space.
    static HitBox of(const Box& bounds, const Box& local, const WorldTransform& to_world) {
        constexpr double last_bit = std::numeric_limits<double>::epsilon();
        constexpr double rounding = 4 * std::max(static_cast<double>(std::numeric_limits<T>::epsilon()), last_bit);
        const DVec3 middle = to_world.place(bounds.centre()), size = bounds.size() * to_world.scale;
        DVec3 half;
        for (int c = 0; c < 3; ++c) {
            double terms = std::fabs(to_world.matrix[3][c]);
            for (int i = 0; i < 3; ++i)
                terms += std::fabs(to_world.matrix[i][c]) * std::max(std::fabs(local.low[i]), std::fabs(local.high[i]));
            half[c] = size[c] / 2 + rounding * (std::fabs(middle[c]) + size[c]) + 4 * last_bit * terms * to_world.scale;
        }
        return {cast<T>(middle), cast<T>(half)};
    }
    /// May rays, whose directions have the length 1, meet the ball around the box?
    template <class S>
    STRAHL_INLINE Mask<S> may_meet(const Ray<S>& ray) const {
        constexpr Element<S> last_bit = std::numeric_limits<Element<S>>::epsilon();
        const Vec3<S> away = ray.origin - splat<S>(middle);
        const S along = dot(away, ray.direction), far = dot(away, away);
        const Vec3<S> nearest = fma(-along, ray.direction, away);
        const S limit = fma(S(1024 * 64 * last_bit * last_bit), far, S(Element<S>(1.1) * dot(half, half)));
        return !((dot(nearest, nearest) > limit) | ((along > S(0)) & (far > limit)));
    }
    /// Is the point of the ray at `t` in the box, up to the rounding of t? `terms` is the sum of what t was added up
    /// from.
    template <class S>
    STRAHL_INLINE Mask<S> holds(const Ray<S>& ray, S t, S terms) const {
        const Vec3<S> p = fma(t, ray.direction, ray.origin - splat<S>(middle));
        const S slack = S(16 * std::numeric_limits<Element<S>>::epsilon()) * terms;
        return (abs(p.x) <= S(half.x) + slack) & (abs(p.y) <= S(half.y) + slack) & (abs(p.z) <= S(half.z) + slack);
    }
};

}  // namespace strahl
