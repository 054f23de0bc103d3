// Makes and holds the arrays that a World points into.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <type_traits>
#include <unordered_map>
#include <vector>

#include "num/buffer.h"
#include "num/thread_pool.h"
#include "scene/scene.h"
#include "trace/hierarchy/hierarchy.h"
#include "trace/hierarchy/moving_hierarchy.h"
#include "trace/world/build_world.h"
#include "trace/world/light_culling.h"
#include "trace/world/mip_maps.h"
#include "trace/world/world.h"

namespace strahl {

inline constexpr std::int32_t share_items = 4096;  // a thread's piece of work on items

/// Counts what shapes emit, by form.
struct ItemCounts {
    std::array<int, Forms::size> items{};
    std::int64_t surfaces = 0;
    ItemCounts& operator+=(const ItemCounts& more) {
        for (std::size_t i = 0; i < items.size(); ++i) items[i] += more.items[i];
        return surfaces += more.surfaces, *this;
    }
};

/// The number of the form whose kernel for T is K.
template <class K, class T, class... F>
consteval int form_number(FormList<F...>) {
    int number = 0, found = -1;
    ((std::is_same_v<typename F::template Kernel<T>, K> ? found = number++ : ++number), ...);
    return found;
}
/// Returns how many faces an item has that a shape emits, or the leaves of a composite together.
int faces_of(const Shape& shape);

/// An emitter that counts.
template <class T>
struct CountItems {
    ItemCounts& counts;
    int faces;
    template <class K>
    void operator()(const K&) const {
        count<K>(1);
    }
    template <class K>
    void count(std::size_t number) const {
        counts.items[form_number<K, T>(Forms{})] += static_cast<int>(number);
        counts.surfaces += static_cast<std::int64_t>(number) * faces;
    }
};
/// Adds what a primitive emits; which forms these are depends on the similarity alone.
template <class T>
void count_items(const Primitive& primitive, ItemCounts& counts) {
    const WorldTransform transform{.similarity = similarity(primitive.transformations)};
    std::visit(
        [&](const auto& shape) {
            shape.template emit<T>(transform, CountItems<T>{counts, faces_of(primitive.shape)});
        },
        primitive.shape);
}

/// The type in which the numbers of a world are computed.
template <class T>
using Made = std::conditional_t<std::is_same_v<T, long double>, long double, double>;

template <class T>
DVec3 to_double(const Vec3<T>& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// The traits of a form.
struct FormTraits {
    bool hot, bounded, convex, listed;  // listed: rays list where they cross its items
    int faces;                          // number of faces of an item
    int fields;                         // numbers in an item, the last two being its surface and its material
};
template <class T, class... F>
constexpr std::array<FormTraits, sizeof...(F)> traits_of(FormList<F...>) {
    return {{{F::hot, F::Kind::bounded, F::Kind::convex, lists_crossings<typename F::Kind>, F::Kind::faces,
              int(sizeof(Item<F, T>) / sizeof(T))}...}};
}

/// The items of a form as plain numbers, one item after the other, so that code which moves them is compiled once.
template <class T>
struct FormItems {
    std::shared_ptr<T[]> numbers, columns;  // shared with the world of another moment where they are equal
    ItemBox* boxes = nullptr;               // boxes of all items, until the items are in order
    int count = 0, in_hierarchy = 0;
    bool copied = false;  // are some in the hierarchy several times?
};

template <class T>
struct FewBodiesArrays {
    std::vector<BoundingVolume> volumes;  // by bin
    BodySet glass = 0;                    // the transparent ones
    BodySet shadowing = 0;                // those that cast shadows
    std::vector<T> balls;
    std::vector<BodyBox<T>> boxes;
    std::vector<LightCone<T>> cones;
    std::vector<ParallelShadows<T>> shadows;
    std::vector<T> cone_columns;
    std::vector<BodySet> occluders;
};
template <class T>
struct CompositeArrays {
    std::vector<CompositeInfo> list;
    std::vector<CompositeLeaf> leaves;
    std::vector<CompositeBall<T>> balls;
    std::vector<CompositeStep> steps;
    std::vector<CompositePlane<T>> planes;
    std::vector<Hierarchy> mesh_hierarchies;  // of meshes that are leaves
    std::vector<std::int32_t> face_keys, leaf_faces;
};
/// The pieces of contours, blobs and sweeps, those that bodies share once.
template <class T>
struct PieceArrays {
    std::vector<ContourPiece<T>> contours;
    std::vector<LumpPiece> lumps;
    std::vector<SweepPiece> sweeps;
    std::unordered_map<const void*, T> first;  // number of the first piece, by the data of a body
    /// Adds the pieces of a scene's bodies.
    void add(const Scene& scene);
    /// Returns the number of the first piece of a body, or 0 if its kind has none.
    T first_of(const Shape& shape) const {
        return std::visit(
            [&]<class Kind>(const Kind& kind) {
                if constexpr (has_pieces<Kind>) return first.at(kind.data.get());
                return T(0);
            },
            shape);
    }
};
template <class T>
struct PatternArrays {
    std::vector<PatternKernel<T>> list;
    std::vector<BendKernel<T>> bends;
    std::vector<ColorStopKernel<T>> stops;
    std::optional<PatternKernel<T>> sky;
    std::vector<PatternKernel<T>> nested, coats;
    std::vector<std::shared_ptr<const MeshData>> meshes;  // meshes that have uv coordinates
    // The material of each leaf of the scene, and the first leaf of each primitive; empty in worlds without patterns.
    std::vector<std::int32_t> leaf_materials, first_leaf;
    std::vector<std::shared_ptr<const Pattern>> kept;  // kernels point to their numbers
};
template <class T>
struct FinishArrays {
    std::vector<FinishKernel<T>> list;
    std::vector<LayerKernel<T>> layers;
    std::vector<PatternKernel<T>> shares;
    std::vector<BendKernel<T>> bends;
    std::vector<std::uint8_t> finished;  // by surface
    std::vector<double> groups;          // of lights, with duplicates
    /// Returns the number of a group as kernels have it: not 0 unless the group is 0.
    std::int32_t group_number(double group) const {
        return group > 0 ? static_cast<std::int32_t>(1 + (std::ranges::find(groups, group) - groups.begin())) : 0;
    }
};
template <class T>
struct MediumArrays {
    struct TransparentShape {
        int surface, medium;  // medium: what is on the stacks of rays that start in it
        Shape shape;
        glm::dmat4 inverse;
    };
    std::vector<T> iors;
    std::vector<std::int32_t> bodies;
    std::vector<std::uint8_t> hollow;
    std::vector<TransparentShape> transparent;
};

template <class T>
struct WorldArrays {
    World<T> world;
    static constexpr auto traits = traits_of<T>(Forms{});
    std::array<FormItems<T>, Forms::size> forms;
    Buffer<ItemBox> boxes;  // boxes of all forms, one form after the other
    Hierarchy hierarchy;
    std::shared_ptr<ItemReference[]> references;
    std::vector<SortBin> sort_bins;
    std::vector<ItemRange> loops;
    std::vector<MaterialKernel<T>> materials;
    std::vector<LightKernel<T>> lights;
    FewBodiesArrays<T> few;
    CompositeArrays<T> composites;
    PieceArrays<T> pieces;
    PatternArrays<T> patterns;
    std::vector<std::int32_t> copied_materials;  // what materials beyond those of the scene are copies of
    MediumArrays<T> media;
    FinishArrays<T> finishes;
    std::vector<PlacedMesh<T>> placed_meshes;  // those of `meshes` that are in this world
    double reach = 0;                          // the largest coordinate of a bounded body
    int surfaces = 0;

    MovingHierarchy* const moving;  // hierarchy of the earlier moments, or nullptr
    const std::shared_ptr<Images> images;
    const int lanes;                      // SIMD lanes of the kernel
    const SharedMeshes<T>* const meshes;  // or nullptr

    WorldArrays(const Scene& scene, const Placement& placement, ThreadPool& pool, MovingHierarchy* moving,
                std::shared_ptr<Images> kept, bool proves, int lanes, const SharedMeshes<T>* meshes);

    /// Makes a world that differs from another one in its lights alone, whose arrays have to stay.
    WorldArrays(const WorldArrays& bodies, const Scene& scene, const Placement& placement);
    /// Takes over arrays of the same scene's world at another moment that are equal, as where no body of a form moves.
    void share(const WorldArrays& other);

    /// Returns by how much coordinates may be off, the largest of them being `furthest`.
    static double rounding(double furthest) { return 32 * culling_unit<T> * furthest; }
    // add_items.cpp
    void add_items(const Scene& scene, const Placement& placement, ThreadPool& pool, bool proves);
    /// Notes where the meshes are that other worlds have.
    void place_meshes(const Scene& scene, const Placement& placement,
                      const typename SharedMeshes<T>::ByPrimitive& shared);
    // arrange_items.cpp
    void arrange_items(ThreadPool& pool, bool proves);
    std::vector<std::int32_t> cut_boxes(const std::array<std::int32_t, Forms::size + 1>& starts, ThreadPool& pool);
    void make_hierarchy(ThreadPool& pool, bool whole);
    void add_columns(const Hierarchy& of, ThreadPool& pool);
    void number_bins(ThreadPool& pool);
    // add_composites.cpp
    void add_composites(const Scene& scene, const Placement& placement, ThreadPool& pool, bool proves);
    // add_patterns.cpp
    void add_sky(const Scene& scene, bool proves);
    void add_patterns(const Scene& scene, const Placement& placement, bool proves);
    /// Adds the colours of a pigment whose kernel is given. Patterns among them are made in the space of this kernel's
    /// body, which has the matrix `to_world`.
    void add_colors(const Pigment& pigment, PatternKernel<T>& kernel, double gamma, const glm::dmat4& to_world,
                    const Placement& placement);
    /// Adds the uv coordinates of a mesh, whose first surface is given, and returns where they are.
    PlacesKernel add_places(const Shape& shape, int first_surface);
    BendKernel<T> bend_of(const Material& material, const glm::dmat4& to_world, const Placement& placement,
                          const PlacesKernel& places);
    void add_image(const std::shared_ptr<const Pixels>& from, double gamma, bool colors, ImageKernel<T>& kernel);
    /// Returns the number of a primitive's material, or of the next leaf's, and goes on to the leaf after it.
    int material_of(const Primitive& primitive, std::int32_t& leaf) const {
        return patterns.leaf_materials.empty() ? primitive.material : patterns.leaf_materials[leaf++];
    }
    std::int32_t leaf_of(std::int32_t primitive) const {
        return patterns.first_leaf.empty() ? 0 : patterns.first_leaf[primitive];
    }
    /// Are there composites, or bodies that list where rays cross them? Parts of composites may be such ones.
    bool has_listed_faces() const {
        for (int form = 0; form < Forms::size; ++form)
            if (forms[form].count > 0 && (traits[form].listed || form == place_of<CompositeForm>(Forms{}))) return true;
        return false;
    }
    bool is_plain(int material) const { return finishes.list.empty() || finishes.list[material].plain; }
    void add_finish(const Material& material, const Scene& scene, const glm::dmat4& to_world,
                    const Placement& placement, const PlacesKernel& places);
    void add_finishes(const Scene& scene, const Placement& placement);
    // build_world.cpp
    /// Lets the world point at patterns and finishes, when no more are added.
    void point_at_patterns();
    /// Sets which distances count as rounding errors, and what is too near or too far to be there.
    void set_distances(const Settings& settings, const Placement& placement, bool proves);
    void add_lights(const Scene& scene, const Placement& placement);
    void add_materials(const Scene& scene);
    void list_transparent(const Scene& scene);
    void fill_groups();
    void bound_bodies();
    void cull_for_lights();
};

}  // namespace strahl
