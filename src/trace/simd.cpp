// Which instruction sets there are, and their names.
#include "trace/kernel/kernel.h"
#include "trace/tracer.h"

namespace strahl {

const char* name(Precision precision) {
    switch (precision) {
        case Precision::float32:
            return "float";
        case Precision::float64:
            return "double";
        default:
            return "extended";
    }
}

const char* name(Simd simd) {
    switch (simd) {
        case Simd::automatic:
            return "auto";
        case Simd::scalar:
            return "scalar";
        case Simd::v2:
            return "x86-64-v2";
        case Simd::v3:
            return "x86-64-v3";
        case Simd::v4:
            return "x86-64-v4";
        default:
            return "neon";
    }
}

bool for_other_processors() {
#if defined(__x86_64__) && !defined(STRAHL_KERNEL_v2)
    return false;
#else
    return true;
#endif
}

// kernels.cmake defines STRAHL_KERNEL_v3 and so on for the levels that are built.
bool supported(Simd simd) {
    switch (simd) {
        case Simd::automatic:
        case Simd::scalar:
            return true;
#if defined(STRAHL_KERNEL_v2)
        case Simd::v2:
            return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt");
#endif
#if defined(STRAHL_KERNEL_v3)
        case Simd::v3:
            return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
#endif
#if defined(STRAHL_KERNEL_v4)
        case Simd::v4:
            return __builtin_cpu_supports("x86-64-v4");
#endif
#if defined(STRAHL_KERNEL_neon)
        case Simd::neon:
            return true;
#endif
        default:
            return false;
    }
}

Simd best_simd() {
    for (const Simd simd : {Simd::v4, Simd::v3, Simd::v2, Simd::neon})
        if (supported(simd)) return simd;
    return Simd::scalar;
}

int lanes(Precision precision, Simd simd) {
    if (simd == Simd::automatic) simd = best_simd();
    if (precision == Precision::extended || simd == Simd::scalar) return 1;
    const int bytes = simd == Simd::v4 ? 64 : simd == Simd::v3 ? 32 : 16;
    return bytes / (precision == Precision::float32 ? 4 : 8);
}

}  // namespace strahl
