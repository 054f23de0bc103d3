// The referee's formulas for spheres, planes and cylinders.
#pragma once
#include "scene/kinds/cylinder.h"
#include "scene/kinds/plane.h"
#include "scene/kinds/sphere.h"
#include "tests/referee/line.h"

namespace strahl::referee {

template <class R>
LineCrossings<R> crossings(const Sphere& sphere, const Line<R>& line, int source) {
    LineCrossings<R> found;
    const R r = sphere.radius;
    const Vector<R> o = line.origin - Vector<R>(sphere.centre), d = line.direction;
    roots(dot(d, d), dot(o, d), dot(o, o) - r * r, source == 0, [&](R t) { found.add(t, 0, o + t * d); });
    return found;
}
template <class R>
bool contains(const Sphere& sphere, const Vector<R>& p) {
    const Vector<R> o = p - Vector<R>(sphere.centre);
    return dot(o, o) < R(sphere.radius) * R(sphere.radius);
}

template <class R>
Vector<R> normal(const Plane& plane) {
    const Vector<R> a = plane.a;
    return cross(Vector<R>(plane.b) - a, Vector<R>(plane.c) - a);
}
template <class R>
LineCrossings<R> crossings(const Plane& plane, const Line<R>& line, int source) {
    LineCrossings<R> found;
    const Vector<R> n = normal<R>(plane);
    const R towards = dot(n, line.direction);
    if (source != 0 && towards != 0) found.add(dot(n, Vector<R>(plane.a) - line.origin) / towards, 0, n);
    return found;
}
template <class R>
bool contains(const Plane& plane, const Vector<R>& p) {
    return dot(normal<R>(plane), p - Vector<R>(plane.a)) < 0;
}

/// Faces: 0 the side, 1 the base, 2 the cap.
template <class R>
LineCrossings<R> crossings(const Cylinder& cylinder, const Line<R>& line, int source) {
    LineCrossings<R> found;
    const Vector<R> base = cylinder.base, whole = Vector<R>(cylinder.cap) - base, axis = unit(whole);
    const R r = cylinder.radius, height = dot(axis, whole);
    const Vector<R> o = line.origin - base, d = line.direction;
    const R o_along = dot(o, axis), d_along = dot(d, axis);
    const Vector<R> o_across = o - o_along * axis, d_across = d - d_along * axis;
    roots(dot(d_across, d_across), dot(o_across, d_across), dot(o_across, o_across) - r * r, source == 0, [&](R t) {
        const R along = o_along + t * d_along;
        if (along >= 0 && along <= height) found.add(t, 0, o_across + t * d_across);
    });
    for (const int face : {1, 2}) {
        if (source == face || d_along == 0) continue;
        const R t = ((face == 1 ? R(0) : height) - o_along) / d_along;
        const Vector<R> across = o_across + t * d_across;
        if (dot(across, across) <= r * r) found.add(t, face, R(face == 1 ? -1 : 1) * axis);
    }
    return found;
}
template <class R>
bool contains(const Cylinder& cylinder, const Vector<R>& p) {
    const Vector<R> base = cylinder.base, whole = Vector<R>(cylinder.cap) - base, axis = unit(whole), o = p - base;
    const R along = dot(o, axis);
    const Vector<R> across = o - along * axis;
    return along > 0 && along < dot(axis, whole) && dot(across, across) < R(cylinder.radius) * R(cylinder.radius);
}

}  // namespace strahl::referee
