// The instructions of x86-64 that Pack uses: SSE2, AVX with FMA, AVX-512. Only pack.h includes this.
#pragma once
#include <immintrin.h>

#include "num/quad.h"

namespace strahl::inline STRAHL_LEVEL {

#if defined(__AVX512F__)
inline constexpr int register_bytes = 64;
#elif defined(__FMA__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif
inline constexpr bool has_fma = register_bytes > 16, has_fours = has_fma, has_mask_registers = register_bytes == 64;

}  // namespace strahl::inline STRAHL_LEVEL

namespace strahl {

/// The processor's type for a register: __m128, __m256d and so on.
template <class T, int bytes>
struct Native {
    using Register [[gnu::vector_size(bytes)]] = T;
};

// Each function is one instruction on one register, but least_of(). minimum() and maximum() of four floats are in
// quad.h. Masks have all bits of a lane or none.
STRAHL_INLINE __m128d minimum(__m128d a, __m128d b) { return _mm_min_pd(a, b); }
STRAHL_INLINE __m128d maximum(__m128d a, __m128d b) { return _mm_max_pd(a, b); }
STRAHL_INLINE __m128 root(__m128 a) { return _mm_sqrt_ps(a); }
STRAHL_INLINE __m128d root(__m128d a) { return _mm_sqrt_pd(a); }
STRAHL_INLINE __m128 absolute(__m128 a) { return _mm_andnot_ps(_mm_set1_ps(-0.f), a); }
STRAHL_INLINE __m128d absolute(__m128d a) { return _mm_andnot_pd(_mm_set1_pd(-0.), a); }
STRAHL_INLINE unsigned mask_bits(__m128 mask) { return static_cast<unsigned>(_mm_movemask_ps(mask)); }
STRAHL_INLINE unsigned mask_bits(__m128d mask) { return static_cast<unsigned>(_mm_movemask_pd(mask)); }
/// Loads floats as doubles. g++ 12 would take a second instruction.
STRAHL_INLINE void widen(__m128d* to, const float* from) { *to = _mm_cvtps_pd(_mm_castsi128_ps(_mm_loadu_si64(from))); }
STRAHL_INLINE float least_of(__m128 a) {
    a = _mm_min_ps(a, _mm_shuffle_ps(a, a, 0b00'01'10'11));
    return _mm_cvtss_f32(_mm_min_ss(a, _mm_movehl_ps(a, a)));
}
STRAHL_INLINE double least_of(__m128d a) { return _mm_cvtsd_f64(_mm_min_sd(a, _mm_unpackhi_pd(a, a))); }
#if defined(__SSE4_1__)
STRAHL_INLINE __m128 rounded_down(__m128 a) { return _mm_floor_ps(a); }
STRAHL_INLINE __m128d rounded_down(__m128d a) { return _mm_floor_pd(a); }
STRAHL_INLINE __m128 chosen(__m128 mask, __m128 yes, __m128 no) { return _mm_blendv_ps(no, yes, mask); }
STRAHL_INLINE __m128d chosen(__m128d mask, __m128d yes, __m128d no) { return _mm_blendv_pd(no, yes, mask); }
#endif
#if defined(__FMA__)
STRAHL_INLINE __m256 minimum(__m256 a, __m256 b) { return _mm256_min_ps(a, b); }
STRAHL_INLINE __m256d minimum(__m256d a, __m256d b) { return _mm256_min_pd(a, b); }
STRAHL_INLINE __m256 maximum(__m256 a, __m256 b) { return _mm256_max_ps(a, b); }
STRAHL_INLINE __m256d maximum(__m256d a, __m256d b) { return _mm256_max_pd(a, b); }
STRAHL_INLINE __m256 fused(__m256 a, __m256 b, __m256 c) { return _mm256_fmadd_ps(a, b, c); }
STRAHL_INLINE __m256d fused(__m256d a, __m256d b, __m256d c) { return _mm256_fmadd_pd(a, b, c); }
STRAHL_INLINE __m256 root(__m256 a) { return _mm256_sqrt_ps(a); }
STRAHL_INLINE __m256d root(__m256d a) { return _mm256_sqrt_pd(a); }
STRAHL_INLINE __m256 absolute(__m256 a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.f), a); }
STRAHL_INLINE __m256d absolute(__m256d a) { return _mm256_andnot_pd(_mm256_set1_pd(-0.), a); }
STRAHL_INLINE __m256 rounded_down(__m256 a) { return _mm256_floor_ps(a); }
STRAHL_INLINE __m256d rounded_down(__m256d a) { return _mm256_floor_pd(a); }
STRAHL_INLINE unsigned mask_bits(__m256 mask) { return static_cast<unsigned>(_mm256_movemask_ps(mask)); }
STRAHL_INLINE unsigned mask_bits(__m256d mask) { return static_cast<unsigned>(_mm256_movemask_pd(mask)); }
STRAHL_INLINE __m256 chosen(__m256 mask, __m256 yes, __m256 no) { return _mm256_blendv_ps(no, yes, mask); }
STRAHL_INLINE __m256d chosen(__m256d mask, __m256d yes, __m256d no) { return _mm256_blendv_pd(no, yes, mask); }
STRAHL_INLINE void widen(__m256d* to, const float* from) { *to = _mm256_cvtps_pd(_mm_loadu_ps(from)); }
STRAHL_INLINE float least_of(__m256 a) {
    return least_of(_mm_min_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1)));
}
STRAHL_INLINE double least_of(__m256d a) {
    return least_of(_mm_min_pd(_mm256_castpd256_pd128(a), _mm256_extractf128_pd(a, 1)));
}

