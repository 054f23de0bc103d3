// Pack: as many numbers as one SIMD register holds, with the functions of lanes.h. Those that take instructions of one
// processor are in pack_x86.h and pack_neon.h; on any other processor only the scalar kernel is built.
//
// It is compiled once per instruction set, inside an inline namespace named by STRAHL_LEVEL (v2, v3, v4, neon), so that
// packs of different width are different types and never merge at link time. Registers are the compiler's vector types,
// which have + - * / and comparisons: kernels compile twice as fast as with std::experimental::simd, whose operators
// are calls of calls.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "num/lanes.h"
#if defined(__x86_64__)
#include "num/pack_x86.h"
#elif defined(__aarch64__)
#include "num/pack_neon.h"
#else
#include "num/pack_plain.h"
#endif

namespace strahl {

// Compare each lane. A mask is a number of -1 or 0 in each lane; where a processor has registers for masks, it is their
// bits, and its own functions are preferred to these.
template <class R>
STRAHL_INLINE auto less(R a, R b) {
    return a < b;
}
template <class R>
STRAHL_INLINE auto less_or_equal(R a, R b) {
    return a <= b;
}
template <class R>
STRAHL_INLINE auto equal(R a, R b) {
    return a == b;
}

}  // namespace strahl

namespace strahl::inline STRAHL_LEVEL {

template <class T>
struct Pack;

template <class T>
struct PackMask {
    using Register = typename Native<T, register_bytes>::Register;
    using Lanes = decltype(less(Register(), Register()));
    Lanes m;
    STRAHL_INLINE friend PackMask operator&(PackMask a, PackMask b) { return {static_cast<Lanes>(a.m & b.m)}; }
    STRAHL_INLINE friend PackMask operator|(PackMask a, PackMask b) { return {static_cast<Lanes>(a.m | b.m)}; }
    STRAHL_INLINE PackMask operator!() const { return {static_cast<Lanes>(~m)}; }
};

template <class T>
struct Pack {
    using Register = typename PackMask<T>::Register;
    static constexpr int size = sizeof(Register) / sizeof(T);
    Register v;

    Pack() = default;
    STRAHL_INLINE Pack(T x) : v(x - Register{}) {}  // in every lane; + would make 0 of -0
    STRAHL_INLINE explicit Pack(Register r) : v(r) {}
    STRAHL_INLINE friend Pack operator+(Pack a, Pack b) { return Pack(a.v + b.v); }
    STRAHL_INLINE friend Pack operator-(Pack a, Pack b) { return Pack(a.v - b.v); }
    STRAHL_INLINE friend Pack operator*(Pack a, Pack b) { return Pack(a.v * b.v); }
    STRAHL_INLINE friend Pack operator/(Pack a, Pack b) { return Pack(a.v / b.v); }
    STRAHL_INLINE Pack operator-() const { return Pack(-v); }
    STRAHL_INLINE Pack& operator+=(Pack b) { return v += b.v, *this; }
    STRAHL_INLINE Pack& operator-=(Pack b) { return v -= b.v, *this; }
    STRAHL_INLINE Pack& operator*=(Pack b) { return v *= b.v, *this; }
    STRAHL_INLINE friend PackMask<T> operator<(Pack a, Pack b) { return {less(a.v, b.v)}; }
    STRAHL_INLINE friend PackMask<T> operator<=(Pack a, Pack b) { return {less_or_equal(a.v, b.v)}; }
    STRAHL_INLINE friend PackMask<T> operator>(Pack a, Pack b) { return {less(b.v, a.v)}; }
    STRAHL_INLINE friend PackMask<T> operator>=(Pack a, Pack b) { return {less_or_equal(b.v, a.v)}; }
    STRAHL_INLINE friend PackMask<T> operator==(Pack a, Pack b) { return {equal(a.v, b.v)}; }
};

}  // namespace strahl::inline STRAHL_LEVEL

