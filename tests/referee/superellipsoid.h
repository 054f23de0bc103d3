// The referee's formulas for superellipsoids: the function as it is written in books, but for powers that would be too
// small; a place along a line where it is below 1 by shrinking intervals, and where it is 1 on both sides of that by
// false position.
#pragma once
#include <cmath>

#include "scene/kinds/superellipsoid.h"
#include "tests/referee/line.h"

namespace strahl::referee {

/// (u^p + v^p)^(1/p) for u, v >= 0; the larger is taken out, as powers may be too small for any number.
template <class R>
R joined(R u, R v, R p) {
    const R large = u < v ? v : u, small = u < v ? u : v;
    return small > 0 ? large * power(1 + power(small / large, p), 1 / p) : large;
}
/// The function that is 1 on the surface: ((|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n))^(n/2).
template <class R>
R value_of(const Superellipsoid& body, const Vector<R>& p) {
    const auto size = [](R c) { return c < 0 ? -c : c; };
    return joined(joined(size(p.x), size(p.y), 2 / R(body.e)), size(p.z), 2 / R(body.n));
}
template <class R>
bool contains(const Superellipsoid& body, const Vector<R>& p) {
    return value_of(body, p) < 1;
}
/// Finds where a line crosses it. Where the line starts on the surface, the crossing nearest to the start is the start.
template <class R>
LineCrossings<R> crossings(const Superellipsoid& body, const Line<R>& line, int source) {
    LineCrossings<R> found;
    const R size = root(dot(line.direction, line.direction));
    const R middle = -dot(line.origin, line.direction) / (size * size);
    const Vector<R> nearest = line.origin + middle * line.direction, d = R(1) / size * line.direction;
    const R square = 3 - dot(nearest, nearest);
    if (square < 0) return found;
    const auto at = [&](R t) { return value_of(body, nearest + t * d) - 1; };
    const R reach = root(square), share = R(.381966011250105151795);
    R low = -reach, high = reach;
    R a = low + (high - low) * share, b = high - (high - low) * share, at_a = at(a), at_b = at(b);
    for (int i = 0; i < 40 && !(at_a < 0 || at_b < 0); ++i)
        if (at_a < at_b)
            high = b, b = a, at_b = at_a, a = low + (high - low) * share, at_a = at(a);
        else
            low = a, a = b, at_a = at_b, b = high - (high - low) * share, at_b = at(b);
    if (!(at_a < 0 || at_b < 0)) return found;
    const R least = at_a < 0 ? a : b;
    for (const R end : {-reach, reach}) {
        // By false position; an end that stays counts half (the Illinois method).
        R outside = end, inside = least, out = at(end), in = at(least), t = end;
        for (int i = 0, side = 0; i < 300; ++i) {
            const R before = t;
            t = i % 8 == 7 ? (outside + inside) / 2 : (out * inside - in * outside) / (out - in);
            if (t == before || out <= 0) break;
            const R value = at(t);
            if (value < 0) {
                inside = t, in = value, out = side < 0 ? out / 2 : out, side = -1;
            } else {
                outside = t, out = value, in = side > 0 ? in / 2 : in, side = 1;
                if (value == 0) break;
            }
        }
        const Vector<R> p = nearest + t * d;
        // The derivative of joined() by u is (u / joined)^(p - 1).
        const auto slope = [](R c, R whole, R p) {
            const R share = (c < 0 ? -c : c) / whole, own = share > 0 ? power(share, p - 1) : R(0);
            return c < 0 ? -own : own;
        };
        const R e = 2 / R(body.e), n = 2 / R(body.n), level = value_of(body, Vector<R>(p.x, p.y, R(0)));
        const R whole = value_of(body, p), across = slope(level, whole, n);
        Vector<R> normal(R(0), R(0), slope(p.z, whole, n));
        if (level > 0) normal.x = across * slope(p.x, level, e), normal.y = across * slope(p.y, level, e);
        found.add(middle + t / size, 0, normal);
    }
    if (source == 0) {
        const auto far = [&](std::size_t i) { return found.list[i].t < 0 ? -found.list[i].t : found.list[i].t; };
        found.list.erase(found.list.begin() + (far(0) < far(1) ? 0 : 1));
    }
    return found;
}

}  // namespace strahl::referee
