// Loads and stores of lanes: consecutive, gathered by index, compressed by mask. The same functions for scalars.
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <utility>

#include "num/pack.h"

namespace strahl {

template <class S>
STRAHL_INLINE S load_lanes(const Element<S>* from) {
    if constexpr (width<S> == 1)
        return *from;
    else
        return S(load_register<typename S::Register>(from));
}
/// Loads lanes from numbers of another type and converts them.
template <class S, class T>
STRAHL_INLINE S load_converted(const T* from) {
    if constexpr (width<S> == 1) {
        return static_cast<S>(*from);
    } else if constexpr (sizeof(T) < sizeof(Element<S>)) {
        typename S::Register result;
        widen(&result, from);
        return S(result);
    } else {
        T source [[gnu::vector_size(width<S> * sizeof(T))]];
        std::memcpy(&source, from, sizeof source);
        return S(__builtin_convertvector(source, typename S::Register));
    }
}
template <class S>
STRAHL_INLINE void store_lanes(Element<S>* to, S value) {
    if constexpr (width<S> == 1)
        *to = value;
    else
        std::memcpy(to, &value.v, sizeof value.v);
}
/// Returns 0, 1, 2, ... in the lanes.
template <class S>
STRAHL_INLINE S iota() {
    if constexpr (width<S> == 1)
        return S(0);
    else
        return lane_numbers<Element<S>>();
}
/// Returns the mask of the first n lanes.
template <class S>
STRAHL_INLINE Mask<S> first_lanes(int n) {
    return iota<S>() < S(static_cast<Element<S>>(n));
}
/// Loads base[index[lane]] into every lane.
template <class S>
STRAHL_INLINE S gather(const Element<S>* base, const int* index) {
    if constexpr (width<S> == 1)
        return base[*index];
    else {
        alignas(64) Element<S> lanes[width<S>];
        for (int i = 0; i < width<S>; ++i) lanes[i] = base[index[i]];
        return load_lanes<S>(lanes);
    }
}
/// Calls set(n) for n = 0, 1, ..., count - 1, each in code of its own.
template <std::size_t count, class Set>
STRAHL_INLINE void each_number(const Set& set) {
    [&]<std::size_t... n>(std::index_sequence<n...>) __attribute__((always_inline)) { (set(n), ...); }
    (std::make_index_sequence<count>());
}
/// Returns a struct of packs whose fields are value(0), value(1), ... They are written in place and not in a loop: so
/// the compiler leaves out what is not used, and need not copy the whole in memory.
template <class R, class S, class Value>
STRAHL_INLINE R of_fields(const Value& value) {
    R result;
    S* const fields = reinterpret_cast<S*>(&result);
    each_number<sizeof(R) / sizeof(S)>([&](std::size_t f) __attribute__((always_inline)) { fields[f] = value(f); });
    return result;
}
/// Loads items[index[lane]] into every lane, for a struct I of elements; R is the same struct of packs.
template <class R, class S, class I>
STRAHL_INLINE R gather_items(const I* items, const int* index) {
    using T = Element<S>;
    constexpr int fields = sizeof(I) / sizeof(T);
    static_assert(sizeof(R) == fields * sizeof(S));
    if constexpr (constexpr int at_once = fields_at_once<S>; at_once > 1 && fields >= at_once) {
        const T* from[width<S>];
        for (int i = 0; i < width<S>; ++i) from[i] = reinterpret_cast<const T*>(items + index[i]);
        R result;
        S* const to = reinterpret_cast<S*>(&result);
        each_number<fields / at_once>([&](std::size_t n) __attribute__((always_inline)) {
            load_fields(from, to + n * at_once);
            for (const T*& place : from) place += at_once;
        });
        if constexpr (fields % at_once != 0) {
            for (const T*& place : from) place -= at_once - fields % at_once;
            load_fields(from, to + fields - at_once);
        }
        return result;
    }
    alignas(64) T lanes[fields][width<S>];
    for (int i = 0; i < width<S>; ++i) {
        const auto values = std::bit_cast<std::array<T, fields>>(items[index[i]]);
        for (int f = 0; f < fields; ++f) lanes[f][i] = values[f];
    }
    return of_fields<R, S>([&](std::size_t f) __attribute__((always_inline)) { return load_lanes<S>(lanes[f]); });
}
/// Gathers items of floats as gather_items does, and converts them to the type of the lanes.
template <template <class> class R, class S>
STRAHL_INLINE R<S> gather_floats(const R<float>* items, const int* index) {
    using F = std::conditional_t<width<S> == 1, float, Pack<float>>;
    if constexpr (std::is_same_v<F, S>) return gather_items<R<S>, S>(items, index);
    int places[width<F>] = {};  // those of the upper half are in the cache
    for (int i = 0; i < width<S>; ++i) places[i] = index[i];
    const R<F> found = gather_items<R<F>, F>(items, places);
    return of_fields<R<S>, S>([&](std::size_t f) __attribute__((always_inline)) {
        alignas(64) float lanes[width<F>];
        store_lanes(lanes, reinterpret_cast<const F*>(&found)[f]);
        return load_converted<S>(lanes);
    });
}
/// Loads items [first, first + width), which are stored by columns: field f begins at columns + f * stride.
template <class R, class S>
STRAHL_INLINE R load_items(const Element<S>* columns, std::size_t stride, int first) {
    return of_fields<R, S>([&](std::size_t f)
                               __attribute__((always_inline)) { return load_lanes<S>(columns + f * stride + first); });
}
/// Adds v[c] to to[4 * index + c] for the first `lanes`, one lane after the other, so that equal indices add up in this
/// order. to[4 * index + 3] is unchanged.
template <class S>
STRAHL_INLINE void add_lanes(Element<S>* to, const S& index, int lanes, const Vec3<S>& v) {
    using T = Element<S>;
    alignas(64) T at[width<S>];
    store_lanes(at, index);
    if constexpr (interleaves<S>) {
        alignas(64) T fours[4 * width<S>];
        interleave(fours, v.x, v.y, v.z);
        for (int k = 0; k < lanes; ++k) add_four(to + 4 * static_cast<int>(at[k]), fours + 4 * interleaved<S>(k));
        return;
    }
    alignas(64) T terms[3][width<S>];
    for (int c = 0; c < 3; ++c) store_lanes(terms[c], v[c]);
    for (int k = 0; k < lanes; ++k)
        for (int c = 0; c < 3; ++c) to[4 * static_cast<int>(at[k]) + c] += terms[c][k];
}
/// Returns the item in every lane.
template <class R, class S, class I>
STRAHL_INLINE R splat_item(const I& item) {
    using T = Element<S>;
    const T* const values = reinterpret_cast<const T*>(&item);
    return of_fields<R, S>([&](std::size_t f) __attribute__((always_inline)) { return S(values[f]); });
}
/// Stores the lanes set in the mask without gaps. Up to a whole pack is written, so leave space behind.
template <Scalar S>
STRAHL_INLINE void compress(S* to, S value, bool mask) {
    if (mask) *to = value;
}
template <Scalar S>
STRAHL_INLINE void store_whole(int* to, S number) {
    *to = static_cast<int>(number);
}
template <Scalar S>
STRAHL_INLINE S floor(S a) {
    return std::floor(a);
}
template <Scalar S>
STRAHL_INLINE S lane(S a, int) {
    return a;
}
template <Scalar S>
STRAHL_INLINE S with_lane(S, int, S value) {
    return value;
}
template <Scalar S>
STRAHL_INLINE S least(S a) {
    return a;
}
STRAHL_INLINE unsigned bits(bool mask) { return mask; }
STRAHL_INLINE int count(bool mask) { return mask; }
STRAHL_INLINE int first(bool) { return 0; }

/// The lanes for what is computed in double, or with more digits: a pack of floats makes two of them.
template <class S>
struct DoubleLanes {
    using Type = S;
};
template <>
struct DoubleLanes<float> {
    using Type = double;
};
template <>
struct DoubleLanes<Pack<float>> {
    using Type = Pack<double>;
};
template <class S>
using Doubles = typename DoubleLanes<S>::Type;
/// Returns the lanes that make the given part.
template <class S>
STRAHL_INLINE Doubles<S> doubles_of(const S& a, int part) {
    if constexpr (std::is_same_v<Doubles<S>, S>) {
        return a;
    } else {
        alignas(64) Element<S> lanes[width<S>];
        store_lanes(lanes, a);
        return load_converted<Doubles<S>>(lanes + part * width<Doubles<S>>);
    }
}
template <class S>
STRAHL_INLINE Vec3<Doubles<S>> doubles_of(const Vec3<S>& v, int part) {
    return {doubles_of(v.x, part), doubles_of(v.y, part), doubles_of(v.z, part)};
}
/// Returns a part as the lanes that it was made of, with 0 in the others.
template <class S>
STRAHL_INLINE S lanes_of(const Doubles<S>& a, int part) {
    if constexpr (std::is_same_v<Doubles<S>, S>) {
        return a;
    } else {
        alignas(64) Element<Doubles<S>> lanes[width<S>] = {};
        store_lanes(lanes + part * width<Doubles<S>>, a);
        return load_converted<S>(lanes);
    }
}

}  // namespace strahl
