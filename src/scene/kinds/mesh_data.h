// Triangles that share their corners, as in files.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "num/vec.h"

namespace strahl {

/// Each triangle has three points. In a smooth mesh each corner also has a normal, of any length and on either side,
/// and normals bend between the corners. Corners may also have places in a picture.
struct MeshData {
    using Corners = std::array<std::int32_t, 3>;
    std::vector<DVec3> points, normals;
    std::vector<Corners> triangles;       // numbers of points
    std::vector<Corners> corner_normals;  // numbers of normals, for each triangle; empty if all are flat
    using Place = std::array<double, 2>;  // u across and v up, see scene/image_pattern.h
    std::vector<Place> places = {};
    std::vector<Corners> corner_places = {};  // numbers of places, for each triangle; empty if they are those of points

    /// The numbers of the places of each triangle's corners; null if there are none.
    const Corners* place_numbers() const {
        return places.empty() ? nullptr : corner_places.empty() ? triangles.data() : corner_places.data();
    }
    bool operator==(const MeshData&) const = default;
};

}  // namespace strahl
