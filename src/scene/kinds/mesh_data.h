// Triangles that share their corners, as files hold them.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "num/vec.h"

namespace strahl {

/// Each triangle is three points. If the mesh is smooth, each corner has a normal as well, which need not be of length
/// 1 and may point to either side; normals bend between the corners. Corners may also have places in a picture.
struct MeshData {
    using Corners = std::array<std::int32_t, 3>;
    std::vector<DVec3> points, normals;
    std::vector<Corners> triangles;       // numbers of points
    std::vector<Corners> corner_normals;  // numbers of normals, for each triangle; empty if all are flat
    using Place = std::array<double, 2>;  // u across and v up, see scene/image_pattern.h
    std::vector<Place> places = {};
    std::vector<Corners> corner_places = {};  // their numbers, likewise; if this is empty they are those of the points

    /// The numbers of the places of each triangle's corners; null if there are none.
    const Corners* place_numbers() const {
        return places.empty() ? nullptr : corner_places.empty() ? triangles.data() : corner_places.data();
    }
    bool operator==(const MeshData&) const = default;
};

}  // namespace strahl
