// The referee's formulas for sweeps: the spheres that touch the surface on a line are at roots of a polynomial of
// degree 10, and those crossings count that no other ball holds.
#pragma once
#include <algorithm>
#include <limits>
#include <vector>

#include "scene/kinds/sweep/sweep.h"
#include "tests/referee/torus.h"

namespace strahl::referee {

/// A polynomial by the coefficients of 1, t, t^2 ...
template <class R>
using Polynomial = std::vector<R>;
template <class R>
Polynomial<R> product(const Polynomial<R>& p, const Polynomial<R>& q) {
    Polynomial<R> all(p.size() + q.size() - 1, R(0));
    for (std::size_t i = 0; i < p.size(); ++i)
        for (std::size_t k = 0; k < q.size(); ++k) all[i + k] += p[i] * q[k];
    return all;
}
/// Returns p + s q.
template <class R>
Polynomial<R> sum(Polynomial<R> p, R s, const Polynomial<R>& q) {
    p.resize(std::max(p.size(), q.size()), R(0));
    for (std::size_t i = 0; i < q.size(); ++i) p[i] += s * q[i];
    return p;
}
template <class R>
Polynomial<R> derivative(const Polynomial<R>& p) {
    Polynomial<R> all;
    for (std::size_t i = 1; i < p.size(); ++i) all.push_back(R(static_cast<int>(i)) * p[i]);
    return all;
}
template <class R>
R value(const Polynomial<R>& p, R t) {
    R all = 0;
    for (std::size_t i = p.size(); i-- > 0;) all = all * t + p[i];
    return all;
}

/// The centre and the radius of the ball along one piece of the curve.
template <class R>
struct BallPath {
    Polynomial<R> x, y, z, radius;

    Vector<R> centre(R t) const { return {value(x, t), value(y, t), value(z, t)}; }
    /// Returns the square of the radius less that of the distance of a point.
    Polynomial<R> depth(const Vector<R>& p) const {
        Polynomial<R> all = product(radius, radius);
        const auto less = [&](Polynomial<R> own, R place) {
            own[0] -= place;
            all = sum(all, R(-1), product(own, own));
        };
        less(x, p.x), less(y, p.y), less(z, p.z);
        return all;
    }
};
template <class R>
std::vector<BallPath<R>> paths_of(const SphereSweep& sweep) {
    std::vector<BallPath<R>> all;
    const std::vector<SweptBall>& balls = sweep.data->balls;
    for (std::size_t i = 0; i + 3 < balls.size(); ++i) {
        const auto path = [&](const auto& of) {
            const R a = of(balls[i]), b = of(balls[i + 1]), c = of(balls[i + 2]), d = of(balls[i + 3]);
            if (balls[0].through)
                return Polynomial<R>{b, (c - a) / 2, (2 * a - 5 * b + 4 * c - d) / 2, (3 * (b - c) + d - a) / 2};
            return Polynomial<R>{(a + 4 * b + c) / 6, (c - a) / 2, (a - 2 * b + c) / 2, (d - a + 3 * (b - c)) / 6};
        };
        all.push_back({path([](const SweptBall& own) { return R(own.centre.x); }),
                       path([](const SweptBall& own) { return R(own.centre.y); }),
                       path([](const SweptBall& own) { return R(own.centre.z); }),
                       path([](const SweptBall& own) { return R(own.radius); })});
    }
    return all;
}
/// Returns the largest depth of a point in any of the balls.
template <class R>
R deepest(const std::vector<BallPath<R>>& paths, const Vector<R>& p) {
    R most = -std::numeric_limits<R>::infinity();
    for (const BallPath<R>& path : paths) {
        const Polynomial<R> depth = path.depth(p);
        most = std::max({most, value(depth, R(0)), value(depth, R(1))});
        for (const R t : roots_between(derivative(depth), R(0), R(1))) most = std::max(most, value(depth, t));
    }
    return most;
}
template <class R>
bool contains(const SphereSweep& sweep, const Vector<R>& p) {
    return deepest(paths_of<R>(sweep), p) > 0;
}
/// Takes, of the crossings of a line that starts on the surface, the one nearest to the start for the start.
template <class R>
LineCrossings<R> crossings(const SphereSweep& sweep, const Line<R>& line, int source) {
    const std::vector<BallPath<R>> paths = paths_of<R>(sweep);
    const R length = root(dot(line.direction, line.direction));
    const Vector<R> d = R(1) / length * line.direction;
    LineCrossings<R> found;
    for (const BallPath<R>& path : paths) {
        // Along the line a ball reaches from b - sqrt(e) to b + sqrt(e), where these are polynomials of t.
        Polynomial<R> b = sum(sum(Polynomial<R>{-dot(line.origin, d)}, d.x, path.x), d.y, path.y);
        b = sum(b, d.z, path.z);
        const Polynomial<R> e = sum(path.depth(line.origin), R(1), product(b, b));
        const Polynomial<R> b_slope = derivative(b), e_slope = derivative(e);
        const Polynomial<R> ends = sum(product(product(b_slope, b_slope), e), R(-1) / 4, product(e_slope, e_slope));
        std::vector<R> places{R(0), R(1)};
        for (const Polynomial<R>& own : {ends, e_slope})
            for (const R t : roots_between(own, R(0), R(1))) places.push_back(t);
        for (const R t : places) {
            const R square = value(e, t);
            if (!(square > 0)) continue;
            for (const R side : {R(-1), R(1)}) {
                const R s = value(b, t) + side * root(square);
                const Vector<R> p = line.origin + s * d;
                if (deepest(paths, p) > R(1e-11)) continue;
                const auto same = [&](const Crossing<R>& own) {
                    const R off = own.t - s / length;
                    return (off < 0 ? -off : off) < R(1e-10);
                };
                if (std::none_of(found.begin(), found.end(), same)) found.add(s / length, 0, p - path.centre(t));
            }
        }
    }
    if (source == 0) found.remove_start();
    return found;
}

}  // namespace strahl::referee
