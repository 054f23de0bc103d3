// Powers, unit vectors and largest components, lane by lane.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
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

/// Returns x^p for the same p in all lanes, which may be below 0: then it returns 1e9 at most.
template <class S>
STRAHL_INLINE S signed_power(const S& x, Element<S> p) {
    return p < 0 ? S(1) / max(power_of_uniform(x, -p), S(1e-9f)) : power_of_uniform(x, p);
}

/// Returns x^p, 0 for x <= 0.
template <class S>
STRAHL_INLINE S power_or_zero(const S& x, Element<S> p) {
    const Mask<S> some = x > S(0);
    if (none(some)) return S(0);
    return select(some, signed_power(select(some, min(x, S(1)), S(1)), p), S(0));
}

/// The type of the bits of S.
template <class S>
struct BitsOf {
    using Lane = std::conditional_t<sizeof(Element<S>) == 4, std::int32_t, std::int64_t>;
    using Type [[gnu::vector_size(sizeof(S))]] = Lane;
};
template <>
struct BitsOf<float> {
    using Lane = std::int32_t;
    using Type = Lane;
};
template <>
struct BitsOf<double> {
    using Lane = std::int64_t;
    using Type = Lane;
};
/// Returns c[0] + c[1] x + c[2] x^2 + ..., even and odd terms side by side.
template <std::size_t terms, class S>
STRAHL_INLINE S polynomial(const std::array<Element<S>, terms>& c, const S& x) {
    const S square = x * x;
    S last(c[terms - 1]), other(c[terms - 2]);
    for (std::size_t k = terms - 2; k-- > 0;) {
        const S next = fma(last, square, S(c[k]));
        last = other, other = next;
    }
    return fma(last, x, other);
}
/// Returns the logarithm to base 2 of x > 0: the exponent, and 2 / ln 2 (f + f^3 / 3 + f^5 / 5 ...) of
/// m = (1 + f) / (1 - f), with some of these terms.
template <int terms = 12, class S>
STRAHL_INLINE S log2_by_series(S x) {
    using R = Element<S>;
    if constexpr (std::is_same_v<R, long double>) {
        return std::log2(x);
    } else {
        using Bits = typename BitsOf<S>::Type;
        using Lane = typename BitsOf<S>::Lane;
        constexpr auto odd = [] {
            std::array<R, terms> all{};
            for (int k = 0; k < terms; ++k) all[k] = R(2 / (std::numbers::ln2 * (2 * k + 1)));
            return all;
        }();
        constexpr int digits = std::numeric_limits<R>::digits - 1;  // of the mantissa as it is stored
        constexpr R bias = std::numeric_limits<R>::max_exponent - 1, whole_unit = R(std::int64_t(1) << digits);
        const Bits whole = std::bit_cast<Bits>(x);
        const S exponent = std::bit_cast<S>((whole >> digits) | std::bit_cast<Lane>(whole_unit)) - S(whole_unit + bias);
        const S mantissa = std::bit_cast<S>((whole & ((Lane(1) << digits) - 1)) | std::bit_cast<Lane>(R(1)));
        const Mask<S> upper = mantissa > S(R(std::numbers::sqrt2));
        const S m = select(upper, S(R(.5)) * mantissa, mantissa), f = (m - S(1)) / (m + S(1)), square = f * f;
        const S sum = polynomial<terms>(odd, square);
        return fma(f, sum, select(upper, exponent + S(1), exponent));
    }
}
/// Returns x^p for x > 0: by default up to some units of a double's last place, with fewer terms of the two series for
/// fewer digits. The powers that are too small for normal numbers become the least of these, or somewhat more. All
/// packs and levels have the same bits, if they have fma.
template <int log_terms = 12, int power_terms = 14, class S>
STRAHL_INLINE S power_by_series(S x, S p) {
    using R = Element<S>;
    if constexpr (std::is_same_v<R, long double>) {
        return std::pow(x, p);
    } else {
        using Bits = typename BitsOf<S>::Type;
        constexpr auto taylor = [] {  // of 2^r
            std::array<R, power_terms> terms{};
            double term = 1;
            for (int k = 0; k < power_terms; ++k) terms[k] = R(term), term *= std::numbers::ln2 / (k + 1);
            return terms;
        }();
        constexpr int digits = std::numeric_limits<R>::digits - 1;  // of the mantissa as it is stored
        constexpr R bias = std::numeric_limits<R>::max_exponent - 1, whole_unit = R(std::int64_t(1) << digits);
        const S y = max(p * log2_by_series<log_terms>(x), S(std::max(R(-1000), 1 - bias)));
        const S n = floor(y + S(R(.5))), r = y - n;
        return polynomial<power_terms>(taylor, r) *
               std::bit_cast<S>(std::bit_cast<Bits>(n + S(R(1.5) * whole_unit + bias)) << digits);
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
