// The referee's formulas for boxes.
#pragma once
#include <algorithm>
#include <utility>

#include "scene/kinds/box.h"
#include "tests/referee/line.h"

namespace strahl::referee {

/// Faces: 0 where x is least, 1 where it is greatest, then those of y and z.
template <class R>
LineCrossings<R> crossings(const Cuboid& box, const Line<R>& line, int source) {
    const Vector<R> p = box.corner, q = box.opposite, o = line.origin, d = line.direction;
    Crossing<R> near{R(-INFINITY), -1, {}}, far{R(INFINITY), -1, {}};
    bool outside = false;
    const auto clip = [&](int face, R from, R to, R o, R d, const Vector<R>& axis) {
        if (from > to) std::swap(from, to);
        if (d == 0) return void(outside |= o < from || o > to);
        Crossing<R> low{source == face ? R(0) : (from - o) / d, face, R(-1) * axis};
        Crossing<R> high{source == face + 1 ? R(0) : (to - o) / d, face + 1, axis};
        if (d < 0) std::swap(low, high);
        if (low.t > near.t) near = low;
        if (high.t < far.t) far = high;
    };
    clip(0, p.x, q.x, o.x, d.x, {1, 0, 0});
    clip(2, p.y, q.y, o.y, d.y, {0, 1, 0});
    clip(4, p.z, q.z, o.z, d.z, {0, 0, 1});
    LineCrossings<R> found;
    if (outside || near.t > far.t) return found;
    for (const Crossing<R>& crossing : {near, far})
        if (crossing.face != source) found.add(crossing.t, crossing.face, crossing.normal);
    return found;
}
template <class R>
bool contains(const Cuboid& box, const Vector<R>& p) {
    const auto between = [](R x, double a, double b) { return x > std::min(a, b) && x < std::max(a, b); };
    return between(p.x, box.corner.x, box.opposite.x) && between(p.y, box.corner.y, box.opposite.y) &&
           between(p.z, box.corner.z, box.opposite.z);
}

}  // namespace strahl::referee
