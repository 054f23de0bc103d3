// Steps of the iterations whose Julia sets are bodies, and functions of complex numbers that some of these take.
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

/// How many steps are taken at most.
inline constexpr int most_julia_steps = 1000;

/// A number of four parts.
template <class V>
struct FourParts {
    V x, y, z, w;
};

/// A complex number.
template <class V>
struct TwoParts {
    V x, y;

    STRAHL_INLINE friend TwoParts operator+(const TwoParts& a, const TwoParts& b) { return {a.x + b.x, a.y + b.y}; }
    STRAHL_INLINE friend TwoParts operator-(const TwoParts& a, const TwoParts& b) { return {a.x - b.x, a.y - b.y}; }
    STRAHL_INLINE friend TwoParts operator*(const TwoParts& a, const TwoParts& b) {
        return {fma(a.x, b.x, -(a.y * b.y)), fma(a.x, b.y, a.y * b.x)};
    }
    STRAHL_INLINE friend TwoParts operator/(const TwoParts& a, const TwoParts& b) { return a * b.reciprocal(); }
    STRAHL_INLINE V square_of_size() const { return fma(x, x, y * y); }
    STRAHL_INLINE TwoParts conjugate() const { return {x, -y}; }
    STRAHL_INLINE TwoParts reciprocal() const {
        const V per = V(1) / square_of_size();
        return {per * x, -(per * y)};
    }
    STRAHL_INLINE TwoParts where(Mask<V> lanes, const TwoParts& other) const {
        return {select(lanes, x, other.x), select(lanes, y, other.y)};
    }
    /// Returns it times -i.
    STRAHL_INLINE TwoParts turned() const { return {y, -x}; }
};

}  // namespace strahl

namespace strahl::inline STRAHL_LEVEL {

/// Returns the number of this size and angle.
template <class R>
TwoParts<R> turned_by(R size, R angle) {
    return {size * std::cos(angle), size * std::sin(angle)};
}
template <class R>
TwoParts<R> complex_log(const TwoParts<R>& a) {
    return {std::log(std::sqrt(a.square_of_size())), std::atan2(a.y, a.x)};
}
template <class R>
TwoParts<R> complex_root(const TwoParts<R>& a) {
    if (a.x == 0 && a.y == 0) return {0, 0};
    return turned_by(std::sqrt(std::sqrt(a.square_of_size())), std::atan2(a.y, a.x) / 2);
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
            return turned_by(std::exp(x), y);
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
            return turned_by(own.x < -690 ? R(0) : std::exp(own.x), own.y);
        }
    }
}

}  // namespace strahl::inline STRAHL_LEVEL
