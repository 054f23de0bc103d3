#include "scene/kinds/contours.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace strahl {
namespace {

using Point = Contour::Point;

double across(const Point& v, const Point& w) { return v[0] * w[1] - v[1] * w[0]; }
double dot(const Point& v, const Point& w) { return v[0] * w[0] + v[1] * w[1]; }
Point way(const Point& from, const Point& to) { return {to[0] - from[0], to[1] - from[1]}; }
Point between(const Point& p, const Point& q, double t) {
    return {(1 - t) * p[0] + t * q[0], (1 - t) * p[1] + t * q[1]};
}

/// A straight line, a quadratic or a cubic curve by its two to four control points.
struct Curve {
    std::array<Point, 4> p;
    std::size_t degree;

    Point leg(std::size_t i) const { return way(p[i], p[i + 1]); }
    bool straight() const {
        for (std::size_t i = 1; i < degree; ++i)
            if (across(leg(i - 1), leg(i)) != 0 || across(leg(0), leg(i)) != 0) return false;
        return true;
    }
    /// Does it turn by hardly more than a right angle, if to one side?
    bool turns_little() const {
        for (std::size_t i = 0; i < degree; ++i)
            for (std::size_t k = i + 1; k < degree; ++k) {
                const double lengths = std::sqrt(dot(leg(i), leg(i)) * dot(leg(k), leg(k)));
                if (dot(leg(i), leg(k)) < -.1 * lengths) return false;
            }
        return true;
    }
    /// Returns the parts before and behind t, by de Casteljau's algorithm.
    std::pair<Curve, Curve> cut(double t) const {
        std::pair<Curve, Curve> parts{*this, *this};
        std::array<Point, 4> q = p;
        for (std::size_t n = 1; n <= degree; ++n) {
            for (std::size_t i = 0; i + n <= degree; ++i) q[i] = between(q[i], q[i + 1], t);
            parts.first.p[n] = q[0], parts.second.p[degree - n] = q[degree - n];
        }
        return parts;
    }
    /// Returns the coefficients: p[0] + t (2 h + t (e + t d)).
    std::array<Point, 3> coefficients() const {
        const double first = static_cast<double>(degree) / 2, second = degree == 3 ? 3 : 1;
        std::array<Point, 3> found{};
        for (std::size_t i = 0; i < 2; ++i) {
            found[0][i] = first * leg(0)[i];
            if (degree > 1) found[1][i] = second * (leg(1)[i] - leg(0)[i]);
            if (degree > 2) found[2][i] = (leg(2)[i] - leg(1)[i]) - (leg(1)[i] - leg(0)[i]);
        }
        return found;
    }
    /// Returns the t between 0 and 1, ascending, at which a cubic curve turns to the other side.
    std::vector<double> turns() const {
        const Point c = leg(0), b = way(leg(0), leg(1)), a = way(way(leg(0), leg(1)), way(leg(1), leg(2)));
        return zeros(across(c, b), across(c, a), across(b, a));
    }
    /// Returns the zeros of c + b t + a t^2 between 0 and 1, ascending.
    static std::vector<double> zeros(double c, double b, double a) {
        const double square = b * b - 4 * a * c;
        if (!(square >= 0)) return {};
        const double q = -(b + std::copysign(std::sqrt(square), b)) / 2;
        std::vector<double> found{q / a, c / q};
        std::erase_if(found, [](double t) { return !(t > 0 && t < 1); });
        std::ranges::sort(found);
        return found;
    }
};

/// Makes pieces of curves, and finds the box around them.
struct PieceMaker {
    std::vector<Curve> curves;
    Point low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};

    /// Adds a curve in parts that turn to one side, by hardly more than a right angle. One that is straight, or leads
    /// beyond its ends and back on a straight line, encloses what the line between its ends does.
    void add(Curve curve) {
        if (curve.degree == 3)
            if (const auto [h, e, d] = curve.coefficients(); d == Point{})
                curve = {{curve.p[0], {curve.p[0][0] + h[0], curve.p[0][1] + h[1]}, curve.p[3]}, 2};
        if (curve.degree == 3 && !curve.straight()) {
            double before = 0;
            for (const double t : curve.turns()) {
                const auto [first, rest] = curve.cut((t - before) / (1 - before));
                halve(first, 0);
                curve = rest, before = t;
            }
        }
        halve(curve, 0);
    }

