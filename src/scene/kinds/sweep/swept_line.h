// The pieces of the curve along which a ball sweeps, and where lines are within the ball on its way.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "num/lanes.h"
#include "num/memory.h"
#include "scene/kinds/field.h"
#include "scene/kinds/turning.h"

namespace strahl {

/// A ball that tells where a sweep leads: the curve goes through it, or else only towards it.
struct SweptBall {
    DVec3 centre{0, 0, 0};
    double radius = .5;
    bool through = true;

    bool operator==(const SweptBall&) const = default;

    static constexpr auto fields =
        std::make_tuple(Field{"centre", &SweptBall::centre, "its centre"},
                        Field{"radius", &SweptBall::radius, "its radius", Range::length_or_zero});
};

/// A piece of the curve: Bezier's control points, and radii that are mixed as these are.
struct SweepPiece {
    std::array<DVec3, 4> centre;
    std::array<double, 4> radius;
    DVec3 middle;           // centre of a ball around all that is swept
    double reach;           // that ball's radius
    DVec3 group_middle{0};  // the same for this piece and those after it
    double group_reach = 0;
};

/// Returns Bernstein's coefficients of a product of two polynomials that have those of p and q.
template <class V, std::size_t m, std::size_t n>
STRAHL_INLINE std::array<V, m + n - 1> bernstein_product(const std::array<V, m>& p, const std::array<V, n>& q) {
    using R = Element<V>;
    constexpr double choose[11][11] = {{1},
                                       {1, 1},
                                       {1, 2, 1},
                                       {1, 3, 3, 1},
                                       {1, 4, 6, 4, 1},
                                       {1, 5, 10, 10, 5, 1},
                                       {1, 6, 15, 20, 15, 6, 1},
                                       {},
                                       {},
                                       {},
                                       {1, 10, 45, 120, 210, 252, 210, 120, 45, 10, 1}};
    std::array<V, m + n - 1> sum;
    for (V& own : sum) own = V(0);
    for (std::size_t i = 0; i < m; ++i)
        for (std::size_t k = 0; k < n; ++k)
            sum[i + k] = fma(V(R(choose[m - 1][i]) * R(choose[n - 1][k]) / R(choose[m + n - 2][i + k])), p[i] * q[k],
                             sum[i + k]);
    return sum;
}
template <class V, std::size_t n>
STRAHL_INLINE std::array<V, n - 1> bernstein_slope(const std::array<V, n>& p) {
    std::array<V, n - 1> slope;
    for (std::size_t i = 0; i + 1 < n; ++i) slope[i] = V(static_cast<Element<V>>(n - 1)) * (p[i + 1] - p[i]);
    return slope;
}
template <class V, std::size_t n>
STRAHL_INLINE V largest_size(const std::array<V, n>& p) {
    V most(0);
    for (const V& own : p) most = max(most, abs(own));
    return most;
}

/// A cubic polynomial by Bernstein's coefficients, and its values.
template <class V>
struct Cubic {
    std::array<V, 4> c;
    V a0, a1, a2, a3;

    STRAHL_INLINE explicit Cubic(const std::array<V, 4>& c)
        : c(c),
          a0(c[0]),
          a1(V(3) * (c[1] - c[0])),
          a2(V(3) * ((c[2] - c[1]) - (c[1] - c[0]))),
          a3((c[3] - c[0]) - V(3) * (c[2] - c[1])) {}
    STRAHL_INLINE V at(const V& t) const { return fma(t, fma(t, fma(t, a3, a2), a1), a0); }
    STRAHL_INLINE V slope(const V& t) const { return fma(t, fma(t, V(3) * a3, V(2) * a2), a1); }
    STRAHL_INLINE V bend(const V& t) const { return fma(t, V(6) * a3, V(2) * a2); }
};

}  // namespace strahl

namespace strahl::inline STRAHL_LEVEL {

/// The parts of lines that are within a sweep, ascending and apart from each other, for each lane.
template <class V>
struct SweptSpans {
    using R = Element<V>;
    static constexpr int most = 256;  // parts of a line; more are left out
    struct LaneSpans {
        Room<R, most> near, far;
        int count;
    };
    std::array<LaneSpans, width<V>> lists;

