// Makes items of primitives by all threads. Each item goes where it would be if they were made one after the other.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <mutex>
#include <numeric>

#include "scene/leaves.h"
#include "scene/overlap.h"
#include "trace/world/extended_numbers.h"
#include "trace/world/world_arrays.h"

namespace strahl {
namespace {

/// An emitter that puts items into their places.
template <class T>
struct PutItems {
    WorldArrays<T>& arrays;
    ItemCounts& before;
    const Box& box;
    T material;
    int faces;
    T first_piece;

    template <class K>
    void operator()(const K& kernel) const {
        constexpr int number = form_number<K, T>(Forms{});
        FormItems<T>& own = arrays.forms[number];
        const int i = before.items[number]++;
        auto* const items = reinterpret_cast<Item<FormAt<number, Forms>, T>*>(own.numbers.get());
        items[i] = {kernel, static_cast<T>(before.surfaces), material};
        if constexpr (requires { kernel.number; }) items[i].shape.number = static_cast<T>(i);
        if constexpr (requires { kernel.first; }) items[i].shape.first = first_piece;
        if constexpr (requires { kernel.bounds(); })
            own.boxes[i] = item_box(kernel.bounds(), number);  // a triangle, say: one of the body's many items
        else
            own.boxes[i] = item_box(box, number);
        before.surfaces += faces;
    }
};

/// Is a body a mesh that is worth a world of its own, and that shadow rays need not ask for its material?
bool can_be_shared(const Scene& scene, const Primitive& body) {
    const Mesh* const mesh = std::get_if<Mesh>(&body.shape);
    const Material& material = scene.materials[static_cast<std::size_t>(body.material)];
    return mesh && mesh->data->triangles.size() > share_items && !material.may_transmit() && material.shadow > 0;
}

}  // namespace

template <class T>
void PieceArrays<T>::add(const Scene& scene) {
    for (const Primitive& primitive : scene.primitives)
        for_each_leaf(primitive, [&](const Primitive& leaf, const glm::dmat4&) {
            const auto add = [&](const auto& data, auto& all) {
                if (first.try_emplace(data.get(), T(all.size())).second)
                    all.insert(all.end(), data->pieces.begin(), data->pieces.end());
            };
            if (const auto* const blob = std::get_if<Blob>(&leaf.shape)) add(blob->data, lumps);
            if (const auto* const sweep = std::get_if<SphereSweep>(&leaf.shape)) add(sweep->data, sweeps);
            const ContourData* const own = contours_of(leaf.shape);
            if (!own || !first.try_emplace(own, T(contours.size())).second) return;
            for (const auto& piece : own->pieces) contours.push_back(piece.template rounded<T>());
        });
}

template <class T>
void WorldArrays<T>::add_items(const Scene& scene, const Placement& placement, ThreadPool& pool, bool proves) {
    const auto size = static_cast<std::int32_t>(scene.primitives.size());
    const bool shares = meshes && !proves;
    const auto shared = shares ? meshes->find(scene) : typename SharedMeshes<T>::ByPrimitive();
    /// Returns how many triangles a mesh has that worlds share, and of all else 0.
    const auto shared_faces = [&](std::int32_t i) {
        if (!shares || !shared[i]) return 0;
        return static_cast<int>(std::get<Mesh>(scene.primitives[i].shape).data->triangles.size());
    };
    std::vector<ItemCounts> before(size / share_items + 2);
    share_out(pool, size, share_items, [&](std::int32_t first, std::int32_t last) {
        ItemCounts own;
        for (std::int32_t i = first; i < last; ++i) {
            if (const int faces = shared_faces(i))
                CountItems<T>{own, faces}(SharedMeshKernel<T>{});
            else
                count_items<T>(scene.primitives[i], own);
        }
        before[first / share_items + 1] = own;
    });
    for (std::size_t i = 1; i < before.size(); ++i) before[i] += before[i - 1];
    const ItemCounts& all = before.back();
    check_capacity<T>(all.surfaces);
    boxes = uninitialized_buffer<ItemBox>(std::accumulate(all.items.begin(), all.items.end(), std::size_t(0)));
    ItemBox* next_box = boxes.get();
    for (int form = 0; form < Forms::size; ++form) {
        forms[form].count = all.items[form];
        forms[form].numbers = uninitialized_buffer<T>(std::size_t(all.items[form] + widest_pack) * traits[form].fields);
        forms[form].boxes = next_box;
        next_box += all.items[form];
    }
    surfaces = static_cast<int>(all.surfaces);
    // Most worlds have no pieces, and to look at a million bodies takes one thread a tenth of the time of building.
    if (has_listed_faces()) pieces.add(scene);
    world.contour_pieces = pieces.contours.data(), world.lump_pieces = pieces.lumps.data();
    world.sweep_pieces = pieces.sweeps.data();

    // Triangles of large meshes are made when all else is: by all threads, while a primitive is made by one.
    struct LargeMesh {
        const Mesh& mesh;
        WorldTransform to_world;
        ItemCounts before;
        T material;
    };
    std::vector<LargeMesh> large;
    std::mutex enlarging;
    std::vector<double> reaches(before.size());
    share_out(pool, size, share_items, [&](std::int32_t first, std::int32_t last) {
        ItemCounts own = before[first / share_items];
        double reach = 0;
        for (std::int32_t i = first; i < last; ++i) {
            const Primitive& primitive = scene.primitives[i];
            const WorldTransform to_world{matrix(primitive.transformations), similarity(primitive.transformations),
                                          placement.origin, placement.scale};
            const Box whole = transformed_bounds(primitive.shape, to_world.matrix);
            const Box box{to_world.place(whole.low), to_world.place(whole.high)};
            if (std::visit([]<class Kind>(const Kind&) { return is_composite<Kind>; }, primitive.shape))
                reach = std::max(reach, reach_from(placement.origin, primitive) * placement.scale);
            else if (box.finite())
                for (int c = 0; c < 3; ++c) reach = std::max({reach, std::abs(box.low[c]), std::abs(box.high[c])});
            std::int32_t leaf = leaf_of(i);
            const T material = static_cast<T>(material_of(primitive, leaf));
            if (const int faces = shared_faces(i)) {
                PutItems<T>{*this, own, box, material, faces, 0}(SharedMeshKernel<T>{});
                continue;
            }
            const Mesh* const mesh = std::get_if<Mesh>(&primitive.shape);
            if (mesh && mesh->data->triangles.size() > share_items && !proves) {
                const std::lock_guard lock(enlarging);
                large.push_back({*mesh, to_world, own, material});
                count_items<T>(primitive, own);
                continue;
            }
            std::visit(
                [&](const auto& shape) {
                    const int faces = faces_of(primitive.shape);
                    emit_in<T>(shape, to_world, primitive.transformations,
                               PutItems<T>{*this, own, box, material, faces, pieces.first_of(primitive.shape)}, proves);
                },
                primitive.shape);
        }
        reaches[first / share_items] = reach;
    });
    reach = *std::max_element(reaches.begin(), reaches.end());
    if (shares) place_meshes(scene, placement, shared);
    for (const LargeMesh& own : large) {
        const auto count = static_cast<std::int32_t>(own.mesh.data->points.size());
        const Buffer<Vec3<T>> points = uninitialized_buffer<Vec3<T>>(count);
        share_out(pool, count, share_items, [&](std::int32_t first, std::int32_t last) {
            own.mesh.place_points(own.to_world, first, last, points.get());
        });
        share_out(pool, static_cast<std::int32_t>(own.mesh.data->triangles.size()), share_items,
                  [&](std::int32_t first, std::int32_t last) {
                      ItemCounts at = own.before;
                      for (int& items : at.items) items += first;
                      at.surfaces += first;
                      own.mesh.emit_stretch(own.to_world, points.get(), first, last,
                                            PutItems<T>{*this, at, {}, own.material, Mesh::faces, 0});
                  });
    }
}

template <class T>
void WorldArrays<T>::place_meshes(const Scene& scene, const Placement& placement,
                                  const typename SharedMeshes<T>::ByPrimitive& shared) {
    constexpr int form = place_of<SharedMeshForm>(Forms{});
    const auto* item = reinterpret_cast<const Item<SharedMeshForm, T>*>(forms[form].numbers.get());
    const auto into = [](const Placement& own) {
        return glm::scale(glm::dmat4(1), glm::dvec3(own.scale)) *
               glm::translate(glm::dmat4(1), -glm::dvec3(own.origin));
    };
    const auto map_of = [](const glm::dmat4& m) {
        return PlaceMap<T>{{cast<T>(DVec3(m[0])), cast<T>(DVec3(m[1])), cast<T>(DVec3(m[2]))}, cast<T>(DVec3(m[3]))};
    };
    for (std::size_t i = 0; i < shared.size(); ++i) {
        const auto* const own = shared[i];
        if (!own) continue;
        const Primitive& body = scene.primitives[i];
        const glm::dmat4 out = into(placement) * matrix(body.transformations) * glm::inverse(into(own->placement));
        const glm::dmat4 in = glm::inverse(out);
        const glm::dmat3 turn(in);
        const double side = glm::determinant(turn) < 0 ? -1 : 1;
        placed_meshes.emplace_back(own->built->world(), map_of(in), map_of(out),
                                   map_of(glm::dmat4(side * glm::transpose(turn))),
                                   static_cast<std::int32_t>(item->surface),
                                   static_cast<std::int32_t>(std::get<Mesh>(body.shape).data->triangles.size()));
        ++item;
    }
    world.meshes = placed_meshes.data();
}

template <class T>
void SharedMeshes<T>::add(const Scene& scene, ThreadPool& pool, int lanes) {
    for (const Primitive& body : scene.primitives) {
        if (!can_be_shared(scene, body)) continue;
        const Mesh& mesh = std::get<Mesh>(body.shape);
        const auto [own, is_new] = worlds.try_emplace(mesh.data);
        if (!is_new) continue;
        Scene alone;
        alone.materials.emplace_back();
        alone.primitives.emplace_back().shape = mesh;
        const Placement place = placement(extent_of(alone), mesh.bounds().centre());
        own->second = {place, std::make_unique<BuiltWorld<T>>(alone, place, pool, nullptr, nullptr, false, lanes)};
    }
}

template <class T>
typename SharedMeshes<T>::ByPrimitive SharedMeshes<T>::find(const Scene& scene) const {
    constexpr double most_uneven = 16;
    const auto largest = [](const glm::dmat3& all) {
        return std::max({length(all[0]), length(all[1]), length(all[2])});
    };
    const auto world_of = [&](const Primitive& body) -> const OwnWorld* {
        if (!can_be_shared(scene, body)) return nullptr;
        const auto found = worlds.find(std::get<Mesh>(body.shape).data);
        if (found == worlds.end()) return nullptr;
        const World<T>& world = found->second.built->world();
        const glm::dmat3 m(matrix(body.transformations)), inverse = glm::inverse(m);
        const bool even = largest(m) * largest(inverse) < most_uneven;
        return even && world.nodes && world.loop_count == 0 ? &found->second : nullptr;
    };
    ByPrimitive found(scene.primitives.size());
    std::ranges::transform(scene.primitives, found.begin(), world_of);
    return found;
}

std::int64_t surfaces_apart(const Scene& scene) {
    ItemCounts counts;
    for (const Primitive& body : scene.primitives)
        if (!can_be_shared(scene, body)) count_items<float>(body, counts);
    return counts.surfaces;
}

template class SharedMeshes<float>;
template class SharedMeshes<double>;
template class SharedMeshes<long double>;
template void WorldArrays<float>::add_items(const Scene&, const Placement&, ThreadPool&, bool);
template void WorldArrays<double>::add_items(const Scene&, const Placement&, ThreadPool&, bool);
template void WorldArrays<long double>::add_items(const Scene&, const Placement&, ThreadPool&, bool);

}  // namespace strahl
