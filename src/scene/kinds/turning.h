// Finds where lines cross the surface that a piece of a contour makes when it turns about an axis.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "num/memory.h"
#include "num/uninitialized.h"
#include "scene/kinds/contours.h"

namespace strahl {

/// Heights between which some lines are all the time that they are in a cylinder about the axis, and how near to it the
/// nearest of them comes.
template <class R>
struct LinesInCylinder {
    R low, high, least;

    /// May one of the lines cross the surface of a piece? It is where the control points of the piece are.
    template <class T>
    STRAHL_INLINE bool may_hold(const ContourPiece<T>& piece) const {
        return R(piece.bottom) <= high && R(piece.top) >= low && R(piece.reach) >= least;
    }
};

/// A line about the y axis: at s its height is `height` + s `rise`, and its distance from the axis the root of
/// `least`^2 + (`along` + s `speed`)^2. rise^2 + speed^2 is 1.
template <class V>
struct LineAroundAxis {
    V height, rise, along, speed, least;

    /// May it come into the cylinder about the axis of this radius from -height to height?
    STRAHL_INLINE Mask<V> meets(V radius, V half) const {
        const V square = (radius - least) * (radius + least), w = rise * along - speed * height;
        return (square > V(0)) & (abs(w) - speed * half <= abs(rise) * sqrt(max(square, V(0))));
    }

    /// Returns where the lines of these lanes are in the cylinder of this radius, and by `slack` more.
    STRAHL_INLINE LinesInCylinder<Element<V>> within(Mask<V> lanes, V radius, Element<V> slack) const {
        const V zero(0), infinite(std::numeric_limits<Element<V>>::infinity());
        const V per = rise / speed, middle = height - per * along;
        const V reach = abs(per) * sqrt(max((radius - least) * (radius + least), zero));
        const Mask<V> level = lanes & (speed > zero);
        const auto lowest = [&](const V& of) { return strahl::least(select(lanes, of, infinite)) - slack; };
        return {lowest(select(level, middle - reach, -infinite)), -lowest(select(level, -(middle + reach), -infinite)),
                lowest(least)};
    }

    /// The line through <x, y, z> along a vector of length 1.
    STRAHL_INLINE static LineAroundAxis of(const Vec3<V>& p, const Vec3<V>& d) {
        const V zero(0), speed = sqrt(d.x * d.x + d.z * d.z), u = d.x / speed, v = d.z / speed;
        const Mask<V> moves = speed > zero;
        return {p.y, d.y, select(moves, p.x * u + p.z * v, zero), select(moves, speed, zero),
                select(moves, abs(p.x * v - p.z * u), sqrt(p.x * p.x + p.z * p.z))};
    }
};

/// Polynomials of degree `degree` between two places by Bernstein's coefficients, one in each of `lanes`. Their signs
/// at the ends are known better than these tell.
template <class V, std::size_t size = 7>
struct BernsteinPart {
    std::array<V, size> c;
    V low, high;
    Mask<V> above_low, above_high, lanes;
    int depth = 0;  // how often it was halved

