// A number with a bound of its error: for short formulas, whose inputs are off independently of each other.
#pragma once
#include "num/lane_math.h"
#include "trace/proof/span_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// A computed number, which is off by at most `off` from the exact one. Operations add their rounding errors.
template <class S>
struct Bounded {
    static constexpr Element<S> half_unit = Element<S>(.51) * unit_error<S>;
    S value, off{0};

    /// Returns the result of an operation with this error before rounding.
    STRAHL_INLINE static Bounded rounded(const S& value, const S& off) {
        return {value, fma(S(half_unit), abs(value), off)};
    }
    STRAHL_INLINE friend Bounded operator+(const Bounded& a, const Bounded& b) {
        return rounded(a.value + b.value, a.off + b.off);
    }
    STRAHL_INLINE friend Bounded operator-(const Bounded& a, const Bounded& b) {
        return rounded(a.value - b.value, a.off + b.off);
    }
    STRAHL_INLINE friend Bounded operator*(const Bounded& a, const Bounded& b) {
        return rounded(a.value * b.value, fma(abs(a.value), b.off, a.off * (abs(b.value) + b.off)));
    }
    /// Division by what may be 0 has an infinite error.
    STRAHL_INLINE friend Bounded operator/(const Bounded& a, const Bounded& b) {
        const S quotient = a.value / b.value, least = abs(b.value) - b.off;
        const S off = fma(abs(quotient), b.off, a.off) / least;
        return rounded(quotient, select(least > S(0), off, S(std::numeric_limits<Element<S>>::infinity())));
    }
    /// The root of a number that is not below 0: sqrt(a) - sqrt(a - e) is at most e / sqrt(a) up to e = a.
    STRAHL_INLINE friend Bounded root(const Bounded& a) {
        const S x = max(a.value, S(0)), own = sqrt(x);
        return rounded(own, select(x > a.off, a.off / own, sqrt(x + a.off)));
    }
    STRAHL_INLINE friend Bounded least_of(const Bounded& a, const S& limit) { return {min(a.value, limit), a.off}; }
    STRAHL_INLINE friend Bounded most_of(const Bounded& a, const S& limit) { return {max(a.value, limit), a.off}; }
};

/// A power of what exact arithmetic has between 0 and 1, with an exponent above 0. It grows with its base, so it lies
/// between those of the base's bounds; powers have p roundings.
template <class S>
STRAHL_INLINE Bounded<S> power_bounds(const Bounded<S>& base, Element<S> p) {
    const auto at = [&](const S& x) { return power_or_zero(x, p); };
    const S value = at(base.value), high = at(base.value + base.off), low = at(base.value - base.off);
    return {value, max(high - value, value - low) + S(unit_error<S> * (p + 8)) * high};
}

}  // namespace strahl::inline STRAHL_LEVEL
