// The patterns themselves. scene/pattern.h says what they are.
#pragma once
#include "trace/image_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

/// x - floor(x)
template <class S>
STRAHL_INLINE S fraction(const S& x) {
    return x - floor(x);
}
/// x mod 289, exact for whole numbers up to 2.8 million in float: there a half over 289 is more than the rounding.
template <class S>
STRAHL_INLINE S mod_289(const S& x) {
    using T = Element<S>;
    return fma(S(T(-289)), floor((x + S(T(.5))) * S(T(1) / T(289))), x);
}
/// The permutation polynomial, of whole numbers from 0 to 577.
template <class S>
STRAHL_INLINE S permuted(const S& number) {
    const S x = select(number < S(289), number, number - S(289));
    return mod_289(fma(S(34), x, S(1)) * x);
}
/// The gradient of a corner with this hash times the way from the corner.
template <class S>
STRAHL_INLINE S slope_at_corner(const S& hash, const S& x, const S& y, const S& z) {
    using T = Element<S>;
    // The hash and a half over 7 is never so near to a whole number that rounding would matter.
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
STRAHL_INLINE S octaves_at(const PatternKernel<Element<S>>& pattern, const Vec3<S>& p) {
    using T = Element<S>;
    S sum(0);
    T strength = 1, fineness = 1;
    for (int i = 0; i < pattern.octaves; ++i) {
        sum = fma(S(strength), noise_at(scale(S(fineness), p)), sum);
        strength *= pattern.omega, fineness *= pattern.lambda;
    }
    return sum;
}

/// Whole numbers modulo 2.
template <class S>
STRAHL_INLINE S parity(const S& x) {
    return fma(S(-2), floor(x * S(Element<S>(.5))), x);
}
/// 0 in the mortar, 1 in a brick. One brick with its mortar is 1 long, wide and high.
template <class S>
STRAHL_INLINE S brick_at(const Vec3<Element<S>>& mortar, const Vec3<S>& p) {
    using T = Element<S>;
    const S half = S(T(.5)), shift = select(fraction(p.y * half) > half, half, S(0));
    const Mask<S> brick = (fraction(p.y) > S(mortar.y)) & (fraction(p.x + shift) > S(mortar.x)) &
                          (fraction(p.z + (half - shift)) > S(mortar.z));
    return select(brick, S(1), S(0));
}
/// From 0 up to 1 and down again.
template <class S>
STRAHL_INLINE S wave(const S& x) {
    return S(1) - abs(fma(S(2), fraction(x), S(-1)));
}

/// The value of a pattern at a point of its space, from 0 to 1, or an image's brightness; where coordinates are too large
/// for numbers 0.
template <class S>
[[gnu::noinline]] S value_at(const PatternKernel<Element<S>>& pattern, const Vec3<S>& p) {
    using T = Element<S>;
    S value(0);
    const auto moved = [&](const S& x) {
        return pattern.turbulence == 0 ? x : fma(S(pattern.turbulence), octaves_at(pattern, p), x);
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
            value = min(max(octaves_at(pattern, p) + S(T(.5)), S(0)), S(1));
            break;
        case PatternForm::layers:
            value = wave(moved(p.x));
            break;
        case PatternForm::rings:
            value = wave(moved(sqrt(fma(p.x, p.x, p.y * p.y))));
            break;
        case PatternForm::image: {
            const Vec3<S> color = image_color(pattern.image, p);
            return fma(S(T(brightness[0])), color.x,
                       fma(S(T(brightness[1])), color.y, S(T(brightness[2])) * color.z));
        }
        case PatternForm::constant:
            break;
    }
    return select((value >= S(0)) & (value <= S(1)), value, S(0));
}

/// Where points of the world, which are on these surfaces, are in the pattern's space.
template <class S>
STRAHL_INLINE Vec3<S> place_of(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                               Vec3<S> position, const S& surface) {
    if (pattern.form == PatternForm::image && pattern.image.map == ImageMap::uv)
        position = place_in_mesh(world, pattern.image, position, surface);
    Vec3<S> p;
    for (int c = 0; c < 3; ++c) p[c] = dot(splat<S>(pattern.rows[c]), position) + S(pattern.offset[c]);
    return p;
}

/// The colour of a pattern at points of the world, which are on these surfaces.
template <class S>
[[gnu::noinline]] Vec3<S> color_at(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                                   const Vec3<S>& position, const S& surface) {
    const Vec3<S> p = place_of(world, pattern, position, surface);
    if (pattern.form == PatternForm::image) return image_color(pattern.image, p);
    const S value = value_at(pattern, p);
    const auto* stop = world.stops + pattern.first_stop;
    Vec3<S> color = splat<S>(stop->color);
    for (int i = 1; i < pattern.stops; ++i) {
        const auto *const before = stop++, *const after = stop;
        const Mask<S> beyond = value > S(before->at);
        if (none(beyond)) break;
        // Two stops in one place are a jump: there, `per` is infinite.
        const S share = min((value - S(before->at)) * S(after->per), S(1)), rest = S(1) - share;
        for (int c = 0; c < 3; ++c)
            color[c] = select(beyond, fma(share, S(after->color[c]), rest * S(before->color[c])), color[c]);
    }
    return color;
}

/// The normal, bent; of length 1 or as it was.
template <class S>
[[gnu::noinline]] Vec3<S> bent_by(const BumpKernel<Element<S>>& bump, const Vec3<S>& position, const Vec3<S>& normal) {
    const auto& pattern = bump.pattern;
    Vec3<S> p, sum = splat<S>(Vec3<Element<S>>(0)), own;
    for (int c = 0; c < 3; ++c) {
        p[c] = dot(splat<S>(pattern.rows[c]), position) + S(pattern.offset[c]);
        own[c] = dot(splat<S>(bump.columns[c]), normal);
    }
    for (int i = 0; i < 4; ++i)
        sum = fma(value_at(pattern, p + splat<S>(bump.steps[i])), splat<S>(bump.bends[i]), sum);
    const Vec3<S> n = fma(sqrt(dot(own, own)), sum, normal);
    const S squared = dot(n, n), length = sqrt(squared);
    return select((squared > S(0)) & (squared < S(std::numeric_limits<Element<S>>::max())), scale(S(1) / length, n),
                  normal);
}

/// Calls visit(which, lanes) for each of the patterned materials in a pack.
template <class S, class Visit>
STRAHL_INLINE void each_pattern(const World<Element<S>>& world, const int* materials, const Visit& visit) {
    using T = Element<S>;
    alignas(64) T numbers[width<S>];
    for (int k = 0; k < width<S>; ++k) numbers[k] = static_cast<T>(materials[k]);
    const S number = load_lanes<S>(numbers);
    Mask<S> left = number >= S(static_cast<T>(world.first_pattern));
    while (any(left)) {
        const T own = lane(number, first(left));
        const Mask<S> lanes = left & (number == S(own));
        visit(static_cast<int>(own) - world.first_pattern, lanes);
        left = left & !lanes;
    }
}

template <class S>
void PatternCalls<S>::paint(const World<T>& world, const int* materials, const Vec3<S>& position,
                            const S& surface, MaterialKernel<S>& values) {
    each_pattern<S>(world, materials, [&](int which, Mask<S> lanes) {
        const PatternKernel<T>& pattern = world.patterns[which];
        const Vec3<S> color = color_at(world, pattern, position, surface);
        for (int c = 0; c < 3; ++c) {
            values.ambient[c] = select(lanes, S(pattern.ambient[c]) * color[c], values.ambient[c]);
            values.diffuse[c] = select(lanes, S(pattern.diffuse) * color[c], values.diffuse[c]);
        }
    });
}

template <class S>
Vec3<S> PatternCalls<S>::bent(const World<T>& world, const int* materials, const Vec3<S>& position,
                              const Vec3<S>& normal) {
    Vec3<S> all = normal;
    each_pattern<S>(world, materials, [&](int which, Mask<S> lanes) {
        if (!world.bumps[which].flat) all = select(lanes, bent_by(world.bumps[which], position, normal), all);
    });
    return all;
}

/// The piece of PatternCalls, in three whole or half numbers.
template <class S>
[[gnu::noinline]] Vec3<S> piece_at(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                                   const Vec3<S>& position, const S& surface) {
    using T = Element<S>;
    const Vec3<S> p = place_of(world, pattern, position, surface);
    const Vec3<S> whole(floor(p.x), floor(p.y), floor(p.z));
    const S zero(0);
    switch (pattern.form) {
        case PatternForm::checker:
            return whole;
        case PatternForm::brick: {
            const S half = S(T(.5)), shift = select(fraction(p.y * half) > half, half, zero);
            const S mortar = select(brick_at(pattern.mortar, p) > zero, zero, half);
            return {floor(p.x + shift), whole.y + mortar, floor(p.z + (half - shift))};
        }
        case PatternForm::ramp:
            return {whole.x, zero, zero};
        case PatternForm::image:
            if (pattern.image.map == ImageMap::spherical || pattern.image.map == ImageMap::cylindrical) break;
            return {whole.x, whole.y, zero};
        default:
            break;
    }
    return {zero, zero, zero};
}
template <class S>
S PatternCalls<S>::piece(const World<T>& world, const int* materials, const Vec3<S>& position, const S& surface) {
    S all(0);
    each_pattern<S>(world, materials, [&](int which, Mask<S> lanes) {
        const Vec3<S> p = piece_at(world, world.patterns[which], position, surface);
        // Square roots of primes: no two sums are the same as long as numbers have the digits.
        const S number = fma(S(T(1.4142135623730951)), p.x, fma(S(T(1.7320508075688772)), p.y, S(T(2.23606797749979)) * p.z));
        all = select(lanes, number, all);
    });
    return all;
}

template <class S>
Vec3<S> PatternCalls<S>::sky(const World<T>& world, const Vec3<S>& direction) {
    return color_at(world, *world.sky, direction, S(-1));
}

template <class S>
void PatternCalls<S>::filter(const World<T>& world, int material, const S& surface, const Ray<S>& ray, const S& t,
                             Mask<S> lanes, Vec3<S>& share) {
    if (none(lanes)) return;
    const PatternKernel<T>& pattern = world.patterns[material - world.first_pattern];
    const Vec3<S> color = color_at(world, pattern, fma(t, ray.direction, ray.origin), surface);
    for (int c = 0; c < 3; ++c)
        share[c] = select(lanes, min(share[c] * (S(pattern.refraction) * color[c]), S(largest_gain)), share[c]);
}

}  // namespace strahl::inline STRAHL_LEVEL
