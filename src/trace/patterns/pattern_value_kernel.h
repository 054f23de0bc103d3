// Values of patterns. scene/pattern.h defines the patterns.
#pragma once
#include "scene/solid/solid_lanes.h"
#include "trace/patterns/image_kernel.h"
#include "trace/patterns/mesh_places_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns x - floor(x).
template <class S>
STRAHL_INLINE S fraction(const S& x) {
    return x - floor(x);
}
/// Returns x mod 289, exact for whole numbers up to 2.8 million in float: there a half over 289 is more than the
/// rounding.
template <class S>
STRAHL_INLINE S mod_289(const S& x) {
    using T = Element<S>;
    return fma(S(T(-289)), floor((x + S(T(.5))) * S(T(1) / T(289))), x);
}
/// Returns the permutation polynomial of whole numbers from 0 to 577.
template <class S>
STRAHL_INLINE S permuted(const S& number) {
    const S x = select(number < S(289), number, number - S(289));
    return mod_289(fma(S(34), x, S(1)) * x);
}
/// Returns the scalar product of the gradient at a corner with this hash and the vector from the corner.
template <class S>
STRAHL_INLINE S slope_at_corner(const S& hash, const S& x, const S& y, const S& z) {
    using T = Element<S>;
    // (The hash + 1/2) / 7 is never so near to a whole number that rounding would matter.
    const S sevens = floor((hash + S(T(.5))) * S(T(1) / T(7))), forties = floor((sevens + S(T(.5))) * S(T(1) / T(7)));
    const S a = fma(S(-7), sevens, hash), b = fma(S(-7), forties, sevens);
    return fma(a - S(3), x, fma(b - S(3), y, (forties - S(T(2.5))) * S(T(1.2)) * z));
}
template <class S>
STRAHL_INLINE S mix(const S& a, const S& b, const S& t) {
    return fma(t, b - a, a);
}
template <class S>
[[gnu::noinline]] S noise_at(const Vec3<S>& p) {
    using T = Element<S>;
    Vec3<S> cell, from, t;
    for (int c = 0; c < 3; ++c) {
        const S low = floor(p[c]);
        from[c] = p[c] - low, cell[c] = mod_289(low);
        const S f = from[c];
        t[c] = f * f * f * fma(f, fma(f, S(6), S(-15)), S(10));
    }
    S along_x[2];
    for (int i = 0; i < 2; ++i) {
        const S x = from.x - S(T(i)), hash_x = permuted(cell.x + S(T(i)));
        S along_y[2];
        for (int j = 0; j < 2; ++j) {
            const S y = from.y - S(T(j)), hash_y = permuted(hash_x + cell.y + S(T(j)));
            S along_z[2];
            for (int k = 0; k < 2; ++k)
                along_z[k] = slope_at_corner(permuted(hash_y + cell.z + S(T(k))), x, y, from.z - S(T(k)));
            along_y[j] = mix(along_z[0], along_z[1], t.z);
        }
        along_x[i] = mix(along_y[0], along_y[1], t.y);
    }
    return mix(along_x[0], along_x[1], t.x) * S(T(1) / T(6));
}
template <class S>
STRAHL_INLINE S octaves_at(const OctavesKernel<Element<S>>& octaves, const Vec3<S>& p) {
    using T = Element<S>;
    S sum(0);
    T strength = 1, fineness = 1;
    for (int i = 0; i < octaves.count; ++i) {
        sum = fma(S(strength), noise_at(scale(S(fineness), p)), sum);
        strength *= octaves.omega, fineness *= octaves.lambda;
    }
    return sum;
}

