// Finds where lines cross the surface that a piece of a contour makes when it turns about an axis.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/kinds/contours.h"

namespace strahl {

/// A line about the y axis: at s its height is `height` + s `rise`, and its distance from the axis the root of
/// `least`^2 + (`along` + s `speed`)^2. rise^2 + speed^2 is 1.
template <class R>
struct LineAroundAxis {
    R height, rise, along, speed, least;

    /// May it come into the cylinder about the axis of this radius from -height to height?
    STRAHL_INLINE bool meets(R radius, R half) const {
        const R square = (radius - least) * (radius + least), w = rise * along - speed * height;
        return square > 0 && std::abs(w) - speed * half <= std::abs(rise) * std::sqrt(square);
    }

    /// The line through <x, y, z> along a vector of length 1.
    STRAHL_INLINE static LineAroundAxis of(const Vec3<R>& p, const Vec3<R>& d) {
        const R speed = std::sqrt(d.x * d.x + d.z * d.z);
        if (!(speed > 0)) return {p.y, d.y, 0, 0, std::sqrt(p.x * p.x + p.z * p.z)};
        const R u = d.x / speed, v = d.z / speed;
        return {p.y, d.y, p.x * u + p.z * v, speed, std::abs(p.x * v - p.z * u)};
    }
};

/// A polynomial of degree `degree` between two places by Bernstein's coefficients. Its signs at the ends are known
/// better than these tell.
template <class R>
struct BernsteinPart {
    std::array<R, 7> c;
    R low, high;
    bool above_low, above_high;

