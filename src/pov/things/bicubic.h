// Turns bicubic patches into the triangles that POV-Ray shows of them.
#pragma once
#include <array>
#include <cstddef>
#include <optional>

#include "scene/kinds/mesh_data.h"

namespace strahl::pov {

/// A bicubic patch: flat triangles, whose normals are interpolated between those of the surface at corners.
struct BicubicPatch {
    static constexpr std::size_t most_triangles = 1 << 20;

    std::array<DVec3, 16> points{};  // control points, row by row
    std::array<int, 2> steps{0, 0};  // how often it is halved at most: across rows, and along them
    double flatness = 0;             // parts whose control points are nearer to a plane than this stay whole
    std::array<MeshData::Place, 4> places{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};  // of its corners

    /// Returns the triangles, none if there were more than `most_triangles`.
    std::optional<MeshData> mesh() const;
};

}  // namespace strahl::pov
