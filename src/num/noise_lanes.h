// POV-Ray's noise for a double or a pack of doubles: each lane has the bits that lattice_noise.h has for its point.
#pragma once
#include <algorithm>

#include "num/lattice_noise.h"
#include "num/memory.h"

namespace strahl::inline STRAHL_LEVEL {

template <int count>
struct WholeLanes {
    using Type [[gnu::vector_size(4 * count)]] = int;
};
template <>
struct WholeLanes<1> {
    using Type = int;
};
/// Whole numbers in lanes, with + & and ^ as integers have them.
template <class S>
using Whole = typename WholeLanes<width<S>>::Type;

/// Drops the digits behind the point.
template <class S>
STRAHL_INLINE Whole<S> whole_part(const S& x) {
    if constexpr (width<S> == 1)
        return static_cast<int>(x);
    else
        return __builtin_convertvector(x.v, Whole<S>);
}
template <class S>
STRAHL_INLINE S number_of(const Whole<S>& k) {
    if constexpr (width<S> == 1)
        return static_cast<S>(k);
    else
        return S(__builtin_convertvector(k, typename S::Register));
}

/// Loads table[at] into every lane; may read, but not use, the two bytes behind the table.
template <class S>
STRAHL_INLINE Whole<S> look_up(const std::uint16_t* table, const Whole<S>& at) {
    if constexpr (width<S> == 1) {
        return table[at];
    } else {
#if defined(__AVX2__)
        const auto* const base = reinterpret_cast<const int*>(table);
        if constexpr (width<S> == 8)
            return reinterpret_cast<Whole<S>>(_mm256_i32gather_epi32(base, reinterpret_cast<__m256i>(at), 2)) & 0xffff;
        else
            return reinterpret_cast<Whole<S>>(_mm_i32gather_epi32(base, reinterpret_cast<__m128i>(at), 2)) & 0xffff;
#else
        Whole<S> found;
        for (int k = 0; k < width<S>; ++k) found[k] = table[at[k]];
        return found;
#endif
    }
}
/// Writes whole numbers to memory, for addresses. If the compiler knew what is there, it would extract the lanes one by
/// one.
template <class S>
STRAHL_INLINE void store_places(const Whole<S>& at, int (&to)[width<S>]) {
    std::memcpy(to, &at, sizeof at);
    if constexpr (width < S >> 1) asm("" : "+m"(to));
}
/// Loads four numbers from each of several places: lane k of to[f] is the one at from[k] + f.
template <class S>
STRAHL_INLINE void load_four(const double* const (&from)[width<S>], S (&to)[4]) {
    if constexpr (width<S> == 1) {
        for (int f = 0; f < 4; ++f) to[f] = from[0][f];
    } else if constexpr (fields_at_once<S> == 4) {
        load_fields(from, to);
    } else {
        for (int f = 0; f < 4; ++f) {
            double lanes[width<S>];
            for (int k = 0; k < width<S>; ++k) lanes[k] = from[k][f];
            to[f] = S(load_register<typename S::Register>(lanes));
        }
    }
}
/// Loads the four numbers from table[at] on into every lane of to[0] to to[3].
template <class S>
STRAHL_INLINE void look_up_four(const double* table, const Whole<S>& at, S (&to)[4]) {
    const double* from[width<S>];
    if constexpr (width<S> == 1)
        from[0] = table + at;
    else
        for (int k = 0; k < width<S>; ++k) from[k] = table + at[k];
    load_four<S>(from, to);
}

template <class S>
STRAHL_INLINE S clamped(const S& x, double least, double most) {
    return select(x < S(least), S(least), select(x > S(most), S(most), x));
}
/// Limits coordinates to where a lattice has cells, and the numbers of cells are integers; not a number becomes -1e9.
template <class S>
STRAHL_INLINE S within_lattice(const S& x) {
    return min(max(S(-1e9), x), S(1e9));
}
template <class S>
STRAHL_INLINE S smooth(const S& u) {
    return u * u * (S(3) - S(2) * u);
}

/// The corners of the cell of a lattice that a point is in; the last index says which of two along an axis.
template <class S>
struct LatticeCorners {
    Whole<S> columns[2][2], z[2];
    S weights[3][2], offsets[3][2];

