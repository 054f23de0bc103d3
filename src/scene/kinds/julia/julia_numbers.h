// Steps of the iterations whose Julia sets are bodies: numbers of four parts, which are multiplied in one of two ways.
#pragma once
#include <array>
#include <cmath>
#include <string_view>

#include "num/lanes.h"
#include "num/memory.h"

namespace strahl {

/// What is done to a number in each step, before a constant is added.
enum class JuliaStep {
    square,
    cube,
    reciprocal,
    exp,
    ln,
    sin,
    asin,
    cos,
    acos,
    tan,
    atan,
    sinh,
    asinh,
    cosh,
    acosh,
    tanh,
    atanh,
    power
};
/// The words for these, as in POV-Ray.
inline constexpr std::array<std::string_view, 18> julia_words{"sqr",   "cube", "reciprocal", "exp",  "ln",    "sin",
                                                              "asin",  "cos",  "acos",       "tan",  "atan",  "sinh",
                                                              "asinh", "cosh", "acosh",      "tanh", "atanh", "pwr"};

/// A number of four parts.
template <class V>
struct FourParts {
    V x, y, z, w;

    STRAHL_INLINE friend FourParts operator+(const FourParts& a, const FourParts& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
    }
    /// Returns the product of quaternions.
    STRAHL_INLINE FourParts times(const FourParts& b) const {
        return {x * b.x - y * b.y - z * b.z - w * b.w, x * b.y + y * b.x + w * b.z - z * b.w,
                x * b.z + z * b.x + y * b.w - w * b.y, x * b.w + w * b.x + z * b.y - y * b.z};
    }
    /// Returns the product of hypercomplex numbers, in which the order does not matter.
    STRAHL_INLINE FourParts by(const FourParts& b) const {
        return {x * b.x - y * b.y - z * b.z + w * b.w, y * b.x + x * b.y - w * b.z - z * b.w,
                z * b.x - w * b.y + x * b.z - y * b.w, w * b.x + z * b.y + y * b.z + x * b.w};
    }
};
template <class V>
STRAHL_INLINE FourParts<V> select(Mask<V> mask, const FourParts<V>& yes, const FourParts<V>& no) {
    return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z), select(mask, yes.w, no.w)};
}

}  // namespace strahl

namespace strahl::inline STRAHL_LEVEL {

/// A complex number, whose operations round as POV-Ray's do.
template <class R>
struct TwoParts {
    R x, y;

    friend TwoParts operator+(const TwoParts& a, const TwoParts& b) { return {a.x + b.x, a.y + b.y}; }
    friend TwoParts operator-(const TwoParts& a, const TwoParts& b) { return {a.x - b.x, a.y - b.y}; }
    friend TwoParts operator*(const TwoParts& a, const TwoParts& b) {
        return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
    }
    friend TwoParts operator/(const TwoParts& a, const TwoParts& b) {
        const R square = b.x * b.x + b.y * b.y;
        return a * TwoParts{b.x / square, -b.y / square};
    }
    /// Returns it times -i.
    TwoParts turned() const { return {y, -x}; }
};
template <class R>
TwoParts<R> complex_log(const TwoParts<R>& a) {
    return {std::log(std::sqrt(a.x * a.x + a.y * a.y)), std::atan2(a.y, a.x)};
}
template <class R>
TwoParts<R> complex_root(const TwoParts<R>& a) {
    if (a.x == 0 && a.y == 0) return {0, 0};
    const R size = std::sqrt(std::sqrt(a.x * a.x + a.y * a.y)), angle = std::atan2(a.y, a.x) / 2;
    return {size * std::cos(angle), size * std::sin(angle)};
}
template <class R>
TwoParts<R> complex_atanh(const TwoParts<R>& a) {
    if (a.x == 0) return {0, std::atan(a.y)};
    if (std::fabs(a.x) == 1 && a.y == 0) return a;
    if (std::fabs(a.x) < 1 && a.y == 0) return {std::log((1 + a.x) / (1 - a.x)) / 2, 0};
    const TwoParts<R> own = complex_log(TwoParts<R>{1 + a.x, a.y} / TwoParts<R>{1 - a.x, -a.y});
    return {R(.5) * own.x, R(.5) * own.y};
}

/// Returns a function of a complex number, by the branches that POV-Ray has.
template <class R>
TwoParts<R> julia_function(JuliaStep step, const TwoParts<R>& z, const TwoParts<R>& exponent) {
    const auto& [x, y] = z;
    const TwoParts<R> one{1, 0};
    switch (step) {
        case JuliaStep::exp:
            return {std::exp(x) * std::cos(y), std::exp(x) * std::sin(y)};
        case JuliaStep::ln:
            return complex_log(z);
        case JuliaStep::sin:
            return {std::sin(x) * std::cosh(y), std::cos(x) * std::sinh(y)};
        case JuliaStep::cos:
            return {std::cos(x) * std::cosh(y), -std::sin(x) * std::sinh(y)};
        case JuliaStep::sinh:
            return {std::sinh(x) * std::cos(y), std::cosh(x) * std::sin(y)};
        case JuliaStep::cosh:
            return {std::cosh(x) * std::cos(y), std::sinh(x) * std::sin(y)};
        case JuliaStep::tan: {
            const R below = std::cos(2 * x) + std::cosh(2 * y);
            return {std::sin(2 * x) / below, std::sinh(2 * y) / below};
        }
        case JuliaStep::tanh: {
            const R below = std::cosh(2 * x) + std::cos(2 * y);
            return {std::sinh(2 * x) / below, std::sin(2 * y) / below};
        }
        case JuliaStep::asin:
            return complex_log(complex_root(one - z * z) + TwoParts<R>{-y, x}).turned();
        case JuliaStep::acos:
            return complex_log(complex_root(z * z - one) + z).turned();
        case JuliaStep::asinh:
            return complex_log(complex_root(z * z + one) + z);
        case JuliaStep::acosh:
            return complex_log(complex_root(z * z - one) + z);
        case JuliaStep::atanh:
            return complex_atanh(z);
        case JuliaStep::atan: {
            if (x == 0 && y == 0) return z;
            if (y == 0) return {std::atan(x), 0};
            if (x == 0) {
                const TwoParts<R> own = complex_atanh(TwoParts<R>{y, 0});
                return {-own.y, own.x};
            }
            const TwoParts<R> own = complex_log(TwoParts<R>{1 + y, -x} / TwoParts<R>{1 - y, x});
            return {own.y * R(-.5), own.x * R(.5)};
        }
        default: {
            if (x == 0 && y == 0) return z;
            const TwoParts<R> own = complex_log(z) * exponent;
            const R size = own.x < -690 ? R(0) : std::exp(own.x);
            return {size * std::cos(own.y), size * std::sin(own.y)};
        }
    }
}

}  // namespace strahl::inline STRAHL_LEVEL