namespace strahl {

template <class T>
STRAHL_INLINE Pack<T> fma(Pack<T> a, Pack<T> b, Pack<T> c) {
    if constexpr (has_fma)
        return Pack<T>(fused(a.v, b.v, c.v));
    else
        return a * b + c;
}
template <class T>
inline constexpr bool fuses<Pack<T>> = has_fma;
template <class T>
STRAHL_INLINE Pack<T> sqrt(Pack<T> a) {
    return Pack<T>(root(a.v));
}
/// Loads a vector, at any address.
template <class R, class T>
STRAHL_INLINE R load_register(const T* from) {
    R result;
    std::memcpy(&result, from, sizeof result);
    return result;
}
/// The first `width` values of `f`.
template <class T, int width, auto f>
inline constexpr std::array<T, width> table_of = [] {
    std::array<T, width> result{};
    for (int i = 0; i < width; ++i) result[i] = f(i);
    return result;
}();
/// Returns 0, 1, 2, ... in the lanes.
template <class T>
STRAHL_INLINE Pack<T> lane_numbers() {
    return Pack<T>(
        load_register<typename Pack<T>::Register>(table_of<T, Pack<T>::size, [](int i) { return i; }>.data()));
}
/// Returns the mask as bits: bit i is lane i.
template <class T>
STRAHL_INLINE unsigned bits(PackMask<T> mask) {
    if constexpr (has_mask_registers)
        return mask.m;
    else
        return mask_bits(reinterpret_cast<typename Pack<T>::Register>(mask.m));
}
/// The lanes whose bits are set.
template <class S>
STRAHL_INLINE Mask<S> mask_of(unsigned bits) {
    if constexpr (width<S> == 1) {
        return bits & 1;
    } else {
        using Lanes = typename Mask<S>::Lanes;
        if constexpr (has_mask_registers) {
            return {static_cast<Lanes>(bits)};
        } else {
            using Lane = std::conditional_t<sizeof(Element<S>) == 4, int, std::int64_t>;
            const auto powers = load_register<Lanes>(table_of<Lane, width<S>, [](int i) { return 1 << i; }>.data());
            return {(powers & static_cast<Lane>(bits)) == powers};
        }
    }
}
template <class T>
STRAHL_INLINE Pack<T> select(PackMask<T> mask, Pack<T> yes, Pack<T> no) {
    if constexpr (has_mask_registers)
        return Pack<T>(chosen(mask.m, yes.v, no.v));
    else
        return Pack<T>(chosen(reinterpret_cast<typename Pack<T>::Register>(mask.m), yes.v, no.v));
}
template <class T>
STRAHL_INLINE Pack<T> abs(Pack<T> a) {
    return Pack<T>(absolute(a.v));
}
// As the scalar functions do, returns the second operand if one is NaN or both are zeros.
template <class T>
STRAHL_INLINE Pack<T> min(Pack<T> a, Pack<T> b) {
    return Pack<T>(minimum(b.v, a.v));
}
template <class T>
STRAHL_INLINE Pack<T> max(Pack<T> a, Pack<T> b) {
    return Pack<T>(maximum(b.v, a.v));
}
template <class T>
STRAHL_INLINE Pack<T> floor(Pack<T> a) {
    return Pack<T>(rounded_down(a.v));
}
template <class T>
STRAHL_INLINE bool any(PackMask<T> mask) {
    return bits(mask) != 0;
}
template <class T>
STRAHL_INLINE bool all(PackMask<T> mask) {
    return bits(mask) == (1u << Pack<T>::size) - 1;
}
template <class T>
STRAHL_INLINE bool none(PackMask<T> mask) {
    return bits(mask) == 0;
}
template <class T>
STRAHL_INLINE int count(PackMask<T> mask) {
    return std::popcount(bits(mask));
}
/// The lowest lane that is set; the mask must not be empty.
template <class T>
STRAHL_INLINE int first(PackMask<T> mask) {
    return __builtin_ctz(bits(mask));
}
template <class T>
STRAHL_INLINE T lane(const Pack<T>& a, int i) {  // from where it lies: no copy of all lanes for the sake of one
    T value;
    std::memcpy(&value, reinterpret_cast<const char*>(&a) + i * sizeof(T), sizeof(T));
    return value;
}
template <class T>
STRAHL_INLINE Pack<T> with_lane(Pack<T> a, int i, T value) {  // a whole pack read after one lane was written waits
    return select(lane_numbers<T>() == Pack<T>(static_cast<T>(i)), Pack<T>(value), a);
}
/// The smallest of the lanes.
template <class T>
STRAHL_INLINE T least(Pack<T> a) {
    return least_of(a.v);
}
template <class T>
STRAHL_INLINE void compress(T* to, Pack<T> value, PackMask<T> mask) {
    if constexpr (has_mask_registers) {
        store_compressed(to, mask.m, value.v);
    } else {
        for (int i = 0; i < Pack<T>::size; ++i) {
            *to = value.v[i];
            to += mask.m[i] != 0;
        }
    }
}

/// Stores numbers that are whole as integers.
template <class T>
STRAHL_INLINE void store_whole(int* to, const Pack<T>& numbers) {
    if constexpr (has_fours)
        store_whole(to, numbers.v);
    else
        for (int i = 0; i < Pack<T>::size; ++i) to[i] = static_cast<int>(numbers.v[i]);
}

/// The number of fields that load_fields() reads at once; 1 where there is no load_fields().
template <class S>
inline constexpr int fields_at_once = 1;
template <class T>
inline constexpr int fields_at_once<Pack<T>> = has_fours ? 4 : 1;
/// Loads the numbers at from[k] + f into lane k of to[f].
template <class T>
STRAHL_INLINE void load_fields(const T* const* from, Pack<T>* to) {
    typename Pack<T>::Register registers[fields_at_once<Pack<T>>];
    load_fours(from, registers);
    for (int f = 0; f < fields_at_once<Pack<T>>; ++f) to[f] = Pack<T>(registers[f]);
}

/// Is there an interleave()?
template <class S>
inline constexpr bool interleaves = false;
template <class T>
inline constexpr bool interleaves<Pack<T>> = has_fours;
/// Writes (x, y, z, 0) of lane k from 4 * interleaved<Pack<T>>(k) on: then one add_four serves all three.
template <class T>
STRAHL_INLINE void interleave(T* to, Pack<T> x, Pack<T> y, Pack<T> z) {
    interleave(to, x.v, y.v, z.v);
}
/// Returns where interleave() writes lane k: in unpacking's order, every fourth float or every second double in a row.
template <class S>
constexpr int interleaved(int k) {
    constexpr int rows = 16 / sizeof(Element<S>);
    return width<S> / rows * (k % rows) + k / rows;
}

template <class T>
struct LaneTraits<Pack<T>> {
    using Element = T;
    using Mask = PackMask<T>;
    static constexpr int width = Pack<T>::size;
};

/// The lanes of this instance.
template <class T>
using Widest =
#ifdef STRAHL_SCALAR
    T;
#else
    Pack<T>;
#endif

}  // namespace strahl

template <class T>
struct std::numeric_limits<strahl::Pack<T>> : std::numeric_limits<T> {};
