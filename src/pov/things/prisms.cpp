#include "pov/things/prisms.h"

#include <algorithm>
#include <cmath>

namespace strahl::pov {
namespace {

/// Are two numbers the same for POV-Ray?
bool equal(double a, double b) { return std::fabs(a - b) < 1e-10; }
bool equal(const Point2& a, const Point2& b) { return equal(a[0], b[0]) && equal(a[1], b[1]); }

/// Returns a cubic curve of Bezier's, as what it was before it was written for POV-Ray: a parabola, a straight line.
Contour::Stroke simplest(std::span<const Point2, 4> p) {
    Contour::Stroke step{p[1], p[3], p[2]};
    bool parabola = true, straight = true;
    Point2 control;
    for (std::size_t i = 0; i < 2; ++i) {
        const double size = std::max({std::fabs(p[0][i]), std::fabs(p[1][i]), std::fabs(p[2][i]), std::fabs(p[3][i])});
        parabola &= std::fabs(p[3][i] - 3 * p[2][i] + 3 * p[1][i] - p[0][i]) <= 4e-15 * size;
        straight &= std::fabs(p[0][i] - 2 * p[1][i] + p[2][i]) <= 4e-15 * size;
        control[i] = (3 * p[1][i] - p[0][i]) / 2;
    }
    if (parabola) step = {straight ? p[3] : control, p[3]};
    return step;
}

}  // namespace

std::vector<Contour> contours_of(SplineKind kind, std::span<const Point2> points) {
    std::vector<Contour> contours;
    const std::size_t count = points.size();
    bool begins = true;
    const auto add = [&](const Point2& from, const Contour::Stroke& step) {
        if (begins) contours.push_back({from, {}});
        contours.back().strokes.push_back(step);
        begins = equal(step.end, contours.back().start);
        if (!begins) return;
        // Ends a figure where it began if it closes but for rounding.
        Contour::Stroke& last = contours.back().strokes.back();
        if (last.straight()) last.control = contours.back().start;
        last.end = contours.back().start;
    };
    switch (kind) {
        case SplineKind::linear:
            for (std::size_t i = 0; i + 1 < count; i += begins ? 2 : 1) add(points[i], {points[i + 1], points[i + 1]});
            break;
        case SplineKind::quadratic:
            // The first point gives the direction at the second, where the contour begins.
            for (std::size_t i = 0; i + 2 < count; i += begins ? 3 : 1) {
                const Point2 &p = points[i], &q = points[i + 1], &r = points[i + 2];
                add(q, {{q[0] + (r[0] - p[0]) / 4, q[1] + (r[1] - p[1]) / 4}, r});
            }
            break;
        case SplineKind::cubic:
            for (std::size_t i = 0; i + 3 < count; i += begins ? 4 : 1) {
                const Point2 &p = points[i], &q = points[i + 1], &r = points[i + 2], &s = points[i + 3];
                add(q, {{q[0] + (r[0] - p[0]) / 6, q[1] + (r[1] - p[1]) / 6},
                        r,
                        Point2{r[0] - (s[0] - q[0]) / 6, r[1] - (s[1] - q[1]) / 6}});
            }
            break;
        case SplineKind::bezier:
            for (std::size_t i = 0; i + 3 < count; i += 4) {
                if (!begins && !equal(points[i], contours.back().strokes.back().end)) begins = true;
                add(points[i], simplest(points.subspan(i).first<4>()));
            }
            break;
    }
    return contours;
}

}  // namespace strahl::pov
