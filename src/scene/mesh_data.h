// Triangles that share their corners, as files hold them.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "num/vec.h"

namespace strahl {

/// Each triangle is three points. If the mesh is smooth, each corner has a normal as well, which need not be of length
/// 1 and may point to either side; normals bend between the corners.
struct MeshData {
    using Corners = std::array<std::int32_t, 3>;
    std::vector<DVec3> points, normals;
    std::vector<Corners> triangles;       // numbers of points
    std::vector<Corners> corner_normals;  // numbers of normals, for each triangle; empty if all are flat
    bool operator==(const MeshData&) const = default;
};

}  // namespace strahl
