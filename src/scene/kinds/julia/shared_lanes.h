// The lanes of a pack, given to fewer rays than it has lanes: several to each.
#pragma once
#include <array>
#include <bit>

#include "num/memory.h"

namespace strahl {

/// Packs few rays: each gets `each` neighbouring lanes, and the number of the lane that it came from is kept.
template <class V>
struct SharedLanes {
    using R = Element<V>;
    int count = 0, each;
    std::array<int, width<V>> rays;
    V number{0};  // index of a lane among those of its ray

    STRAHL_INLINE explicit SharedLanes(unsigned mask) {
        for (; mask; mask &= mask - 1) rays[count++] = std::countr_zero(mask);
        each = width<V> / count;
        const V all = iota<V>();
        for (int i = 0; i < count; ++i) number = select(lanes(i), all - V(static_cast<R>(i * each)), number);
    }
    STRAHL_INLINE unsigned bits_of(unsigned mask, int i) const { return mask >> i * each & ((1u << each) - 1); }
    STRAHL_INLINE Mask<V> lanes(int i) const { return mask_of<V>(((1u << each) - 1) << i * each); }
    /// Returns the lanes of the rays whose bits are set.
    STRAHL_INLINE Mask<V> lanes_of(unsigned mask) const {
        unsigned all = 0;
        for (int i = 0; i < count; ++i) all |= (mask >> rays[i] & 1) * ((1u << each) - 1) << i * each;
        return mask_of<V>(all);
    }
    /// Returns the values of rays in all of their lanes.
    STRAHL_INLINE V of(const R* values) const {
        V all(0);
        for (int i = 0; i < count; ++i) all = select(lanes(i), V(values[rays[i]]), all);
        return all;
    }
    STRAHL_INLINE V of(const V& values) const {
        alignas(64) R stored[width<V>];
        store_lanes(stored, values);
        return of(stored);
    }
    STRAHL_INLINE Vec3<V> of(const Vec3<V>& v) const { return {of(v.x), of(v.y), of(v.z)}; }
};

}  // namespace strahl
