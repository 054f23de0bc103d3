// Spaces within the world.
#pragma once
#include <glm/mat4x4.hpp>

#include "scene/kinds/mesh.h"
#include "tests/referee/line.h"

namespace strahl::referee {

/// A space with these axes and this origin: world = a x + b y + c z + origin.
template <class R>
struct Space {
    Vector<R> a, b, c, origin;

    explicit Space(const glm::dmat4& m)
        : a{m[0].x, m[0].y, m[0].z},
          b{m[1].x, m[1].y, m[1].z},
          c{m[2].x, m[2].y, m[2].z},
          origin{m[3].x, m[3].y, m[3].z} {}
    Space(const Vector<R>& a, const Vector<R>& b, const Vector<R>& c, const Vector<R>& origin)
        : a(a), b(b), c(c), origin(origin) {}
    Vector<R> direction(const Vector<R>& v) const { return v.x * a + v.y * b + v.z * c; }
    Vector<R> point(const Vector<R>& p) const { return origin + direction(p); }
    /// The space of `inner`, whose coordinates are those of this one.
    Space around(const Space& inner) const {
        return {direction(inner.a), direction(inner.b), direction(inner.c), point(inner.origin)};
    }
};

/// Returns the space in which a point of a triangle has the given place (u, v, 0). Its axes are how points of the
/// triangle move with u and with v, but for their parts along the normal, and the normal, of length 1.
template <class R>
Space<R> space_by_uv(const MeshData& mesh, int triangle, const Space<R>& to_world, const Vector<R>& point,
                     const Vector<R>& place, const Vector<R>& normal) {
    const MeshData::Corners& corners = mesh.triangles[triangle];
    const MeshData::Corners& numbers = mesh.place_numbers()[triangle];
    const auto way = [&](int k) {
        return to_world.direction(Vector<R>(mesh.points[corners[k]]) - Vector<R>(mesh.points[corners[0]]));
    };
    const auto further = [&](int k, int j) { return R(mesh.places[numbers[k]][j]) - R(mesh.places[numbers[0]][j]); };
    const R whole = further(1, 0) * further(2, 1) - further(1, 1) * further(2, 0);
    const auto flat = [&](const Vector<R>& v) { return v - dot(v, normal) * normal; };
    const Vector<R> u = flat(1 / whole * (further(2, 1) * way(1) - further(1, 1) * way(2)));
    const Vector<R> v = flat(1 / whole * (further(1, 0) * way(2) - further(2, 0) * way(1)));
    const Vector<R> across = cross(u, v), w = 1 / root(root(dot(across, across))) * across;
    return {u, v, w, point - place.x * u - place.y * v};
}

}  // namespace strahl::referee
