// The instructions of aarch64 that Pack uses: NEON, which every such processor has. Only pack.h includes this.
#pragma once
#include <arm_neon.h>

#include "num/quad.h"

namespace strahl::inline STRAHL_LEVEL {

inline constexpr bool has_fma = true, has_mask_registers = false, has_least = true, has_fours = false;

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

// Compared and selected: fmin and fmax would treat NaN and signed zeros otherwise than x86. Of four floats in quad.h.
STRAHL_INLINE float64x2_t minimum(float64x2_t a, float64x2_t b) { return vbslq_f64(vcltq_f64(a, b), a, b); }
STRAHL_INLINE float64x2_t maximum(float64x2_t a, float64x2_t b) { return vbslq_f64(vcgtq_f64(a, b), a, b); }
STRAHL_INLINE float32x4_t fused(float32x4_t a, float32x4_t b, float32x4_t c) { return vfmaq_f32(c, a, b); }
STRAHL_INLINE float64x2_t fused(float64x2_t a, float64x2_t b, float64x2_t c) { return vfmaq_f64(c, a, b); }
STRAHL_INLINE float least_of(float32x4_t a) { return vminvq_f32(a); }
STRAHL_INLINE double least_of(float64x2_t a) { return vminvq_f64(a); }

}  // namespace strahl
