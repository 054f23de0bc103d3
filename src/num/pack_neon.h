// The instructions of aarch64 that Pack uses: NEON, which every such processor has. Only pack.h includes this.
#pragma once
#include <arm_neon.h>

#include "num/quad.h"

namespace strahl::inline STRAHL_LEVEL {

inline constexpr int register_bytes = 16;
inline constexpr bool has_fma = true, has_mask_registers = false, has_fours = false;

}  // namespace strahl::inline STRAHL_LEVEL

namespace strahl {

template <class T, int bytes>
struct Native;
template <>
struct Native<float, 16> {
    using Register = float32x4_t;
};
template <>
struct Native<double, 16> {
    using Register = float64x2_t;
};

// The least and the largest by a comparison and a choice, as x86 has it for NaN and signed zeros; fmin and fmax differ.
STRAHL_INLINE float64x2_t minimum(float64x2_t a, float64x2_t b) { return vbslq_f64(vcltq_f64(a, b), a, b); }
STRAHL_INLINE float64x2_t maximum(float64x2_t a, float64x2_t b) { return vbslq_f64(vcgtq_f64(a, b), a, b); }
STRAHL_INLINE float32x4_t fused(float32x4_t a, float32x4_t b, float32x4_t c) { return vfmaq_f32(c, a, b); }
STRAHL_INLINE float64x2_t fused(float64x2_t a, float64x2_t b, float64x2_t c) { return vfmaq_f64(c, a, b); }
STRAHL_INLINE float32x4_t root(float32x4_t a) { return vsqrtq_f32(a); }
STRAHL_INLINE float64x2_t root(float64x2_t a) { return vsqrtq_f64(a); }
STRAHL_INLINE float32x4_t absolute(float32x4_t a) { return vabsq_f32(a); }
STRAHL_INLINE float64x2_t absolute(float64x2_t a) { return vabsq_f64(a); }
STRAHL_INLINE float32x4_t rounded_down(float32x4_t a) { return vrndmq_f32(a); }
STRAHL_INLINE float64x2_t rounded_down(float64x2_t a) { return vrndmq_f64(a); }
STRAHL_INLINE float32x4_t chosen(float32x4_t mask, float32x4_t yes, float32x4_t no) {
    return vbslq_f32(vreinterpretq_u32_f32(mask), yes, no);
}
STRAHL_INLINE float64x2_t chosen(float64x2_t mask, float64x2_t yes, float64x2_t no) {
    return vbslq_f64(vreinterpretq_u64_f64(mask), yes, no);
}
STRAHL_INLINE unsigned mask_bits(float32x4_t mask) {
    return vaddvq_u32(vandq_u32(vreinterpretq_u32_f32(mask), uint32x4_t{1, 2, 4, 8}));
}
STRAHL_INLINE unsigned mask_bits(float64x2_t mask) {
    return static_cast<unsigned>(vaddvq_u64(vandq_u64(vreinterpretq_u64_f64(mask), uint64x2_t{1, 2})));
}
STRAHL_INLINE void widen(float64x2_t* to, const float* from) { *to = vcvt_f64_f32(vld1_f32(from)); }
STRAHL_INLINE float least_of(float32x4_t a) { return vminvq_f32(a); }
STRAHL_INLINE double least_of(float64x2_t a) { return vminvq_f64(a); }

}  // namespace strahl
