// Turns bodies that a scene cannot hold into meshes.
#pragma once
#include <array>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "pov/things/outlines.h"
#include "scene/kinds/mesh_data.h"

namespace strahl::pov {

/// Joins equal points, and equal normals, of a mesh whose triangles have corners of their own.
void join_points(MeshData& mesh);
/// Turns triangles over so that neighbours run in the same direction, around what they enclose. Points are joined.
void turn_alike(MeshData& mesh);

enum class SplineKind { linear, quadratic, cubic, bezier };
/// How many straight pieces approximate each piece of a curve.
inline constexpr int curve_pieces = 16;

/// Returns the curves of a prism as straight lines, one for each piece of the spline; a linear one is one
/// line.
std::vector<std::vector<Point2>> lines_of(SplineKind kind, std::span<const Point2> points);

/// How outlines in x and z become a solid: over y from `low` to `high`.
struct Sweep {
    double low = 0, high = 1;
    bool conic = false;  // it narrows towards y = 0
    bool caps = true;
    bool smooth = false;  // its sides have no edges where the outline hardly turns
};
/// Returns the solid over closed outlines. Where one lies within another there are holes, within these there is
/// material again, and so on.
MeshData swept(std::vector<Outline> outlines, const Sweep& sweep);
/// (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) = 1.
MeshData superellipsoid(double e, double n, int cells);
/// The surface of the points that `at` returns with their normals for (u, v), each from 0 to 1, in `pieces` by `pieces`
/// squares of two triangles. One is left out if a corner is not finite; a normal is if it is 0. `place` returns places
/// by uv.
MeshData patch(int pieces, const std::function<std::pair<DVec3, DVec3>(double u, double v)>& at,
               const std::function<Point2(const Point2& uv)>& place);
/// The field of heights over x and z from 0 to 1, from the lower row of z on; what is below `water` is left out.
MeshData height_field(int width, int height, std::span<const double> heights, double water, bool smooth);

}  // namespace strahl::pov
