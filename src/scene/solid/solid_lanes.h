// Solid patterns for a double or a pack of doubles: each lane has the bits that solid.h has for its point.
#pragma once
#include <numbers>

#include "num/noise_lanes.h"
#include "num/vec_math.h"
#include "scene/solid/fractal.h"
#include "scene/solid/solid.h"

namespace strahl {

inline constexpr double nearly_zero = 1e-10;  // POV-Ray's EPSILON

/// POV-Ray's table of 32768 random numbers from 0 to 1, of the Mersenne twister.
const double* random_numbers();

/// The middle and the frequency of one of the waves that `ripples` and `waves` sum up.
struct WaveSource {
    DVec3 centre;
    double frequency;
};
const std::array<WaveSource, 10>& wave_sources();

SolidDetails::Repeat repeat_of(const SolidPattern& own);
/// Does the kind itself begin anew at whole numbers, where that makes no difference?
bool goes_on(const SolidPattern& own);
/// Returns the value that spirals and `radial` have at a point before frequency, phase and wave.
double single_value(const SolidPattern& own, const DVec3& point, double step);

}  // namespace strahl

namespace strahl::inline STRAHL_LEVEL {

/// Returns f(x) lane by lane, for functions of the standard library.
template <class S, class F>
STRAHL_INLINE S by_lanes(const S& x, const F& f) {
    alignas(64) double values[width<S>];
    store_lanes(values, x);
    for (double& value : values) value = f(value);
    return load_lanes<S>(values);
}
template <class S>
STRAHL_INLINE DVec3 point_in_lane(const Vec3<S>& p, int k) {
    alignas(64) double at[3][width<S>];
    for (int c = 0; c < 3; ++c) store_lanes(at[c], p[c]);
    return {at[0][k], at[1][k], at[2][k]};
}
/// Returns f(point) lane by lane.
template <class S, class F>
STRAHL_INLINE S by_points(const Vec3<S>& p, const F& f) {
    alignas(64) double values[width<S>];
    for (int k = 0; k < width<S>; ++k) values[k] = f(point_in_lane(p, k));
    return load_lanes<S>(values);
}

template <class S>
STRAHL_INLINE S fractional(const S& x) {
    return x - floor(x);
}
/// sin(2 pi x).
template <class S>
STRAHL_INLINE S cycle(const S& x) {
    return by_lanes(fractional(x), [](double part) { return std::sin(2 * std::numbers::pi * part); });
}
template <class S>
STRAHL_INLINE S rise_and_fall(const S& x) {
    const S part = fractional(x);
    return select(part > S(.5), S(2) - S(2) * part, S(2) * part);
}
template <class S>
STRAHL_INLINE S rooted(const S& a, const S& b, const S& c = S(0)) {
    return sqrt(a * a + b * b + c * c);
}

/// Returns the point that turbulence moves a point to.
template <class S>
Vec3<S> moved(const SolidPattern& own, const Vec3<S>& p, const DVec3& by, double step) {
    const Vec3<S> way = lattice_vector_turbulence(p, static_cast<int>(own.octaves), static_cast<float>(own.omega),
                                                  static_cast<float>(own.lambda), step);
    return {p.x + S(by.x) * way.x, p.y + S(by.y) * way.y, p.z + S(by.z) * way.z};
}
template <class S>
S turbulent(const SolidPattern& own, const Vec3<S>& p, double step) {
    return lattice_turbulence(p, static_cast<int>(own.octaves), static_cast<float>(own.omega),
                              static_cast<float>(own.lambda), static_cast<int>(own.generator), step);
}
template <class S>
STRAHL_INLINE S noise_of(const SolidPattern& own, const Vec3<S>& p) {
    return lattice_noise(p, static_cast<int>(own.generator));
}

template <class S>
STRAHL_INLINE S along_axis(const SolidPattern& own, const Vec3<S>& p) {
    const DVec3 axis = normalize(own.axis);
    return S(axis.x) * p.x + S(axis.y) * p.y + S(axis.z) * p.z;
}

/// Finds the number of the cell that a coordinate is in.
template <class S>
STRAHL_INLINE Whole<S> cell_of(const S& x) {
    return whole_part(floor(within_lattice(x)));
}

/// The difference of the distances to the two nearest of points that are spread one to a cell.
template <class S>
[[gnu::noinline]] S crackle_at(const Vec3<S>& p) {
    const std::uint16_t* const hash = lattice::noise_tables().hash.data();
    const double* const random = random_numbers();
    Whole<S> cells[3];
    S within[3];
    for (int c = 0; c < 3; ++c) {
        cells[c] = cell_of(p[c] - S(nearly_zero));
        within[c] = p[c] - number_of<S>(cells[c]);
    }
    S nearest(1e9), second(1e9), least[3][5];  // the squares of the least ways into the cells along each axis
    for (int c = 0; c < 3; ++c)
        for (int i = -2; i <= 2; ++i) {
            const S way = i < 0 ? within[c] + S(-1 - i) : S(i) - within[c];
            least[c][i + 2] = i == 0 ? S(0) : way * way;
        }
    const auto visit = [&](const Whole<S>& column, int i, int j, int k) {
        if (none((least[0][i + 2] + least[1][j + 2] + least[2][k + 2]) * S(1 - 1e-9) < second)) return;
        alignas(32) int places[width<S>];
        store_places<S>(column ^ ((cells[2] + k) & 4095), places);
        const double* from[width<S>];
        for (int l = 0; l < width<S>; ++l) from[l] = random + hash[places[l]];
        S point[4];
        load_four<S>(from, point);
        const S x = p.x - (number_of<S>(cells[0] + i) + point[0]), y = p.y - (number_of<S>(cells[1] + j) + point[1]);
        const S z = p.z - (number_of<S>(cells[2] + k) + point[2]), squared = x * x + y * y + z * z;
        second = min(second, max(nearest, squared)), nearest = min(nearest, squared);
    };
    const auto column_of = [&](int i, int j) {
        return look_up<S>(hash, look_up<S>(hash, (cells[0] + i) & 4095) ^ ((cells[1] + j) & 4095));
    };
    constexpr int near_first[]{0, -1, 1};
    for (const int i : near_first)
        for (const int j : near_first) {
            const Whole<S> column = column_of(i, j);
            for (const int k : near_first) visit(column, i, j, k);
        }
    // POV-Ray looks at the nine cells beyond each face of these as well.
    for (int c = 0; c < 3; ++c)
        for (const int side : {-2, 2}) {
            if (none(least[c][side + 2] * S(1 - 1e-9) < second)) continue;
            for (const int a : near_first)
                for (const int b : near_first) {
                    const int i = c == 0 ? side : a, j = c == 1 ? side : c == 0 ? a : b, k = c == 2 ? side : b;
                    visit(column_of(i, j), i, j, k);
                }
        }
    return clamped(sqrt(second) - sqrt(nearest), 0, 1);
}

/// See quilt() and quilt_value() of solid.h.
template <class S>
STRAHL_INLINE Vec3<S> quilted_way(const Vec3<S>& p, double middle = 1, double border = 1) {
    const Vec3<S> way(fractional(p.x) - S(.5), fractional(p.y) - S(.5), fractional(p.z) - S(.5));
    const S t = rooted(way.x, way.y, way.z), rest = S(1) - t;
    return scale((t * t * t + S(3) * t * rest * rest * S(middle) + S(3) * t * t * rest * S(border)) * S(1.154700538),
                 way);
}
template <class S>
STRAHL_INLINE S value_of_quilt(const Vec3<S>& way) {
    return (abs(way.x) + abs(way.y) + abs(way.z)) / S(3);
}

/// The mean of a grain of granite at points that lie in their cells as this one does: on a floor at a whole number it
/// is not that of all points. Fitted to means of 400,000 points at random; off by up to .006.
template <class S>
STRAHL_INLINE S mean_of_grain(const SolidPattern& own, const Vec3<S>& p) {
    S mean(own.generator == 3 ? .228 : .202);
    const S swing(own.generator == 3 ? -.0137 : .0133);
    for (int c = 0; c < 3; ++c) {
        const S t = fractional(p[c]), inwards = S(2) * min(t, S(1) - t);
        mean += swing * (S(1) - S(2) * inwards * inwards * (S(3) - S(2) * inwards));
    }
    return mean;
}

template <class S>
S solid_value(const SolidPattern& own, const Vec3<S>& p);
template <class S>
inline constexpr SolidLanes solid_lanes{
    noise_lanes<S>,
    [](const SolidPattern& pattern, const DVec3* points, int count, double* values) {
        each_value<S>(points, count, values, [&](const Vec3<S>& p) { return solid_value(pattern, p); });
    },
    [](const FractalForm& form, const DVec3* points, int count, double* values) {
        each_value<S>(points, count, values, [&](const Vec3<S>& p) { return fractal_value(form, p.x, p.y); });
    }};
/// Returns the values of a pattern's function.
template <class S>
S function_values(const SolidPattern& own, const Vec3<S>& p) {
    DVec3 points[width<S>];
    alignas(64) double values[width<S>];
    for (int k = 0; k < width<S>; ++k) points[k] = point_in_lane(p, k);
    own.function->values_at(points, width<S>, values, solid_lanes<S>);
    return load_lanes<S>(values);
}

/// Returns the value before frequency, phase and wave, at a point that turbulence has moved. Where a kind sums up
/// several sizes of detail, those too fine for points that are `step` apart fade to their means.
template <class S>
[[gnu::noinline]] S raw_value(const SolidPattern& own, const Vec3<S>& p, double step) {
    const S zero(0), one(1);
    const double frequency = static_cast<float>(own.frequency), phase = static_cast<float>(own.phase);
    const Solid solid = own.function ? Solid::uniform : own.solid;
    switch (solid) {
        case Solid::agate: {
            const S value = S(.5) * (cycle(S(1.3) * turbulent(own, p, step) + S(1.1) * p.z) + one);
            return by_lanes(clamped(value, 0, 1), [](double v) { return std::pow(v, .77); });
        }
        case Solid::boxed:
            return max(zero, one - max(max(abs(p.x), abs(p.y)), abs(p.z)));
        case Solid::bozo:
        case Solid::bumps:
            return noise_of(own, p);
        case Solid::cells: {
            const auto along = [](const S& x) { return cell_of(x + S(nearly_zero)) & 4095; };
            const std::uint16_t* const hash = lattice::noise_tables().hash.data();
            const Whole<S> column = look_up<S>(hash, look_up<S>(hash, along(p.x)) ^ along(p.y));
            S value[4];
            look_up_four<S>(random_numbers(), look_up<S>(hash, column ^ along(p.z)), value);
            return value[0];
        }
        case Solid::crackle:
            return crackle_at(p);
        case Solid::cylindrical:
            return max(zero, one - rooted(p.x, p.z));
        case Solid::dents:
            return by_lanes(noise_of(own, p), [](double v) { return std::pow(v, 3); });
        case Solid::gradient: {
            const S along = along_axis(own, p);
            return select(along > one, fractional(along), along);
        }
        case Solid::granite: {
            S sum(0);
            for (int i = 0; i < 6; ++i) {
                const double fine = std::ldexp(1, i);
                const Vec3<S> grain = scale(S(4 * fine), p);
                const auto value = [&] {
                    const S n = noise_of(own, grain);
                    return own.generator > 1 ? min(S(.5), abs(one - S(2) * n)) : abs(S(.5) - n);
                };
                sum += lattice::faded(4 * fine * step, step > 0 ? mean_of_grain(own, grain) : zero, value) / S(fine);
            }
            return sum;
        }
        case Solid::leopard: {
            const auto sine = [](const S& x) { return by_lanes(x, [](double v) { return std::sin(v); }); };
            const S sum = (sine(p.x) + sine(p.y) + sine(p.z)) / S(3);
            return sum * sum;
        }
        case Solid::marble:
            return own.turbulence.x == 0 ? p.x : p.x + S(own.turbulence.x) * turbulent(own, p, step);
        case Solid::onion:
            return fractional(rooted(p.x, p.y, p.z));
        case Solid::planar:
            return max(zero, one - abs(p.y));
        case Solid::quilted:
            return value_of_quilt(quilted_way(p));
        case Solid::ripples:
        case Solid::waves: {
            S sum(0);
            for (const auto& [centre, pace] : wave_sources()) {
                const double faster = solid == Solid::waves ? pace : 1;
                const S away = rooted(p.x - S(centre.x), p.y - S(centre.y), p.z - S(centre.z));
                sum += cycle(away * S(frequency) * S(faster) + S(phase)) / S(faster);
            }
            return solid == Solid::waves ? S(.2) * (S(2.5) + sum / S(10)) : S(.5) * (one + sum / S(10));
        }
        case Solid::spherical:
            return max(zero, one - rooted(p.x, p.y, p.z));
        case Solid::wood: {
            if (own.turbulence == DVec3(0)) return rooted(p.x, p.y);
            const Vec3<S> to = moved(own, p, DVec3(1), step);
            return rooted(p.x + cycle((p.x + (to.x - p.x)) * S(own.turbulence.x)),
                          p.y + cycle((p.y + (to.y - p.y)) * S(own.turbulence.y)));
        }
        case Solid::wrinkles: {
            S sum(0);
            for (int i = 0; i < 10; ++i) {
                const double fine = std::ldexp(1, i);
                sum += lattice::faded(fine * step, S(.5),
                                      [&] {
                                          const S n = noise_of(own, scale(S(fine), p));
                                          return own.generator > 1 ? clamped(S(2) * n - S(.5), 0, 1) : n;
                                      }) /
                       S(fine);
            }
            return sum / S(2);
        }
        case Solid::radial:
        case Solid::spiral1:
        case Solid::spiral2:
        case Solid::uniform:
            if (own.function) return function_values(own, p);
            return by_points(p, [&](const DVec3& point) { return single_value(own, point, step); });
    }
    return zero;
}

/// Calls find(points), with the origin in place of points that have no digits left for where in a cell they are; the
/// result is 0 there.
template <class S, class Find>
STRAHL_INLINE auto within_reach(const Vec3<S>& p, const Find& find) {
    const S reach(1e9);
    const Mask<S> near = (abs(p.x) <= reach) & (abs(p.y) <= reach) & (abs(p.z) <= reach);
    const auto found = find(select(near, p, splat<S>(DVec3(0))));
    return select(near, found, decltype(found)(S(0)));
}
template <class S>
STRAHL_INLINE Vec3<S> place_of(const SolidPattern& own, const Vec3<S>& p, double step = 0) {
    const bool moves_itself = own.solid == Solid::marble || own.solid == Solid::wood;
    return own.turbulence == DVec3(0) || moves_itself ? p : moved(own, p, own.turbulence, step);
}

/// Returns a value with its frequency and phase.
template <class S>
STRAHL_INLINE S repeated(const SolidPattern& own, const S& value) {
    return own.frequency == 0 ? value : value * S(static_cast<float>(own.frequency)) + S(static_cast<float>(own.phase));
}
/// Returns the value that comes of it.
template <class S>
[[gnu::noinline]] S waved(const SolidPattern& own, S value) {
    const double period = 1.00001;
    if (own.frequency != 0 && any(!(abs(value) < S(period))))
        value = by_lanes(value, [&](double v) { return std::fmod(v, period); });
    value = select(value < S(0), fractional(value), value);
    switch (static_cast<int>(own.wave)) {
        case 1:
            value = rise_and_fall(value);
            break;
        case 2:
            value = (S(1) + cycle(value)) / S(2);
            break;
        case 3:
            value = abs(cycle(value / S(2)));
            break;
        case 4:
            value = value * value * (S(3) - S(2) * value);
            break;
        default:
            break;
    }
    return select(value - value == S(0), clamped(value, 0, 1), S(0));  // 0 if it is not finite
}
/// Returns the value at a point that turbulence has moved.
template <class S>
S value_of(const SolidPattern& own, const Vec3<S>& p) {
    return waved(own, repeated(own, raw_value(own, p, 0)));
}
/// See value_at() of solid.h.
template <class S>
[[gnu::noinline]] S solid_value(const SolidPattern& own, const Vec3<S>& p) {
    return within_reach(p, [&](const Vec3<S>& near) { return value_of(own, place_of(own, near)); });
}

/// See smoothed_value() of solid.h.
template <class S>
[[gnu::noinline]] S smoothed_solid(const SolidPattern& own, const Vec3<S>& point, double step) {
    const auto find = [&](const Vec3<S>& near) {
        const Vec3<S> p = place_of(own, near, step);
        S value;
        if (!own.function && goes_on(own))
            value = own.solid == Solid::onion ? rooted(p.x, p.y, p.z) : along_axis(own, p);
        else
            value = raw_value(own, p, step);
        value = repeated(own, value);
        if (repeat_of(own) == SolidDetails::Repeat::never) value = waved(own, value);
        return select(value - value == S(0), value, S(0));
    };
    return within_reach(point, find);
}

/// Returns what values add to a normal, by their differences around a point that turbulence has moved.
template <class S>
Vec3<S> slope_of(const SolidPattern& own, const Vec3<S>& p) {
    // The corners of a tetrahedron around the point.
    constexpr DVec3 corners[4]{{0.942809041582063366, -1. / 3, 0},
                               {-0.471404520791031683, -1. / 3, 0.816496580927726033},
                               {-0.471404520791031683, -1. / 3, -0.816496580927726033},
                               {0, 1, 0}};
    Vec3<S> sum = splat<S>(DVec3(0));
    for (const DVec3& corner : corners) {
        const S value = S(5) * value_of(own, p + splat<S>(.02 * corner));
        for (int c = 0; c < 3; ++c) sum[c] -= value * S(corner[c]);
    }
    return sum;
}
/// Returns what a pattern adds to a normal at a point that turbulence has moved.
template <class S>
Vec3<S> bend_of(const SolidPattern& own, const Vec3<S>& p, const Vec3<S>& normal) {
    Vec3<S> sum = splat<S>(DVec3(0));
    if (own.function) {
        alignas(64) double bends[3][width<S>];
        for (int k = 0; k < width<S>; ++k) {
            const auto bend = own.function->bend_at(point_in_lane(p, k), point_in_lane(normal, k));
            if (!bend) return slope_of(own, p);
            for (int c = 0; c < 3; ++c) bends[c][k] = (*bend)[c];
        }
        return {load_lanes<S>(bends[0]), load_lanes<S>(bends[1]), load_lanes<S>(bends[2])};
    }
    switch (own.solid) {
        case Solid::bumps:
            return lattice_vector_noise(p);
        case Solid::dents:
            return scale(raw_value(own, p, 0), lattice_vector_noise(p));
        case Solid::wrinkles:
            for (int i = 0; i < 10; ++i) {
                const double fine = std::ldexp(1, i);
                const Vec3<S> n = lattice_vector_noise(scale(S(fine), p));
                for (int c = 0; c < 3; ++c) sum[c] += abs(n[c]) / S(fine);
            }
            return sum;
        case Solid::quilted:
            return quilted_way(p);
        case Solid::ripples:
        case Solid::waves:
            for (const auto& [centre, pace] : wave_sources()) {
                const double faster = own.solid == Solid::waves ? pace : 1;
                const Vec3<S> way = p - splat<S>(centre);
                const S away = rooted(way.x, way.y, way.z);
                const S push = cycle(away * S(own.frequency) * S(faster) + S(own.phase)) / (away * S(10) * S(faster));
                sum = sum + scale(select(away > S(0), push, S(0)), way);
            }
            return sum;
        default:
            return slope_of(own, p);
    }
}
/// See bend_at() of solid.h.
template <class S>
[[gnu::noinline]] Vec3<S> solid_bend(const SolidPattern& own, const Vec3<S>& point, const Vec3<S>& normal) {
    return within_reach(point, [&](const Vec3<S>& near) { return bend_of(own, place_of(own, near), normal); });
}

}  // namespace strahl::inline STRAHL_LEVEL
