#include "scene/kinds/mesh.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace strahl {

std::optional<std::pair<DVec3, DVec3>> open_side(const MeshData& mesh) {
    struct DirectedSide {
        std::int32_t low, high;
        int direction;
        auto ends() const { return std::pair(low, high); }
        bool operator<(const DirectedSide& other) const { return ends() < other.ends(); }
    };
    const auto visit = [&](const auto& take) {
        for (const MeshData::Corners& triangle : mesh.triangles)
            for (int k = 0; k < 3; ++k) {
                const std::int32_t from = triangle[k], to = triangle[(k + 1) % 3];
                take(from < to ? DirectedSide{from, to, 1} : DirectedSide{to, from, -1});
            }
    };
    // Sorted by counting those of each point, which are few.
    std::vector<std::size_t> begins(mesh.points.size() + 1);
    visit([&](const DirectedSide& side) { ++begins[side.low + 1]; });
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<DirectedSide> sides(3 * mesh.triangles.size());
    std::vector<std::size_t> ends = begins;
    visit([&](const DirectedSide& side) { sides[ends[side.low]++] = side; });
    const auto at = [&](std::size_t n) { return sides.begin() + static_cast<std::ptrdiff_t>(n); };
    for (std::size_t i = 0; i < mesh.points.size(); ++i) std::sort(at(begins[i]), at(ends[i]));
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        int balance = sides[i].direction;
        while (end < sides.size() && !(sides[i] < sides[end])) balance += sides[end++].direction;
        if (balance != 0 || end - i != 2) return std::pair(mesh.points[sides[i].low], mesh.points[sides[i].high]);
        i = end;
    }
    return {};
}

bool same_triangles(const MeshData& a, const MeshData& b) {
    if (a.triangles.size() != b.triangles.size() || a.corner_normals.size() != b.corner_normals.size()) return false;
    const MeshData::Corners *const a_places = a.place_numbers(), *const b_places = b.place_numbers();
    if (!a_places != !b_places) return false;
    for (std::size_t i = 0; i < a.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            if (a.points[a.triangles[i][k]] != b.points[b.triangles[i][k]]) return false;
            if (!a.corner_normals.empty() && a.normals[a.corner_normals[i][k]] != b.normals[b.corner_normals[i][k]])
                return false;
            if (a_places && a.places[a_places[i][k]] != b.places[b_places[i][k]]) return false;
        }
    return true;
}

std::shared_ptr<const MeshData> Mesh::tetrahedron() {
    static const auto shared =
        std::make_shared<const MeshData>(MeshData{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                                  .normals = {},
                                                  .triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
                                                  .corner_normals = {}});
    return shared;
}

Box Mesh::bounds(const glm::dmat4& matrix) const {
    Box box;
    std::vector<char> used(data->points.size());  // single bits take longer
    for (const MeshData::Corners& triangle : data->triangles)
        for (const std::int32_t corner : triangle) used[corner] = true;
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i]) continue;
        const DVec3 p = transform_point(matrix, data->points[i]);
        box = {min(box.low, p), max(box.high, p)};
    }
    return box;
}

bool Mesh::contains(const DVec3& p) const {
    const Ray<double> ray{p, {0, 0, 1}, -1};
    bool inside = false;
    for (const auto& [a, b, c] : data->triangles) {
        const DVec3 low = min(min(data->points[a], data->points[b]), data->points[c]);
        const DVec3 high = max(max(data->points[a], data->points[b]), data->points[c]);
        if (p.x < low.x || p.y < low.y || p.x > high.x || p.y > high.y || p.z > high.z) continue;
        const Span<double> span =
            TriangleKernel<double>{data->points[a], data->points[b], data->points[c]}.span(ray, -1.);
        inside ^= span.hit && span.far > 0;
    }
    return inside && !open_side(*data);
}

}  // namespace strahl
