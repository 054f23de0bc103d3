// Pack: as many numbers as one SIMD register holds, with the words of lanes.h. This is the only file with intrinsics.
//
// It is compiled once per instruction set, inside an inline namespace named by STRAHL_LEVEL (v2, v3, v4), so that
// packs of different width are different types and never merge at link time. The wrapper around std::experimental::simd
// exists because numeric_limits must be specialised for vectors of packs, which std forbids for its own type, and
// because g++ 12 turns the standard's fma of 16 floats into scalar calls.
#pragma once
#include <immintrin.h>

#include <array>
#include <bit>
#include <cstring>
#include <experimental/simd>

#include "num/lanes.h"

namespace strahl::inline STRAHL_LEVEL {

template <class T>
struct PackMask {
    typename std::experimental::native_simd<T>::mask_type m;
    STRAHL_INLINE friend PackMask operator&(PackMask a, PackMask b) { return {a.m && b.m}; }
    STRAHL_INLINE friend PackMask operator|(PackMask a, PackMask b) { return {a.m || b.m}; }
    STRAHL_INLINE PackMask operator!() const { return {!m}; }
};

template <class T>
struct Pack {
    using Register = std::experimental::native_simd<T>;
    static constexpr int size = static_cast<int>(Register::size());
    Register v;

    Pack() = default;
    STRAHL_INLINE Pack(T x) : v(x) {}
    STRAHL_INLINE explicit Pack(Register r) : v(r) {}
    STRAHL_INLINE friend Pack operator+(Pack a, Pack b) { return Pack(a.v + b.v); }
    STRAHL_INLINE friend Pack operator-(Pack a, Pack b) { return Pack(a.v - b.v); }
    STRAHL_INLINE friend Pack operator*(Pack a, Pack b) { return Pack(a.v * b.v); }
    STRAHL_INLINE friend Pack operator/(Pack a, Pack b) { return Pack(a.v / b.v); }
    STRAHL_INLINE Pack operator-() const { return Pack(-v); }
    STRAHL_INLINE Pack& operator+=(Pack b) { return v += b.v, *this; }
    STRAHL_INLINE Pack& operator-=(Pack b) { return v -= b.v, *this; }
    STRAHL_INLINE Pack& operator*=(Pack b) { return v *= b.v, *this; }
    STRAHL_INLINE friend PackMask<T> operator<(Pack a, Pack b) { return {a.v < b.v}; }
    STRAHL_INLINE friend PackMask<T> operator<=(Pack a, Pack b) { return {a.v <= b.v}; }
    STRAHL_INLINE friend PackMask<T> operator>(Pack a, Pack b) { return {a.v > b.v}; }
    STRAHL_INLINE friend PackMask<T> operator>=(Pack a, Pack b) { return {a.v >= b.v}; }
    STRAHL_INLINE friend PackMask<T> operator==(Pack a, Pack b) { return {a.v == b.v}; }
};

}  // namespace strahl::inline STRAHL_LEVEL

