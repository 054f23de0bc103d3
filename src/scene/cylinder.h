// The closed cylinder between two points.
#pragma once
#include <cmath>
#include <tuple>

#include "num/box.h"
#include "num/ray.h"
#include "scene/field.h"

namespace strahl {

struct Cylinder {
    DVec3 base{0, 0, 0}, cap{0, 0, 1};
    double radius = 1;

    bool operator==(const Cylinder&) const = default;

    static constexpr const char* name = "cylinder";
    static constexpr auto fields =
        std::make_tuple(Field{"base", &Cylinder::base, "centre of one end"},
                        Field{"cap", &Cylinder::cap, "centre of the other end"},
                        Field{"radius", &Cylinder::radius, "the radius", Range::positive});
    const char* fault() const { return base == cap ? "base and cap are the same point" : nullptr; }
    DVec3 axis() const {
        const DVec3 a = cap - base;
        return a / std::hypot(a.x, a.y, a.z);
    }
    Box bounds() const {
        const DVec3 a = axis();
        Box box;
        for (int i = 0; i < 3; ++i) {
            const double reach = radius * std::sqrt(std::max(0., 1 - a[i] * a[i]));
            box.low[i] = std::min(base[i], cap[i]) - reach;
            box.high[i] = std::max(base[i], cap[i]) + reach;
        }
        return box;
    }
    bool contains(const DVec3& p) const {
        const DVec3 a = axis(), d = p - base, h = cap - base;
        const double along = a.x * d.x + a.y * d.y + a.z * d.z;
        const DVec3 across = d - along * a;
        return along > 0 && along < std::hypot(h.x, h.y, h.z) &&
               across.x * across.x + across.y * across.y + across.z * across.z < radius * radius;
    }
};

/// Faces: 0 the side, 1 the base, 2 the cap.
template <class T>
struct CylinderKernel {
    static constexpr int faces = 3;
    Vec3<T> base, axis;  // axis is of length 1
    T radius, height;

    // implemented with the engine
    template <class S>
    Span<S> span(const Ray<S>& ray, Mask<S> starts_here) const;
    template <class S>
    SurfacePoint<S> at(const Ray<S>& ray, S t, Mask<S> starts_here) const;
};

}  // namespace strahl
