// The referee's formulas for discs.
#pragma once
#include "scene/kinds/disc.h"
#include "tests/referee/line.h"

namespace strahl::referee {

template <class R>
LineCrossings<R> crossings(const Disc& disc, const Line<R>& line, int source) {
    LineCrossings<R> found;
    const Vector<R> n = disc.normal, o = line.origin - Vector<R>(disc.centre), d = line.direction;
    const R towards = dot(n, d);
    if (source == 0 || towards == 0) return found;
    const R t = -dot(n, o) / towards;
    const Vector<R> p = o + t * d;
    const R squared = dot(p, p);
    if (squared <= R(disc.radius) * R(disc.radius) && squared >= R(disc.hole) * R(disc.hole)) found.add(t, 0, n);
    return found;
}
template <class R>
bool contains(const Disc&, const Vector<R>&) {
    return false;
}

}  // namespace strahl::referee
