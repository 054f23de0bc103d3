// The referee's formulas for lathes: a polynomial of up to the sixth degree for each curve of a contour, and its roots
// between those of its derivative.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/kinds/lathe.h"
#include "tests/referee/prism.h"

namespace strahl::referee {

/// Bounds a lathe by a distance from its axis and two heights. Curves lie between their control points.
struct LatheReach {
    double radius = 0, low = HUGE_VAL, high = -HUGE_VAL;

    explicit LatheReach(const ContourData& data) {
        for (const Contour& contour : data.contours) {
            add(contour.start);
            for (const Contour::Stroke& stroke : contour.strokes)
                add(stroke.control), add(stroke.end), add(stroke.second.value_or(stroke.end));
        }
    }
    void add(const Contour::Point& point) {
        radius = std::max(radius, std::abs(point[0]) * (1 + 1e-9));
        low = std::min(low, point[1]), high = std::max(high, point[1]);
    }
    /// May a line meet the lathe? It is nearest to the axis at `nearest`.
    template <class R>
    bool meets(const Line<R>& line, const R& a, const R& b, const R& c) const {
        const R nearest = a > 0 ? -b / a : R(0), inside = R(radius) * radius - (c + nearest * b);
        if (!(inside >= 0)) return false;
        if (!(a > 0)) return true;
        const R half = root(inside / a), slack = R(1e-9) * (R(high) - low);
        const R one = line.origin.y + (nearest - half) * line.direction.y,
                other = line.origin.y + (nearest + half) * line.direction.y;
        return std::max(one, other) >= low - slack && std::min(one, other) <= high + slack;
    }
};

template <class R>
bool contains(const Lathe& lathe, const Vector<R>& p) {
    const R radius = root(p.x * p.x + p.z * p.z);
    const LatheReach reach(*lathe.data);
    if (radius > reach.radius || p.y < reach.low || p.y > reach.high) return false;
    int around = 0;
    cross_curves(*lathe.data, false, R(0), p.y, R(1), R(0),
                 [&](int, const R&, const R& x, const R&, const R&, const R&) { around += x > radius || x < -radius; });
    return around % 2 == 1;
}
inline int faces_of(const Lathe& lathe) {
    int count = 0;
    for (const Contour& contour : lathe.data->contours) count += static_cast<int>(contour.strokes.size());
    return count;
}
/// Level lines cross the surface where curves have their height. Of the crossings of the curve that a line starts on,
/// the one nearest to the start is the start.
template <class R>
LineCrossings<R> crossings(const Lathe& lathe, const Line<R>& line, int source) {
    LineCrossings<R> found;
    const Vector<R>&o = line.origin, &d = line.direction;
    const R a = d.x * d.x + d.z * d.z, b = o.x * d.x + o.z * d.z, c = o.x * o.x + o.z * o.z;
    if (!LatheReach(*lathe.data).meets(line, a, b, c)) return found;
    const auto size = [](R t) { return t < 0 ? -t : t; };
    std::size_t start = 0;
    bool starts = false;
    each_curve<R>(*lathe.data, false, [&](int number, const std::vector<R>& radius, const std::vector<R>& height) {
        const auto add = [&](R place, R t) {
            const Vector<R> p = o + place * d;
            const R out = slope_of(radius, t) * value_of(radius, t), up = slope_of(height, t);
            found.add(place, number, {up * p.x, -out, up * p.z});
            if (number != source || (starts && size(place) > size(found.list[start].t))) return;
            start = found.list.size() - 1, starts = true;
        };
        std::vector<R> rise = height;
        rise[0] -= o.y;
        if (size(d.y) < R(1e-14)) {
            for (const R t : roots_between(rise, R(0), R(1)))
                roots(a, b, c - value_of(radius, t) * value_of(radius, t), false, [&](R place) { add(place, t); });
            return;
        }
        std::vector<R> sum(2 * radius.size() - 1, R(0));
        sum[0] = -d.y * d.y * c;
        for (std::size_t i = 0; i < radius.size(); ++i) {
            sum[i] -= 2 * b * d.y * rise[i];
            for (std::size_t k = 0; k < radius.size(); ++k)
                sum[i + k] += d.y * d.y * radius[i] * radius[k] - a * rise[i] * rise[k];
        }
        for (const R t : roots_between(sum, R(0), R(1))) add(value_of(rise, t) / d.y, t);
    });
    if (starts) found.list.erase(found.list.begin() + static_cast<std::ptrdiff_t>(start));
    return found;
}

}  // namespace strahl::referee
