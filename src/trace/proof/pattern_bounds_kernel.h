// The code of error bounds of patterns' colours. scene/pattern.h defines the patterns.
#pragma once
#include "trace/patterns/pattern_kernel.h"
#include "trace/proof/pattern_bounds.h"
#include "trace/proof/span_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// A place in a pattern's space, and an error bound of each coordinate.
template <class S>
struct OffPlace {
    Vec3<S> p, off;
};
/// Finds the place of a position. A row's length carries over the error of the position. Roundings: three products and
/// two sums count 3/2 u, and the offset's sum 1/2.
template <class S>
STRAHL_INLINE OffPlace<S> off_place(const PatternKernel<Element<S>>& pattern, const Vec3<S>& position, const S& away) {
    using T = Element<S>;
    constexpr T u = unit_error<S>;
    OffPlace<S> own{in_space_of(pattern, position), {}};
    const S size = norm1(position);
    for (int c = 0; c < 3; ++c) {
        const Vec3<T>& row = pattern.rows[c];
        const T length = std::sqrt(dot(row, row)) * T(1.001), sum = std::abs(row.x) + std::abs(row.y) + std::abs(row.z);
        own.off[c] = fma(S(length), away, S(pattern.slack.turned + T(2.1) * u * sum) * size) +
                     S(pattern.slack.moved + u * std::abs(pattern.offset[c]));
    }
    return own;
}

/// Finds the place of a position by uv. The same weights carry a point of the exact triangle to one of the computed
/// triangle no further off than its corners are, so the place is off by the errors of the weights. A corner's weight
/// grows by the length of the side across it over twice the area. Roundings: relative to the vector q from a corner,
/// the vector across a side has 9/2 u and 2 u times how narrow the triangle is, the division 3 u and 4 times that; the
/// mean 3/2 u of what is summed.
template <class S>
[[gnu::noinline]] OffPlace<S> off_place_by_uv(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                                              const Vec3<S>& position, const S& surface, const S& away,
                                              const Slack<Element<S>>& slack) {
    using T = Element<S>;
    constexpr T u = unit_error<S>;
    const PlacedTriangles<S> t = placed_triangles(world, pattern.places, surface);
    const Vec3<S> q = position - t.corner, n = cross(t.e, t.f), place = place_in(t, position);
    const S e_long = sqrt(dot(t.e, t.e)), f_long = sqrt(dot(t.f, t.f)), width = e_long + f_long;
    const S tall = sqrt(dot(n, n)), narrow = e_long * f_long / tall;
    const S own = S(T(1.01) * slack.share) * (S(3) * norm1(t.corner) + norm1(t.e) + norm1(t.f));
    const S off = (away + own + S(u) * (S(5) + S(4) * narrow) * (norm1(q) + width)) / tall;
    const Mask<S> known = (tall * tall > S(std::numeric_limits<T>::min() / u)) & (narrow < S(T(1e-4) / u));
    const S of_e = off * f_long, of_f = off * e_long;
    S place_off[2];
    for (int j = 0; j < 2; ++j) {
        const S e = abs(t.on_e[j]), f = abs(t.on_f[j]);
        const S sum = fma(of_e, e, fma(of_f, f, S(2 * u) * (e + f + abs(t.place[j]))));
        place_off[j] = select(known, sum, S(std::numeric_limits<T>::infinity()));
    }
    OffPlace<S> own_place{in_space_of(pattern, place), {}};
    const S size = abs(place.x) + abs(place.y);
    for (int c = 0; c < 3; ++c) {
        const Vec3<T>& row = pattern.rows[c];
        const T x = std::abs(row.x), y = std::abs(row.y);
        const S moved = fma(S(T(1.001) * x), place_off[0], S(T(1.001) * y) * place_off[1]);
        own_place.off[c] = fma(S(pattern.slack.turned + T(2.1) * u * (x + y)), size,
                               moved + S(pattern.slack.moved + u * std::abs(pattern.offset[c])));
    }
    return own_place;
}
/// Finds the place of a surface's position that is off by `away`.
template <class S>
STRAHL_INLINE OffPlace<S> off_place(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                                    const Vec3<S>& position, const S& surface, const S& away,
                                    const Slack<Element<S>>& slack) {
    if (pattern.by_uv) [[unlikely]]
        return off_place_by_uv(world, pattern, position, surface, away, slack);
    return off_place(pattern, position, away);
}

/// Returns the lanes in which a coordinate may be on the other side of a whole number.
template <class S>
STRAHL_INLINE Mask<S> near_whole(const S& x, const S& off) {
    const S from = fraction(x);
    return !(min(from, S(1) - from) > off);
}

