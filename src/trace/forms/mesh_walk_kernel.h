// Finds where rays cross a mesh or a body with contours that is part of a composite.
#pragma once
#include "trace/forms/form_kernel.h"
#include "trace/hierarchy/traverse.h"

namespace strahl::inline STRAHL_LEVEL {

/// Lists the nearest places beyond `place` where rays cross such faces, up to `limit`; further ones may be missing.
/// In the lanes of `all` every face beyond `place` is counted, whatever the limit.
template <class S>
[[gnu::noinline]] void list_mesh_crossings(const World<Element<S>>& world, const CompositeLeaf& mesh, const Ray<S>& ray,
                                           Mask<S> lanes, const S& place, const S& limit, Mask<S> all,
                                           MeshCrossings<S>& found) {
    using T = Element<S>;
    const TraversalRay<S> line = traversal_ray(ray);
    const FormCalls<S>& form = calls<S>(mesh.form);
    found.clear(lanes);
    if (!mesh.nodes) return form.cross_beyond(world, mesh.item, 1, ray, lanes, place, found);
    S end;
    const auto set_end = [&] {
        end = select(all, S(std::numeric_limits<T>::infinity()), min(limit, found.t[found.most - 1]));
    };
    set_end();
    const auto look = [&](const Leaf& leaf, Mask<S> mask) {
        form.cross_beyond(world, leaf.first, leaf.count(), ray, mask, place, found);
        set_end();
        return false;
    };
    traverse<true>(mesh.nodes, line, lanes, end, look, [&](int k, const Leaf& root) {
        T own_end = lane(end, k);
        const Ray<S> one = lane_of(ray, k);
        const auto look_single = [&](const Leaf& leaf) {
            form.cross_beyond_single(world, leaf.first, leaf.count(), one, k, place, found);
            set_end();
            own_end = lane(end, k);
            return false;
        };
        if (root.code != 0)
            look_single(root);
        else
            traverse_single<true>(mesh.nodes, root.first, lane_of(line, k), own_end, look_single);
    });
}

}  // namespace strahl::inline STRAHL_LEVEL