/// Returns how many times finer than the first octave the finest one is that has more than `least` of its strength.
template <class T>
T finest_octave(const OctavesKernel<T>& octaves, T least) {
    T finest = 1, strength = 1;
    for (int i = 1; i < octaves.count && octaves.lambda > T(1) && (strength *= octaves.omega) >= least; ++i)
        finest *= octaves.lambda;
    return finest;
}
/// Returns how much of an octave is left, from 1 to 0, if points are `step` of its cells apart. All of it is if its
/// cells have two points; none if they are smaller than one and a half steps (A. Apodaca and L. Gritz, "Advanced
/// RenderMan", 1999, chapter 12, on frequency clamping).
template <class S>
STRAHL_INLINE S left_of_octave(const S& step) {
    using T = Element<S>;
    return min(max(S(T(1.5)) - step, S(0)), S(1));
}
/// Returns the value of noise, layers or rings before it is folded or limited, without octaves finer than points of a
/// grid which are `step` apart.
template <class S>
[[gnu::noinline]] S smoothed_value(const PatternKernel<Element<S>>& pattern, const Vec3<S>& p, const S& step) {
    using T = Element<S>;
    const OctavesKernel<T>& octaves = pattern.octaves;
    const bool noise = pattern.form == PatternForm::noise;
    S sum(0);
    T strength = noise ? T(1) : pattern.turbulence, fineness = 1;
    for (int i = 0; i < octaves.count && strength != 0; ++i) {
        const S left = left_of_octave(S(fineness) * step);
        if (!none(left > S(0))) sum = fma(S(strength) * left, noise_at(scale(S(fineness), p)), sum);
        strength *= octaves.omega, fineness *= octaves.lambda;
    }
    if (noise) return sum + S(T(.5));
    return sum + (pattern.form == PatternForm::layers ? p.x : sqrt(fma(p.x, p.x, p.y * p.y)));
}
/// Returns the variance of an octave over an area, as a share of that over all of space: less where the area lies in a
/// plane of the lattice, on which floors often are. Fitted to 2,000,000 points; off by up to 3 %.
template <class S>
STRAHL_INLINE S variance_in_plane(const Vec3<S>& p, const Vec3<S>& across, const Vec3<S>& down) {
    using T = Element<S>;
    const S one(1), two(T(2));
    S share(1);
    for (int c = 0; c < 3; ++c) {
        const S within = max(one - two * (abs(across[c]) + abs(down[c])), S(0));
        const S part = p[c] - floor(p[c]), t = two * min(part, one - part);
        share = share * fma(S(T(-.143)) * within, fma(S(T(-2)) * t * t, fma(S(T(-2)), t, S(T(3))), one), one);
    }
    return share;
}
/// Says what a grid lacks of octaves.
template <class S>
struct LostOctaves {
    S spread;  // the standard deviation of what smoothed_value leaves out
    S loose;   // the share of their variation over areas beside each other that the grid does not show, from 0 to 1
    S unseen;  // see ValueGrid
};
/// Finds that for a grid over an area around p whose sides, of these lengths, have steps as long as these. Over an
/// area, octaves with many cells vary little.
template <class S>
LostOctaves<S> lost_octaves(const PatternKernel<Element<S>>& pattern, const Vec3<S>& p, const Vec3<S>& across,
                            const Vec3<S>& down, const S (&steps)[2], const S (&lengths)[2]) {
    using T = Element<S>;
    constexpr T variance = T(.0121);  // of one octave, over all of space
    const OctavesKernel<T>& octaves = pattern.octaves;
    const S one(1), step = max(steps[0], steps[1]);
    S squares(0), missed(0), all(0), unseen(0);
    T strength = pattern.form == PatternForm::noise ? T(1) : pattern.turbulence, fineness = 1, total = 0;
    for (int i = 0; i < octaves.count && strength != 0; ++i) {
        const S fine(fineness), own = fine * step;
        const S lost = lost_of_octave(left_of_octave(own), fine * steps[0], fine * steps[1]);
        const S flat = variance_in_plane(scale(fine, p), scale(fine, across), scale(fine, down));
        squares = fma(S(strength * strength * variance) * flat, lost, squares);
        const S cells = max(fine * lengths[0], one) * max(fine * lengths[1], one);
        const S varies = S(strength * strength) / cells, share = min(own, one);
        missed = fma(varies * share, share, missed), all = all + varies;
        unseen = fma(varies, unseen_of_cell(own, false), unseen), total += strength * strength;
        strength *= octaves.omega, fineness *= octaves.lambda;
    }
    return {sqrt(squares), select(all > S(0), sqrt(missed / all), min(step, one)),
            total > 0 ? unseen / S(total) : S(0)};
}

