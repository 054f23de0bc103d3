// Powers, unit vectors and largest components, lane by lane.
#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <type_traits>

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

template <class S>
struct BitsOfDoubles {
    using Type [[gnu::vector_size(sizeof(S))]] = std::int64_t;
};
template <>
struct BitsOfDoubles<double> {
    using Type = std::int64_t;
};
/// Returns x^p for doubles, or more digits, up to some units of the last place: x is at least 2^-1000, and powers below
/// 2^-1000 become that. All packs and levels have the same bits, if they have fma.
template <class S>
STRAHL_INLINE S power_of_double(S x, S p) {
    if constexpr (!std::is_same_v<Element<S>, double>) {
        return std::pow(x, p);
    } else {
        using Bits = typename BitsOfDoubles<S>::Type;
        // The logarithm to base 2: the exponent, and 2 / ln 2 (f + f^3 / 3 + f^5 / 5 ...) of m = (1 + f) / (1 - f).
        constexpr auto odd = [] {
            std::array<double, 12> terms{};
            for (int k = 0; k < 12; ++k) terms[k] = 2 / (std::numbers::ln2 * (2 * k + 1));
            return terms;
        }();
        constexpr auto taylor = [] {  // of 2^r
            std::array<double, 14> terms{1};
            for (int k = 1; k < 14; ++k) terms[k] = terms[k - 1] * std::numbers::ln2 / k;
            return terms;
        }();
        const Bits whole = std::bit_cast<Bits>(x);
        const S exponent = std::bit_cast<S>((whole >> 52) | std::bit_cast<std::int64_t>(0x1p52)) - S(0x1p52 + 1023);
        const S mantissa = std::bit_cast<S>((whole & 0xfffffffffffff) | std::bit_cast<std::int64_t>(1.));
        const Mask<S> upper = mantissa > S(std::numbers::sqrt2);
        const S m = select(upper, S(.5) * mantissa, mantissa), f = (m - S(1)) / (m + S(1)), square = f * f;
        S sum(odd.back());
        for (std::size_t k = odd.size() - 1; k-- > 0;) sum = fma(sum, square, S(odd[k]));
        const S y = max(p * fma(f, sum, select(upper, exponent + S(1), exponent)), S(-1000));
        const S n = floor(y + S(.5)), r = y - n;
        S power(taylor.back());
        for (std::size_t k = taylor.size() - 1; k-- > 0;) power = fma(power, r, S(taylor[k]));
        return power * std::bit_cast<S>(std::bit_cast<Bits>(n + S(0x1.8p52 + 1023)) << 52);
    }
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