    STRAHL_INLINE SweptSpans() {
        for (LaneSpans& own : lists) own.count = 0;
    }
    /// Adds a part; it becomes one with those that it reaches.
    [[gnu::noinline]] void add(int lane, R near, R far) {
        LaneSpans& own = lists[static_cast<std::size_t>(lane)];
        int first = own.count;
        while (first > 0 && !(own.far[first - 1] < near)) --first;
        int end = first;
        for (; end < own.count && !(far < own.near[end]); ++end)
            near = min(near, own.near[end]), far = max(far, own.far[end]);
        if (end == first) {
            if (own.count == most) return;
            for (int i = own.count++; i > first; --i) own.near[i] = own.near[i - 1], own.far[i] = own.far[i - 1];
        } else if (const int gone = end - first - 1; gone > 0) {
            own.count -= gone;
            for (int i = first + 1; i < own.count; ++i)
                own.near[i] = own.near[i + gone], own.far[i] = own.far[i + gone];
        }
        own.near[first] = near, own.far[first] = far;
    }
};

/// A part of the way along a piece where lines are within the ball, while it is looked for.
template <class V>
struct SweptPart {
    Mask<V> open;
    V near, far;

    /// Goes on to where the line, counted from the ball's centre, is within the ball half the root of `square` long;
    /// `place` is that of the centre. Adds what ends there to `spans`.
    STRAHL_INLINE void visit(Mask<V> lanes, const V& square, const V& place, SweptSpans<V>& spans) {
        const Mask<V> in = lanes & (square > V(0));
        close(lanes & !in, spans);
        const V half = sqrt(max(square, V(0))), low = place - half, high = place + half;
        near = select(in, select(open, min(near, low), low), near);
        far = select(in, select(open, max(far, high), high), far);
        open = open | in;
    }
    STRAHL_INLINE void close(Mask<V> lanes, SweptSpans<V>& spans) {
        for (unsigned left = bits(open & lanes); left; left &= left - 1) {
            const int k = std::countr_zero(left);
            spans.add(k, lane(near, k), lane(far, k));
        }
        open = open & !lanes;
    }
};

/// Adds where lines, given by a point and a direction of length 1, are within the ball while it sweeps along a piece.
/// At t the ball holds the line from z - sqrt(d) to z + sqrt(d) if d > 0, where z is the place nearest to its centre
/// and d the square of its radius less that of the distance. The ends of what it holds at any t are at t = 0 and 1, or
/// where one of these two does not change: where G = 4 z'^2 d - d'^2, of degree 10, is 0. Where d does not change is
/// looked at as well: between these places d grows or falls, so that it is above 0 everywhere between two at which it
/// is.
template <class V>
STRAHL_INLINE void sweep_along(const SweepPiece& piece, const Vec3<V>& from, const Vec3<V>& unit, Mask<V> lanes,
                               SweptSpans<V>& spans) {
    using R = Element<V>;
    constexpr R last_bit = std::numeric_limits<R>::epsilon();
    const V zero(0), one(1), two(2), four(4);
    // Two axes at right angles to the line and to each other.
    const Mask<V> up = unit.z < zero;
    const V sign = select(up, -one, one), a = -one / (sign + unit.z), b = unit.x * unit.y * a;
    const Vec3<V> across(fma(sign * unit.x, unit.x * a, one), sign * b, -sign * unit.x);
    const Vec3<V> beside(b, fma(unit.y, unit.y * a, sign), -unit.y);
    std::array<V, 4> xs, ys, zs, rs;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3<V> p = splat<V>(piece.centre[i]) - from;
        xs[i] = dot(p, across), ys[i] = dot(p, beside), zs[i] = dot(p, unit), rs[i] = V(R(piece.radius[i]));
    }
    const Cubic<V> x(xs), y(ys), z(zs), r(rs);
    const std::array<V, 7> xx = bernstein_product(xs, xs), yy = bernstein_product(ys, ys),
                           rr = bernstein_product(rs, rs);
    std::array<V, 7> d;
    V highest = zero;
    for (std::size_t i = 0; i < 7; ++i) d[i] = rr[i] - (xx[i] + yy[i]), highest = max(highest, d[i]);
    lanes = lanes & (highest > zero);
    if (none(lanes)) return;

