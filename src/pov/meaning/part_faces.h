// Flat faces of simple bodies, and points on curved ones: to find those that several bodies have in one place.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <iterator>
#include <vector>

#include "num/vec_math.h"
#include "scene/scene.h"

namespace strahl::pov {

/// Returns how far faces at a distance may be apart to be in one place.
inline double off(double at) { return 1e-10 * (1 + std::fabs(at)); }

/// A face of a simple body.
struct BodyFace {
    std::size_t part;   // that the body is, or is in
    int material;       // of the body
    bool there = true;  // is it a surface, not only the end of an open body's inside?
    bool round = true;  // of a cylinder or a cone: in POV-Ray its points are always outside
};
/// A flat one: a convex polygon that holds it.
struct PartFace : BodyFace {
    DVec3 normal;  // of length 1; its first coordinate that is not 0 is positive
    double at;     // normal . p of its points
    std::vector<DVec3> corners;
    Box box;

    bool may_meet(const PartFace& other) const;
};
/// Adds the flat faces of a simple body, which a matrix moves. `reach` is how far planes go.
void add_flat(std::vector<PartFace>& faces, const Shape& shape, const glm::dmat4& matrix, BodyFace face, double reach);
/// Returns the part of a convex polygon that another one in its plane covers.
std::vector<DVec3> common_part(std::vector<DVec3> polygon, const PartFace& other);
/// Returns the part of it in a box.
std::vector<DVec3> common_part(std::vector<DVec3> polygon, const Box& box);
/// Calls test(p) for points of a convex polygon until it returns true, and returns whether it did.
template <class Test>
bool any_point_of(const std::vector<DVec3>& polygon, const Test& test) {
    if (polygon.size() < 3) return false;
    DVec3 middle(0);
    for (const DVec3& corner : polygon) middle = middle + 1. / double(polygon.size()) * corner;
    for (const double share : {.05, .4, .9})
        for (std::size_t i = 0; i < polygon.size(); ++i)
            for (const double turn : {0., .5}) {
                const DVec3 rim = (1 - turn) * polygon[i] + turn * polygon[(i + 1) % polygon.size()];
                if (test(middle + share * (rim - middle))) return true;
            }
    return false;
}

/// A place on a surface, with a normal of length 1.
struct PointOnFace {
    DVec3 p, normal;
};
/// The curved face of a sphere, a cylinder or a cone.
struct CurvedFace : BodyFace {
    std::size_t kind;  // Shape::index()
    DVec3 centre;      // of a sphere; the tip of a cone; of a cylinder's axis the point that is nearest to the origin
    DVec3 axis;        // of length 1; its first coordinate that is not 0 is positive
    double size;       // radius, or of a cone radius per length
    std::vector<PointOnFace> points{};  // some, where they are asked for

    /// Returns the centre's place along a direction in which those of a lattice or on a sphere are hardly ever the
    /// same.
    double along() const { return dot_product(centre, DVec3(.48712, .71359, .50341)); }
    bool continues(const CurvedFace& other) const;
};
/// Adds the curved face of a simple body, which a matrix moves that keeps shapes similar.
void add_curved(std::vector<CurvedFace>& faces, const Shape& shape, const glm::dmat4& matrix, BodyFace face);
/// Returns points on the curved face of a body, which such a matrix moves.
std::vector<PointOnFace> points_on(const Shape& shape, const glm::dmat4& matrix);
/// Calls test(a, b) for pairs of faces of two parts that continue each other until it returns true, and returns whether
/// it did. Sorts the faces.
template <class Test>
bool any_pair_of(std::vector<CurvedFace>& faces, const Test& test) {
    std::ranges::sort(faces, {}, &CurvedFace::along);
    for (std::size_t a = 0; a < faces.size(); ++a) {
        const double most = faces[a].along() + off(length(faces[a].centre));
        for (std::size_t b = a + 1; b < faces.size() && faces[b].along() <= most; ++b)
            if (faces[a].part != faces[b].part && faces[a].continues(faces[b]) && test(faces[a], faces[b])) return true;
    }
    return false;
}
/// Calls test(a, b) for pairs of flat faces in one plane, until it is true; returns whether it was. Sorts the faces.
template <class Test>
bool any_pair_of(std::vector<PartFace>& faces, const Test& test) {
    std::ranges::sort(faces, {}, &PartFace::at);
    for (auto begin = faces.begin(), end = begin; begin != faces.end(); begin = end) {
        Box around;
        do around.add(end->box);
        while (++end != faces.end() && end->at - std::prev(end)->at <= off(end->at));
        // Thousands may stand on one floor: only those are compared that overlap along the longest side of all.
        const DVec3 size = around.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        std::ranges::sort(begin, end, {}, [&](const PartFace& face) { return face.box.low[axis]; });
        for (auto a = begin; a != end; ++a)
            for (auto b = std::next(a); b != end && b->box.low[axis] <= a->box.high[axis]; ++b)
                if (a->part != b->part && a->may_meet(*b) && test(*a, *b)) return true;
    }
    return false;
}

}  // namespace strahl::pov
