#include "pov/meaning/mesh_planes.h"

#include <cmath>
#include <utility>
#include <vector>

#include "num/vec_math.h"

namespace strahl::pov {

MeshData in_single_planes(MeshData mesh) {
    const auto single = [](const DVec3& v) { return DVec3(Vec3<float>(v)); };
    const std::vector<DVec3> given = std::exchange(mesh.points, {});
    if (!mesh.places.empty() && mesh.corner_places.empty()) mesh.corner_places = mesh.triangles;
    for (MeshData::Corners& corners : mesh.triangles) {
        const DVec3 a = given[corners[0]], b = given[corners[1]], c = given[corners[2]];
        const DVec3 n = normalize(cross_product(c - a, b - a)), normal = single(n);
        const double distance = static_cast<float>(dot_product(n, a));
        // POV-Ray sees whether a ray meets the triangle along the axis that it lies across most.
        int axis = 0;
        for (int i = 1; i < 3; ++i)
            if (std::fabs(n[i]) > std::fabs(n[axis])) axis = i;
        for (std::int32_t& corner : corners) {
            DVec3 p = single(given[corner]);
            p[axis] += (distance - dot_product(normal, p)) / normal[axis];
            corner = static_cast<std::int32_t>(mesh.points.size());
            mesh.points.push_back(p);
        }
    }
    return mesh;
}

}  // namespace strahl::pov