    const std::array<V, 6> slopes = bernstein_slope(d);
    const std::array<V, 3> ways = bernstein_slope(zs);
    const std::array<V, 11> grown = bernstein_product(bernstein_product(ways, ways), d);
    const std::array<V, 11> turned = bernstein_product(slopes, slopes);
    const V size = largest_size(d);
    BernsteinPart<V, 11> whole{{}, zero, one, lanes, lanes, lanes};
    for (std::size_t i = 0; i < 11; ++i) whole.c[i] = four * grown[i] - turned[i];
    const V steep = largest_size(slopes), fast = largest_size(ways);
    const V noise = V(64 * last_bit) * (four * fast * fast * size + steep * steep);
    whole.above_low = whole.c[0] > zero, whole.above_high = whole.c[10] > zero;

    struct Own {
        V d, slope, bend;
    };
    const auto square_at = [&](const V& t) __attribute__((always_inline)) {
        const V px = x.at(t), py = y.at(t), pr = r.at(t);
        return fma(pr, pr, -fma(px, px, py * py));
    };
    const auto values_at = [&](const V& t) __attribute__((always_inline)) {
        const V px = x.at(t), py = y.at(t), pr = r.at(t), sx = x.slope(t), sy = y.slope(t), sr = r.slope(t);
        return Own{fma(pr, pr, -fma(px, px, py * py)), two * fma(pr, sr, -fma(px, sx, py * sy)),
                   two * (fma(sr, sr, pr * r.bend(t)) - fma(sx, sx, px * x.bend(t)) - fma(sy, sy, py * y.bend(t)))};
    };
    // Where G is not far below 0, 2 |z'| sqrt(d) - |d'|, which has its sign: it is steep where zeros of G are close to
    // each other, but too steep where d is near 0.
    const auto end_at = [&](const V& t) __attribute__((always_inline)) {
        const Own own = values_at(t);
        const V way = z.slope(t), bend = z.bend(t), fall = own.slope * own.slope, rise = four * way * way;
        const V root = sqrt(max(own.d, zero)), per = one / max(root, V(std::numeric_limits<R>::min()));
        const V speed = select(way < zero, -bend, bend);
        const Mask<V> near = fall < four * rise * own.d;
        return std::pair(
            select(near, fma(two * abs(way), root, -abs(own.slope)), fma(rise, own.d, -fall)),
            select(near,
                   fma(two * speed, root, abs(way) * own.slope * per - select(own.slope < zero, -own.bend, own.bend)),
                   fma(V(8) * way * bend, own.d, own.slope * (rise - two * own.bend))));
    };
    const Mask<V> closed = lanes & !lanes;
    SweptPart<V> part{closed, zero, zero};
    const auto end = [&](std::size_t i) __attribute__((always_inline)) {
        part.visit(lanes, fma(rs[i], rs[i], -fma(xs[i], xs[i], ys[i] * ys[i])), zs[i], spans);
    };
    const auto search = [&](const BernsteinPart<V, 11>& own) __attribute__((always_inline)) {
        isolate_zeros(
            own, 10, noise, [&](const V& t) __attribute__((always_inline)) { return end_at(t).first > zero; },
            [&](const BernsteinPart<V, 11>& here) __attribute__((always_inline)) {
                const V t = here.zero(10, end_at);
                part.visit(here.lanes, square_at(t), z.at(t), spans);
            });
    };
    end(0);
    BernsteinPart<V> turns{{}, zero, one, slopes[0] > zero, slopes[5] > zero, lanes};
    for (std::size_t i = 0; i < 6; ++i) turns.c[i] = slopes[i];
    isolate_zeros(
        turns, 5,
        V(16 * last_bit) * size, [&](const V& t) __attribute__((always_inline)) { return values_at(t).slope > zero; },
        [&](const BernsteinPart<V>& here) __attribute__((always_inline)) {
            const auto slope_at = [&](const V& t) __attribute__((always_inline)) {
                const Own own = values_at(t);
                return std::pair(own.slope, own.bend);
            };
            const V t = here.zero(5, slope_at), square = square_at(t);
            search(whole.cut(10, t, square > zero, here.lanes));
            part.visit(here.lanes, square, z.at(t), spans);
        });
    search(whole);
    end(3);
    part.close(lanes, spans);
}
template <class V>
[[gnu::noinline]] void call_sweep_along(const SweepPiece& piece, const Vec3<V>& from, const Vec3<V>& unit,
                                        Mask<V> lanes, SweptSpans<V>& spans) {
    sweep_along<V>(piece, from, unit, lanes, spans);
}

}  // namespace strahl::inline STRAHL_LEVEL