    /// Cuts it at `place`, and keeps what is beyond; returns what is before.
    STRAHL_INLINE BernsteinPart cut(int degree, R place, bool above) {
        BernsteinPart before = *this;
        const R share = high > low ? (place - low) / (high - low) : R(0);
        for (int n = 0; n <= degree; ++n) {
            before.c[n] = c[0];
            for (int i = 0; i + n < degree; ++i) c[i] += share * (c[i + 1] - c[i]);
        }
        before.high = low = place, before.above_high = above_low = above;
        return before;
    }
};

/// Calls found(low, high, above) for intervals in each of which the polynomial has one zero, by Descartes' rule of
/// signs: there are at most as many as its coefficients change their signs. `above` tells whether it is above 0 at the
/// interval's begin; above_at(place) tells so for places between. Two zeros that rounding, up to `noise`, hides from
/// each other are left out.
template <class R, class AboveAt, class Found>
STRAHL_INLINE void isolate_zeros(const BernsteinPart<R>& whole, int degree, R noise, const AboveAt& above_at,
                                 const Found& found) {
    constexpr int most = 40;
    BernsteinPart<R> waiting[most];
    waiting[0] = whole;
    int count = 1;
    for (int cuts = 0; count > 0;) {
        BernsteinPart<R> part = waiting[--count];
        int changes = 0;
        bool above = part.above_low;
        const auto meet = [&](bool next) { changes += next != above, above = next; };
        for (int i = 1; i < degree; ++i)
            if (std::abs(part.c[i]) > noise) meet(part.c[i] > 0);
        meet(part.above_high);
        if (changes > 1 && count + 2 <= most && cuts < 100) {
            const R middle = (part.low + part.high) / 2;
            const BernsteinPart<R> before = part.cut(degree, middle, above_at(middle));
            waiting[count++] = part, waiting[count++] = before;
            ++cuts;
        } else if (part.above_low != part.above_high) {
            found(part.low, part.high, part.above_low);
        }
    }
}

/// Writes the places s where a line crosses the surface of a piece that turns about the y axis, and returns how many
/// they are. In the plane of distance from the axis and height, the line is a hyperbola: where a piece crosses it, the
/// line crosses the surface. Whether an end of a piece is beyond the hyperbola is decided once for both pieces that
/// meet there. Where lines are nearly level, both branches of the hyperbola are close together: the piece is cut
/// between them.
template <int degree, class R, class T>
STRAHL_INLINE int cross_turned(const ContourPiece<T>& piece, const LineAroundAxis<R>& line, std::array<R, 6>& places) {
    constexpr R bits = 16 * std::numeric_limits<R>::epsilon();
    const auto& [height, rise, along, speed, least] = line;
    const R ax = piece.ax, ay = piece.ay, cx = piece.cx, cy = piece.cy, hx = piece.hx, hy = piece.hy, ex = piece.ex,
            ey = piece.ey, dx = piece.dx, dy = piece.dy, steep = std::abs(rise), third = R(1) / 3;
    // w is the height above where the line is nearest to the axis, times its speed.
    const auto above_nearest = [&](R y) { return speed * (y - height) + rise * along; };
    std::array<R, 4> r{ax, degree == 2 ? ax + hx : ax + 2 * third * hx, ax + third * (4 * hx + ex), cx};
    std::array<R, 4> w{ay, degree == 2 ? ay + hy : ay + 2 * third * hy, ay + third * (4 * hy + ey), cy};
    r[degree] = cx, w[degree] = cy;
    R furthest = 0, lowest = std::numeric_limits<R>::infinity(), highest = -lowest;
    for (int i = 0; i <= degree; ++i) {
        w[i] = above_nearest(w[i]);
        furthest = std::max(furthest, std::abs(r[i])), lowest = std::min(lowest, w[i]),
        highest = std::max(highest, w[i]);
    }
    const auto square = [&](R radius) { return (std::abs(radius) - least) * (std::abs(radius) + least); };
    const R most = square(furthest);
    if (!(most > 0) || std::max(lowest, -highest) > steep * std::sqrt(most)) return 0;

    const auto beyond = [&](R radius, R own_w) __attribute__((always_inline)) {
        const R own = square(radius);
        return own > 0 && steep * std::sqrt(own) > std::abs(own_w);
    };
    const auto radius_at = [&](R t) { return ax + t * (2 * hx + t * (ex + t * dx)); };
    const auto height_at = [&](R t) { return ay + t * (2 * hy + t * (ey + t * dy)); };
    // F = rise^2 (r^2 - least^2) - w^2.
    constexpr R choose[7][7] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}, {}, {1, 6, 15, 20, 15, 6, 1}};
    constexpr auto weights = [&] {
        std::array<std::array<R, degree + 1>, degree + 1> all{};
        for (int i = 0; i <= degree; ++i)
            for (int k = 0; k <= degree; ++k)
                all[i][k] = choose[degree][i] * choose[degree][k] / choose[2 * degree][i + k];
        return all;
    }();
    BernsteinPart<R> curve{{}, 0, 1, beyond(ax, w[0]), beyond(cx, w[degree])};
    for (int i = 0; i <= degree; ++i)
        for (int k = 0; k <= degree; ++k)
            curve.c[i + k] += weights[i][k] * (rise * rise * (r[i] - least) * (r[k] + least) - w[i] * w[k]);
    const R size = std::max(std::abs(lowest), std::abs(highest));
    const R noise = bits * (rise * rise * furthest * furthest + size * size);

    int count = 0;
    bool above = w[0] >= 0;  // the nearest point of the line to the axis
    const auto cross = [&](const BernsteinPart<R>& part) __attribute__((always_inline)) {
        const auto above_at = [&](R t) __attribute__((always_inline)) {
            return beyond(radius_at(t), above_nearest(height_at(t)));
        };
        isolate_zeros(
            part, 2 * degree, noise, above_at, [&](R low, R high, bool begins_above) __attribute__((always_inline)) {
                const auto value = [&](R t) __attribute__((always_inline)) {
                    const R radius = radius_at(t), own = square(radius), own_w = above_nearest(height_at(t));
                    const R slope = radius * (2 * hx + t * (2 * ex + t * 3 * dx));
                    const R w_slope = speed * (2 * hy + t * (2 * ey + t * 3 * dy));
                    if (steep > R(.1))
                        return std::pair(rise * rise * own - own_w * own_w,
                                         2 * (rise * rise * slope - own_w * w_slope));
                    const R distance = std::sqrt(std::abs(own));
                    return std::pair(steep * (own < 0 ? -distance : distance) - std::abs(own_w),
                                     steep * slope / std::max(distance, R(1e-4)) - (own_w < 0 ? -w_slope : w_slope));
                };
                const R t = zero_between<R>(value, low, high, !begins_above, true);
                const R radius = radius_at(t), distance = std::sqrt(std::max(square(radius), R(0)));
                // The place by the height, or by the distance from the axis: the one that rounding moves less.
                const R by_height = (std::abs(2 * hy + t * (2 * ey + t * 3 * dy)) + 1) * distance * speed;
                const R by_distance = (std::abs(2 * hx + t * (2 * ex + t * 3 * dx)) + 1) * std::abs(radius) * steep;
                if (count < static_cast<int>(places.size()))
                    places[count++] = speed == 0 || by_height < by_distance
                                          ? (height_at(t) - height) / rise
                                          : ((above == (rise >= 0) ? distance : -distance) - along) / speed;
            });
    };
    const auto cut = [&](R low, R high, bool begins_above) __attribute__((always_inline)) {
        const auto value = [&](R t) __attribute__((always_inline)) {
            return std::pair(above_nearest(height_at(t)), speed * (2 * hy + t * (2 * ey + t * 3 * dy)));
        };
        const R t = zero_between<R>(value, low, high, !begins_above, true);
        cross(curve.cut(2 * degree, t, square(radius_at(t)) > 0));
        above = !above;
    };
    if (speed > 0 && lowest < 0 && highest >= 0) {
        BernsteinPart<R> heights{{w[0], w[1], w[2], w[3]}, 0, 1, above, w[degree] >= 0};
        isolate_zeros(
            heights, degree, bits * size, [&](R t) { return above_nearest(height_at(t)) >= 0; }, cut);
    }
    cross(curve);
    return count;
}
template <class R, class T>
STRAHL_INLINE int cross_turned(const ContourPiece<T>& piece, const LineAroundAxis<R>& line, std::array<R, 6>& places) {
    if (piece.dx != 0 || piece.dy != 0) return cross_turned<3>(piece, line, places);
    if (piece.ex != 0 || piece.ey != 0) return cross_turned<2>(piece, line, places);
    return cross_turned<1>(piece, line, places);
}

}  // namespace strahl