  private:
    void halve(const Curve& curve, int halvings) {
        constexpr int most_halvings = 16;
        const Point &a = curve.p[0], &c = curve.p[curve.degree];
        if (curve.straight()) {
            if (a != c) curves.push_back({{a, c}, 1});
        } else if (!curve.turns_little() && halvings < most_halvings) {
            const auto [first, last] = curve.cut(.5);
            halve(first, halvings + 1), halve(last, halvings + 1);
            return;
        } else {
            curves.push_back(curve);
            const auto [h, e, d] = curve.coefficients();
            for (std::size_t i = 0; i < 2; ++i)
                for (const double t : Curve::zeros(2 * h[i], 2 * e[i], 3 * d[i]))  // it turns back along this axis
                    include(a[i] + t * (2 * h[i] + t * (e[i] + t * d[i])), i);
        }
        for (std::size_t i = 0; i < 2; ++i) include(a[i], i), include(c[i], i);
    }
    void include(double value, std::size_t axis) {
        low[axis] = std::min(low[axis], value), high[axis] = std::max(high[axis], value);
    }
};

}  // namespace

ContourData::ContourData(std::vector<Contour> all, bool turned) : contours(std::move(all)) {
    PieceMaker maker;
    for (const Contour& own : contours) {
        Point from = own.start;
        for (const auto& [control, end, second] : own.strokes) {
            maker.add(second ? Curve{{from, control, *second, end}, 3} : Curve{{from, control, end}, 2});
            from = end;
        }
        if (!turned) maker.add({{from, own.start}, 1});
    }
    if (maker.curves.empty()) return;
    inner = maker.low[0];
    if (turned) maker.high[0] = std::max(-maker.low[0], maker.high[0]), maker.low[0] = -maker.high[0];
    for (std::size_t i = 0; i < 2; ++i) {
        centre[i] = maker.low[i] / 2 + maker.high[i] / 2;
        half[i] = maker.high[i] / 2 - maker.low[i] / 2;
    }
    unit = std::max(half[0], half[1]);
    if (!(half[0] > 0 && (turned || half[1] > 0))) return;  // all is on a line
    for (const Curve& curve : maker.curves) {
        if (turned && curve.degree == 1 && curve.p[0][0] == 0 && curve.p[1][0] == 0) continue;  // on the axis
        const auto place = [&](const Point& p, std::size_t i) { return (p[i] - centre[i]) / unit; };
        const Point &a = curve.p[0], &c = curve.p[curve.degree];
        const auto [h, e, d] = curve.coefficients();
        pieces.push_back({place(a, 0), place(a, 1), place(c, 0), place(c, 1), h[0] / unit, h[1] / unit, e[0] / unit,
                          e[1] / unit, d[0] / unit, d[1] / unit});
        pieces.back().bound();
    }
}

bool ContourData::is_convex_polygon() const {
    if (contours.size() != 1) return false;
    double whole = 0, turns = 0;  // the angles between its sides, and the sum of their sizes
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const ContourPiece<double>&own = pieces[i], &next = pieces[i + 1 < pieces.size() ? i + 1 : 0];
        if (own.ex != 0 || own.ey != 0 || own.dx != 0 || own.dy != 0) return false;
        const PlaneLine<double> side{own.ax, own.ay, own.cx - own.ax, own.cy - own.ay};
        const double x = next.cx - next.ax, y = next.cy - next.ay;
        const double turn = std::atan2(side.across(x, y), side.along(x, y));
        whole += turn, turns += std::abs(turn);
    }
    return turns < 6.5 && std::abs(whole) > 6;  // once around, always to the same side
}

std::shared_ptr<const ContourData> ContourData::usual() {
    static const auto shared = std::make_shared<const ContourData>(
        std::vector<Contour>{{{1, 0}, {{{1, 1}, {0, 1}}, {{-1, 1}, {-1, 0}}, {{-1, -1}, {0, -1}}, {{1, -1}, {1, 0}}}},
                             {{.3, .3}, {{{-.3, .3}, {-.3, .3}}, {{-.3, -.3}, {-.3, -.3}}, {{.3, -.3}, {.3, -.3}}}}});
    return shared;
}

}  // namespace strahl
