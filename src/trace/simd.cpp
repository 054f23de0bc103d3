// The SIMD levels: their names, and which of their kernels this program has. Their macros are defined for this file
// only, by kernels.cmake: STRAHL_KERNEL_v3 and so on for the levels that are built. Without the scalar level no kernels
// of proofs are.
#include <stdexcept>
#include <type_traits>

#include "trace/built_kernels.h"
#include "trace/tracer.h"

namespace strahl {
namespace {

#ifdef STRAHL_KERNEL_scalar
constexpr bool only_least = false;
#else
constexpr bool only_least = true;
#endif

}  // namespace

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

bool proves() { return !only_least; }

bool built([[maybe_unused]] Simd simd) {
    switch (simd) {
        case Simd::automatic:
            return true;
        case Simd::scalar:
            return !only_least;
#if defined(STRAHL_KERNEL_v2)
        case Simd::v2:
            return true;
#endif
#if defined(STRAHL_KERNEL_v3)
        case Simd::v3:
            return true;
#endif
#if defined(STRAHL_KERNEL_v4)
        case Simd::v4:
            return true;
#endif
#if defined(STRAHL_KERNEL_neon)
        case Simd::neon:
            return true;
#endif
        default:
            return false;
    }
}

bool supported(Simd simd) {
#if defined(__x86_64__)
    if (simd == Simd::v2 && !(__builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt"))) return false;
    if (simd == Simd::v3 &&
        !(__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2")))
        return false;
    // clang 16 does not know "x86-64-v4".
    if (simd == Simd::v4 && !(__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                              __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                              __builtin_cpu_supports("avx512vl")))
        return false;
#endif
    return built(simd);
}

Simd best_simd() {
    for (const Simd simd : {Simd::v4, Simd::v3, Simd::v2, Simd::neon})
        if (supported(simd)) return simd;
    if (only_least)
        throw std::runtime_error(
            "this program was built for other processors; cmake --preset release "
            "-D STRAHL_LEVELS=all builds one for all");
    return Simd::scalar;
}

int lanes(Precision precision, Simd simd) {
    if (simd == Simd::automatic) simd = best_simd();
    if (precision == Precision::extended || simd == Simd::scalar) return 1;
    const int bytes = simd == Simd::v4 ? 64 : simd == Simd::v3 ? 32 : 16;
    return bytes / (precision == Precision::float32 ? 4 : 8);
}

template <class T, class Purpose>
Kernel<T> kernel_for([[maybe_unused]] Simd simd) {
    constexpr bool proving = std::is_same_v<Purpose, ForProofs>;
    if constexpr (proving && only_least) {
        return {};
    } else if constexpr (std::is_same_v<T, long double>) {
        return long_double::kernel<T, Purpose>();
    } else {
#if defined(STRAHL_KERNEL_v2)
        if constexpr (!proving)
            if (simd == Simd::v2) return v2::kernel<T, Purpose>();
#endif
#if defined(STRAHL_KERNEL_v3)
        if (simd == Simd::v3) return v3::kernel<T, Purpose>();
#endif
#if defined(STRAHL_KERNEL_v4)
        if (simd == Simd::v4) return v4::kernel<T, Purpose>();
#endif
#if defined(STRAHL_KERNEL_neon)
        if (simd == Simd::neon) return neon::kernel<T, Purpose>();
#endif
        if constexpr (only_least)
            return {};
        else
            return scalar::kernel<T, Purpose>();
    }
}
template Kernel<float> kernel_for<float, ForPictures>(Simd);
template Kernel<double> kernel_for<double, ForPictures>(Simd);
template Kernel<long double> kernel_for<long double, ForPictures>(Simd);
template Kernel<double> kernel_for<double, ForProofs>(Simd);
template Kernel<long double> kernel_for<long double, ForProofs>(Simd);

}  // namespace strahl