// Store whole numbers, for addresses. If g++ knew what is in memory, it would extract the lanes one by one.
STRAHL_INLINE void store_whole(int* to, __m256 numbers) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_cvttps_epi32(numbers));
    asm("" : "+m"(*reinterpret_cast<int(*)[8]>(to)));
}
STRAHL_INLINE void store_whole(int* to, __m256d numbers) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm256_cvttpd_epi32(numbers));
    asm("" : "+m"(*reinterpret_cast<int(*)[4]>(to)));
}

/// Loads four numbers from each of 8 places: lane k of to[f] is the one at from[k] + f.
STRAHL_INLINE void load_fours(const float* const* from, __m256* to) {
    const auto row = [from](int j) __attribute__((always_inline)) {
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(from[j])), _mm_loadu_ps(from[4 + j]), 1);
    };
    const __m256 a = row(0), b = row(1), c = row(2), d = row(3);
    const __m256d low_ab = _mm256_castps_pd(_mm256_unpacklo_ps(a, b));
    const __m256d high_ab = _mm256_castps_pd(_mm256_unpackhi_ps(a, b));
    const __m256d low_cd = _mm256_castps_pd(_mm256_unpacklo_ps(c, d));
    const __m256d high_cd = _mm256_castps_pd(_mm256_unpackhi_ps(c, d));
    to[0] = _mm256_castpd_ps(_mm256_unpacklo_pd(low_ab, low_cd));
    to[1] = _mm256_castpd_ps(_mm256_unpackhi_pd(low_ab, low_cd));
    to[2] = _mm256_castpd_ps(_mm256_unpacklo_pd(high_ab, high_cd));
    to[3] = _mm256_castpd_ps(_mm256_unpackhi_pd(high_ab, high_cd));
}
/// Loads four numbers from each of 4 places.
STRAHL_INLINE void load_fours(const double* const* from, __m256d* to) {
    const __m256d a = _mm256_loadu_pd(from[0]), b = _mm256_loadu_pd(from[1]);
    const __m256d c = _mm256_loadu_pd(from[2]), d = _mm256_loadu_pd(from[3]);
    const __m256d even_ab = _mm256_unpacklo_pd(a, b), even_cd = _mm256_unpacklo_pd(c, d);
    const __m256d odd_ab = _mm256_unpackhi_pd(a, b), odd_cd = _mm256_unpackhi_pd(c, d);
    to[0] = _mm256_permute2f128_pd(even_ab, even_cd, 0x20);
    to[1] = _mm256_permute2f128_pd(odd_ab, odd_cd, 0x20);
    to[2] = _mm256_permute2f128_pd(even_ab, even_cd, 0x31);
    to[3] = _mm256_permute2f128_pd(odd_ab, odd_cd, 0x31);
}

