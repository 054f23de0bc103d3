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
    const LightBuffer<T>& buffer = world.light_buffers[number];
    const LightKernel<T>& from = world.lights[number];
    const bool parallel = from.finite == 0;
    const Vec3<S> position = splat<S>(from.position), origin = own.ray.origin;
    const T room = (T(.5 * LightBuffers<T>::proving_margin) - 8 * (slack.share + slack.turn)) * slack.reach;
    const S wrong = own.doubt.away + S(from.finite * unit_error<S>) * norm1(position);
    const Mask<S> near = active & (dot(origin, origin) < S(buffer.furthest * buffer.furthest)) & (wrong < S(room));
    const S depth = parallel ? -dot(position, origin) : distance;
    S at = cells_of(buffer, parallel, parallel ? origin : origin - position, near);
    Mask<S> left = near & (at > S(0));
    while (any(left)) {
        int places[width<S>], items[width<S>];
        store_whole(places, at);
        const auto candidate = gather_items<Candidate<S>, S>(buffer.candidates, places);
        left = left & (candidate.near < depth);
        if (none(left)) break;
        const S form(lane(candidate.form, first(left)));
        const Mask<S> now = left & (candidate.form == form);
        store_whole(items, select(now, candidate.item, S(0)));
        const bool known = if_hot(world, static_cast<int>(lane(form, 0)), [&](const auto& group) {
            using Item = typename std::remove_cvref_t<decltype(group)>::template ItemOf<S>;
            pass_opaque_items(gather_items<Item, S>(group.items, items), own, now, distance, off, slack, light);
        });
        if (!known) light.doubt = light.doubt | now;
        left = left & !light.dark;
        at = select(now, candidate.next, at);
    }
    return active & !near;
}

}  // namespace strahl::inline STRAHL_LEVEL
