// Quad: four floats, one register of any processor, with + - * / and comparisons.
#pragma once
#include "num/lanes.h"
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace strahl {

// Returns the second operand if one is NaN or both are zeros, as one instruction of x86 does.
#if defined(__x86_64__)
using Quad = __m128;
STRAHL_INLINE Quad minimum(Quad a, Quad b) { return _mm_min_ps(a, b); }
STRAHL_INLINE Quad maximum(Quad a, Quad b) { return _mm_max_ps(a, b); }
#else
using Quad [[gnu::vector_size(16)]] = float;
STRAHL_INLINE Quad minimum(Quad a, Quad b) { return a < b ? a : b; }
STRAHL_INLINE Quad maximum(Quad a, Quad b) { return a > b ? a : b; }
#endif

}  // namespace strahl