/// See interleaved() in pack.h.
STRAHL_INLINE void interleave(float* to, __m256 x, __m256 y, __m256 z) {
    const __m256 none = _mm256_setzero_ps();
    const __m256d low_xy = _mm256_castps_pd(_mm256_unpacklo_ps(x, y));
    const __m256d high_xy = _mm256_castps_pd(_mm256_unpackhi_ps(x, y));
    const __m256d low_z = _mm256_castps_pd(_mm256_unpacklo_ps(z, none));
    const __m256d high_z = _mm256_castps_pd(_mm256_unpackhi_ps(z, none));
    _mm256_store_ps(to, _mm256_castpd_ps(_mm256_unpacklo_pd(low_xy, low_z)));
    _mm256_store_ps(to + 8, _mm256_castpd_ps(_mm256_unpackhi_pd(low_xy, low_z)));
    _mm256_store_ps(to + 16, _mm256_castpd_ps(_mm256_unpacklo_pd(high_xy, high_z)));
    _mm256_store_ps(to + 24, _mm256_castpd_ps(_mm256_unpackhi_pd(high_xy, high_z)));
}
STRAHL_INLINE void interleave(double* to, __m256d x, __m256d y, __m256d z) {
    const __m256d none = _mm256_setzero_pd();
    const __m256d even_xy = _mm256_unpacklo_pd(x, y), even_z = _mm256_unpacklo_pd(z, none);
    const __m256d odd_xy = _mm256_unpackhi_pd(x, y), odd_z = _mm256_unpackhi_pd(z, none);
    _mm256_store_pd(to, _mm256_permute2f128_pd(even_xy, even_z, 0x20));
    _mm256_store_pd(to + 4, _mm256_permute2f128_pd(even_xy, even_z, 0x31));
    _mm256_store_pd(to + 8, _mm256_permute2f128_pd(odd_xy, odd_z, 0x20));
    _mm256_store_pd(to + 12, _mm256_permute2f128_pd(odd_xy, odd_z, 0x31));
}
STRAHL_INLINE void add_four(float* to, const float* from) {
    _mm_storeu_ps(to, _mm_add_ps(_mm_loadu_ps(to), _mm_load_ps(from)));
}
STRAHL_INLINE void add_four(double* to, const double* from) {
    _mm256_storeu_pd(to, _mm256_add_pd(_mm256_loadu_pd(to), _mm256_load_pd(from)));
}
#endif
#if defined(__AVX512F__)
STRAHL_INLINE __m512 minimum(__m512 a, __m512 b) { return _mm512_min_ps(a, b); }
STRAHL_INLINE __m512d minimum(__m512d a, __m512d b) { return _mm512_min_pd(a, b); }
STRAHL_INLINE __m512 maximum(__m512 a, __m512 b) { return _mm512_max_ps(a, b); }
STRAHL_INLINE __m512d maximum(__m512d a, __m512d b) { return _mm512_max_pd(a, b); }
STRAHL_INLINE __m512 fused(__m512 a, __m512 b, __m512 c) { return _mm512_fmadd_ps(a, b, c); }
STRAHL_INLINE __m512d fused(__m512d a, __m512d b, __m512d c) { return _mm512_fmadd_pd(a, b, c); }
STRAHL_INLINE __m512 root(__m512 a) { return _mm512_sqrt_ps(a); }
STRAHL_INLINE __m512d root(__m512d a) { return _mm512_sqrt_pd(a); }
STRAHL_INLINE __m512 absolute(__m512 a) { return _mm512_abs_ps(a); }
STRAHL_INLINE __m512d absolute(__m512d a) { return _mm512_abs_pd(a); }
STRAHL_INLINE __m512 rounded_down(__m512 a) { return _mm512_floor_ps(a); }
STRAHL_INLINE __m512d rounded_down(__m512d a) { return _mm512_floor_pd(a); }
STRAHL_INLINE __mmask16 less(__m512 a, __m512 b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OS); }
STRAHL_INLINE __mmask8 less(__m512d a, __m512d b) { return _mm512_cmp_pd_mask(a, b, _CMP_LT_OS); }
STRAHL_INLINE __mmask16 less_or_equal(__m512 a, __m512 b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OS); }
STRAHL_INLINE __mmask8 less_or_equal(__m512d a, __m512d b) { return _mm512_cmp_pd_mask(a, b, _CMP_LE_OS); }
STRAHL_INLINE __mmask16 equal(__m512 a, __m512 b) { return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ); }
STRAHL_INLINE __mmask8 equal(__m512d a, __m512d b) { return _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ); }
STRAHL_INLINE __m512 chosen(__mmask16 mask, __m512 yes, __m512 no) { return _mm512_mask_mov_ps(no, mask, yes); }
STRAHL_INLINE __m512d chosen(__mmask8 mask, __m512d yes, __m512d no) { return _mm512_mask_mov_pd(no, mask, yes); }
STRAHL_INLINE void widen(__m512d* to, const float* from) { *to = _mm512_cvtps_pd(_mm256_loadu_ps(from)); }
STRAHL_INLINE float least_of(__m512 a) { return _mm512_reduce_min_ps(a); }
STRAHL_INLINE double least_of(__m512d a) { return _mm512_reduce_min_pd(a); }

// Compressing in the register and storing whole: vcompress to memory is slow microcode on some processors.
STRAHL_INLINE void store_compressed(float* to, __mmask16 mask, __m512 value) {
    _mm512_storeu_ps(to, _mm512_maskz_compress_ps(mask, value));
}
STRAHL_INLINE void store_compressed(double* to, __mmask8 mask, __m512d value) {
    _mm512_storeu_pd(to, _mm512_maskz_compress_pd(mask, value));
}

