// Transmitted light with error bounds, by a light buffer: past the bodies in the cells of rays.
#pragma once
#include "trace/lights/light_buffer_cells_kernel.h"
#include "trace/proof/item_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// Attenuates a light that has a buffer by the items of the hierarchy. Returns the lanes that are left to the hierarchy
/// itself. Kept out of line: inlined, its stack frame would slow down small worlds.
///
/// If the exact ray from x to the light L meets a body, at x + s (L - x) with s from 0 to 1, the computed ray from p to
/// M passes at p + s (M - p), no further from there than the larger of |x - p| and |L - M|; that point is in the cell,
/// and no further from M than p is. So the cell has the body if balls were enlarged by that distance and by the error
/// of the body itself. Parallel light comes from no further than the world is wide, where the error of its direction is
/// less than the half of the margin that is left.
template <class S>
[[gnu::noinline]] Mask<S> light_bounds_in_buffer(const World<Element<S>>& world, int number, const DoubtfulRay<S>& own,
                                                 const S& distance, const S& off, Mask<S> active,
                                                 const Slack<Element<S>>& slack, LightBounds<S>& light) {
    using T = Element<S>;
    const LightKernel<T>& from = world.lights[number];
    const Vec3<S> origin = own.ray.origin;
    const T furthest = world.light_buffers[number].furthest;
    const T room = (T(.5 * LightBuffers<T>::proving_margin) - 8 * (slack.share + slack.turn)) * slack.reach;
    const S wrong = own.doubt.away + S(from.finite * unit_error<S>) * norm1(splat<S>(from.position));
    const Mask<S> near = active & (dot(origin, origin) < S(furthest * furthest)) & (wrong < S(room));
    walk_candidates(world, number, origin, distance, near, [&](int form, Mask<S> lanes, const int* items) {
        const bool known = if_hot(world, form, [&](const auto& group) {
            using Item = typename std::remove_cvref_t<decltype(group)>::template ItemOf<S>;
            pass_opaque_items(gather_items<Item, S>(group.items, items), own, lanes, distance, off, slack, light);
        });
        if (!known) light.doubt = light.doubt | lanes;
        return light.dark;
    });
    return active & !near;
}

}  // namespace strahl::inline STRAHL_LEVEL
