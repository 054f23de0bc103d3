// Finds triangles by the numbers of their surfaces.
#pragma once
#include "num/memory.h"
#include "trace/world/world.h"

namespace strahl::inline STRAHL_LEVEL {

template <class T>
STRAHL_INLINE const TriangleKernel<T>& flat(const TriangleKernel<T>& triangle) {
    return triangle;
}
template <class T>
STRAHL_INLINE const TriangleKernel<T>& flat(const SmoothTriangleKernel<T>& triangle) {
    return triangle.flat;
}
/// Returns the triangle that a surface is, or null.
template <class T>
STRAHL_INLINE const TriangleKernel<T>* triangle_of(const World<T>& world, int surface) {
    const ItemReference& reference = world.references[surface];
    const int form = world.sort_bins[reference.bin].form;
    const auto in = [&]<class Form>(Form) {
        return &flat(world.groups.template get<Form>().items[reference.item].shape);
    };
    return form == place_of<Form<Triangle, 0>>(Forms{})         ? in(Form<Triangle, 0>{})
           : form == place_of<Form<SmoothTriangle, 0>>(Forms{}) ? in(Form<SmoothTriangle, 0>{})
                                                                : nullptr;
}
/// Returns the shared mesh that a surface belongs to, or null.
template <class T>
STRAHL_INLINE const PlacedMesh<T>* placed_mesh_of(const World<T>& world, int surface) {
    const ItemReference& reference = world.references[surface];
    const bool shared = world.sort_bins[reference.bin].form == place_of<SharedMeshForm>(Forms{});
    return shared ? &placed_mesh(world, reference.item) : nullptr;
}

}  // namespace strahl::inline STRAHL_LEVEL
