// Plane figures with contours of straight lines and of curves, and where lines cross these.
#pragma once
#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "num/lanes.h"

namespace strahl {

/// Returns the lanes that are in one of the masks.
template <class M>
STRAHL_INLINE M either(const M& a, const M& b) {
    return (a & !b) | (b & !a);
}

/// A line in a plane. As a part of a figure's edge it is closed: where its last stroke does not end at its start, a
/// straight line leads there.
struct Contour {
    using Point = std::array<double, 2>;
    /// A curve of Bezier's from where the stroke before ends: quadratic, or cubic if it has a second control point. It
    /// is straight if its only control point is its end.
    struct Stroke {
        Point control, end;
        std::optional<Point> second{};
        bool operator==(const Stroke&) const = default;
        bool straight() const { return control == end && !second; }
    };
    Point start{};
    std::vector<Stroke> strokes;
    bool operator==(const Contour&) const = default;
};

/// Finds the zero of a function between `low` and `high`, where its signs differ: by Newton's steps from `t` on, or
/// half of what is known where these would lead out of it. `value(t)` returns the value and its slope; `below` tells
/// whether the value at `low` is below 0. In lanes outside of the mask it returns anything. It ends with the step whose
/// square is less than a rounding: what is left then is of that order.
template <class S, class Value>
STRAHL_INLINE S zero_between(const Value& value, S low, S high, S t, Mask<S> below, Mask<S> lanes) {
    const S least(std::sqrt(std::numeric_limits<Element<S>>::epsilon()) / 16);
    for (int i = 0; i < 80 && any(lanes); ++i) {
        const auto [y, slope] = value(t);
        const Mask<S> before = either(below, Mask<S>(!(y < S(0))));
        low = select(before, t, low), high = select(before, high, t);
        const S newton = t - y / slope, half = S(Element<S>(.5)) * (low + high);
        const Mask<S> leads = (newton >= low) & (newton <= high);
        const S next = select(leads, newton, half), step = abs(next - t);
        const Mask<S> found = y == S(0), goes_on = step > least * max(abs(t), S(Element<S>(.25)));
        t = select(lanes & !found, next, t);  // those that are done stay where they are
        lanes = lanes & !found & (goes_on | (Mask<S>(step > S(0)) & !leads));
    }
    return t;
}
template <class S, class Value>
STRAHL_INLINE S zero_between(const Value& value, S low, S high, Mask<S> below, Mask<S> lanes) {
    return zero_between<S>(value, low, high, S(Element<S>(.5)) * (low + high), below, lanes);
}

/// The points a + t (2 h + t (e + t d)) of a contour for t from 0 to 1. It ends at c, where the next piece begins. `d`
/// is 0 if it is a parabola, and `e` as well if it is straight; else it turns to one side, by hardly more than a right
/// angle.
template <class T>
struct ContourPiece {
    T ax, ay, cx, cy, hx, hy, ex, ey, dx, dy;
    T bottom = 0, top = 0, reach = 0;  // between which y it is, and up to which |x|

    /// Finds between which numbers the control points are, in one direction. Those of a straight line or of a parabola
    /// are between these of a cubic.
    static std::pair<T, T> between(T a, T h, T e, T c) {
        const T first = a + T(2) / 3 * h, second = first + (2 * h + e) / 3;
        return {std::min(std::min(a, c), std::min(first, second)), std::max(std::max(a, c), std::max(first, second))};
    }
    /// Sets the bounds.
    void bound() {
        const auto [left, right] = between(ax, hx, ex, cx);
        std::tie(bottom, top) = between(ay, hy, ey, cy), reach = std::max(-left, right);
    }
    /// Rounds its numbers.
    template <class R>
    ContourPiece<R> rounded() const {
        return {R(ax), R(ay), R(cx), R(cy), R(hx), R(hy), R(ex), R(ey), R(dx), R(dy), R(bottom), R(top), R(reach)};
    }
    /// Converts it to numbers of more digits, and changes the last one so that the piece ends at c: rounded numbers
    /// miss it.
    template <class R>
    ContourPiece<R> as() const {
        ContourPiece<R> all = rounded<R>();
        if constexpr (std::is_same_v<R, T>) return all;
        const auto end = [](R a, R c, R& h, R& e, R& d, bool cubic, bool curved) {
            if (cubic)
                d = c - a - 2 * h - e;
            else if (curved)
                e = c - a - 2 * h;
            else
                h = (c - a) / 2;
        };
        const bool cubic = dx != 0 || dy != 0, curved = ex != 0 || ey != 0;
        end(all.ax, all.cx, all.hx, all.ex, all.dx, cubic, curved);
        end(all.ay, all.cy, all.hy, all.ey, all.dy, cubic, curved);
        return all;
    }

