// fma() and fmaf() that round once, as their names promise and Linux's do: mingw-w64's round twice. Kernels without
// packs, or for processors without these instructions, call them.
#include <type_traits>

namespace {

const bool has_instruction = __builtin_cpu_supports("fma");

template <class T>
[[gnu::target("fma")]] T fused(T a, T b, T c) {
    if constexpr (std::is_same_v<T, float>)
        return __builtin_fmaf(a, b, c);
    else
        return __builtin_fma(a, b, c);
}

/// Returns a * b + c, rounded once. Where the processor lacks the instruction, rounds to 113 bits first: one of some
/// 2^59 results is another number then.
template <class T>
T rounded(T a, T b, T c) {
    return has_instruction ? fused(a, b, c) : static_cast<T>(static_cast<__float128>(a) * b + c);
}

}  // namespace

extern "C" double fma(double a, double b, double c) { return rounded(a, b, c); }
extern "C" float fmaf(float a, float b, float c) { return rounded(a, b, c); }
