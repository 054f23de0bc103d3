// Gives the planes that faces of a composite's parts lie in numbers that are equal for all faces in one plane.
#pragma once
#include <functional>
#include <optional>

#include "num/vec_math.h"
#include "scene/kinds/kinds.h"

namespace strahl {

/// Returns the plane that a face lies in, with its normal out of the body; nothing for a curved face.
inline std::optional<HalfSpace> plane_of(const Plane& plane, int) { return HalfSpace{plane.a, plane.normal()}; }
template <class Kind>
std::optional<HalfSpace> plane_of_ends(const Kind& body, int face) {
    if (face == 0) return {};
    return face == 1 ? HalfSpace{body.base, -body.axis()} : HalfSpace{body.cap, body.axis()};
}
inline std::optional<HalfSpace> plane_of(const Cylinder& cylinder, int face) { return plane_of_ends(cylinder, face); }
inline std::optional<HalfSpace> plane_of(const Cone& cone, int face) { return plane_of_ends(cone, face); }
inline std::optional<HalfSpace> plane_of(const Cuboid& cuboid, int face) {
    const Box box = cuboid.bounds();
    DVec3 normal(0);
    normal[face / 2] = face % 2 == 0 ? -1 : 1;
    return HalfSpace{face % 2 == 0 ? box.low : box.high, normal};
}
template <class Kind>
std::optional<HalfSpace> plane_of(const Kind&, int) {
    return {};
}

inline HalfSpace moved(const HalfSpace& space, const glm::dmat4& m) {
    return {transform_point(m, space.point), normalize(glm::transpose(glm::inverse(glm::dmat3(m))) * space.normal)};
}

/// A plane as numbers that are the same for all faces in it, whichever side they are on.
struct PlaneNumbers {
    DVec3 normal;
    double distance, side;  // side is 1 if the normal is that of the half-space, else -1
    explicit PlaneNumbers(const HalfSpace& space) : normal(space.normal) {
        const DVec3& n = space.normal;
        side = n.x > 0 || (n.x == 0 && (n.y > 0 || (n.y == 0 && n.z > 0))) ? 1 : -1;
        normal = side * n + DVec3(0.);  // adding 0 makes -0 and 0, which are equal, the same bits
        distance = dot_product(normal, space.point) + 0.;
    }
    bool operator==(const PlaneNumbers& other) const { return normal == other.normal && distance == other.distance; }
    struct Hash {
        std::size_t operator()(const PlaneNumbers& plane) const {
            std::size_t hash = 0;
            for (const double number : {plane.normal.x, plane.normal.y, plane.normal.z, plane.distance})
                hash = (hash ^ std::hash<double>()(number)) * 0x9e3779b97f4a7c15;
            return hash;
        }
    };
};

/// Returns the plane of a triangle whose corners are transformed.
inline HalfSpace plane_of_triangle(const MeshData& mesh, const MeshData::Corners& corners, const glm::dmat4& m) {
    const auto point = [&](int k) { return transform_point(m, mesh.points[corners[k]]); };
    const DVec3 a = point(0);
    return {a, normalize(cross_product(point(1) - a, point(2) - a))};
}

}  // namespace strahl
