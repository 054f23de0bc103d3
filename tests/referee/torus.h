// The referee's formulas for tori: the quartic, and its roots between those of its derivative.
#pragma once
#include <vector>

#include "scene/kinds/torus.h"
#include "tests/referee/line.h"

namespace strahl::referee {

/// Returns the real roots of c[0] + c[1] t + c[2] t^2 + ... between low and high where the polynomial changes its sign,
/// to an ulp of their own or 1/1024 ulp of high - low. It takes Newton's steps, of which each third halves the bracket.
template <class R>
std::vector<R> roots_between(const std::vector<R>& c, R low, R high) {
    if (c.size() < 2) return {};
    // About the middle it has no root if its first coefficient outweighs what the others can add.
    std::vector<R> about = c;
    for (std::size_t i = 1; i < c.size(); ++i)
        for (std::size_t k = c.size() - 1; k-- > i - 1;) about[k] += (low + high) / 2 * about[k + 1];
    R others = 0;
    for (std::size_t i = c.size(); i-- > 1;) others = (high - low) / 2 * (others + std::max(about[i], -about[i]));
    if (std::max(about[0], -about[0]) > others) return {};

    std::vector<R> derivative, ends{low}, found;
    for (std::size_t i = 1; i < c.size(); ++i) derivative.push_back(R(static_cast<int>(i)) * c[i]);
    for (const R t : roots_between(derivative, low, high)) ends.push_back(t);
    ends.push_back(high);
    const auto value = [](const std::vector<R>& polynomial, R t) {
        R sum = 0;
        for (std::size_t i = polynomial.size(); i-- > 0;) sum = sum * t + polynomial[i];
        return sum;
    };
    const auto tiny = [span = high - low](R width) { return span + width / 1024 == span; };
    for (std::size_t i = 1; i < ends.size(); ++i) {
        R a = ends[i - 1], b = ends[i], t = (a + b) / 2;
        const bool below = value(c, a) < 0;
        if (below == (value(c, b) < 0)) continue;
        for (int step = 1; t != a && t != b && !tiny(b - a); ++step) {
            const R here = value(c, t), next = t - here / value(derivative, t);
            ((here < 0) == below ? a : b) = t;
            if (tiny(next - t)) break;
            t = step % 3 != 0 && a < next && next < b ? next : (a + b) / 2;
        }
        found.push_back(t);
    }
    return found;
}

/// (p^2 + R^2 - r^2)^2 - 4 R^2 (p^2 - (p a)^2) for points p of the line, counted from where it is nearest to the
/// centre, or from its start on the torus, where one root is 0. A spindle torus has crossings in its inside, with what
/// lies beyond the axis, that are none of the body's surface.
template <class R>
LineCrossings<R> crossings(const Torus& torus, const Line<R>& line, int source) {
    LineCrossings<R> found;
    const R major = torus.major, minor = torus.minor;
    const Vector<R> axis = unit(Vector<R>(torus.axis)), o = line.origin - Vector<R>(torus.centre);
    const R length = root(dot(line.direction, line.direction));
    const Vector<R> d = R(1) / length * line.direction;
    const R shift = source == 0 ? R(0) : -dot(o, d);
    const Vector<R> p = o + shift * d;
    const R square = dot(p, p), far = (major + minor) * (1 + R(1e-9));
    if (source != 0 && square > far * far) return found;  // it misses the ball around the torus
    const R along = dot(p, axis), slope = dot(d, axis), towards = dot(p, d);
    const R k = square + major * major - minor * minor, four = 4 * major * major;
    std::vector<R> c{k * k - four * (square - along * along), 4 * k * towards - 2 * four * (towards - along * slope),
                     2 * k + 4 * towards * towards - four * (1 - slope * slope), 4 * towards, R(1)};
    if (source == 0) c.erase(c.begin());
    const R reach = 4 * (major + minor) + root(square);
    for (const R t : roots_between(c, -reach, reach)) {
        const Vector<R> q = p + t * d, across = q - dot(q, axis) * axis;
        const R rho = root(dot(across, across)), height = dot(q, axis);
        if (minor > major && (rho - major) * (rho - major) + height * height < (1 - R(1e-9)) * minor * minor) continue;
        found.add((shift + t) / length, 0, q - (major / rho) * across);
    }
    return found;
}
template <class R>
bool contains(const Torus& torus, const Vector<R>& p) {
    const Vector<R> axis = unit(Vector<R>(torus.axis)), o = p - Vector<R>(torus.centre);
    const R along = dot(o, axis);
    const Vector<R> across = o - along * axis;
    const R out = root(dot(across, across)) - R(torus.major);
    return out * out + along * along < R(torus.minor) * R(torus.minor);
}

}  // namespace strahl::referee
