// Pack: as many numbers as one SIMD register holds, with the functions of lanes.h. Those that take instructions of one
// processor are in pack_x86.h and pack_neon.h; on any other processor only the scalar kernel is built.
//
// It is compiled once per instruction set, inside an inline namespace named by STRAHL_LEVEL (v2, v3, v4, neon), so that
// packs of different width are different types and never merge at link time. The wrapper around std::experimental::simd
// exists because numeric_limits must be specialised for vectors of packs, which std forbids for its own type, and
// because g++ 12 turns the standard's fma of 16 floats into scalar calls.
#pragma once
#include <array>
#include <bit>
#include <cstring>
#include <experimental/simd>
#include <limits>

#include "num/lanes.h"
#if defined(__x86_64__)
#include "num/pack_x86.h"
#elif defined(__aarch64__)
#include "num/pack_neon.h"
#else
#include "num/pack_plain.h"
#endif

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

/// The register as intrinsics take it.
template <class T>
STRAHL_INLINE auto raw(Pack<T> a) {
    return static_cast<typename Native<T, sizeof(Pack<T>)>::Register>(a.v);
}

template <class T>
STRAHL_INLINE Pack<T> fma(Pack<T> a, Pack<T> b, Pack<T> c) {
    if constexpr (has_fma)
        return Pack<T>(typename Pack<T>::Register(fused(raw(a), raw(b), raw(c))));
    else
        return a * b + c;
}
template <class T>
inline constexpr bool fuses<Pack<T>> = has_fma;
template <class T>
STRAHL_INLINE Pack<T> sqrt(Pack<T> a) {
    return Pack<T>(std::experimental::sqrt(a.v));
}
/// Returns the mask as bits: bit i is lane i.
template <class T>
STRAHL_INLINE unsigned bits(PackMask<T> mask) {
    return static_cast<unsigned>(mask.m.__to_bitset().to_ulong());
}
/// The lanes whose bits are set.
template <class S>
STRAHL_INLINE Mask<S> mask_of(unsigned bits) {
    if constexpr (width<S> == 1)
        return bits & 1;
    else
        return {S::Register::mask_type::__from_bitset(bits)};
}
template <class T>
STRAHL_INLINE Pack<T> select(PackMask<T> mask, Pack<T> yes, Pack<T> no) {
    if constexpr (has_mask_registers) {  // the standard's way keeps g++ 12 from putting it into the instruction before
        return Pack<T>(typename Pack<T>::Register(chosen(bits(mask), raw(yes), raw(no))));
    } else {
        std::experimental::where(mask.m, no.v) = yes.v;
        return no;
    }
}
template <class T>
STRAHL_INLINE Pack<T> abs(Pack<T> a) {
    return Pack<T>(std::experimental::abs(a.v));
}
// As the scalar functions do, returns the second operand if one is NaN or both are zeros.
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
    if constexpr (has_least)
        return least_of(raw(a));
    else
        return std::experimental::hmin(a.v);
}
template <class T>
STRAHL_INLINE void compress(T* to, Pack<T> value, PackMask<T> mask) {
    if constexpr (has_mask_registers) {
        store_compressed(to, bits(mask), raw(value));
    } else {
        for (int i = 0; i < Pack<T>::size; ++i) {
            *to = value.v[i];
            to += mask.m[i];
        }
    }
}

/// Stores numbers that are whole as integers.
template <class T>
STRAHL_INLINE void store_whole(int* to, const Pack<T>& numbers) {
    if constexpr (has_fours)
        store_whole(to, raw(numbers));
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
    typename Native<T, sizeof(Pack<T>)>::Register registers[fields_at_once<Pack<T>>];
    load_fours(from, registers);
    for (int f = 0; f < fields_at_once<Pack<T>>; ++f) to[f] = Pack<T>(typename Pack<T>::Register(registers[f]));
}

/// Is there an interleave()?
template <class S>
inline constexpr bool interleaves = false;
template <class T>
inline constexpr bool interleaves<Pack<T>> = has_fours;
/// Writes (x, y, z, 0) of lane k from 4 * interleaved<Pack<T>>(k) on: then one add_four serves all three.
template <class T>
STRAHL_INLINE void interleave(T* to, Pack<T> x, Pack<T> y, Pack<T> z) {
    interleave(to, raw(x), raw(y), raw(z));
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
