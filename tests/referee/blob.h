// The referee's formulas for blobs: the sum of the lumps' polynomials between the places where one begins or ends, and
// its roots by halving between those of its derivative.
#pragma once
#include <algorithm>
#include <limits>
#include <vector>

#include "scene/kinds/blob/blob.h"
#include "tests/referee/torus.h"

namespace strahl::referee {

/// A lump's own space, counted from its end `from`.
template <class R>
struct LumpSpace {
    std::array<Vector<R>, 3> rows;
    Vector<R> from, line;

    explicit LumpSpace(const Lump& lump) : from(lump.from), line(Vector<R>(lump.to) - Vector<R>(lump.from)) {
        const Vector<R> x(lump.x), y(lump.y), z(lump.z);
        const R per = R(1) / dot(x, cross(y, z));
        rows = {per * cross(y, z), per * cross(z, x), per * cross(x, y)};
    }
    Vector<R> turn(const Vector<R>& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
};
/// Adds a lump's field at a point to `field`, and its slope to `slope`.
template <class R>
void add_field(const Lump& lump, const Vector<R>& p, R& field, Vector<R>& slope) {
    const LumpSpace<R> space(lump);
    Vector<R> off = space.turn(p) - space.from;
    const R square = dot(space.line, space.line), share = square > 0 ? dot(off, space.line) / square : R(0);
    off = off - (share < 0 ? R(0) : share > 1 ? R(1) : share) * space.line;
    const R per = R(1) / (R(lump.radius) * R(lump.radius)), q = 1 - per * dot(off, off);
    if (!(q > 0)) return;
    field += R(lump.strength) * q * q;
    const Vector<R> own = (-4 * R(lump.strength) * q * per) * off;
    slope = slope + own.x * space.rows[0] + own.y * space.rows[1] + own.z * space.rows[2];
}
template <class R>
bool contains(const Blob& blob, const Vector<R>& p) {
    R field = 0;
    Vector<R> slope;
    for (const Lump& lump : blob.data->lumps) add_field(lump, p, field, slope);
    return field > R(blob.threshold);
}
/// Finds where a line crosses the surface, but for the place nearest to the start if it starts there.
template <class R>
LineCrossings<R> crossings(const Blob& blob, const Line<R>& line, int source) {
    struct Part {
        R enter, leave;
        std::vector<R> field;
    };
    std::vector<Part> parts;
    std::vector<R> ends;
    const auto add = [&](const Lump& lump, const Vector<R>& o, const Vector<R>& d, R low, R high) {
        const R per = R(1) / (R(lump.radius) * R(lump.radius));
        const std::vector<R> q{1 - per * dot(o, o), -2 * per * dot(o, d), -per * dot(d, d)};
        R enter = low, leave = high;
        if (q[2] < 0) {
            const R square = q[1] * q[1] - 4 * q[0] * q[2];
            if (!(square > 0)) return;
            enter = std::max(low, (root(square) - q[1]) / (2 * q[2]));
            leave = std::min(high, (-root(square) - q[1]) / (2 * q[2]));
        } else if (!(q[0] > 0)) {
            return;
        }
        if (!(enter < leave)) return;
        Part part{enter, leave, std::vector<R>(5, R(0))};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k) part.field[i + k] += R(lump.strength) * q[i] * q[k];
        ends.push_back(enter), ends.push_back(leave), parts.push_back(part);
    };
    const R far = R(1e30);
    for (const Lump& lump : blob.data->lumps) {
        const LumpSpace<R> space(lump);
        const Vector<R> o = space.turn(line.origin) - space.from, d = space.turn(line.direction);
        const R square = dot(space.line, space.line);
        if (!(square > 0)) {
            add(lump, o, d, -far, far);
            continue;
        }
        const R begin = dot(o, space.line) / square, way = dot(d, space.line) / square;
        const auto place = [&](R share) { return way == 0 ? (begin < share ? far : -far) : (share - begin) / way; };
        const R first = place(0), second = place(1);
        const auto between = [&](R a, R b, const Vector<R>& oo, const Vector<R>& dd) {
            add(lump, oo, dd, std::min(a, b), std::max(a, b));
        };
        const R before = way < 0 ? far : -far;
        between(before, first, o, d);
        between(first, second, o - begin * space.line, d - way * space.line);
        between(second, -before, o - space.line, d);
    }
    std::sort(ends.begin(), ends.end());
    LineCrossings<R> found;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const R low = ends[i], high = ends[i + 1], middle = (low + high) / 2;
        if (!(low < high)) continue;
        std::vector<R> sum(5, R(0));
        sum[0] = -R(blob.threshold);
        for (const Part& part : parts)
            if (part.enter < middle && middle < part.leave)
                for (std::size_t k = 0; k < 5; ++k) sum[k] += part.field[k];
        for (const R t : roots_between(sum, low, high)) {
            R field = 0;
            Vector<R> slope;
            for (const Lump& lump : blob.data->lumps) add_field(lump, line.origin + t * line.direction, field, slope);
            found.add(t, 0, R(-1) * slope);
        }
    }
    if (source == 0) found.remove_start();
    return found;
}

}  // namespace strahl::referee