STRAHL_INLINE void store_whole(int* to, __m512 numbers) {
    _mm512_storeu_si512(to, _mm512_cvttps_epi32(numbers));
    asm("" : "+m"(*reinterpret_cast<int(*)[16]>(to)));
}
STRAHL_INLINE void store_whole(int* to, __m512d numbers) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm512_cvttpd_epi32(numbers));
    asm("" : "+m"(*reinterpret_cast<int(*)[8]>(to)));
}
STRAHL_INLINE void load_fours(const float* const* from, __m512* to) {
    const auto row = [from](int j) __attribute__((always_inline)) {
        const __m512 first = _mm512_castps128_ps512(_mm_loadu_ps(from[j]));
        const __m512 two = _mm512_insertf32x4(first, _mm_loadu_ps(from[4 + j]), 1);
        return _mm512_insertf32x4(_mm512_insertf32x4(two, _mm_loadu_ps(from[8 + j]), 2), _mm_loadu_ps(from[12 + j]), 3);
    };
    const __m512 a = row(0), b = row(1), c = row(2), d = row(3);
    const __m512d low_ab = _mm512_castps_pd(_mm512_unpacklo_ps(a, b));
    const __m512d high_ab = _mm512_castps_pd(_mm512_unpackhi_ps(a, b));
    const __m512d low_cd = _mm512_castps_pd(_mm512_unpacklo_ps(c, d));
    const __m512d high_cd = _mm512_castps_pd(_mm512_unpackhi_ps(c, d));
    to[0] = _mm512_castpd_ps(_mm512_unpacklo_pd(low_ab, low_cd));
    to[1] = _mm512_castpd_ps(_mm512_unpackhi_pd(low_ab, low_cd));
    to[2] = _mm512_castpd_ps(_mm512_unpacklo_pd(high_ab, high_cd));
    to[3] = _mm512_castpd_ps(_mm512_unpackhi_pd(high_ab, high_cd));
}
STRAHL_INLINE void load_fours(const double* const* from, __m512d* to) {
    const auto row = [from](int j) __attribute__((always_inline)) {
        return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(from[j])), _mm256_loadu_pd(from[4 + j]), 1);
    };
    const __m512d a = row(0), b = row(1), c = row(2), d = row(3);
    const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13),
                  high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    const __m512d even_ab = _mm512_unpacklo_pd(a, b), even_cd = _mm512_unpacklo_pd(c, d);
    const __m512d odd_ab = _mm512_unpackhi_pd(a, b), odd_cd = _mm512_unpackhi_pd(c, d);
    to[0] = _mm512_permutex2var_pd(even_ab, low, even_cd);
    to[1] = _mm512_permutex2var_pd(odd_ab, low, odd_cd);
    to[2] = _mm512_permutex2var_pd(even_ab, high, even_cd);
    to[3] = _mm512_permutex2var_pd(odd_ab, high, odd_cd);
}

STRAHL_INLINE void interleave(float* to, __m512 x, __m512 y, __m512 z) {
    const __m512 none = _mm512_setzero_ps();
    const __m512d low_xy = _mm512_castps_pd(_mm512_unpacklo_ps(x, y));
    const __m512d high_xy = _mm512_castps_pd(_mm512_unpackhi_ps(x, y));
    const __m512d low_z = _mm512_castps_pd(_mm512_unpacklo_ps(z, none));
    const __m512d high_z = _mm512_castps_pd(_mm512_unpackhi_ps(z, none));
    _mm512_store_ps(to, _mm512_castpd_ps(_mm512_unpacklo_pd(low_xy, low_z)));
    _mm512_store_ps(to + 16, _mm512_castpd_ps(_mm512_unpackhi_pd(low_xy, low_z)));
    _mm512_store_ps(to + 32, _mm512_castpd_ps(_mm512_unpacklo_pd(high_xy, high_z)));
    _mm512_store_ps(to + 48, _mm512_castpd_ps(_mm512_unpackhi_pd(high_xy, high_z)));
}
STRAHL_INLINE void interleave(double* to, __m512d x, __m512d y, __m512d z) {
    const __m512d none = _mm512_setzero_pd();
    const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11),
                  last = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
    const __m512d even_xy = _mm512_unpacklo_pd(x, y), even_z = _mm512_unpacklo_pd(z, none);
    const __m512d odd_xy = _mm512_unpackhi_pd(x, y), odd_z = _mm512_unpackhi_pd(z, none);
    _mm512_store_pd(to, _mm512_permutex2var_pd(even_xy, first, even_z));
    _mm512_store_pd(to + 8, _mm512_permutex2var_pd(even_xy, last, even_z));
    _mm512_store_pd(to + 16, _mm512_permutex2var_pd(odd_xy, first, odd_z));
    _mm512_store_pd(to + 24, _mm512_permutex2var_pd(odd_xy, last, odd_z));
}
#endif

}  // namespace strahl