namespace strahl {

// One register, one instruction.
STRAHL_INLINE __m128 minimum(__m128 a, __m128 b) { return _mm_min_ps(a, b); }
STRAHL_INLINE __m128d minimum(__m128d a, __m128d b) { return _mm_min_pd(a, b); }
STRAHL_INLINE __m128 maximum(__m128 a, __m128 b) { return _mm_max_ps(a, b); }
STRAHL_INLINE __m128d maximum(__m128d a, __m128d b) { return _mm_max_pd(a, b); }
#if defined(__FMA__)
STRAHL_INLINE __m256 minimum(__m256 a, __m256 b) { return _mm256_min_ps(a, b); }
STRAHL_INLINE __m256d minimum(__m256d a, __m256d b) { return _mm256_min_pd(a, b); }
STRAHL_INLINE __m256 maximum(__m256 a, __m256 b) { return _mm256_max_ps(a, b); }
STRAHL_INLINE __m256d maximum(__m256d a, __m256d b) { return _mm256_max_pd(a, b); }
STRAHL_INLINE __m256 fused(__m256 a, __m256 b, __m256 c) { return _mm256_fmadd_ps(a, b, c); }
STRAHL_INLINE __m256d fused(__m256d a, __m256d b, __m256d c) { return _mm256_fmadd_pd(a, b, c); }
#endif
#if defined(__AVX512F__)
STRAHL_INLINE __m512 minimum(__m512 a, __m512 b) { return _mm512_min_ps(a, b); }
STRAHL_INLINE __m512d minimum(__m512d a, __m512d b) { return _mm512_min_pd(a, b); }
STRAHL_INLINE __m512 maximum(__m512 a, __m512 b) { return _mm512_max_ps(a, b); }
STRAHL_INLINE __m512d maximum(__m512d a, __m512d b) { return _mm512_max_pd(a, b); }
STRAHL_INLINE __m512 fused(__m512 a, __m512 b, __m512 c) { return _mm512_fmadd_ps(a, b, c); }
STRAHL_INLINE __m512d fused(__m512d a, __m512d b, __m512d c) { return _mm512_fmadd_pd(a, b, c); }
STRAHL_INLINE __m512 chosen(unsigned mask, __m512 yes, __m512 no) {
    return _mm512_mask_mov_ps(no, static_cast<__mmask16>(mask), yes);
}
STRAHL_INLINE __m512d chosen(unsigned mask, __m512d yes, __m512d no) {
    return _mm512_mask_mov_pd(no, static_cast<__mmask8>(mask), yes);
}
STRAHL_INLINE float least_of(__m512 a) { return _mm512_reduce_min_ps(a); }
STRAHL_INLINE double least_of(__m512d a) { return _mm512_reduce_min_pd(a); }
#endif
template <class T>
STRAHL_INLINE auto raw(Pack<T> a) {
    constexpr int bytes = sizeof(Pack<T>);
    if constexpr (std::is_same_v<T, float>) {
        if constexpr (bytes == 16)
            return static_cast<__m128>(a.v);
        else if constexpr (bytes == 32)
            return static_cast<__m256>(a.v);
        else
            return static_cast<__m512>(a.v);
    } else {
        if constexpr (bytes == 16)
            return static_cast<__m128d>(a.v);
        else if constexpr (bytes == 32)
            return static_cast<__m256d>(a.v);
        else
            return static_cast<__m512d>(a.v);
    }
}

template <class T>
STRAHL_INLINE Pack<T> fma(Pack<T> a, Pack<T> b, Pack<T> c) {
#if defined(__FMA__)
    return Pack<T>(typename Pack<T>::Register(fused(raw(a), raw(b), raw(c))));
#else
    return a * b + c;
#endif
}
template <class T>
STRAHL_INLINE Pack<T> sqrt(Pack<T> a) {
    return Pack<T>(std::experimental::sqrt(a.v));
}
/// Bit i is lane i.
template <class T>
STRAHL_INLINE unsigned bits(PackMask<T> mask) {
    return static_cast<unsigned>(mask.m.__to_bitset().to_ulong());
}
template <class T>
STRAHL_INLINE Pack<T> select(PackMask<T> mask, Pack<T> yes, Pack<T> no) {
#if defined(__AVX512F__)  // the standard's way keeps g++ 12 from putting it into the instruction before
    return Pack<T>(typename Pack<T>::Register(chosen(bits(mask), raw(yes), raw(no))));
#else
    std::experimental::where(mask.m, no.v) = yes.v;
    return no;
#endif
}
template <class T>
STRAHL_INLINE Pack<T> abs(Pack<T> a) {
    return Pack<T>(std::experimental::abs(a.v));
}
// In NaN and signed zeros the instructions' answer is their second operand: as in the scalar functions.
template <class T>
STRAHL_INLINE Pack<T> min(Pack<T> a, Pack<T> b) {
    return Pack<T>(typename Pack<T>::Register(minimum(raw(b), raw(a))));
}
template <class T>
STRAHL_INLINE Pack<T> max(Pack<T> a, Pack<T> b) {
    return Pack<T>(typename Pack<T>::Register(maximum(raw(b), raw(a))));
}
template <class T>
STRAHL_INLINE Pack<T> floor(Pack<T> a) {
    return Pack<T>(std::experimental::floor(a.v));
}
template <class T>
STRAHL_INLINE bool any(PackMask<T> mask) {
    return std::experimental::any_of(mask.m);
}
template <class T>
STRAHL_INLINE bool all(PackMask<T> mask) {
    return std::experimental::all_of(mask.m);
}
template <class T>
STRAHL_INLINE bool none(PackMask<T> mask) {
    return std::experimental::none_of(mask.m);
}
template <class T>
STRAHL_INLINE int count(PackMask<T> mask) {
    return std::experimental::popcount(mask.m);
}
/// The lowest lane that is set; the mask must not be empty.
template <class T>
STRAHL_INLINE int first(PackMask<T> mask) {
    return std::experimental::find_first_set(mask.m);
}
template <class T>
STRAHL_INLINE T lane(const Pack<T>& a, int i) {  // from where it lies: no copy of all lanes for the sake of one
    T value;
    std::memcpy(&value, reinterpret_cast<const char*>(&a) + i * sizeof(T), sizeof(T));
    return value;
}
template <class T>
STRAHL_INLINE Pack<T> with_lane(Pack<T> a, int i, T value) {  // a whole pack read after one lane was written waits
    const Pack<T> numbers{typename Pack<T>::Register([](auto n) { return static_cast<T>(n); })};
    return select(numbers == Pack<T>(static_cast<T>(i)), Pack<T>(value), a);
}
/// The smallest of the lanes.
template <class T>
STRAHL_INLINE T least(Pack<T> a) {
#if defined(__AVX512F__)
    return least_of(raw(a));
#else
    return std::experimental::hmin(a.v);
#endif
}
template <class T>
STRAHL_INLINE void compress(T* to, Pack<T> value, PackMask<T> mask) {
    constexpr int n = Pack<T>::size;
#if defined(__AVX512F__)
    // Compressing in the register and storing whole: vcompress to memory is slow microcode on some processors.
    if constexpr (std::is_same_v<T, float> && n == 16) {
        return _mm512_storeu_ps(to, _mm512_maskz_compress_ps(static_cast<__mmask16>(bits(mask)), raw(value)));
    } else if constexpr (std::is_same_v<T, double> && n == 8) {
        return _mm512_storeu_pd(to, _mm512_maskz_compress_pd(static_cast<__mmask8>(bits(mask)), raw(value)));
    }
#endif
    for (int i = 0; i < n; ++i) {
        *to = value.v[i];
        to += mask.m[i];
    }
}

/// (x, y, z, 0) of lane k from 4 * interleaved(k) on: then one addition serves all three.
template <class T>
inline constexpr bool interleaves =
#if defined(__AVX512F__)
    std::is_same_v<T, float>&& Pack<T>::size == 16;
#else
    false;
#endif
constexpr int interleaved(int k) { return 4 * (k % 4) + k / 4; }
#if defined(__AVX512F__)
STRAHL_INLINE void interleave(float* to, Pack<float> x, Pack<float> y, Pack<float> z) {
    const __m512 none = _mm512_setzero_ps();
    const __m512d low_xy = _mm512_castps_pd(_mm512_unpacklo_ps(raw(x), raw(y)));
    const __m512d high_xy = _mm512_castps_pd(_mm512_unpackhi_ps(raw(x), raw(y)));
    const __m512d low_z = _mm512_castps_pd(_mm512_unpacklo_ps(raw(z), none));
    const __m512d high_z = _mm512_castps_pd(_mm512_unpackhi_ps(raw(z), none));
    _mm512_store_ps(to, _mm512_castpd_ps(_mm512_unpacklo_pd(low_xy, low_z)));
    _mm512_store_ps(to + 16, _mm512_castpd_ps(_mm512_unpackhi_pd(low_xy, low_z)));
    _mm512_store_ps(to + 32, _mm512_castpd_ps(_mm512_unpacklo_pd(high_xy, high_z)));
    _mm512_store_ps(to + 48, _mm512_castpd_ps(_mm512_unpackhi_pd(high_xy, high_z)));
}
STRAHL_INLINE void add_four(float* to, const float* from) {
    _mm_storeu_ps(to, _mm_add_ps(_mm_loadu_ps(to), _mm_load_ps(from)));
}
#endif

template <class T>
struct LaneTraits<Pack<T>> {
    using Element = T;
    using Mask = PackMask<T>;
    static constexpr int width = Pack<T>::size;
};

}  // namespace strahl

template <class T>
struct std::numeric_limits<strahl::Pack<T>> : std::numeric_limits<T> {};
