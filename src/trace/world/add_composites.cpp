// Makes leaves, steps and planes of composites.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <type_traits>
#include <unordered_map>

#include "scene/leaves.h"
#include "trace/world/extended_numbers.h"
#include "trace/world/plane_numbers.h"
#include "trace/world/world_arrays.h"

namespace strahl {
namespace {

template <class Kind>
int faces_of_leaf(const Kind& kind) {
    if constexpr (lists_crossings<Kind>) return kind.face_count();
    return Kind::faces;
}
int faces_of_leaf(const Mesh& mesh) { return static_cast<int>(mesh.data->triangles.size()); }

/// Adds the leaves of one composite.
template <class T>
class CompositeBuilder {
  public:
    CompositeBuilder(WorldArrays<T>& arrays, std::array<std::vector<T>, Forms::size>& leaf_numbers,
                     const Primitive& whole, int surface, std::int32_t first_leaf, const Placement& placement,
                     ThreadPool& pool, bool proves)
        : arrays(arrays),
          tables(arrays.composites),
          leaf_numbers(leaf_numbers),
          placement(placement),
          pool(pool),
          proves(proves),
          outer(matrix(whole.transformations)),
          next_leaf(first_leaf) {
        info.first_leaf = static_cast<std::int32_t>(tables.leaves.size());
        info.first_step = static_cast<std::int32_t>(tables.steps.size());
        info.first_plane = static_cast<std::int32_t>(tables.planes.size());
        info.first_key = static_cast<std::int32_t>(tables.face_keys.size());
        info.surface = next_surface = surface;
        for_each_leaf_within(
            whole,
            [&](const Primitive& leaf, const LeafWay& way) {
                std::visit(
                    [&]<class Kind>(const Kind& shape) {
                        if constexpr (!is_composite<Kind>) add_leaf(shape, leaf, way);
                    },
                    leaf.shape);
            },
            [&](Operation operation, bool keeps) {
                info.keeps |= keeps;
                tables.steps.push_back(keeps ? CompositeStep::keep : step(operation));
            });
        share_planes();
        info.leaves = static_cast<std::int32_t>(tables.leaves.size()) - info.first_leaf;
        release_planes();
        info.steps = static_cast<std::int32_t>(tables.steps.size()) - info.first_step;
        info.surfaces = next_surface - surface;
        mark_what_cuts();
        tables.list.push_back(info);
    }

