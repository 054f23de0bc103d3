// Quadruple: numbers of 113 bits, to judge by. On aarch64 that is long double; on x86-64 a type of g++'s, for which the
// C library's <math.h> has functions. From g++ 13 on these take _Float128, a type of its own with the same values.
#pragma once
#include <cfloat>
#include <cmath>
#include <concepts>

namespace strahl {

#if LDBL_MANT_DIG < 113
using Quadruple = __float128;
inline Quadruple root(Quadruple a) { return sqrtf128(a); }
inline Quadruple power(Quadruple a, Quadruple b) { return powf128(a, b); }
inline Quadruple exponential(Quadruple a) { return expf128(a); }
inline Quadruple sine_of(Quadruple a) { return sinf128(a); }
inline Quadruple angle_of(Quadruple x, Quadruple y) { return atan2f128(y, x); }
#else
using Quadruple = long double;
#endif
template <std::floating_point R>
R root(R a) {
    return std::sqrt(a);
}
template <std::floating_point R>
R power(R a, R b) {
    return std::pow(a, b);
}
template <std::floating_point R>
R exponential(R a) {
    return std::exp(a);
}
template <std::floating_point R>
R sine_of(R a) {
    return std::sin(a);
}
/// Returns the angle of (x, y) from the x axis.
template <std::floating_point R>
R angle_of(R x, R y) {
    return std::atan2(y, x);
}

}  // namespace strahl
