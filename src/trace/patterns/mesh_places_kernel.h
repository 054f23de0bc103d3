// Places by uv of points on meshes.
#pragma once
#include "num/memory.h"
#include "trace/patterns/triangle_of.h"

namespace strahl::inline STRAHL_LEVEL {

/// A triangle in each lane, with the places by uv of its corners; all zeros if a surface has none.
template <class S>
struct PlacedTriangles {
    Vec3<S> corner, e, f;  // and the sides to the two others
    S place[2];            // place of the corner
    S on_e[2], on_f[2];    // places of the others less that of the corner
};
template <class S>
[[gnu::noinline]] PlacedTriangles<S> placed_triangles(const World<Element<S>>& world, const PlacesKernel& places,
                                                      const S& surface) {
    using T = Element<S>;
    constexpr int numbers = 15;  // for a triangle: its corners, then their places
    alignas(64) T values[numbers][width<S>] = {};
    for (int k = 0; k < width<S>; ++k) {
        const int own = static_cast<int>(lane(surface, k)), i = own - places.first_surface;
        if (!places.corners || i < 0 || i >= places.surfaces) continue;
        const PlacedMesh<T>* const mesh = placed_mesh_of(world, own);
        const TriangleKernel<T>* const triangle = mesh ? triangle_of(mesh->mesh, i) : triangle_of(world, own);
        if (!triangle) continue;
        const Vec3<T> own_corners[]{triangle->a, triangle->b, triangle->c};
        for (int c = 0; c < 3; ++c) {
            const Vec3<T> corner = mesh ? mesh->out.point(own_corners[c]) : own_corners[c];
            for (int axis = 0; axis < 3; ++axis) values[3 * c + axis][k] = corner[axis];
            for (int j = 0; j < 2; ++j)
                values[9 + 2 * c + j][k] = static_cast<T>(places.places[places.corners[i][c]][j]);
        }
    }
    const auto number = [&](int i) { return load_lanes<S>(values[i]); };
    const auto corner = [&](int i) { return Vec3<S>(number(3 * i), number(3 * i + 1), number(3 * i + 2)); };
    const Vec3<S> a = corner(0);
    return {a,
            corner(1) - a,
            corner(2) - a,
            {number(9), number(10)},
            {number(11) - number(9), number(12) - number(10)},
            {number(13) - number(9), number(14) - number(10)}};
}

/// Returns the places by uv of points of these triangles, (u, v, 0). A point is a mean of the corners, each weighted by
/// the area of the triangle that the point makes with the opposite side.
template <class S>
STRAHL_INLINE Vec3<S> place_in(const PlacedTriangles<S>& t, const Vec3<S>& position) {
    const Vec3<S> p = position - t.corner, n = cross(t.e, t.f);
    const S squared = dot(n, n);
    const auto share = [&](const Vec3<S>& v) {
        return select(squared > S(0), min(max(dot(v, n) / squared, S(0)), S(1)), S(0));
    };
    const S of_e = share(cross(p, t.f)), of_f = share(cross(t.e, p));
    const auto mean = [&](int j) { return fma(of_e, t.on_e[j], fma(of_f, t.on_f[j], t.place[j])); };
    return {mean(0), mean(1), S(0)};
}
/// Returns how the place changes along a vector in the plane of the triangle.
template <class S>
STRAHL_INLINE Vec3<S> way_in(const PlacedTriangles<S>& t, const Vec3<S>& way) {
    const Vec3<S> n = cross(t.e, t.f);
    const S per = S(1) / dot(n, n), of_e = per * dot(cross(way, t.f), n), of_f = per * dot(cross(t.e, way), n);
    const auto change = [&](int j) { return fma(of_e, t.on_e[j], of_f * t.on_f[j]); };
    return {change(0), change(1), S(0)};
}

/// The vectors along a surface on which u grows by 1, and v, both times the same positive number; 0 where there are
/// none.
template <class S>
struct Tangents {
    Vec3<S> u, v;
};
/// Returns these without their parts along a normal of length 1.
template <class S>
STRAHL_INLINE Tangents<S> tangents(const PlacedTriangles<S>& t, const Vec3<S>& normal) {
    const S determinant = fma(t.on_e[0], t.on_f[1], -(t.on_e[1] * t.on_f[0]));
    const S side = select(determinant < S(0), S(-1), S(1));
    const auto along = [&](int j) {
        const Vec3<S> way = fma(t.on_f[j], t.e, scale(-t.on_e[j], t.f));
        return scale(side, fma(-dot(way, normal), normal, way));
    };
    return {along(1), scale(S(-1), along(0))};
}

}  // namespace strahl::inline STRAHL_LEVEL
