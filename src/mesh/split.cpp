#include "mesh/split.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace strahl {

std::span<const FaceSplitter::Triangle> FaceSplitter::split(const std::vector<DVec3>& points,
                                                            std::span<const std::int32_t> corners) {
    const auto count = static_cast<std::int32_t>(corners.size());
    triangles.clear();
    if (count == 3 || convex(points, corners)) {
        for (std::int32_t i = 2; i < count; ++i) triangles.push_back({0, i - 1, i});
        return triangles;
    }
    if (corners.size() > most_concave) return {};
    // Seen along the axis that is nearest to the normal; the two others, in this order, turn the same way round.
    int axis = 0;
    for (const int other : {1, 2})
        if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    const double side = normal[axis] < 0 ? -1 : 1;
    ring.resize(corners.size());
    for (std::int32_t i = 0; i < count; ++i) {
        const DVec3 p = points[corners[i]] - points[corners[0]];
        ring[i] = {p[x], side * p[y], (i + count - 1) % count, (i + 1) % count, false};
    }
    clip_ears();
    return triangles;
}

/// Does the face turn to the same side, or not at all, at every corner? Sets its `normal`: the sum of the normals of
/// the triangles around its first corner.
bool FaceSplitter::convex(const std::vector<DVec3>& points, std::span<const std::int32_t> corners) {
    const DVec3 origin = points[corners[0]];
    normal = {};
    for (std::size_t i = 2; i < corners.size(); ++i)
        normal += glm::cross(points[corners[i - 1]] - origin, points[corners[i]] - origin);
    DVec3 a = points[corners[corners.size() - 2]], b = points[corners.back()];
    for (const std::int32_t corner : corners) {
        const DVec3 c = points[corner];
        if (glm::dot(glm::cross(b - a, c - b), normal) < 0) return false;
        a = b, b = c;
    }
    return true;
}

namespace {

/// Twice the area of a triangle, positive if a, b, c are in counter-clockwise order.
template <class P>
double area(const P& a, const P& b, const P& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
template <class P>
bool same(const P& a, const P& b) {
    return a.x == b.x && a.y == b.y;
}

}  // namespace

/// Does the triangle of a corner and its neighbours lie inside the face, without another corner in it?
bool FaceSplitter::is_ear(std::int32_t corner) const {
    const RingCorner &b = ring[corner], &a = ring[b.before], &c = ring[b.after];
    if (area(a, b, c) <= 0) return false;
    for (std::int32_t i = c.after; i != b.before; i = ring[i].after) {
        const RingCorner& p = ring[i];
        if (same(p, a) || same(p, b) || same(p, c)) continue;  // a hole is often cut open along an edge used twice
        if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
    }
    return true;
}

/// Clips ears until nothing is left. Clipping one changes only whether its two neighbours are ears.
void FaceSplitter::clip_ears() {
    auto left = static_cast<std::int32_t>(ring.size());
    for (std::int32_t i = 0; i < left; ++i) ring[i].ear = is_ear(i);
    for (std::int32_t i = 0; left >= 3; --left) {
        // There is an ear, unless the face crosses itself; then any corner will do.
        for (std::int32_t passed = 0; !ring[i].ear && passed < left; ++passed) i = ring[i].after;
        const std::int32_t before = ring[i].before, after = ring[i].after;
        triangles.push_back({before, i, after});
        ring[before].after = after, ring[after].before = before;
        ring[before].ear = is_ear(before), ring[after].ear = is_ear(after);
        i = after;
    }
}

}  // namespace strahl
