// Powers, unit vectors and largest components, lane by lane.
#pragma once
#include <cmath>

#include "num/memory.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns x^p for x > 0, p >= 0. Whole p, as in most scenes, is computed by squaring: the same bits on every machine.
template <class S>
STRAHL_INLINE S power(S x, S p) {
    using T = Element<S>;
    const Mask<S> whole = (floor(p) == p) & (p <= S(1024));
    S result(1), base = x, e = select(whole, p, S(0));
    while (any(e > S(0))) {
        const S half = floor(e * S(T(.5)));
        result = select(half + half < e, result * base, result);
        base *= base;
        e = half;
    }
    if (!all(whole)) {
        T bases[width<S>], exponents[width<S>];
        store_lanes(bases, x), store_lanes(exponents, p);
        for (int i = 0; i < width<S>; ++i) bases[i] = std::pow(bases[i], exponents[i]);
        result = select(whole, result, load_lanes<S>(bases));
    }
    return result;
}

/// Returns x^p for an exponent that all lanes share.
template <class S>
STRAHL_INLINE S power_of_uniform(S x, Element<S> p) {
    if (!(std::floor(p) == p && p <= 1024)) return power(x, S(p));
    S result(1);
    for (int e = static_cast<int>(p); e > 0; e >>= 1) {
        if (e & 1) result *= x;
        x *= x;
    }
    return result;
}

/// Renormalises vectors whose lengths are 1 but for rounding: one step of Newton's method for 1 / sqrt(v.v).
template <class S>
STRAHL_INLINE Vec3<S> unit(const Vec3<S>& v) {
    using T = Element<S>;
    return scale(fma(S(T(-.5)), dot(v, v), S(T(1.5))), v);
}

template <class T>
STRAHL_INLINE T largest(const Vec3<T>& v) {
    return max(v.x, max(v.y, v.z));
}

}  // namespace strahl::inline STRAHL_LEVEL
