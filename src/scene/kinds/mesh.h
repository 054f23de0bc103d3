// The mesh: triangles that share corners and are one body, given in the scene or in a file.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "scene/kinds/mesh_data.h"
#include "scene/kinds/smooth_triangle.h"

namespace strahl {

/// Finds a place where a mesh is not closed: the ends of a side that two triangles do not share in opposite directions;
/// nothing if the mesh is closed.
std::optional<std::pair<DVec3, DVec3>> open_side(const MeshData& mesh);

/// Do two meshes have the same corners, normals and places, however these are numbered?
bool same_triangles(const MeshData& a, const MeshData& b);

/// Its items are triangles. A point is inside of a closed mesh if a line from it crosses the mesh an odd number of
/// times.
struct Mesh {
    std::shared_ptr<const MeshData> data = tetrahedron();
    std::string file;  // as the scene names it; empty for a mesh whose triangles stand in the scene

    bool operator==(const Mesh& other) const {
        return file == other.file && (data == other.data || same_triangles(*data, *other.data));
    }

    static constexpr const char* name = "mesh";
    static constexpr int faces = 1, max_crossings = 1;  // of an item, a triangle
    static constexpr bool bounded = true, convex = true, closed = false, hot = false;
    static constexpr auto fields = std::make_tuple();
    static std::shared_ptr<const MeshData> tetrahedron();

    /// Does it have sides that two triangles do not share?
    bool open() const { return open_side(*data).has_value(); }
    const char* fault() const { return data->triangles.empty() ? "it has no triangles" : nullptr; }
    Box bounds() const { return bounds(glm::dmat4(1)); }
    Box bounds(const glm::dmat4& matrix) const;
    bool contains(const DVec3& p) const;

    template <class T>
    using Kernels = std::tuple<>;
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        const std::size_t triangles = data->triangles.size();
        if constexpr (requires { emit.template count<TriangleKernel<T>>(triangles); }) {
            data->corner_normals.empty() ? emit.template count<TriangleKernel<T>>(triangles)
                                         : emit.template count<SmoothTriangleKernel<T>>(triangles);
        } else {
            std::vector<Vec3<T>> points(data->points.size());
            place_points(to_world, 0, points.size(), points.data());
            emit_stretch(to_world, points.data(), 0, triangles, emit);
        }
    }
    /// Puts the points from `first` to before `last` into the world.
    template <class T>
    void place_points(const WorldTransform& to_world, std::size_t first, std::size_t last, Vec3<T>* places) const {
        for (std::size_t i = first; i < last; ++i) places[i] = cast<T>(to_world.point(data->points[i]));
    }
    /// Emits the triangles from `first` to before `last`.
    template <class T, class Emit>
    void emit_stretch(const WorldTransform& to_world, const Vec3<T>* corners, std::size_t first, std::size_t last,
                      const Emit& emit) const {
        const auto& normals = data->normals;
        const auto &triangles = data->triangles, &corner_normals = data->corner_normals;
        const NormalTransform turn(to_world.matrix);
        for (std::size_t i = first; i < last; ++i) {
            const auto [a, b, c] = triangles[i];
            const TriangleKernel<T> flat{corners[a], corners[b], corners[c]};
            if (corner_normals.empty()) {
                emit(flat);
            } else {
                const auto normal = [&](int k) { return turn(normalize(normals[corner_normals[i][k]])); };
                emit(smooth_kernel(flat, normal(0), normal(1), normal(2)));
            }
        }
    }
};

/// The number of a mesh of which worlds share the triangles.
template <class T>
struct SharedMeshKernel {
    T number;
};
/// A mesh whose triangles are in a world of their own, in their own coordinates: see PlacedMesh. No kind of scenes, but
/// a form of meshes in worlds.
struct SharedMesh {
    static constexpr int faces = 0;
    static constexpr bool bounded = true, convex = false, closed = false, hot = false;
    template <class T>
    using Kernels = std::tuple<SharedMeshKernel<T>>;
};

}  // namespace strahl
