// The SIMD and vector operations that kernels are written in. The same code runs on a scalar or on a pack of lanes.
//
// The type S is float, double, long double or Pack<T>. It has + - * /, comparisons that give Mask<S>, and the functions
// below. Fused multiply-adds are written out as fma(a, b, c) and the compiler may not fuse on its own, so that scalar,
// AVX2 and AVX-512 code give the same bits. x86-64-v2 has no fma and may differ in the last bits.
#pragma once
#include <cmath>
#include <type_traits>

#include "num/vec.h"

namespace strahl {

template <class S>
struct LaneTraits {
    using Element = S;
    using Mask = bool;
    static constexpr int width = 1;
};
template <class S>
using Element = typename LaneTraits<S>::Element;
template <class S>
using Mask = typename LaneTraits<S>::Mask;
template <class S>
inline constexpr int width = LaneTraits<S>::width;

template <class S>
concept Scalar = std::is_floating_point_v<S>;

#define STRAHL_INLINE [[gnu::always_inline]] inline

/// Returns a * b + c, rounded once; twice in long double, for which there is only a library function 100 times as slow.
template <Scalar S>
STRAHL_INLINE S fma(S a, S b, S c) {
    if constexpr (std::is_same_v<S, long double>) return a * b + c;
    return std::fma(a, b, c);
}
/// Is fma(a, b, c) rounded once?
template <class S>
inline constexpr bool fuses = !std::is_same_v<S, long double>;
template <Scalar S>
STRAHL_INLINE S sqrt(S a) {
    return std::sqrt(a);
}
template <Scalar S>
STRAHL_INLINE S abs(S a) {
    return std::fabs(a);
}
template <Scalar S>
STRAHL_INLINE S min(S a, S b) {
    return b < a ? b : a;
}
template <Scalar S>
STRAHL_INLINE S max(S a, S b) {
    return a < b ? b : a;
}
template <Scalar S>
STRAHL_INLINE S select(bool mask, S yes, S no) {
    return mask ? yes : no;
}
STRAHL_INLINE bool any(bool mask) { return mask; }
STRAHL_INLINE bool all(bool mask) { return mask; }
STRAHL_INLINE bool none(bool mask) { return !mask; }
// Masks, of scalars and of packs alike, combine with & | !.
template <class S>
STRAHL_INLINE S dot(const Vec3<S>& a, const Vec3<S>& b) {
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}
template <class S>
STRAHL_INLINE Vec3<S> cross(const Vec3<S>& a, const Vec3<S>& b) {
    return {fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)), fma(a.x, b.y, -(a.y * b.x))};
}
/// Returns a + s * b.
template <class S>
STRAHL_INLINE Vec3<S> fma(S s, const Vec3<S>& b, const Vec3<S>& a) {
    return {fma(s, b.x, a.x), fma(s, b.y, a.y), fma(s, b.z, a.z)};
}
template <class S>
STRAHL_INLINE Vec3<S> scale(S s, const Vec3<S>& v) {
    return {s * v.x, s * v.y, s * v.z};
}
template <class S>
STRAHL_INLINE Vec3<S> select(Mask<S> mask, const Vec3<S>& yes, const Vec3<S>& no) {
    return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}
/// Returns the vector in every lane.
template <class S, class T>
STRAHL_INLINE Vec3<S> splat(const Vec3<T>& v) {
    return {S(v.x), S(v.y), S(v.z)};
}

}  // namespace strahl
