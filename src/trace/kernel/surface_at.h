// The points where rays meet the surfaces that were found.
#pragma once
#include "trace/kernel/shading.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns the number of a surface's material.
template <class T>
int material_of(const World<T>& world, int surface) {
    const ItemReference& reference = world.references[surface];
    const int form = world.sort_bins[reference.bin].form;
    int number = 0, material = 0;
    world.groups.each([&](const auto& group) {
        if (number++ == form) material = static_cast<int>(group.items[reference.item].material);
    });
    return material;
}

/// Returns the points where rays first meet the one item of a bin, at distance `t`. Functions that are called get
/// copies, so that all else can stay in registers.
template <class S>
STRAHL_INLINE SurfaceHit<S> surface_at(const World<Element<S>>& world, const SortBin& bin, const Ray<S>& ray, S t) {
    SurfaceHit<S> hit;
    const auto inline_code = [&](const auto& group) __attribute__((always_inline)) {
        using Item = typename std::remove_cvref_t<decltype(group)>::template ItemOf<S>;
        hit = surface_hit(splat_item<Item, S>(group.items[bin.item]), ray, t, crossings_of<S, Item>);
    };
    if (!if_hot(world, bin.form, inline_code)) {
        const Ray<S> copy = ray;
        SurfaceHit<S> called;
        calls<S>(bin.form).surface_at(world, bin.item, copy, S(t), called);
        hit.point = called.point, hit.surface = called.surface, hit.body = called.body;
    }
    return hit;
}
/// Returns the points where rays first meet the items of their surfaces, all of one form, and the items' materials.
template <class S>
STRAHL_INLINE SurfaceHit<S> surfaces_at(const World<Element<S>>& world, int form, const Element<S>* surfaces,
                                        const LaneIndices<S>& pick, const Ray<S>& ray, S t, int* materials) {
    int items[width<S>];
    for (int k = 0; k < width<S>; ++k) items[k] = world.references[static_cast<int>(surfaces[pick.index[k]])].item;
    S faces(-1);
    if (world.composites.leaf_faces) {
        alignas(64) Element<S> known[width<S>];
        for (int k = 0; k < width<S>; ++k)
            known[k] = static_cast<Element<S>>(world.composites.leaf_faces[static_cast<int>(surfaces[pick.index[k]])]);
        faces = load_lanes<S>(known);
    }
    if (form == place_of<SharedMeshForm>(Forms{})) [[unlikely]] {
        alignas(64) Element<S> triangles[width<S>];
        for (int k = 0; k < width<S>; ++k)
            triangles[k] =
                surfaces[pick.index[k]] - world.groups.template get<SharedMeshForm>().items[items[k]].surface;
        faces = load_lanes<S>(triangles);
    }
    const Ray<S> copy = ray;
    SurfaceHit<S> called;
    calls<S>(form).surfaces_at(world, items, copy, S(t), faces, called, materials);
    return called;
}

}  // namespace strahl::inline STRAHL_LEVEL