namespace strahl {

/// The ball of a sweep that a point is deepest in: the square of its radius less that of the point's distance from its
/// centre, and the point seen from there.
template <class R>
struct DeepestBall {
    R depth = -std::numeric_limits<R>::infinity();
    Vec3<R> out{0, 0, 0};

    /// Looks at the balls of a piece.
    STRAHL_INLINE void visit(const SweepPiece& piece, const Vec3<R>& p) {
        constexpr R last_bit = std::numeric_limits<R>::epsilon();
        std::array<R, 4> xs, ys, zs, rs;
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec3<R> off = splat<R>(piece.centre[i]) - p;
            xs[i] = off.x, ys[i] = off.y, zs[i] = off.z, rs[i] = R(piece.radius[i]);
        }
        const Cubic<R> x(xs), y(ys), z(zs), r(rs);
        const auto visit_ball = [&](const R& px, const R& py, const R& pz, const R& pr) __attribute__((always_inline)) {
            const R own = pr * pr - (px * px + py * py + pz * pz);
            if (own > depth) depth = own, out = {-px, -py, -pz};
        };
        visit_ball(xs[0], ys[0], zs[0], rs[0]), visit_ball(xs[3], ys[3], zs[3], rs[3]);
        const auto xx = bernstein_product(xs, xs), yy = bernstein_product(ys, ys), zz = bernstein_product(zs, zs),
                   rr = bernstein_product(rs, rs);
        std::array<R, 7> depths;
        R most = depth;
        for (std::size_t i = 0; i < 7; ++i) depths[i] = rr[i] - (xx[i] + yy[i] + zz[i]), most = max(most, depths[i]);
        if (!(most > depth)) return;
        const std::array<R, 6> slopes = bernstein_slope(depths);
        BernsteinPart<R> turns{{}, R(0), R(1), slopes[0] > 0, slopes[5] > 0, true};
        for (std::size_t i = 0; i < 6; ++i) turns.c[i] = slopes[i];
        const auto slope_at = [&](const R& t) __attribute__((always_inline)) {
            const R px = x.at(t), py = y.at(t), pz = z.at(t), pr = r.at(t);
            const R sx = x.slope(t), sy = y.slope(t), sz = z.slope(t), sr = r.slope(t);
            return std::pair(2 * (pr * sr - px * sx - py * sy - pz * sz),
                             2 * (sr * sr + pr * r.bend(t) - sx * sx - px * x.bend(t) - sy * sy - py * y.bend(t) -
                                  sz * sz - pz * z.bend(t)));
        };
        isolate_zeros(
            turns, 5, 16 * last_bit * largest_size(depths),
            [&](const R& t) __attribute__((always_inline)) { return slope_at(t).first > 0; },
            [&](const BernsteinPart<R>& here) __attribute__((always_inline)) {
                const R t = here.zero(5, slope_at);
                visit_ball(x.at(t), y.at(t), z.at(t), r.at(t));
            });
    }
};

}  // namespace strahl