    /// Returns the t of a point <x, y> of the piece. It is found along the chord, along which the piece has one point
    /// everywhere; where it is steep there this is off by the square root of a rounding, and a step along the piece
    /// itself mends it.
    STRAHL_INLINE T nearest(T x, T y) const {
        const T chord_x = cx - ax, chord_y = cy - ay, zero(0), one(1);
        const T half = fma(chord_x, hx, chord_y * hy), bend = fma(chord_x, ex, chord_y * ey);
        const T way = fma(chord_x, x - ax, chord_y * (y - ay));
        const T square = fma(half, half, bend * way);
        const Mask<T> cubic = !((dx == zero) & (dy == zero));
        T t = way / (half + sqrt(max(square, zero)));
        if (any(cubic)) {
            const T third = fma(chord_x, dx, chord_y * dy), two(2), three(3);
            const auto value = [&](const T& at) __attribute__((always_inline)) {
                return std::pair(fma(at, fma(at, fma(at, third, bend), two * half), -way),
                                 fma(at, fma(at, three * third, two * bend), two * half));
            };
            t = select(cubic, zero_between<T>(value, zero, one, zero < one, cubic), t);
        }
        t = max(zero, min(one, t));
        const T two(2), off_x = x - fma(t, fma(two, hx, t * fma(t, dx, ex)), ax);
        const T off_y = y - fma(t, fma(two, hy, t * fma(t, dy, ey)), ay);
        const auto [way_x, way_y] = way_at(t);
        const T square_way = two * fma(way_x, way_x, way_y * way_y);
        t = t + fma(off_x, way_x, off_y * way_y) / max(square_way, T(std::numeric_limits<Element<T>>::min()));
        return max(zero, min(one, t));
    }
    /// Returns the x and y of half of the derivative at t.
    STRAHL_INLINE std::pair<T, T> way_at(T t) const {
        const T more = T(Element<T>(1.5)) * t;
        return {fma(t, fma(more, dx, ex), hx), fma(t, fma(more, dy, ey), hy)};
    }
};

/// Contours, and their pieces in a space of their own, in which they lie between -1 and 1: there <x, y> is at (<x, y> -
/// centre) / unit. Points are inside that an odd number of contours surround.
struct ContourData {
    std::vector<Contour> contours;
    std::vector<ContourPiece<double>> pieces;
    Contour::Point centre{}, half{};  // the middle of the box around them, and half of its size
    double inner = 0;                 // those that turn are not nearer to their axis
    double unit = 1;

    /// Contours that turn about the y axis are not closed, and the box around them has it in its middle.
    explicit ContourData(std::vector<Contour> all, bool turned = false);
    /// Is the figure a convex polygon?
    bool is_convex_polygon() const;
    /// The disc of radius 1, or nearly, with a square hole.
    static std::shared_ptr<const ContourData> usual();
};

/// Does a kind of bodies have contours?
template <class Kind>
inline constexpr bool has_contours = requires(const Kind kind) {
    kind.data->contours;
};

/// Do rays list where they cross bodies of a kind, which may be often?
template <class Kind>
inline constexpr bool lists_crossings = requires(const Kind kind) {
    kind.face_count();
};

/// Do these have pieces, which worlds keep?
template <class Kind>
inline constexpr bool has_pieces = requires(const Kind kind) {
    kind.data->pieces;
};

/// A line in the plane: a point of it, from which on places along it are counted, and its direction, of length 1.
template <class S>
struct PlaneLine {
    S x, y, ux, uy;

