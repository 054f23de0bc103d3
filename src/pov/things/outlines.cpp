#include "pov/things/outlines.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace strahl::pov {
namespace {

/// Twice the area of a triangle, positive if a, b, c turn to the left.
double area(const Point2& a, const Point2& b, const Point2& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}
double area(const Outline& outline) {
    double sum = 0;
    for (std::size_t i = 2; i < outline.size(); ++i) sum += area(outline[0], outline[i - 1], outline[i]);
    return sum;
}

bool surrounds(const Outline& outline, const Point2& p) {
    bool in = false;
    for (std::size_t i = 0, k = outline.size() - 1; i < outline.size(); k = i++) {
        const Point2 &a = outline[i], &b = outline[k];
        if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1]) + a[0]) in = !in;
    }
    return in;
}

/// Do two segments meet, other than at an end that they share?
bool meet(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
    if (a == c || a == d || b == c || b == d) return false;
    const auto sides = [](double s, double t) { return (s >= 0 && t <= 0) || (s <= 0 && t >= 0); };
    const bool apart = std::max(a[0], b[0]) < std::min(c[0], d[0]) || std::max(c[0], d[0]) < std::min(a[0], b[0]) ||
                       std::max(a[1], b[1]) < std::min(c[1], d[1]) || std::max(c[1], d[1]) < std::min(a[1], b[1]);
    return !apart && sides(area(a, b, c), area(a, b, d)) && sides(area(c, d, a), area(c, d, b));
}

bool crosses(const Point2& a, const Point2& b, const Outline& outline) {
    for (std::size_t i = 0; i < outline.size(); ++i)
        if (meet(a, b, outline[i], outline[(i + 1) % outline.size()])) return true;
    return false;
}

/// Does a corner of a face see a point on its inner side? (`InCone` of J. O'Rourke, "Computational Geometry in C".)
bool opens_to(const Outline& face, std::size_t corner, const Point2& p) {
    const std::size_t count = face.size();
    const Point2 &a = face[(corner + count - 1) % count], &b = face[corner], &c = face[(corner + 1) % count];
    if (area(a, b, c) >= 0) return area(b, p, a) > 0 && area(p, b, c) > 0;
    return !(area(b, p, c) >= 0 && area(p, b, a) >= 0);
}

/// Drops the points that lie on the straight line between their neighbours.
void drop_straight(Outline& outline) {
    Outline kept;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point2 &a = kept.empty() ? outline.back() : kept.back(), &b = outline[i];
        const Point2& c = outline[(i + 1) % outline.size()];
        const double sides = std::hypot(b[0] - a[0], b[1] - a[1]) * std::hypot(c[0] - b[0], c[1] - b[1]);
        if (std::fabs(area(a, b, c)) > 1e-9 * sides) kept.push_back(b);
    }
    outline = std::move(kept);
}

std::size_t rightmost(const Outline& outline) {
    return static_cast<std::size_t>(std::ranges::max_element(outline) - outline.begin());
}

}  // namespace

std::vector<Outline>& turned_as_faces(std::vector<Outline>& outlines) {
    std::ranges::for_each(outlines, drop_straight);
    std::erase_if(outlines, [](const Outline& own) { return own.size() < 3; });
    std::vector<bool> to_right;
    for (const Outline& own : outlines) {
        const auto around = [&](const Outline& other) { return &other != &own && surrounds(other, own[0]); };
        to_right.push_back(std::ranges::count_if(outlines, around) % 2 != 0);
    }
    for (std::size_t i = 0; i < outlines.size(); ++i)
        if ((area(outlines[i]) < 0) != to_right[i]) std::ranges::reverse(outlines[i]);
    return outlines;
}

std::vector<Outline> faces_of(const std::vector<Outline>& outlines) {
    std::vector<Outline> faces, holes;
    for (const Outline& own : outlines) (area(own) < 0 ? holes : faces).push_back(own);
    // From the rightmost point of the hole that reaches furthest to the right no other hole hides its face.
    std::ranges::sort(holes, std::greater(), [](const Outline& hole) { return hole[rightmost(hole)]; });
    std::ranges::sort(faces, {}, [](const Outline& face) { return area(face); });
    for (std::size_t h = 0; h < holes.size(); ++h) {
        Outline& hole = holes[h];
        std::ranges::rotate(hole, hole.begin() + static_cast<std::ptrdiff_t>(rightmost(hole)));
        const Point2 from = hole[0];
        // The smallest face around the hole is its own.
        const auto face = std::ranges::find_if(faces, [&](const Outline& own) { return surrounds(own, from); });
        if (face == faces.end()) continue;
        std::size_t nearest = face->size();
        const auto away = [&](std::size_t i) { return std::hypot((*face)[i][0] - from[0], (*face)[i][1] - from[1]); };
        for (std::size_t i = 0; i < face->size(); ++i) {
            if (nearest < face->size() && away(i) >= away(nearest)) continue;
            const auto hides = [&](const Outline& own) { return crosses(from, (*face)[i], own); };
            const auto left = holes.begin() + static_cast<std::ptrdiff_t>(h);
            if (opens_to(*face, i, from) && !hides(*face) && std::none_of(left, holes.end(), hides)) nearest = i;
        }
        if (nearest == face->size()) continue;
        hole.push_back(from);
        hole.push_back((*face)[nearest]);
        face->insert(face->begin() + static_cast<std::ptrdiff_t>(nearest) + 1, hole.begin(), hole.end());
    }
    return faces;
}

}  // namespace strahl::pov
