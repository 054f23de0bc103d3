// The referee's formulas for cones.
#pragma once
#include "scene/kinds/cone.h"
#include "tests/referee/line.h"

namespace strahl::referee {

/// A cone by its base, the direction of its axis, and how its radius grows along it.
template <class R>
struct ConeShape {
    Vector<R> base, axis;
    R height, radius, slope;

    explicit ConeShape(const Cone& cone) : base(cone.base) {
        const Vector<R> whole = Vector<R>(cone.cap) - base;
        axis = unit(whole);
        height = dot(axis, whole);
        radius = cone.base_radius;
        slope = (R(cone.cap_radius) - radius) / height;
    }
};

/// Faces: 0 the side, 1 the base, 2 the cap.
template <class R>
LineCrossings<R> crossings(const Cone& cone, const Line<R>& line, int source) {
    LineCrossings<R> found;
    const ConeShape<R> shape(cone);
    const Vector<R> o = line.origin - shape.base, d = line.direction;
    const R o_along = dot(o, shape.axis), d_along = dot(d, shape.axis);
    const Vector<R> o_across = o - o_along * shape.axis, d_across = d - d_along * shape.axis;
    const R radius = shape.radius + shape.slope * o_along, growth = shape.slope * d_along;
    const R a = dot(d_across, d_across) - growth * growth, b = dot(o_across, d_across) - radius * growth;
    const R c = dot(o_across, o_across) - radius * radius, discriminant = b * b - a * c;
    // The double cone's other half has negative radii, which are beyond the ends.
    const auto add_side = [&](R t) {
        const R along = o_along + t * d_along;
        if (along >= 0 && along <= shape.height)
            found.add(t, 0, o_across + t * d_across - shape.slope * (radius + t * growth) * shape.axis);
    };
    if (source == 0) {
        if (a != 0) add_side(-2 * b / a);
    } else if (discriminant > 0) {
        const R q = b > 0 ? -(b + root(discriminant)) : root(discriminant) - b;
        add_side(c / q);
        if (a != 0) add_side(q / a);
    }
    for (const int face : {1, 2}) {
        if (source == face || d_along == 0) continue;
        const R t = ((face == 1 ? R(0) : shape.height) - o_along) / d_along;
        const Vector<R> across = o_across + t * d_across;
        const R end = face == 1 ? cone.base_radius : cone.cap_radius;
        if (dot(across, across) < end * end) found.add(t, face, R(face == 1 ? -1 : 1) * shape.axis);
    }
    return found;
}
template <class R>
bool contains(const Cone& cone, const Vector<R>& p) {
    const ConeShape<R> shape(cone);
    const Vector<R> o = p - shape.base;
    const R along = dot(o, shape.axis), radius = shape.radius + shape.slope * along;
    const Vector<R> across = o - along * shape.axis;
    return along > 0 && along < shape.height && dot(across, across) < radius * radius;
}

}  // namespace strahl::referee
