// Pruning: leaves out a pixel's weakest rays, as long as their light adds up to less than the error asked for.
#pragma once
#include <bit>

#include "trace/kernel/shading.h"

namespace strahl::inline STRAHL_LEVEL {

/// A contribution is pruned only if it is at most this share of what a pixel may still lack: later and weaker rays, of
/// which there are more, need some of that too.
inline constexpr float weak_share = .25f;

/// A contribution that may be pruned: an upper bound of its light, and the lanes that have it at all. prune() sets
/// `pruned`.
template <class S>
struct Contribution {
    S most;
    Mask<S> lanes, pruned;
    Element<S> share[width<S>], pruned_lanes[width<S>];
    STRAHL_INLINE Contribution(S light, Mask<S> mask) : most(light), lanes(mask), pruned(first_lanes<S>(0)) {}
};

/// Prunes contributions that are weak beside what the pixel may still lack, and adds them to what it lacks. One lane
/// after the other, so that what happens to a pixel depends on its own rays alone.
template <class S, class P, class... Contributions>
STRAHL_INLINE void prune(const Shading<S, P>& shading, const S& pixel, Contributions&... parts) {
    using T = Element<S>;
    const T error = shading.limits.error;
    if (error == 0) return;
    const auto weak = [&](const Contribution<S>& part) {
        return bits(part.lanes & (part.most <= S(weak_share * error)));
    };
    unsigned some = (weak(parts) | ...);
    if (some == 0) return;
    T pixels[width<S>];
    store_lanes(pixels, pixel);
    const auto lay_out = [&](Contribution<S>& part) {
        store_lanes(part.share, select(part.lanes, part.most, S(std::numeric_limits<T>::infinity())));
        store_lanes(part.pruned_lanes, S(0));
    };
    (lay_out(parts), ...);
    for (; some != 0; some &= some - 1) {
        const int k = std::countr_zero(some);
        T& lacking = shading.batch.sums[static_cast<int>(pixels[k])].pruned;
        const auto decide = [&](Contribution<S>& part) {
            if (part.share[k] <= weak_share * (error - lacking)) lacking += part.share[k], part.pruned_lanes[k] = 1;
        };
        (decide(parts), ...);
    }
    ((parts.pruned = load_lanes<S>(parts.pruned_lanes) > S(0)), ...);
}

/// Bounds the light that generations past the last could bring, and adds that to `PixelBatch::past`.
template <class S, class P>
STRAHL_INLINE void truncate(const Shading<S, P>& shading, const Hit<S>& hit) {
    using T = Element<S>;
    const S share = hit.material.reflection + hit.material.refraction;
    const Mask<S> more = hit.active & (hit.weight * share > S(0));
    if (none(more)) return;
    T pixels[width<S>], most[width<S>];
    store_lanes(pixels, hit.pixel), store_lanes(most, hit.weight * share * S(shading.limits.brightest_limit));
    for (unsigned left = bits(more); left != 0; left &= left - 1) {
        const int k = std::countr_zero(left);
        shading.batch.past[static_cast<int>(pixels[k])] += most[k];
    }
}

}  // namespace strahl::inline STRAHL_LEVEL