    /// Returns how far a vector leads along the line, and how far to its left.
    STRAHL_INLINE S along(const S& vx, const S& vy) const { return fma(ux, vx, uy * vy); }
    STRAHL_INLINE S across(const S& vx, const S& vy) const { return fma(ux, vy, -(uy * vx)); }
};

/// Returns the zeros of (1 - t)^2 from + 2 t (1 - t) middle + t^2 to: the only one between 0 and 1 if the signs of
/// `from` and `to` differ, where 0 counts as above; else both, if they are there: `square` is middle^2 - from to.
template <class S>
STRAHL_INLINE std::pair<S, S> zeros_between(S from, S middle, S to, S square) {
    const S zero(0), one(1), root = sqrt(max(square, zero)), q = -(middle + select(middle < zero, -root, root));
    const S first_sum = from + q, last_sum = q + to;
    const S first = select(first_sum == zero, zero, from / first_sum);
    const S last = select(last_sum == zero, one, q / last_sum);
    return {select(either(Mask<S>(from < zero), Mask<S>(q < zero)), last, first), last};
}

/// Calls crossed(lanes, w, number) where lines cross pieces: at the places w along them. Whether an end of a piece is
/// left of a line is decided once for both pieces that meet there. So each line crosses closed contours an even number
/// of times, and neither passes between two pieces nor is seen to cross both.
template <class S, class Crossed>
STRAHL_INLINE void cross_contours(const ContourPiece<Element<S>>* pieces, int count, const PlaneLine<S>& line,
                                  Mask<S> lanes, const Crossed& crossed) {
    const S zero(0), one(1), two(2), three(3);
    for (int i = 0; i < count; ++i) {
        const ContourPiece<Element<S>>& piece = pieces[i];
        const S from_x = S(piece.ax) - line.x, from_y = S(piece.ay) - line.y, h_x(piece.hx), h_y(piece.hy);
        const S from = line.across(from_x, from_y), to = line.across(S(piece.cx) - line.x, S(piece.cy) - line.y);
        const Mask<S> right = from < zero, changes = either(right, Mask<S>(to < zero)), single = lanes & changes;
        const bool parabola = piece.dx == 0 && piece.dy == 0;
        if (parabola && piece.ex == 0 && piece.ey == 0) {
            if (none(single)) continue;
            crossed(single, fma(from / (from - to), two * line.along(h_x, h_y), line.along(from_x, from_y)), i);
            continue;
        }
        const S e_x(piece.ex), e_y(piece.ey), h = line.across(h_x, h_y), e = line.across(e_x, e_y);
        S first, last;
        Mask<S> twice;
        if (parabola) {
            const S middle = from + h, square = fma(middle, middle, -(from * to));
            twice = lanes & !changes & either(right, Mask<S>(middle < zero)) & (square > zero);
            if (none(single | twice)) continue;
            const auto zeros = zeros_between(from, middle, to, square);
            first = zeros.first, last = zeros.second;
        } else {
            // It turns to one side, so that the distance from the line has at most one extreme.
            const S d = line.across(S(piece.dx), S(piece.dy)), begin = two * h, middle = begin + e;
            const S end = fma(three, d, middle + e);
            const auto value = [&](const S& t) __attribute__((always_inline)) {
                return std::pair(fma(t, fma(t, fma(t, d, e), two * h), from),
                                 fma(t, fma(t, three * d, two * e), two * h));
            };
            const Mask<S> comes = either(right, Mask<S>(begin < zero)), goes = either(right, Mask<S>(end >= zero));
            twice = lanes & !changes & comes & goes;
            if (none(single | twice)) continue;
            S extreme = one, there = to;
            if (any(twice)) {
                const S square = fma(middle, middle, -(begin * end));
                extreme = select(twice, zeros_between(begin, middle, end, square).first, one);
                there = value(extreme).first;
                twice = twice & either(right, Mask<S>(there < zero));
                extreme = select(twice, extreme, one), there = select(twice, there, to);
                if (none(single | twice)) continue;
            }
            const S share = from / (from - there), other = there / (there - to);
            first = zero_between<S>(value, zero, extreme, extreme * share, right, Mask<S>(single | twice));
            last = any(twice) ? zero_between<S>(value, extreme, one, fma(one - extreme, other, extreme),
                                                Mask<S>(!right), twice)
                              : first;
        }
        const auto place = [&](const S& t) __attribute__((always_inline)) {
            const S bend = fma(t, line.along(S(piece.dx), S(piece.dy)), line.along(e_x, e_y));
            return fma(t, fma(t, bend, two * line.along(h_x, h_y)), line.along(from_x, from_y));
        };
        crossed(Mask<S>(single | twice), place(first), i);
        if (any(twice)) crossed(twice, place(last), i);
    }
}

}  // namespace strahl