/// Returns the lanes in which it is certain whether a place is in a brick or in the mortar: that is where its row is
/// certain, or where its height is in the mortar. The mortar's share is rounded once, sums with the shift too.
template <class S>
STRAHL_INLINE Mask<S> brick_told(const Vec3<Element<S>>& mortar, const OffPlace<S>& place) {
    using T = Element<S>;
    constexpr T u = unit_error<S>;
    const auto& [p, off] = place;
    const S half = S(T(.5)), shift = select(fraction(p.y * half) > half, half, S(0));
    const Vec3<S> moved(p.x + shift, p.y, p.z + (half - shift));
    Mask<S> in[3], out[3];
    for (int c = 0; c < 3; ++c) {
        const S from = fraction(moved[c]), wrong = fma(S(u), abs(moved[c]) + S(mortar[c] + 1), off[c]);
        in[c] = (from - wrong > S(mortar[c])) & (from + wrong < S(1));
        out[c] = (from + wrong < S(mortar[c])) & (from - wrong > S(0));
    }
    const Mask<S> in_row = !near_whole(p.y, off.y);
    return (in_row & in[0] & in[1] & in[2]) | out[1] | (in_row & (out[0] | out[2]));
}

/// Bounds the error of a sum of octaves of noise.
///
/// Noise changes by at most 2.32 per length along each axis: half the mean of the corners' slopes along it, each at
/// most 1, makes .4375; the change of the weights, at most 15/8, counts times half the difference between both sides,
/// which is at most 1 along the axis and 1 across. The value itself is at most .75. Roundings: weights of corners have
/// 17 u at most and count up to 15 times at each of three steps, slopes and means 25 u; of that a sixth. Places have 1
/// for each octave before. Beyond 2^40 cells lack the digits for their hashes.
template <class S>
[[gnu::noinline]] S octaves_error(const OctavesKernel<Element<S>>& octaves, const OffPlace<S>& place) {
    using T = Element<S>;
    constexpr T u = unit_error<S>;
    const S off = place.off.x + place.off.y + place.off.z, size = norm1(place.p);
    S error(0);
    Mask<S> known = first_lanes<S>(width<S>);
    T strength = 1, fineness = 1;
    for (int i = 0; i < octaves.count; ++i) {
        const S own = S(T(2.33) * fineness) * fma(S(T(i + 1) * u), size, off);
        error = fma(S(strength), select(own < S(T(1.5)), own, S(T(1.5))) + S(T(160 + 2 * octaves.count) * u), error);
        known = known & (S(fineness) * size < S(T(0x1p40)));
        strength *= octaves.omega, fineness *= octaves.lambda;
    }
    return select(known, error, S(std::numeric_limits<T>::infinity()));
}

/// Bounds the error of a pattern's value; infinite where it may have any. The slopes of waves are 2 and -2; waves have
/// 4 u.
template <class S>
[[gnu::noinline]] S value_error(const PatternKernel<Element<S>>& pattern, const OffPlace<S>& place) {
    using T = Element<S>;
    constexpr T u = unit_error<S>;
    const S any(std::numeric_limits<T>::infinity());
    const auto& [p, off] = place;
    const auto wave_error = [&](const S& x, const S& wrong) {
        const S moved = pattern.turbulence == 0 ? S(0) : S(pattern.turbulence) * octaves_error(pattern.octaves, place);
        return fma(S(2), wrong + moved + S(u) * abs(x), S(4 * u));
    };
    switch (pattern.form) {
        case PatternForm::checker:
            return select(near_whole(p.x, off.x) | near_whole(p.y, off.y) | near_whole(p.z, off.z), any, S(0));
        case PatternForm::brick:
            return select(brick_told(pattern.mortar, place), S(0), any);
        case PatternForm::ramp:
            return select(near_whole(p.x, off.x), any, off.x + S(2 * u));
        case PatternForm::noise:
            return octaves_error(pattern.octaves, place) + S(u);
        case PatternForm::layers:
            return wave_error(p.x, off.x);
        case PatternForm::rings: {
            const S radius = sqrt(fma(p.x, p.x, p.y * p.y));
            return wave_error(radius, fma(S(2 * u), radius, off.x + off.y));
        }
        case PatternForm::image:
        case PatternForm::solid:
            break;
        case PatternForm::constant:
            return S(0);
    }
    return any;
}