    /// Finds the zero by the values and slopes that value(t) returns.
    template <class Value>
    STRAHL_INLINE V zero(int degree, const Value& value) const {
        const V share = c[0] / (c[0] - c[degree]), t = low + share * (high - low);
        const V start = select((share > V(0)) & (share < V(1)), t, V(Element<V>(.5)) * (low + high));
        return zero_between<V>(value, low, high, start, !above_low, lanes);
    }
    /// Cuts it at `place` in these lanes, and keeps what is beyond; returns what is before.
    STRAHL_INLINE BernsteinPart cut(int degree, V place, Mask<V> above, Mask<V> own) {
        BernsteinPart before = *this;
        before.lanes = own;
        const V share = select(own & (high > low), (place - low) / (high - low), V(0));
        for (int n = 0; n <= degree; ++n) {
            before.c[n] = c[0];
            for (int i = 0; i + n < degree; ++i) c[i] += share * (c[i + 1] - c[i]);
        }
        before.high = place, before.above_high = above;
        low = select(own, place, low), above_low = (own & above) | (above_low & !own);
        return before;
    }
};

/// Calls found(part) for parts in whose lanes the polynomial has one zero, by Descartes' rule of signs: there are at
/// most as many as its coefficients change their signs. above_at(place) tells whether it is above 0 there. Two zeros
/// that rounding, up to `noise`, hides from each other are left out.
template <class V, std::size_t size, class AboveAt, class Found>
STRAHL_INLINE void isolate_zeros(const BernsteinPart<V, size>& whole, int degree, V noise, const AboveAt& above_at,
                                 const Found& found) {
    constexpr int deepest = 40, most_cuts = 100;  // a line in the surface has zeros everywhere
    Room<BernsteinPart<V, size>, deepest + 1> waiting;
    waiting[0] = whole;
    V cuts(0);
    for (int count = 1; count > 0;) {
        BernsteinPart<V, size> part = waiting[--count];
        V changes(0);
        Mask<V> above = part.above_low;
        const auto meet = [&](Mask<V> known, Mask<V> next) __attribute__((always_inline)) {
            const Mask<V> turns = known & either(next, above);
            changes = select(turns, changes + V(1), changes), above = either(above, turns);
        };
        for (int i = 1; i < degree; ++i) meet(abs(part.c[i]) > noise, part.c[i] > V(0));
        meet(part.lanes, part.above_high);
        const Mask<V> several =
            part.lanes & (changes > V(part.depth < deepest ? 1 : 2 * degree)) & (cuts < V(most_cuts));
        const Mask<V> single = part.lanes & !several & either(part.above_low, part.above_high);
        part.lanes = single;
        if (any(single)) found(part);
        if (none(several)) continue;
        const V middle = (part.low + part.high) / V(2);
        cuts = select(several, cuts + V(1), cuts);
        ++part.depth, part.lanes = several;
        const BernsteinPart<V, size> before = part.cut(degree, middle, above_at(middle), several);
        waiting[count++] = part, waiting[count++] = before;
    }
}

/// Places along lines, in no order; those that are not there are infinite.
template <class V>
using TurnedPlaces = std::array<V, 6>;

/// Returns the places s where lines cross the surface of a piece that turns about the y axis. In the plane of distance
/// from the axis and height, a line is a hyperbola: where a piece crosses it, the line crosses the surface. Whether an
/// end of a piece is beyond the hyperbola is decided once for both pieces that meet there. Where lines are nearly
/// level, both branches of the hyperbola are close together: the piece is cut between them.
template <int degree, class V>
STRAHL_INLINE TurnedPlaces<V> cross_turned(const ContourPiece<Element<V>>& piece, const LineAroundAxis<V>& line,
                                           Mask<V> lanes) {
    using R = Element<V>;
    constexpr R bits = 16 * std::numeric_limits<R>::epsilon();
    const auto& [height, rise, along, speed, least] = line;
    const V zero(0), one(1), two(2), steep = abs(rise);
    const V ax(piece.ax), ay(piece.ay), hx(piece.hx), hy(piece.hy), ex(piece.ex), ey(piece.ey), dx(piece.dx),
        dy(piece.dy);
    // The control points: their distances from the axis, and their heights above where the line is nearest to the axis,
    // times its speed.
    const auto above_nearest = [&](const V& y) { return speed * (y - height) + rise * along; };
    const auto control = [](R a, R h, R e) {
        return std::array<R, 3>{a, degree == 2 ? a + h : a + 2 * (R(1) / 3) * h, a + (R(1) / 3) * (4 * h + e)};
    };
    const auto xs = control(piece.ax, piece.hx, piece.ex), ys = control(piece.ay, piece.hy, piece.ey);
    std::array<V, degree + 1> r, w;
    R furthest = 0, left = std::numeric_limits<R>::infinity(), right = -left;
    V lowest(std::numeric_limits<R>::infinity()), highest = -lowest;
    for (int i = 0; i <= degree; ++i) {
        const R x = i == degree ? piece.cx : xs[i];
        r[i] = V(x), w[i] = above_nearest(V(i == degree ? piece.cy : ys[i]));
        furthest = std::max(furthest, std::abs(x)), left = std::min(left, x), right = std::max(right, x);
        lowest = min(lowest, w[i]), highest = max(highest, w[i]);
    }
    TurnedPlaces<V> places;
    for (V& place : places) place = V(std::numeric_limits<R>::infinity());
    const auto square = [&](const V& radius) __attribute__((always_inline)) {
        return (abs(radius) - least) * (abs(radius) + least);
    };
    // Rules out lines that pass the control points on one side. F is the polynomial below.
    const V size = max(abs(lowest), abs(highest)), most = square(V(furthest)), steepness = rise * rise;
    const V noise = V(bits) * (steepness * V(furthest) * V(furthest) + size * size);
    const R nearest = std::max(std::max(left, -right), R(0));
    const V least_f = steepness * (V(nearest) - least) * (V(nearest) + least) - size * size;
    lanes = lanes & (most > zero) & !(max(lowest, -highest) > steep * sqrt(max(most, zero))) & !(least_f > noise);
    if (none(lanes)) return places;

    const auto beyond = [&](const V& radius, const V& own_w) __attribute__((always_inline))->Mask<V> {
        const V own = square(radius);
        return (own > zero) & (steep * sqrt(max(own, zero)) > abs(own_w));
    };
    // The piece's coordinates and their derivatives; the constants are those of its degree.
    const auto at = [](const V& t, const V& a, const V& h, const V& e, const V& d) __attribute__((always_inline)) {
        if constexpr (degree == 1) return a + t * (V(2) * h);
        if constexpr (degree == 2) return a + t * (V(2) * h + t * e);
        return a + t * (V(2) * h + t * (e + t * d));
    };
    const auto slope_at = [](const V& t, const V& h, const V& e, const V& d) __attribute__((always_inline)) {
        if constexpr (degree == 1) return V(2) * h;
        if constexpr (degree == 2) return V(2) * (h + t * e);
        return V(2) * h + t * (V(2) * e + t * V(3) * d);
    };
    const auto radius_at = [&](const V& t) { return at(t, ax, hx, ex, dx); };
    const auto height_at = [&](const V& t) { return at(t, ay, hy, ey, dy); };
    const auto out_at = [&](const V& t) { return slope_at(t, hx, ex, dx); };
    const auto up_at = [&](const V& t) { return slope_at(t, hy, ey, dy); };
    // F = rise^2 (r^2 - least^2) - w^2.
    constexpr R choose[7][7] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}, {}, {1, 6, 15, 20, 15, 6, 1}};
    BernsteinPart<V> curve{{}, zero, one, beyond(r[0], w[0]), beyond(r[degree], w[degree]), lanes};
    for (V& c : curve.c) c = zero;
    for (int i = 0; i <= degree; ++i)
        for (int k = 0; k <= degree; ++k)
            curve.c[i + k] += V(choose[degree][i] * choose[degree][k] / choose[2 * degree][i + k]) *
                              (rise * rise * (r[i] - least) * (r[k] + least) - w[i] * w[k]);
    // Where all coefficients have one sign there is no zero, and nothing to be cut.
    V smallest = curve.c[0], largest = curve.c[0];
    for (int i = 1; i <= 2 * degree; ++i) smallest = min(smallest, curve.c[i]), largest = max(largest, curve.c[i]);
    const Mask<V> no_zero = ((smallest > noise) & curve.above_low & curve.above_high) |
                            ((largest < -noise) & !(curve.above_low | curve.above_high));
    lanes = curve.lanes = lanes & !no_zero;
    if (none(lanes)) return places;

    V count(0);
    Mask<V> above = w[0] >= zero;  // the nearest point of the line to the axis
    const auto cross = [&](const BernsteinPart<V>& part) __attribute__((always_inline)) {
        const auto above_at = [&](const V& t) __attribute__((always_inline)) {
            return beyond(radius_at(t), above_nearest(height_at(t)));
        };
        const auto find = [&](const BernsteinPart<V>& here) __attribute__((always_inline)) {
            const Mask<V> own = here.lanes, polynomial = steep > V(R(.1));
            const bool all_polynomial = none(own & !polynomial);
            const auto value = [&](const V& t) __attribute__((always_inline)) {
                const V radius = radius_at(t), beside = square(radius), own_w = above_nearest(height_at(t));
                const V slope = radius * out_at(t), w_slope = speed * up_at(t);
                const std::pair whole(rise * rise * beside - own_w * own_w,
                                      two * (rise * rise * slope - own_w * w_slope));
                if (all_polynomial) return whole;
                const V distance = sqrt(abs(beside));
                return std::pair(
                    select(polynomial, whole.first, steep * select(beside < zero, -distance, distance) - abs(own_w)),
                    select(polynomial, whole.second,
                           steep * slope / max(distance, V(R(1e-4))) - select(own_w < zero, -w_slope, w_slope)));
            };
            const V t = here.zero(2 * degree, value);
            const V radius = radius_at(t), distance = sqrt(max(square(radius), zero));
            // The place by the height, or by the distance from the axis: the one that rounding moves less.
            const V by_height = (abs(up_at(t)) + one) * distance * speed;
            const V by_distance = (abs(out_at(t)) + one) * abs(radius) * steep;
            const Mask<V> away = either(above, rise < zero);
            const V place = select((speed == zero) | (by_height < by_distance), (height_at(t) - height) / rise,
                                   (select(away, distance, -distance) - along) / speed);
            for (std::size_t i = 0; i < places.size(); ++i)
                places[i] = select(own & (count == V(static_cast<R>(i))), place, places[i]);
            count = select(own, count + one, count);
        };
        isolate_zeros(part, 2 * degree, noise, above_at, find);
    };
    const Mask<V> split = lanes & (speed > zero) & (lowest < zero) & (highest >= zero);
    if (any(split)) {
        BernsteinPart<V> heights{{}, zero, one, above, w[degree] >= zero, split};
        for (int i = 0; i <= degree; ++i) heights.c[i] = w[i];
        const auto cut = [&](const BernsteinPart<V>& here) __attribute__((always_inline)) {
            const auto value = [&](const V& t) __attribute__((always_inline)) {
                return std::pair(above_nearest(height_at(t)), speed * up_at(t));
            };
            const V t = here.zero(degree, value);
            cross(curve.cut(2 * degree, t, square(radius_at(t)) > zero, here.lanes));
            above = either(above, here.lanes);
        };
        isolate_zeros(
            heights, degree, V(bits) * size, [&](const V& t) { return above_nearest(height_at(t)) >= zero; }, cut);
    }
    cross(curve);
    return places;
}
template <class V>
STRAHL_INLINE TurnedPlaces<V> cross_turned_here(const ContourPiece<Element<V>>& piece, const LineAroundAxis<V>& line,
                                                Mask<V> lanes) {
    if (piece.dx != 0 || piece.dy != 0) return cross_turned<3, V>(piece, line, lanes);
    if (piece.ex != 0 || piece.ey != 0) return cross_turned<2, V>(piece, line, lanes);
    return cross_turned<1, V>(piece, line, lanes);
}
template <class V>
[[gnu::noinline]] TurnedPlaces<V> call_cross_turned(const ContourPiece<Element<V>>& piece,
                                                    const LineAroundAxis<V>& line, Mask<V> lanes) {
    return cross_turned_here<V>(piece, line, lanes);
}
/// Returns what cross_turned_here does. Packs call it: its code is long, and the call costs little.
template <class V>
STRAHL_INLINE TurnedPlaces<V> cross_turned(const ContourPiece<Element<V>>& piece, const LineAroundAxis<V>& line,
                                           Mask<V> lanes) {
    if constexpr (width < V >> 1)
        return call_cross_turned<V>(piece, line, lanes);
    else
        return cross_turned_here<V>(piece, line, lanes);
}

}  // namespace strahl
