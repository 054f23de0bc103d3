// Finds where rays cross a mesh that is part of a composite, one crossing after the other.
#pragma once
#include "trace/forms/form_kernel.h"
#include "trace/hierarchy/traverse.h"

namespace strahl::inline STRAHL_LEVEL {

template <class S>
STRAHL_INLINE Mask<S> only_lane(int k) {
    return first_lanes<S>(k + 1) & !first_lanes<S>(k);
}

/// Finds where rays next pass through the surface of a mesh beyond `place`. Crossings of an even number of triangles in
/// one place, at a fold, do not count. The surface is counted from the mesh's first. With `all`, counts all triangles
/// beyond `place`: an odd number if that place is inside.
template <class S>
[[gnu::noinline]] MeshCrossing<S> next_mesh_crossing(const World<Element<S>>& world, const CompositeLeaf& mesh,
                                                     const Ray<S>& ray, Mask<S> lanes, S place, bool all) {
    using T = Element<S>;
    const S inf(std::numeric_limits<T>::infinity());
    const TraversalRay<S> line = traversal_ray(ray);
    MeshCrossing<S> result;
    result.odd = result.odd_in_all = first_lanes<S>(0);
    for (Mask<S> open = lanes; any(open); all = false) {
        MeshCrossing<S> found;
        found.odd = found.odd_in_all = first_lanes<S>(0);
        const auto look = [&](const Leaf& leaf, Mask<S> mask) {
            calls<S>(mesh.form).cross_beyond(world, leaf.first, leaf.count(), ray, mask, place, found);
            return false;
        };
        const auto single = [&](int k, const Leaf& root) {
            const Mask<S> mask = only_lane<S>(k);
            if (root.code != 0) return void(look(root, mask));
            T limit = std::numeric_limits<T>::infinity();
            traverse_single<true>(mesh.nodes, root.first, lane_of(line, k), limit, [&](const Leaf& leaf) {
                look(leaf, mask);
                if (!all) limit = lane(found.t, k);
                return false;
            });
        };
        const S& limit = all ? inf : found.t;
        traverse<true>(mesh.nodes, line, open, limit, look, single);
        result.t = select(open, found.t, result.t);
        result.surface = select(open, found.surface - S(static_cast<T>(mesh.surface)), result.surface);
        if (all) result.odd_in_all = found.odd_in_all;
        place = select(open, found.t, place);
        open = open & !found.odd & (found.t < inf);
    }
    return result;
}

}  // namespace strahl::inline STRAHL_LEVEL