  private:
    static CompositeStep step(Operation operation) {
        return operation == Operation::unite       ? CompositeStep::unite
               : operation == Operation::intersect ? CompositeStep::intersect
                                                   : CompositeStep::subtract;
    }
    /// Marks the first leaf of all that a step cuts another body with.
    void mark_what_cuts() const {
        std::vector<std::int32_t> first;  // the leaves with which the bodies on the stack begin
        std::int32_t next = 0;
        for (std::int32_t i = 0; i < info.steps; ++i) {
            const CompositeStep step = tables.steps[info.first_step + i];
            if (step == CompositeStep::leaf) {
                first.push_back(next++);
                continue;
            }
            CompositeLeaf& own = tables.leaves[info.first_leaf + first.back()];
            if (!unites(step)) own.until = i, own.leaves = next - first.back();
            first.pop_back();
            if (step == CompositeStep::keep)
                for (std::int32_t n = first.back(); n < next; ++n) tables.leaves[info.first_leaf + n].kept = true;
        }
    }
    template <class Kind>
    void add_leaf(const Kind& shape, const Primitive& part, const LeafWay& way) {
        const glm::dmat4& m = way.inner;
        const WorldTransform to_world{outer * m, way.similarity, placement.origin, placement.scale};
        const std::int32_t material = arrays.material_of(part, next_leaf);
        CompositeLeaf leaf{-1, 0, material, next_surface, faces_of_leaf(shape), 0};
        std::vector<ItemBox> boxes;
        tables.balls.emplace_back();
        const auto put = [&]<class K>(const K& kernel) {
            constexpr int form = form_number<K, T>(Forms{});
            using Own = Item<FormAt<form, Forms>, T>;
            constexpr std::size_t fields = sizeof(Own) / sizeof(T);
            const auto surface = static_cast<T>(next_surface + static_cast<int>(boxes.size()));
            Own item{kernel, surface, static_cast<T>(material)};
            if constexpr (lists_crossings<Kind>) item.shape.first = arrays.pieces.first_of(shape);
            std::vector<T>& numbers = leaf_numbers[form];
            if (leaf.form < 0) leaf.item = arrays.forms[form].count + static_cast<int>(numbers.size() / fields);
            leaf.form = form;
            const T* const first = reinterpret_cast<const T*>(&item);
            numbers.insert(numbers.end(), first, first + fields);
            if constexpr (std::is_same_v<Kind, Mesh>) boxes.push_back(item_box(kernel.bounds(), form));
            if constexpr (requires { kernel.ball(); }) tables.balls.back() = ball_around(kernel.ball());
        };
        emit_in<T>(shape, to_world, way.steps, put, proves);
        if constexpr (std::is_same_v<Kind, Mesh>) {
            meshes.push_back({shape.data.get(), m, tables.leaves.size()});
            return add_mesh(leaf, boxes);
        }
        if constexpr (lists_crossings<Kind>) {
            if constexpr (std::is_same_v<Kind, Prism>)
                prisms.push_back({{shape.base, shape.top}, m, tables.leaves.size()});
            const Box box = transformed(shape.bounds(), to_world.matrix);
            bool convex = false;
            if constexpr (std::is_same_v<Kind, Prism>) convex = shape.data->is_convex_polygon();
            return add_with_contours(leaf, {to_world.place(box.low), to_world.place(box.high)}, convex);
        }
        leaf.first_key = most_planes + 8 * equal_leaf(leaf);
        for (int face = 0; face < Kind::faces; ++face) {
            const std::optional<HalfSpace> plane = plane_of(shape, face);
            if (plane) {
                const PlaneNumbers numbers(moved(*plane, m));
                tables.face_keys.push_back(plane_key(numbers));
                if constexpr (!Kind::bounded) leaf.half_space = static_cast<std::int32_t>(numbers.side);
            } else {
                tables.face_keys.push_back(leaf.first_key + face);
            }
        }
        next_surface += Kind::faces;
        tables.leaves.push_back(leaf);
        tables.steps.push_back(CompositeStep::leaf);
    }
    static CompositeBall<T> ball_around(const Ball& ball) {
        const DVec3& c = ball.centre;
        const double reach = std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}) + ball.radius;
        const double radius = ball.radius + WorldArrays<T>::rounding(reach);
        return {cast<T>(ball.centre), static_cast<T>(radius * radius)};
    }
    /// Adds a mesh, whose triangles are put into the order of a hierarchy of their own.
    void add_mesh(CompositeLeaf& leaf, const std::vector<ItemBox>& boxes) {
        const std::size_t fields = WorldArrays<T>::traits[leaf.form].fields;
        T* const numbers = &leaf_numbers[leaf.form][(leaf.item - arrays.forms[leaf.form].count) * fields];
        const std::vector<T> before(numbers, numbers + boxes.size() * fields);
        double reach = 0;
        for (const ItemBox& box : boxes)
            for (int c = 0; c < 3; ++c) reach = std::max<double>({reach, std::abs(box.low[c]), std::abs(box.high[c])});
        const auto size = static_cast<std::int32_t>(boxes.size());
        Buffer<ItemBox> copies = uninitialized_buffer<ItemBox>(size);
        std::copy(boxes.begin(), boxes.end(), copies.get());
        Hierarchy own = build_hierarchy(std::move(copies), size, WorldArrays<T>::rounding(reach), pool, arrays.lanes);
        for (std::int32_t i = 0; i < size; ++i)
            std::copy_n(&before[own.order[i] * fields], fields, numbers + i * fields);
        for (Node* node = own.nodes.get(); node < own.nodes.get() + own.size; ++node)
            for (int c = 0; c < node->children; ++c)
                if (node->leaves[c] != 0) node->first[c] += leaf.item;
        own.order.reset();
        leaf.listed = true;
        leaf.nodes = own.nodes.get();
        for (int c = 0; c < 3; ++c) {
            const auto &low = leaf.nodes->low[c], &high = leaf.nodes->high[c];
            leaf.low[c] = *std::min_element(low, low + leaf.nodes->children);
            leaf.high[c] = *std::max_element(high, high + leaf.nodes->children);
        }
        tables.mesh_hierarchies.push_back(std::move(own));
        add_listed(leaf);
    }
    void add_with_contours(CompositeLeaf& leaf, const Box& box, bool convex) {
        leaf.listed = !convex;
        if (convex) tables.balls.back() = ball_around({(box.low + box.high) / 2., glm::length(box.high - box.low) / 2});
        double reach = 0;
        for (int c = 0; c < 3; ++c) reach = std::max({reach, std::abs(box.low[c]), std::abs(box.high[c])});
        const double margin = WorldArrays<T>::rounding(reach);
        // Rounded outwards, for the next crossings are looked for from the box on.
        constexpr float inf = std::numeric_limits<float>::infinity();
        for (int c = 0; c < 3; ++c) {
            leaf.low[c] = std::nextafter(static_cast<float>(box.low[c] - margin), -inf);
            leaf.high[c] = std::nextafter(static_cast<float>(box.high[c] + margin), inf);
        }
        add_listed(leaf);
    }
    void add_listed(CompositeLeaf& leaf) {
        leaf.first_key = first_key(leaf);
        for (std::int32_t i = 0; i < leaf.faces; ++i) tables.face_keys.push_back(leaf.first_key + i);
        next_surface += leaf.faces;
        tables.leaves.push_back(leaf);
        tables.steps.push_back(CompositeStep::leaf);
    }
    /// Returns the key of the first face of a mesh or a body with contours: that of the first one with the same
    /// numbers.
    std::int32_t first_key(const CompositeLeaf& own) {
        const int equal = equal_leaf(own);
        if (equal < leaves_so_far()) return tables.leaves[info.first_leaf + equal].first_key;
        return most_planes + 8 * most_leaves + own.surface - info.surface;
    }
    std::int32_t plane_key(const PlaneNumbers& own) {
        const auto found = std::ranges::find(planes, own);
        if (found != planes.end()) return static_cast<std::int32_t>(found - planes.begin());
        planes.push_back(own);
        const HalfSpace there = moved({own.distance * own.normal, own.normal}, outer);
        const DVec3 point = (there.point - placement.origin) * placement.scale;
        tables.planes.push_back({cast<T>(there.normal), static_cast<T>(dot_product(there.normal, point))});
        return static_cast<std::int32_t>(planes.size()) - 1;
    }
    /// Gives triangles and the caps of prisms in a plane with a face of another part the key of that plane, as long as
    /// there is one left.
    void share_planes() {
        if ((meshes.empty() && prisms.empty()) || tables.leaves.size() - info.first_leaf < 2) return;
        constexpr std::int32_t none = -1;
        struct User {
            std::int32_t key, leaf;  // key of the plane; first face of the only leaf on it
        };
        std::unordered_map<PlaneNumbers, User, PlaneNumbers::Hash> users;
        for (std::size_t i = 0; i < planes.size(); ++i) users[planes[i]] = {static_cast<std::int32_t>(i), none};
        const auto each_face = [&](const auto& visit) {
            for (const MeshLeaf& mesh : meshes)
                for (std::size_t i = 0; i < mesh.data->triangles.size(); ++i) {
                    const PlaneNumbers plane(plane_of_triangle(*mesh.data, mesh.data->triangles[i], mesh.matrix));
                    if (std::isfinite(plane.distance)) visit(tables.leaves[mesh.leaf], static_cast<int>(i), plane);
                }
            for (const PrismLeaf& prism : prisms)
                for (int i = 0; i < 2; ++i) {
                    const double z = i == 0 ? std::ranges::min(prism.ends) : std::ranges::max(prism.ends);
                    const PlaneNumbers plane(moved({{0, 0, z}, {0, 0, i == 0 ? -1. : 1.}}, prism.matrix));
                    if (std::isfinite(plane.distance)) visit(tables.leaves[prism.leaf], i, plane);
                }
        };
        each_face([&](const CompositeLeaf& leaf, int, const PlaneNumbers& plane) {
            User& user = users.try_emplace(plane, User{none, leaf.first_key}).first->second;
            if (user.key == none && user.leaf != leaf.first_key && planes.size() < most_planes)
                user.key = plane_key(plane);
        });
        each_face([&](CompositeLeaf& leaf, int face, const PlaneNumbers& plane) {
            const std::int32_t key = users.find(plane)->second.key;
            if (key == none) return;
            tables.face_keys[info.first_key + leaf.surface - info.surface + face] = key;
            leaf.in_planes = true;
        });
    }
    /// Returns the number, in the composite, of the first leaf with the same numbers, and notes if there is one.
    int equal_leaf(const CompositeLeaf& own) {
        const std::size_t fields = WorldArrays<T>::traits[own.form].fields;
        const auto numbers = [&](const CompositeLeaf& leaf) {
            return leaf_numbers[own.form].data() + (leaf.item - arrays.forms[own.form].count) * fields;
        };
        for (int i = 0; i < leaves_so_far(); ++i) {
            const CompositeLeaf& other = tables.leaves[info.first_leaf + i];
            const int items = own.nodes ? own.faces : 1;
            bool same = other.form == own.form && (other.nodes ? other.faces : 1) == items;
            for (int k = 0; same && k < items; ++k)
                same = std::equal(numbers(own) + k * fields, numbers(own) + (k + 1) * fields - 2,
                                  numbers(other) + k * fields);
            info.shares_faces |= same;
            if (same) return i;
        }
        return leaves_so_far();
    }
    int leaves_so_far() const { return static_cast<int>(tables.leaves.size()) - info.first_leaf; }
    /// Gives faces keys of their own that lie in their planes alone: only where faces meet their crossings have to be
    /// those of the plane.
    void release_planes() {
        std::vector<int> faces(planes.size());  // number of faces in each plane
        const auto each_key = [&](const auto& visit) {
            for (const CompositeLeaf& leaf : std::span(tables.leaves).subspan(info.first_leaf))
                for (std::int32_t face = 0; face < leaf.faces; ++face) {
                    std::int32_t& key = tables.face_keys[info.first_key + leaf.surface - info.surface + face];
                    if (key < most_planes) visit(leaf, face, key);
                }
        };
        each_key([&](const CompositeLeaf& leaf, int, int key) { faces[key] += leaf.half_space != 0 ? 2 : 1; });
        each_key([&](const CompositeLeaf& leaf, int face, std::int32_t& key) {
            if (faces[key] == 1) key = leaf.first_key + face;
            info.shares_faces |= key < most_planes;
        });
    }

