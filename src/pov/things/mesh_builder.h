// Collects the triangles of a surface.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "mesh/join.h"
#include "num/vec_math.h"
#include "scene/kinds/mesh_data.h"
#include "scene/kinds/triangle.h"

namespace strahl::pov {

/// Collects triangles; those without area are left out.
class MeshBuilder {
  public:
    /// Adds a triangle. `places`, if given, are the numbers of its corners' places by uv; all triangles have some then.
    void add_triangle(const std::array<DVec3, 3>& points, const std::array<DVec3, 3>& normals, bool smooth,
                      const MeshData::Corners* places = nullptr) {
        const std::array<std::int32_t, 3> corners{joined.number_of(points[0]), joined.number_of(points[1]),
                                                  joined.number_of(points[2])};
        if (Triangle{points[0], points[1], points[2]}.fault()) return;
        mesh.triangles.push_back(corners);
        any_smooth |= smooth;
        const DVec3 flat = cross_product(points[1] - points[0], points[2] - points[0]);
        MeshData::Corners own;
        for (std::size_t k = 0; k < 3; ++k) {
            const bool given = smooth && length(normals[k]) > 0;
            own[k] = directions.number_of(given ? normals[k] : flat);
        }
        mesh.corner_normals.push_back(own);
        if (places) mesh.corner_places.push_back(*places);
    }
    /// Adds a quadrilateral whose corners go round.
    void add_square(const std::array<DVec3, 4>& p, const std::array<DVec3, 4>& n, bool smooth = true) {
        add_triangle({p[0], p[1], p[2]}, {n[0], n[1], n[2]}, smooth);
        add_triangle({p[0], p[2], p[3]}, {n[0], n[2], n[3]}, smooth);
    }
    MeshData finish() {
        mesh.points = std::move(joined.points()), mesh.normals = std::move(directions.points());
        if (!any_smooth) mesh.normals.clear(), mesh.corner_normals.clear();
        return std::move(mesh);
    }

  private:
    MeshData mesh;
    PointJoiner joined, directions;
    bool any_smooth = false;
};

}  // namespace strahl::pov