    STRAHL_INLINE LatticeCorners(const std::uint16_t* hash, const Vec3<S>& p) {
        Whole<S> cells[3];
        for (int c = 0; c < 3; ++c) {
            const S x = within_lattice(p[c]);
            const Whole<S> k = whole_part(select(x >= S(0), x, x - S(1 - 1e-10)));
            cells[c] = (k + 10000) & 4095;
            const S fraction = p[c] - number_of<S>(k);
            offsets[c][0] = fraction, offsets[c][1] = fraction - S(1);
            weights[c][1] = smooth(fraction), weights[c][0] = S(1) - weights[c][1];
        }
        for (int i = 0; i < 2; ++i) {
            const Whole<S> row = look_up<S>(hash, cells[0] + i);
            for (int j = 0; j < 2; ++j) columns[i][j] = look_up<S>(hash, row ^ (cells[1] + j));
        }
        for (int k = 0; k < 2; ++k) z[k] = cells[2] + k;
    }
    /// Calls add(index of the hash, weight, offset to the corner): bit 0 of a corner is for x, 1 for y, 2 for z.
    template <class Add>
    STRAHL_INLINE void visit(int corner, const Add& add) const {
        const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
        add(Whole<S>(columns[i][j] ^ z[k]), weights[0][i] * weights[1][j] * weights[2][k],
            Vec3<S>(offsets[0][i], offsets[1][j], offsets[2][k]));
    }
};

/// Generator 3: gradients on a lattice of 2048 cells.
template <class S>
[[gnu::noinline]] S gradient_noise(const Vec3<S>& point) {
    const lattice::NoiseTables& tables = lattice::noise_tables();
    Whole<S> cells[3][2];
    S offsets[3], shares[3];
    for (int c = 0; c < 3; ++c) {
        const S t = within_lattice(point[c]) + S(10000000.023157213), low = floor(t);
        cells[c][0] = whole_part(low) & 2047, cells[c][1] = (cells[c][0] + 1) & 2047;
        offsets[c] = t - low, shares[c] = smooth(offsets[c]);
    }
    const auto mix = [](const S& t, const S& a, const S& b) { return a + t * (b - a); };
    const auto at = [&](int i, int j, int k) {
        const Whole<S> row = look_up<S>(tables.order.data(), cells[0][i]);
        const Whole<S> column = look_up<S>(tables.order.data(), row + cells[1][j]);
        S gradient[4];
        look_up_four<S>(&tables.gradients[0].x, 3 * (column + cells[2][k]), gradient);
        return (offsets[0] - S(i)) * gradient[0] + (offsets[1] - S(j)) * gradient[1] +
               (offsets[2] - S(k)) * gradient[2];
    };
    S planes[2];
    for (int k = 0; k < 2; ++k)
        planes[k] = mix(shares[1], mix(shares[0], at(0, 0, k), at(1, 0, k)), mix(shares[0], at(0, 1, k), at(1, 1, k)));
    return mix(shares[2], planes[0], planes[1]);
}

/// Noise from 0 to 1; `generator` is 1, 2 or 3.
template <class S>
[[gnu::noinline]] S lattice_noise(const Vec3<S>& point, int generator) {
    if (generator == 3) return clamped(S(.5) * (S(1.59) * gradient_noise(point) + S(.985)), 0, 1);
    const lattice::NoiseTables& tables = lattice::noise_tables();
    const LatticeCorners<S> corners(tables.hash.data(), point);
    S sum(0);
    for (int corner = 0; corner < 8; ++corner)
        corners.visit(corner, [&](const Whole<S>& at, const S& weight, const Vec3<S>& offset) {
            alignas(32) int places[width<S>];
            store_places<S>(at, places);
            const double* from[width<S>];
            for (int k = 0; k < width<S>; ++k) from[k] = tables.random.data() + tables.low[places[k]];
            S numbers[4];
            load_four<S>(from, numbers);
            sum +=
                weight * (numbers[0] * S(.5) + numbers[1] * offset.x + numbers[2] * offset.y + numbers[3] * offset.z);
        });
    return clamped(generator == 1 ? sum + S(.5) : (sum + S(1.05242)) * S(.48985582), 0, 1);
}
/// Three independent noises without an offset. They are computed side by side for one point after the other, which
/// takes two thirds of the time of three times as many numbers sorted into lanes.
template <class S>
[[gnu::noinline]] Vec3<S> lattice_vector_noise(const Vec3<S>& point) {
    // Four numbers, in a register or in two: one for each noise, and one that is not used.
    constexpr int bytes = register_bytes < 32 ? register_bytes : 32, part = bytes / sizeof(double);
    using Part [[gnu::vector_size(bytes)]] = double;
    const lattice::NoiseTables& tables = lattice::noise_tables();
    const LatticeCorners<S> corners(tables.hash.data(), point);
    alignas(32) int places[8][width<S>];
    alignas(64) double weights[8][width<S>], offsets[3][2][width<S>], sums[width<S>][4];
    for (int corner = 0; corner < 8; ++corner)
        corners.visit(corner, [&](const Whole<S>& at, const S& weight, const Vec3<S>&) {
            store_places<S>(at, places[corner]), store_lanes(weights[corner], weight);
        });
    for (int c = 0; c < 3; ++c)
        for (int i = 0; i < 2; ++i) store_lanes(offsets[c][i], corners.offsets[c][i]);
    const double* from[width<S>];
    for (int k = 0; k < width<S>; ++k) {
        for (int c = 0; c < 4; c += part) {
            Part sum{};
            each_number<8>([&](std::size_t n) __attribute__((always_inline)) {
                constexpr int order[8]{0, 1, 3, 2, 6, 7, 5, 4};
                const int corner = order[n];
                const double* const row = tables.vectors[tables.low[places[corner][k]]].data() + c;
                const auto number = [&](int f) __attribute__((always_inline)) {
                    return load_register<Part>(row + 4 * f);
                };
                sum += weights[corner][k] *
                       (number(0) * .5 + number(1) * offsets[0][corner & 1][k] +
                        number(2) * offsets[1][corner >> 1 & 1][k] + number(3) * offsets[2][corner >> 2][k]);
            });
            std::memcpy(sums[k] + c, &sum, sizeof sum);
        }
        from[k] = sums[k];
    }
    S sum[4];
    load_four<S>(from, sum);
    return {sum[0], sum[1], sum[2]};
}
/// See lattice::turbulence().
template <class S>
S lattice_turbulence(const Vec3<S>& point, int octaves, float omega, float lambda, int generator, double step = 0) {
    const auto at = [&](const Vec3<S>& p, double fine) {
        return lattice::faded(fine * step, S(.5), [&] {
            const S noise = lattice_noise(p, generator);
            return generator > 1 ? S(2) * noise - S(.5) : noise;
        });
    };
    S sum = at(point, 1);
    if (generator > 1) sum = clamped(sum, 0, 1);
    double l = lambda, o = omega;
    for (int i = 2; i <= octaves; ++i, l *= lambda, o *= omega) sum += S(o) * at(scale(S(l), point), l);
    return sum;
}
/// See lattice::vector_turbulence().
template <class S>
Vec3<S> lattice_vector_turbulence(const Vec3<S>& point, int octaves, float omega, float lambda, double step = 0) {
    Vec3<S> sum = splat<S>(DVec3(0));
    double l = 1, o = 1;
    for (int i = 1; i <= octaves; ++i, l *= lambda, o *= omega) {
        const double left = lattice::left_of_noise(l * step);
        if (left == 0) continue;
        const Vec3<S> noise = lattice_vector_noise(scale(S(l), point));
        for (int c = 0; c < 3; ++c) sum[c] += noise[c] * S(o * left);
    }
    return sum;
}

/// Calls visit(pack, first, number) for points in packs; lanes without a point have that of the last one.
template <class S, class Visit>
STRAHL_INLINE void each_pack(const DVec3* points, int count, const Visit& visit) {
    for (int i = 0; i < count; i += width<S>) {
        alignas(64) double at[3][width<S>];
        for (int k = 0; k < width<S>; ++k)
            for (int c = 0; c < 3; ++c) at[c][k] = points[i + k < count ? i + k : count - 1][c];
        visit(Vec3<S>(load_lanes<S>(at[0]), load_lanes<S>(at[1]), load_lanes<S>(at[2])), i,
              count - i < width<S> ? count - i : width<S>);
    }
}
/// Writes value(pack) for points in packs.
template <class S, class Value>
STRAHL_INLINE void each_value(const DVec3* points, int count, double* values, const Value& value) {
    each_pack<S>(points, count, [&](const Vec3<S>& p, int first, int number) {
        alignas(64) double own[width<S>];
        store_lanes(own, value(p));
        std::copy_n(own, number, values + first);
    });
}
template <class S>
inline constexpr lattice::NoiseLanes noise_lanes{
    [](const DVec3* points, int count, int generator, double* values) {
        each_value<S>(points, count, values, [&](const Vec3<S>& p) { return lattice_noise(p, generator); });
    },
    [](const DVec3* points, int count, int octaves, float omega, float lambda, DVec3* ways) {
        each_pack<S>(points, count, [&](const Vec3<S>& p, int first, int number) {
            const Vec3<S> way = lattice_vector_turbulence(p, octaves, omega, lambda);
            alignas(64) double own[width<S>];
            for (int c = 0; c < 3; ++c) {
                store_lanes(own, way[c]);
                for (int k = 0; k < number; ++k) ways[first + k][c] = own[k];
            }
        });
    }};

/// Returns the share of the variance of an octave that a grid lacks: what has faded, and what is left out by straight
/// lines between points that are these parts of a cell apart. Fitted to 40,000 points of noise.
template <class S>
STRAHL_INLINE S lost_of_octave(const S& left, const S& step, const S& other) {
    S curved(0);
    for (const S& own : {step, other}) {
        const S t = min(max((own - S(.25)) * S(1 / .6), S(0)), S(1));
        curved = fma(S(.29) * t * t, fma(S(-2), t, S(3)), curved);
    }
    return S(1) - left * left * (S(1) - curved);
}

}  // namespace strahl::inline STRAHL_LEVEL