    WorldArrays<T>& arrays;
    CompositeArrays<T>& tables;
    std::array<std::vector<T>, Forms::size>& leaf_numbers;
    const Placement& placement;
    ThreadPool& pool;
    const bool proves;
    const glm::dmat4 outer;
    std::int32_t next_leaf;  // number that the scene's next leaf gets
    CompositeInfo info{};
    std::int32_t next_surface;
    std::vector<PlaneNumbers> planes;
    struct MeshLeaf {
        const MeshData* data;
        glm::dmat4 matrix;  // from its own space into the composite's
        std::size_t leaf;
    };
    std::vector<MeshLeaf> meshes;
    struct PrismLeaf {
        std::array<double, 2> ends;
        glm::dmat4 matrix;
        std::size_t leaf;
    };
    std::vector<PrismLeaf> prisms;
};

}  // namespace

int faces_of(const Shape& shape) {
    const bool item = std::holds_alternative<Mesh>(shape);
    return sum_of_leaves(shape, [&](const auto& kind) { return item ? Mesh::faces : faces_of_leaf(kind); });
}

/// Adds the leaves of all composites, which follow the items of their forms, and notes where the faces of bodies with
/// contours, of blobs, of sweeps and of Julia sets are.
template <class T>
void WorldArrays<T>::add_composites(const Scene& scene, const Placement& placement, ThreadPool& pool, bool proves) {
    if (!has_listed_faces()) return;
    std::array<std::vector<T>, Forms::size> leaf_numbers;
    ItemCounts before;
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        const Primitive& primitive = scene.primitives[i];
        if (std::visit([]<class Kind>(const Kind&) { return is_composite<Kind>; }, primitive.shape))
            CompositeBuilder<T>(*this, leaf_numbers, primitive, static_cast<int>(before.surfaces),
                                leaf_of(static_cast<std::int32_t>(i)), placement, pool, proves);
        count_items<T>(primitive, before);
    }
    for (int form = 0; form < Forms::size; ++form) {
        FormItems<T>& own = forms[form];
        const std::size_t size = std::size_t(own.count) * traits[form].fields, more = leaf_numbers[form].size();
        if (more == 0) continue;
        Buffer<T> longer = uninitialized_buffer<T>(size + more + std::size_t(widest_pack) * traits[form].fields);
        std::copy_n(own.numbers.get(), size, longer.get());
        std::copy_n(leaf_numbers[form].data(), more, longer.get() + size);
        own.numbers = std::move(longer);
        if (composites.mesh_hierarchies.empty()) continue;
        Buffer<T> columns = uninitialized_buffer<T>(size + more + widest_pack);
        std::fill_n(&columns[size + more], widest_pack, T(0));
        std::copy_n(own.columns.get(), std::size_t(own.in_hierarchy) * traits[form].fields, columns.get());
        own.columns = std::move(columns);
    }
    for (const Hierarchy& own : composites.mesh_hierarchies) add_columns(own, pool);
    auto& [list, leaves, balls, steps, planes, hierarchies, face_keys, leaf_faces] = composites;
    leaf_faces.assign(surfaces, -1);
    // All leaves of a form share a bin, also where each item has one of its own.
    std::array<std::int32_t, Forms::size> first_bins, leaf_bins;
    for (int form = 0, bin = 0; form < Forms::size; bin += forms[form++].count) {
        first_bins[form] = world.bin_per_item ? bin : form, leaf_bins[form] = form;
        if (!world.bin_per_item || leaf_numbers[form].empty()) continue;
        leaf_bins[form] = static_cast<std::int32_t>(sort_bins.size());
        sort_bins.push_back({form});
    }
    const auto refer_to = [&](std::int32_t bin, std::int32_t surface, std::int32_t item, int face, int material) {
        references[1 + surface] = {item, bin};
        leaf_faces[surface] = face;
        if (world.finishes.finished) finishes.finished[surface] = !is_plain(material);
    };
    const auto refer_to_all = [&]<class Own>(std::type_identity<Own>) {
        if constexpr (lists_crossings<typename Own::Kind>) {
            constexpr int form = place_of<Own>(Forms{});
            const auto* const all = reinterpret_cast<const Item<Own, T>*>(forms[form].numbers.get());
            for (int i = 0; i < forms[form].count; ++i)
                for (int face = 0; face < all[i].shape.face_count(); ++face)
                    refer_to(first_bins[form] + (world.bin_per_item ? i : 0), static_cast<int>(all[i].surface) + face,
                             i, face, static_cast<int>(all[i].material));
        }
    };
    [&]<class... Own>(FormList<Own...>) { (refer_to_all(std::type_identity<Own>()), ...); }(Forms{});
    for (const CompositeLeaf& leaf : leaves) {
        const auto refer = [&](std::int32_t surface, std::int32_t item, int face) {
            refer_to(leaf_bins[leaf.form], surface, item, face, leaf.material);
        };
        const std::size_t fields = traits[leaf.form].fields;
        const T* const numbers = forms[leaf.form].numbers.get();
        for (int i = 0; i < leaf.faces; ++i)
            if (leaf.nodes)
                refer(static_cast<int>(numbers[(leaf.item + i + 1) * fields - 2]), leaf.item + i, 0);
            else
                refer(leaf.surface + i, leaf.item, i);
    }
    world.composites = {list.data(),   leaves.data(),    balls.data(),     steps.data(),
                        planes.data(), face_keys.data(), leaf_faces.data()};
}

template void WorldArrays<float>::add_composites(const Scene&, const Placement&, ThreadPool&, bool);
template void WorldArrays<double>::add_composites(const Scene&, const Placement&, ThreadPool&, bool);
template void WorldArrays<long double>::add_composites(const Scene&, const Placement&, ThreadPool&, bool);

}  // namespace strahl
