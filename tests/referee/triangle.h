// The referee's formulas for triangles and meshes.
#pragma once
#include "scene/kinds/mesh.h"
#include "tests/referee/line.h"

namespace strahl::referee {

/// The normals of the corners, of length 1, or none for a flat triangle.
template <class R>
struct Corner {
    Vector<R> point, normal;
};

/// o + t d = (1 - u - v) a + u b + v c, by Cramer's rule.
template <class R>
void cross_triangle(const Corner<R>& a, const Corner<R>& b, const Corner<R>& c, bool smooth, const Line<R>& line,
                    int face, LineCrossings<R>& found) {
    const Vector<R> e = b.point - a.point, f = c.point - a.point, o = line.origin - a.point, d = line.direction;
    const Vector<R> n = cross(e, f);
    const R volume = -dot(n, d);
    if (volume == 0) return;
    const Vector<R> m = cross(o, d);
    const R u = dot(f, m) / volume, v = -dot(e, m) / volume, t = dot(n, o) / volume;
    if (u < 0 || v < 0 || u + v > 1) return;
    Vector<R> normal = smooth ? (1 - u - v) * a.normal + u * b.normal + v * c.normal : n;
    if (dot(normal, d) * dot(n, d) < 0) normal = R(-1) * normal;
    found.add(t, face, normal);
}

template <class R>
LineCrossings<R> crossings(const Triangle& triangle, const Line<R>& line, int source) {
    LineCrossings<R> found;
    if (source != 0) cross_triangle<R>({triangle.a, {}}, {triangle.b, {}}, {triangle.c, {}}, false, line, 0, found);
    return found;
}
template <class R>
LineCrossings<R> crossings(const SmoothTriangle& t, const Line<R>& line, int source) {
    LineCrossings<R> found;
    const auto corner = [](const DVec3& point, const DVec3& normal) {
        return Corner<R>{point, unit(Vector<R>(normal))};
    };
    if (source != 0)
        cross_triangle(corner(t.a, t.normal_a), corner(t.b, t.normal_b), corner(t.c, t.normal_c), true, line, 0, found);
    return found;
}
/// A face for each triangle.
template <class R>
LineCrossings<R> crossings(const Mesh& mesh, const Line<R>& line, int source) {
    LineCrossings<R> found;
    const auto &points = mesh.data->points, &normals = mesh.data->normals;
    const auto &triangles = mesh.data->triangles, &corner_normals = mesh.data->corner_normals;
    for (int i = 0; i < static_cast<int>(triangles.size()); ++i) {
        const bool smooth = !corner_normals.empty();
        const auto corner = [&](int k) {
            return Corner<R>{points[triangles[i][k]],
                             smooth ? unit(Vector<R>(normals[corner_normals[i][k]])) : Vector<R>()};
        };
        if (source != i) cross_triangle(corner(0), corner(1), corner(2), smooth, line, i, found);
    }
    return found;
}
template <class R>
bool contains(const Triangle&, const Vector<R>&) {
    return false;
}
template <class R>
bool contains(const SmoothTriangle&, const Vector<R>&) {
    return false;
}
/// An odd number of triangles lies in some direction.
template <class R>
bool contains(const Mesh& mesh, const Vector<R>& p) {
    const LineCrossings<R> found = crossings(mesh, Line<R>{p, {R(.36), R(.48), R(.8)}}, -1);
    int ahead = 0;
    for (const auto& crossing : found) ahead += crossing.t > 0;
    return ahead % 2 == 1 && !open_side(*mesh.data);
}

/// Where a point of a triangle is by uv: p - a = s e + t f, by two scalar products.
template <class R>
Vector<R> place_in(const MeshData& mesh, int triangle, const Vector<R>& p) {
    const MeshData::Corners* const numbers = mesh.place_numbers();
    if (!numbers) return {0, 0, 0};
    const auto corner = [&](int k) { return Vector<R>(mesh.points[mesh.triangles[triangle][k]]); };
    const Vector<R> a = corner(0), e = corner(1) - a, f = corner(2) - a, q = p - a;
    const R ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), qe = dot(q, e), qf = dot(q, f);
    const R whole = ee * ff - ef * ef, s = (qe * ff - qf * ef) / whole, t = (qf * ee - qe * ef) / whole;
    const auto place = [&](int j) {
        const auto at = [&](int k) { return R(mesh.places[numbers[triangle][k]][j]); };
        return (1 - s - t) * at(0) + s * at(1) + t * at(2);
    };
    return {place(0), place(1), 0};
}

}  // namespace strahl::referee