/// Bounds the error of an image's colour: pixels next to each other differ by no more than any two colours. An angle is
/// off by at most 1.02 times the error of its place over the radius, if that error is less than a quarter of the
/// radius. Roundings: angles have 8 u, places in pixels 2 u of the image's size, and means of colours 6. An image that
/// is there once may begin or end where its place is within twice its border.
template <class S>
[[gnu::noinline]] S image_error(const PatternKernel<Element<S>>& pattern, const OffPlace<S>& place) {
    using T = Element<S>;
    constexpr T u = unit_error<S>;
    const ImageKernel<T>& image = pattern.image;
    const auto& [p, off] = place;
    if (image.sharp) return S(std::numeric_limits<T>::infinity());
    const auto turns_error = [&](const S& radius, const S& wrong) {
        return select(radius > S(4) * wrong, S(T(.163)) * wrong / radius, S(1)) + S(8 * u);
    };
    S off_u = off.x, off_v = off.y;
    if (image.map == ImageMap::spherical || image.map == ImageMap::cylindrical) {
        const S squared = fma(p.x, p.x, p.y * p.y), across = off.x + off.y;
        off_u = turns_error(sqrt(squared), across), off_v = off.z;
        if (image.map == ImageMap::spherical)
            off_v = S(2) * turns_error(sqrt(fma(p.z, p.z, squared)), across + off.z) + S(4 * u);
    }
    const S in_pixels = fma(S(T(image.width)), off_u + S(2 * u), S(T(image.height)) * (off_v + S(2 * u)));
    const S error = fma(S(pattern.slack.apart), in_pixels, S(6 * u * pattern.slack.largest));
    if (!image.once) return error;
    const auto [x, y] = place_in_image(image, p);
    const auto ends = [&](const S& at, const S& wrong) {
        const S near = wrong + S(2 * image.border);
        return !((abs(at) > near) & (abs(at - S(1)) > near));
    };
    return select(ends(x, off_u) | ends(y, off_v), S(std::numeric_limits<T>::infinity()), error);
}

/// Bounds the error of a pattern's colour at places. A value that is off by e makes colours that are off by e times the
/// steepest slope between stops that it may be on. Roundings: the share of a stop has 2 u, the products and the sum
/// with it 3/2.
template <class S>
[[gnu::noinline]] S color_error(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                                const OffPlace<S>& place) {
    using T = Element<S>;
    const S apart(pattern.slack.apart);
    if (pattern.form == PatternForm::image) {
        const S error = image_error(pattern, place);
        return select(error < apart, error, apart);
    }
    const S off = value_error(pattern, place);
    if (all(off == S(0))) return S(0);
    if (pattern.form == PatternForm::checker || pattern.form == PatternForm::brick)
        return select(off == S(0), S(0), apart);
    const S value = value_at(pattern, place.p);
    S steepest(0);
    Mask<S> jumps = first_lanes<S>(0);
    for (int i = 1; i < pattern.stops; ++i) {
        const ColorStopKernel<T>&before = world.patterns.stops[pattern.first_stop + i - 1], &after = (&before)[1];
        const Mask<S> near = (value + off >= S(before.at)) & (value - off <= S(after.at));
        if (before.at == after.at) {
            jumps = jumps | near;
            continue;
        }
        T rise = 0;
        for (int c = 0; c < 3; ++c) rise = std::max(rise, std::abs(after.color[c] - before.color[c]));
        steepest = max(steepest, select(near, S(rise * after.per * T(1.001)), S(0)));
    }
    const S error = fma(off, steepest, S(4 * unit_error<S> * pattern.slack.largest));
    return select((off < S(1)) & (error < apart) & !jumps, error, apart);
}

template <class S>
ColorErrors<S> PatternBounds<S>::of_hits(const World<T>& world, const int* materials, const Vec3<S>& position,
                                         const S& surface, const S& away, const Slack<T>& slack) {
    ColorErrors<S> errors;
    each_pattern<S>(world, materials, [&](int which, Mask<S> lanes) {
        const PatternKernel<T>& pattern = world.patterns.list[which];
        const S error = color_error(world, pattern, off_place(world, pattern, position, surface, away, slack));
        const T ambient =
            std::max({std::abs(pattern.ambient.x), std::abs(pattern.ambient.y), std::abs(pattern.ambient.z)});
        errors.color = select(lanes, error, errors.color);
        errors.ambient = select(lanes, S(ambient) * error, errors.ambient);
        errors.diffuse = select(lanes, S(pattern.diffuse) * error, errors.diffuse);
    });
    return errors;
}

/// Directions may be 3 u longer or shorter than 1, which counts as an error of the place.
template <class S>
S PatternBounds<S>::of_sky(const World<T>& world, const Vec3<S>& direction, const S& turn) {
    if (world.patterns.coat_count > 0) return S(std::numeric_limits<T>::infinity());
    return color_error(world, *world.patterns.sky,
                       off_place(*world.patterns.sky, direction, turn + S(3 * unit_error<S>)));
}

template <class S>
S PatternBounds<S>::of_filter(const World<T>& world, int material, const Vec3<S>& position, const S& surface,
                              const S& away, const Slack<T>& slack) {
    const PatternKernel<T>& pattern = world.patterns.list[material - world.patterns.first];
    const OffPlace<S> place = off_place(world, pattern, position, surface, away, slack);
    return S(pattern.refraction) * color_error(world, pattern, place);
}

}  // namespace strahl::inline STRAHL_LEVEL
