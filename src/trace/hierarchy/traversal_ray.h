// Rays in the form that is tested against boxes of the hierarchy: one, a pack, or several packs together. They are
// rounded outwards where boxes have fewer bits.
#pragma once
#include <cstdint>
#include <limits>
#include <type_traits>

#include "num/memory.h"
#include "num/ray.h"

namespace strahl::inline STRAHL_LEVEL {

/// The lanes that hold boxes. Rays in double, rounded outwards, are tested in float: twice as many boxes at a time.
template <class S>
struct BoxLanes {
    using Type = S;
};
template <>
struct BoxLanes<Pack<double>> {
    using Type = Pack<float>;
};
template <class S>
using ForBoxes = typename BoxLanes<S>::Type;

/// Converts x to F; if that has fewer bits than T, rounds away from 0 if `up`, else towards 0.
template <class F, class T>
STRAHL_INLINE F rounded(T x, bool up) {
    if constexpr (std::is_same_v<F, T>) return x;
    constexpr F unit = std::numeric_limits<F>::epsilon();
    return static_cast<F>(x) * (up ? 1 + unit : 1 - unit);
}

/// A ray to be tested against boxes, with finite reciprocals of its direction.
template <class S>
struct TraversalRay {
    Vec3<S> origin, inverse;
    STRAHL_INLINE const S& low(int i) const { return origin[i]; }
    STRAHL_INLINE const S& high(int i) const { return origin[i]; }
};
/// A ray whose origin is only known to be between two places.
template <class F>
struct RoundedTraversalRay {
    Vec3<F> origin_low, origin_high, inverse;
    STRAHL_INLINE const F& low(int i) const { return origin_low[i]; }
    STRAHL_INLINE const F& high(int i) const { return origin_high[i]; }
};
template <class S>
STRAHL_INLINE TraversalRay<S> traversal_ray(const Ray<S>& ray) {
    using T = Element<S>;
    constexpr T tiny = T(1) / (T(1) * (std::uint64_t(1) << 60));
    const auto reciprocal = [](S d) { return S(1) / select(abs(d) < S(tiny), select(d < S(0), S(-tiny), S(tiny)), d); };
    return {ray.origin, {reciprocal(ray.direction.x), reciprocal(ray.direction.y), reciprocal(ray.direction.z)}};
}
/// Coordinates from `farthest` on are replaced by the interval from -anywhere to anywhere, so that no float overflows.
inline constexpr double farthest = 1e18, anywhere = 1e19;

/// Returns ray k of the pack in all lanes, rounded outwards where boxes have fewer bits.
template <class S>
STRAHL_INLINE RoundedTraversalRay<ForBoxes<S>> lane_of(const RoundedTraversalRay<S>& ray, int k) {
    using F = ForBoxes<S>;
    using E = Element<F>;
    RoundedTraversalRay<F> result;
    for (int i = 0; i < 3; ++i) {
        const Element<S> low = lane(ray.origin_low[i], k), high = lane(ray.origin_high[i], k);
        const bool near = low > -farthest && high < farthest;
        result.origin_low[i] = F(near ? rounded<E>(low, low < 0) : E(-anywhere));
        result.origin_high[i] = F(near ? rounded<E>(high, high > 0) : E(anywhere));
        result.inverse[i] = F(near ? static_cast<E>(lane(ray.inverse[i], k)) : E(1));
    }
    return result;
}
template <class S>
STRAHL_INLINE auto lane_of(const TraversalRay<S>& ray, int k) {
    if constexpr (std::is_same_v<ForBoxes<S>, S>) {
        const auto pick = [k](const Vec3<S>& v) { return Vec3<S>(S(lane(v.x, k)), S(lane(v.y, k)), S(lane(v.z, k))); };
        return TraversalRay<S>{pick(ray.origin), pick(ray.inverse)};
    } else {
        return lane_of(RoundedTraversalRay<S>{ray.origin, ray.origin, ray.inverse}, k);
    }
}

/// The number of packs that are traversed together: they have as many rays as there are lanes for boxes.
template <class S>
inline constexpr int together = width<ForBoxes<S>> / width<S>;
/// Returns the lanes of the packs, one pack after the other, as lanes for boxes.
template <class S>
STRAHL_INLINE ForBoxes<S> join(const S (&packs)[together<S>]) {
    if constexpr (together<S> == 1) return packs[0];
    alignas(64) Element<S> lanes[width<ForBoxes<S>>];
    for (int h = 0; h < together<S>; ++h) store_lanes(lanes + h * width<S>, packs[h]);
    return load_converted<ForBoxes<S>>(lanes);
}
template <class S>
STRAHL_INLINE Mask<ForBoxes<S>> join_masks(const Mask<S> (&packs)[together<S>]) {
    if constexpr (together<S> == 1) return packs[0];
    unsigned all = 0;
    for (int h = 0; h < together<S>; ++h) all |= bits(packs[h]) << h * width<S>;
    return mask_of<ForBoxes<S>>(all);
}
/// Returns the lanes of pack h among those of packs that go together.
template <class S>
STRAHL_INLINE Mask<S> pack_of(Mask<ForBoxes<S>> mask, int h) {
    if constexpr (together<S> == 1)
        return mask;
    else
        return mask_of<S>(bits(mask) >> h * width<S>);
}
/// Returns the rays of several packs as one, rounded outwards if boxes have fewer bits.
template <class S>
STRAHL_INLINE auto traversal_ray(const Ray<S> (&rays)[together<S>]) {
    using F = ForBoxes<S>;
    if constexpr (together<S> == 1) {
        return traversal_ray(rays[0]);
    } else {
        constexpr auto unit = std::numeric_limits<Element<F>>::epsilon();
        const F up(1 + unit), down(1 - unit);
        RoundedTraversalRay<F> result;
        TraversalRay<S> lines[together<S>];
        for (int h = 0; h < together<S>; ++h) lines[h] = traversal_ray(rays[h]);
        for (int i = 0; i < 3; ++i) {
            S origins[together<S>], inverses[together<S>];
            Mask<S> nears[together<S>];
            for (int h = 0; h < together<S>; ++h) {
                nears[h] = abs(lines[h].origin[i]) < S(farthest);
                origins[h] = select(nears[h], lines[h].origin[i], S(0));
                inverses[h] = select(nears[h], lines[h].inverse[i], S(1));
            }
            const F origin = join(origins);
            const Mask<F> negative = origin < F(0), near = join_masks<S>(nears);
            result.origin_low[i] = select(near, origin * select(negative, up, down), F(-anywhere));
            result.origin_high[i] = select(near, origin * select(negative, down, up), F(anywhere));
            result.inverse[i] = join(inverses);
        }
        return result;
    }
}

}  // namespace strahl::inline STRAHL_LEVEL
