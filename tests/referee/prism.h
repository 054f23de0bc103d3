// The referee's formulas for prisms: curves are cut where lines of the plane cross them, by halving.
#pragma once
#include <vector>

#include "scene/kinds/prism.h"
#include "tests/referee/torus.h"

namespace strahl::referee {

/// Returns a polynomial's value, or that of its derivative.
template <class R>
R value_of(const std::vector<R>& c, const R& t) {
    R sum = 0;
    for (std::size_t i = c.size(); i-- > 0;) sum = sum * t + c[i];
    return sum;
}
template <class R>
R slope_of(const std::vector<R>& c, const R& t) {
    R sum = 0;
    for (std::size_t i = c.size(); i-- > 1;) sum = sum * t + R(static_cast<int>(i)) * c[i];
    return sum;
}

/// Calls visit(number, x, y) for the curves of contours: two polynomials. The last line of a contour that is closed is
/// straight and may have no length.
template <class R, class Visit>
void each_curve(const ContourData& data, bool closed, const Visit& visit) {
    int number = 0;
    for (const Contour& contour : data.contours) {
        std::vector<Contour::Stroke> steps = contour.strokes;
        if (closed) steps.push_back({contour.start, contour.start});
        Contour::Point from = contour.start;
        for (const auto& [control, end, second] : steps) {
            const bool straight = control == end && !second;
            const auto coefficients = [&](std::size_t i) {
                const R a = from[i], b = control[i], c = end[i];
                if (second) {
                    const R other = (*second)[i];
                    return std::vector<R>{a, 3 * (b - a), 3 * (a - 2 * b + other), c - 3 * other + 3 * b - a};
                }
                return straight ? std::vector<R>{a, c - a} : std::vector<R>{a, 2 * (b - a), a - 2 * b + c};
            };
            visit(number, coefficients(0), coefficients(1));
            from = end, ++number;
        }
    }
}

/// Calls visit(number, t, x, y, dx, dy) where a line through <ox, oy> along <ux, uy> crosses the curves of contours,
/// with the way along the curve there.
template <class R, class Visit>
void cross_curves(const ContourData& data, bool closed, const R& ox, const R& oy, const R& ux, const R& uy,
                  const Visit& visit) {
    each_curve<R>(data, closed, [&](int number, const std::vector<R>& x, const std::vector<R>& y) {
        std::vector<R> across;
        for (std::size_t i = 0; i < x.size(); ++i) across.push_back(ux * y[i] - uy * x[i]);
        across[0] -= ux * oy - uy * ox;
        for (const R t : roots_between(across, R(0), R(1)))
            visit(number, t, value_of(x, t), value_of(y, t), slope_of(x, t), slope_of(y, t));
    });
}

template <class R>
bool in_figure(const Prism& prism, const Vector<R>& p) {
    int ahead = 0;
    cross_curves(*prism.data, true, p.x, p.y, R(.6), R(.8),
                 [&](int, const R&, const R& x, const R& y, const R&, const R&) {
                     ahead += (x - p.x) * R(.6) + (y - p.y) * R(.8) > 0;
                 });
    return ahead % 2 == 1;
}
template <class R>
bool contains(const Prism& prism, const Vector<R>& p) {
    const R low = std::min(prism.base, prism.top), high = std::max(prism.base, prism.top);
    return low < p.z && p.z < high && in_figure(prism, p);
}
/// How many faces it has for the referee: its caps are faces 0 and 1, and the curves of its contours follow.
inline int faces_of(const Prism& prism) {
    int count = 2;
    for (const Contour& contour : prism.data->contours) count += static_cast<int>(contour.strokes.size()) + 1;
    return count;
}
/// Finds where a line crosses a prism. Of the crossings of the curve that it starts on, the nearest one is the start.
template <class R>
LineCrossings<R> crossings(const Prism& prism, const Line<R>& line, int source) {
    LineCrossings<R> found;
    const Vector<R>&o = line.origin, &d = line.direction;
    const R low = std::min(prism.base, prism.top), high = std::max(prism.base, prism.top);
    const R across = d.x * d.x + d.y * d.y;
    for (int face = 0; face < 2; ++face) {
        if (source == face || d.z == 0) continue;
        const R t = ((face == 0 ? low : high) - o.z) / d.z;
        if (in_figure(prism, o + t * d)) found.add(t, face, {0, 0, R(face == 0 ? -1 : 1)});
    }
    const auto size = [](R t) { return t < 0 ? -t : t; };
    std::size_t start = 0;
    bool starts = false;
    const auto add = [&](int number, const R&, const R& x, const R& y, const R& dx, const R& dy) {
        found.add(((x - o.x) * d.x + (y - o.y) * d.y) / across, 2 + number, {dy, -dx, 0});
        if (2 + number != source || (starts && size(found.list.back().t) > size(found.list[start].t))) return;
        start = found.list.size() - 1, starts = true;
    };
    if (across > 0) cross_curves(*prism.data, true, o.x, o.y, d.x, d.y, add);
    if (starts) found.list.erase(found.list.begin() + static_cast<std::ptrdiff_t>(start));
    std::erase_if(found.list, [&](const Crossing<R>& crossing) {
        const R z = o.z + crossing.t * d.z;
        return crossing.face >= 2 && !(low < z && z < high);
    });
    return found;
}

}  // namespace strahl::referee
