#include "pov/things/prisms.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

std::vector<Contour> contours_of(SplineKind kind, std::span<const Point2> points, bool turned) {
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
        begins = !turned;
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

namespace {

/// A piece of a sor: its squared radius is a cubic of t from 0 to 1, along which the height grows evenly.
struct SorPiece {
    double first, m, c, d;  // first + t (m + t (c + t d))
    double base, height;
    double radius, last;  // at its ends

    double square(double t) const { return first + t * (m + t * (c + t * d)); }
    double slope(double t) const { return m + t * (2 * c + t * 3 * d); }
    Point2 at(double t) const {
        return {t == 0 ? radius : t == 1 ? last : std::sqrt(std::max(square(t), 0.)), base + t * height};
    }
    /// Returns the direction there, of length 1. It is level where the radius is 0, unless that has a tip.
    Point2 direction(double t, const Point2& point) const {
        double aside = slope(t), up = 2 * point[0] * height;
        if (up == 0 && std::fabs(aside) <= 1e-12 * (std::fabs(m) + std::fabs(c) + std::fabs(d)))
            aside = std::copysign(std::sqrt(std::max(c + t * 3 * d, 0.)), .5 - t), up = height;
        const double length = std::hypot(aside, up);
        return length > 0 ? Point2{aside / length, up / length} : Point2{0, std::copysign(1., height)};
    }
    /// Returns how far a point is from the surface, nearly, and below 0 inside.
    double away(const Point2& p) const {
        const double t = (p[1] - base) / height, steep = std::hypot(2 * p[0], slope(t) / height);
        return steep > 0 ? (p[0] * p[0] - square(t)) / steep : p[0];
    }
    /// Returns where the radius begins or ends, between the ends of the piece.
    std::vector<double> parts() const {
        constexpr int steps = 64;
        std::vector<double> places{0};
        for (int i = 0; i < steps; ++i) {
            double low = double(i) / steps, high = double(i + 1) / steps;
            if ((square(low) > 0) == (square(high) > 0) || square(low) == 0 || square(high) == 0) continue;
            for (int k = 0; k < 60; ++k) {
                const double middle = (low + high) / 2;
                ((square(middle) > 0) == (square(low) > 0) ? low : high) = middle;
            }
            // Nearer to the ends rounding makes them.
            if (std::min(low, 1 - low) > 1e-6) places.push_back(low);
        }
        places.push_back(1);
        return places;
    }
};

/// Adds a part of a piece as cubic curves: their ends and directions there are the piece's, and so are their middles.
void add_sor(const SorPiece& piece, double low, double high, double tolerance, int halvings, Contour& contour) {
    const Point2 from = piece.at(low), to = piece.at(high);
    if (!(piece.square((low + high) / 2) > 0)) return contour.strokes.push_back({to, to});
    const Point2 d = piece.direction(low, from), e = piece.direction(high, to);
    double reach = std::hypot(to[0] - from[0], to[1] - from[1]) / 3;
    const double shortest = reach / 2, longest = reach * 2;
    const auto on = [&](double t) {
        const double u = 1 - t, p = u * u * (1 + 2 * t), q = t * t * (1 + 2 * u), k = 3 * t * u * reach;
        return Point2{p * from[0] + q * to[0] + k * (u * d[0] - t * e[0]),
                      p * from[1] + q * to[1] + k * (u * d[1] - t * e[1])};
    };
    for (int i = 0; i < 8; ++i) {
        const double off = piece.away(on(.5)), before = reach, step = 1e-4 * reach;
        reach += step;
        const double change = (piece.away(on(.5)) - off) / step;
        reach = std::fabs(change) > 1e-6 ? std::clamp(before - off / change, shortest, longest) : before;
    }
    double off = 0;
    for (const double t : {.25, .5, .75}) off = std::max(off, std::fabs(piece.away(on(t))));
    if (halvings == 0 || off <= tolerance)
        return contour.strokes.push_back(
            {{from[0] + reach * d[0], from[1] + reach * d[1]}, to, Point2{to[0] - reach * e[0], to[1] - reach * e[1]}});
    const double half = (low + high) / 2;
    add_sor(piece, low, half, tolerance, halvings - 1, contour);
    add_sor(piece, half, high, tolerance, halvings - 1, contour);
}

}  // namespace

Contour contour_of_sor(std::span<const Point2> points, bool open) {
    Contour contour;
    double largest = 0;
    for (const Point2& p : points) largest = std::max(largest, p[0]);
    for (std::size_t i = 1; i + 2 < points.size(); ++i) {
        const Point2 &p = points[i], &q = points[i + 1];
        // The square's slopes at both ends are those that their neighbours give.
        const auto slope = [&](std::size_t n) {
            return 2 * points[n][0] * (points[n + 1][0] - points[n - 1][0]) / (points[n + 1][1] - points[n - 1][1]);
        };
        const double height = q[1] - p[1], m = slope(i) * height, n = slope(i + 1) * height;
        if (!std::isfinite(m) || !std::isfinite(n) || height == 0) return {};
        const double first = p[0] * p[0], rise = q[0] * q[0] - first;
        if (i == 1) {
            contour.start = open ? p : Point2{0, p[1]};
            if (!open) contour.strokes.push_back({p, p});
        }
        const SorPiece piece{first, m, 3 * rise - 2 * m - n, m + n - 2 * rise, p[1], height, p[0], q[0]};
        const std::vector<double> places = piece.parts();
        for (std::size_t k = 1; k < places.size(); ++k)
            add_sor(piece, places[k - 1], places[k], 7e-9 * largest, 8, contour);
        contour.strokes.back().end = q;
    }
    if (!open && !contour.strokes.empty()) {
        const Point2 end{0, contour.strokes.back().end[1]};
        contour.strokes.push_back({end, end});
    }
    return contour;
}

namespace {

Moves turned_moves(std::function<double(double away, double y)> height) {
    return {Warp(TurnedWarp{std::make_shared<const std::function<double(double, double)>>(std::move(height))})};
}

/// A piece of a spline: a t^3 + b t^2 + c t + d for t from 0 to 1.
struct SplinePiece {
    Point2 a{}, b{}, c{}, d{};
    double at(std::size_t k, double t) const { return d[k] + t * (c[k] + t * (b[k] + t * a[k])); }
    double slope(std::size_t k, double t) const { return c[k] + t * (2 * b[k] + t * 3 * a[k]); }
    double away(double t, const Point2& p) const { return std::hypot(at(0, t) - p[0], at(1, t) - p[1]); }
    /// Returns where the piece is nearest to a point on it, from a place near there, by Newton's steps.
    double nearest(double t, const Point2& p) const {
        for (int i = 0; i < 8; ++i) {
            const double x = slope(0, t), y = slope(1, t), squared = x * x + y * y;
            if (!(squared > 0)) break;
            t = std::clamp(t - (x * (at(0, t) - p[0]) + y * (at(1, t) - p[1])) / squared, 0., 1.);
        }
        return t;
    }
};

/// Returns the pieces of a lathe's spline, as POV-Ray has them.
std::vector<SplinePiece> pieces_of(SplineKind kind, std::span<const Point2> points) {
    const std::size_t needs = kind == SplineKind::linear ? 2 : kind == SplineKind::quadratic ? 3 : 4;
    std::vector<SplinePiece> all;
    for (std::size_t i = 0; i + needs <= points.size(); i += kind == SplineKind::bezier ? 4 : 1) {
        SplinePiece& own = all.emplace_back();
        for (std::size_t k = 0; k < 2; ++k) {
            const auto p = [&](std::size_t n) { return points[i + n][k]; };
            if (kind == SplineKind::linear) {
                own.c[k] = p(1) - p(0), own.d[k] = p(0);
            } else if (kind == SplineKind::quadratic) {
                own.b[k] = (p(0) - 2 * p(1) + p(2)) / 2, own.c[k] = (p(2) - p(0)) / 2, own.d[k] = p(1);
            } else if (kind == SplineKind::cubic) {
                own.a[k] = (3 * (p(1) - p(2)) + p(3) - p(0)) / 2, own.b[k] = p(0) - 2.5 * p(1) + 2 * p(2) - p(3) / 2;
                own.c[k] = (p(2) - p(0)) / 2, own.d[k] = p(1);
            } else {
                own.a[k] = p(3) - p(0) + 3 * (p(1) - p(2)), own.b[k] = 3 * (p(2) - 2 * p(1) + p(0));
                own.c[k] = 3 * (p(1) - p(0)), own.d[k] = p(0);
            }
        }
    }
    return all;
}

}  // namespace

Moves places_of_lathe(SplineKind kind, std::span<const Point2> points) {
    return turned_moves([pieces = pieces_of(kind, points)](double away, double y) {
        constexpr int starts = 8;
        double least = HUGE_VAL, place = 0;
        for (std::size_t i = 0; i < pieces.size(); ++i)
            for (int k = 0; k <= starts; ++k) {
                const double t = pieces[i].nearest(double(k) / starts, {away, y}), off = pieces[i].away(t, {away, y});
                if (off < least) least = off, place = (double(i) + t) / double(pieces.size());
            }
        return place;
    });
}

Moves places_of_sor(std::span<const Point2> points) {
    if (points.size() < 4) return turned_moves([](double, double) { return 0; });
    return turned_moves([p = std::vector<Point2>(points.begin() + 1, points.end() - 1)](double away, double y) {
        constexpr double tolerance = 1e-9;
        const Point2 &base = p.front(), &cap = p.back();
        if (std::fabs(y - base[1]) < tolerance && base[0] > 0) return away / base[0] - 1;
        if (std::fabs(y - cap[1]) < tolerance && cap[0] > 0) return 2 - away / cap[0];
        std::size_t i = 0;
        while (i + 2 < p.size() && y > p[i + 1][1]) ++i;
        return (double(i) + (y - p[i][1]) / (p[i + 1][1] - p[i][1])) / double(p.size() - 1);
    });
}

Contour contour_of_ovus(double bottom, double top) {
    constexpr double right = std::numbers::pi / 2;
    Contour contour{{0, -bottom}, {}};
    const auto add_arc = [&](const Point2& centre, double radius, double from, double to) {
        const int pieces = static_cast<int>(std::ceil((to - from) / (right / 6)));
        const double step = (to - from) / pieces, reach = 4. / 3 * std::tan(step / 4);
        const auto at = [&](double angle, double ahead) {  // of a circle, and ahead along its tangent
            return Point2{centre[0] + radius * (std::cos(angle) - ahead * std::sin(angle)),
                          centre[1] + radius * (std::sin(angle) + ahead * std::cos(angle))};
        };
        for (int i = 0; i < pieces; ++i) {
            const double a = from + i * step, b = i + 1 < pieces ? a + step : to;
            contour.strokes.push_back({at(a, reach), at(b, 0), at(b, -reach)});
        }
    };
    const double large = 2 * std::max(bottom, top);
    // The large circle's middle is at (-aside, height): from the balls' middles by its radius less theirs.
    const double height =
        (bottom * bottom + (large - bottom) * (large - bottom) - (large - top) * (large - top)) / (2 * bottom);
    const double aside = std::sqrt(std::max((large - bottom) * (large - bottom) - height * height, 0.));
    if (top < 2 * bottom) {
        const double lower = std::atan2(-height, aside), upper = std::atan2(bottom - height, aside);
        add_arc({0, 0}, bottom, -right, lower);
        add_arc({-aside, height}, large, lower, upper);
        add_arc({0, bottom}, top, upper, right);
    } else {  // the lower ball is within the upper one
        contour.start[1] = bottom - top;
        add_arc({0, bottom}, top, -right, right);
    }
    contour.strokes.back().end[0] = 0;
    return contour;
}

std::vector<Contour> contours_of_quadric(double square, double linear, double constant) {
    if (square == 0) {
        const double apex = -constant / linear, radius = std::sqrt(std::fabs(linear) * endless);
        return {{{0, apex}, {{{radius / 2, apex}, {radius, apex + std::copysign(endless, linear)}}}}};
    }
    const double middle = -linear / (2 * square), rest = constant - square * middle * middle;
    const double radius = std::sqrt(std::fabs(rest)), height = std::sqrt(std::fabs(rest) / square);
    // Curves are the longer the further away they are: there they are nearly straight.
    std::vector<double> places{0};
    for (const double most = std::asinh(endless / height); places.back() < most;) {
        const double u = places.back();
        places.push_back(std::min(most, u + std::min(.25 * std::exp(u / 3), 1.5)));
    }
    const auto arcs = [&](bool from_below, double side) {
        const auto at = [&](double u, double ahead) {  // of the hyperbola, and ahead along its tangent
            const double c = std::cosh(u) + ahead * std::sinh(u), s = std::sinh(u) + ahead * std::cosh(u);
            return Point2{radius * (rest > 0 ? c : s), middle + side * height * (rest > 0 ? s : c)};
        };
        Contour own{at(from_below ? -places.back() : 0, 0), {}};
        const auto add = [&](double from, double to) {
            const double reach = 4. / 3 * std::tanh((to - from) / 4);
            own.strokes.push_back({at(from, reach), at(to, 0), at(to, -reach)});
        };
        for (std::size_t i = places.size() - 1; from_below && i > 0; --i) add(-places[i], -places[i - 1]);
        for (std::size_t i = 1; i < places.size(); ++i) add(places[i - 1], places[i]);
        return own;
    };
    if (rest > 0) return {arcs(true, 1)};
    return {arcs(false, -1), arcs(false, 1)};
}

}  // namespace strahl::pov