/// Returns whole numbers modulo 2.
template <class S>
STRAHL_INLINE S parity(const S& x) {
    return fma(S(-2), floor(x * S(Element<S>(.5))), x);
}
/// Returns 0 in the mortar, 1 in a brick. One brick with its mortar is 1 long, wide and high.
template <class S>
STRAHL_INLINE S brick_at(const Vec3<Element<S>>& mortar, const Vec3<S>& p) {
    using T = Element<S>;
    const S half = S(T(.5)), shift = select(fraction(p.y * half) > half, half, S(0));
    const Mask<S> brick = (fraction(p.y) > S(mortar.y)) & (fraction(p.x + shift) > S(mortar.x)) &
                          (fraction(p.z + (half - shift)) > S(mortar.z));
    return select(brick, S(1), S(0));
}
/// Returns a wave of period 1, from 0 up to 1 and down again.
template <class S>
STRAHL_INLINE S wave(const S& x) {
    return S(1) - abs(fma(S(2), fraction(x), S(-1)));
}

/// Returns the first `count` components of find(given), which computes in double, as many lanes at once as it can.
template <int count, class S, int n, class Find>
STRAHL_INLINE Vec3<S> in_double(const Vec3<S> (&given)[n], const Find& find) {
    using T = Element<S>;
    using D = Widest<double>;
    alignas(64) T at[3 * n][width<S>];
    for (int i = 0; i < 3 * n; ++i) store_lanes(at[i], given[i / 3][i % 3]);
    for (int k = 0; k < width<S>; k += width<D>) {
        Vec3<D> own_given[n];
        for (int i = 0; i < 3 * n; ++i) own_given[i / 3][i % 3] = load_converted<D>(at[i] + k);
        const Vec3<D> found = find(own_given);
        for (int c = 0; c < count; ++c) {
            alignas(64) double own[width<D>];
            store_lanes(own, found[c]);
            for (int i = 0; i < width<D>; ++i) at[c][k + i] = static_cast<T>(own[i]);
        }
    }
    return {load_lanes<S>(at[0]), load_lanes<S>(at[1]), load_lanes<S>(at[2])};
}

/// Returns the value of a pattern at a point of its space, from 0 to 1, or an image's brightness; 0 where coordinates
/// are too large for the number type.
template <class S>
[[gnu::noinline]] S value_at(const PatternKernel<Element<S>>& pattern, const Vec3<S>& p) {
    using T = Element<S>;
    S value(0);
    const auto moved = [&](const S& x) {
        return pattern.turbulence == 0 ? x : fma(S(pattern.turbulence), octaves_at(pattern.octaves, p), x);
    };
    switch (pattern.form) {
        case PatternForm::checker:
            value = parity(parity(floor(p.x)) + parity(floor(p.y)) + parity(floor(p.z)));
            break;
        case PatternForm::brick:
            value = brick_at(pattern.mortar, p);
            break;
        case PatternForm::ramp:
            value = max(fraction(p.x) - S(pattern.border), S(0));
            break;
        case PatternForm::noise:
            value = min(max(octaves_at(pattern.octaves, p) + S(T(.5)), S(0)), S(1));
            break;
        case PatternForm::layers:
            value = wave(moved(p.x));
            break;
        case PatternForm::rings:
            value = wave(moved(sqrt(fma(p.x, p.x, p.y * p.y))));
            break;
        case PatternForm::image: {
            const Vec3<S> color = image_color(pattern.image, p);
            return fma(S(T(brightness[0])), color.x, fma(S(T(brightness[1])), color.y, S(T(brightness[2])) * color.z));
        }
        case PatternForm::solid:
            return in_double<1>({p},
                                [&]<class D>(const Vec3<D>* at) { return Vec3<D>(solid_value(*pattern.solid, *at)); })
                .x;
        case PatternForm::constant:
            break;
    }
    return select((value >= S(0)) & (value <= S(1)), value, S(0));
}

/// Returns where a point of the world, or a place by uv, is in the pattern's space.
template <class S>
STRAHL_INLINE Vec3<S> in_space_of(const PatternKernel<Element<S>>& pattern, const Vec3<S>& position) {
    Vec3<S> p;
    for (int c = 0; c < 3; ++c) p[c] = dot(splat<S>(pattern.rows[c]), position) + S(pattern.offset[c]);
    return p;
}

}  // namespace strahl::inline STRAHL_LEVEL
