// fma() and fmaf() that round once, as their names promise and Linux's do: mingw-w64's round twice. Kernels without
// packs, or for processors without these instructions, call them.
#include <immintrin.h>

namespace {

[[gnu::target("fma")]] double fused(double a, double b, double c) {
    return _mm_cvtsd_f64(_mm_fmadd_sd(_mm_set_sd(a), _mm_set_sd(b), _mm_set_sd(c)));
}
[[gnu::target("fma")]] float fused(float a, float b, float c) {
    return _mm_cvtss_f32(_mm_fmadd_ss(_mm_set_ss(a), _mm_set_ss(b), _mm_set_ss(c)));
}

/// Where the processor lacks the instruction it rounds to 113 bits first, by which one of some 2^59 results is another.
template <class T>
T rounded(T a, T b, T c) {
    static const bool has_instruction = __builtin_cpu_supports("fma");
    return has_instruction ? fused(a, b, c) : static_cast<T>(static_cast<__float128>(a) * b + c);
}

}  // namespace

extern "C" double fma(double a, double b, double c) { return rounded(a, b, c); }
extern "C" float fmaf(float a, float b, float c) { return rounded(a, b, c); }
