// Colours of pictures. scene/image_pattern.h defines where a point is in one.
#pragma once
#include <array>
#include <limits>

#include "num/lane_math.h"
#include "num/memory.h"
#include "scene/image_pattern.h"
#include "trace/world/world.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns the angle of (x, y) from the x axis, in turns, 0 or above and below 1: by the series of the arc tangent (J.
/// Gregory, 1671), after the angle, at most an eighth of a turn, was halved twice by
/// tan(a/2) = tan a / (1 + sqrt(1 + tan^2 a)). It is off by a few units in the last place of 1. At (0, 0) it is 0.
template <class S>
STRAHL_INLINE S turns(const S& x, const S& y) {
    using T = Element<S>;
    constexpr int digits = std::numeric_limits<T>::digits, terms = digits <= 24 ? 5 : digits <= 53 ? 11 : 14;
    const S across = abs(x), up = abs(y), longer = max(across, up);
    S tangent = select(longer > S(0), min(across, up) / longer, S(0));
    for (int i = 0; i < 2; ++i) tangent = tangent / (S(1) + sqrt(fma(tangent, tangent, S(1))));
    const S squared = tangent * tangent;
    S sum(T(1) / T(2 * terms - 1));
    for (int i = terms - 2; i >= 0; --i) sum = fma(-squared, sum, S(T(1) / T(2 * i + 1)));
    S angle = S(T(2) / T(3.14159265358979323846264338327950288L)) * (tangent * sum);
    angle = select(up > across, S(T(.25)) - angle, angle);
    angle = select(x < S(0), S(T(.5)) - angle, angle);
    angle = select(y < S(0), S(1) - angle, angle);
    return select(angle < S(1), angle, S(0));
}

/// Two pixels next to each other along an axis of `size` pixels: their numbers, and how far from the first to the
/// second a place is, from 0 to 1. Places are in pixels; the middle of the first pixel is at 1/2. In a sharp picture
/// the first is the one in which the place lies.
template <class S>
struct PixelPair {
    alignas(64) Element<S> numbers[2][width<S>];
    S share;
    PixelPair(const S& place, const S& size, bool ends, bool sharp) {
        const S last = size - S(1), from_middle = sharp ? min(floor(place), last) : place - S(Element<S>(.5));
        const S low = floor(from_middle);
        const S high = low + S(1);
        share = from_middle - low;
        store_lanes(numbers[0], select(low < S(0), ends ? S(0) : last, low));
        store_lanes(numbers[1], select(high > last, ends ? last : S(0), high));
    }
};

/// Returns where a point of the pattern's space is in the picture: u and v.
template <class S>
STRAHL_INLINE std::array<S, 2> place_in_image(const ImageKernel<Element<S>>& image, const Vec3<S>& p) {
    using T = Element<S>;
    S u = p.x, v = p.y;
    if (image.map == ImageMap::spherical || image.map == ImageMap::cylindrical) u = turns(p.x, p.y), v = p.z;
    if (image.map == ImageMap::spherical) {
        const S latitude = turns(sqrt(fma(p.x, p.x, p.y * p.y)), p.z);
        v = fma(S(2), select(latitude > S(T(.5)), latitude - S(1), latitude), S(T(.5)));
    }
    return {u + S(image.shift[0]), v + S(image.shift[1])};
}

/// Returns where a place along u or v is in the picture itself, from 0 to 1; 0 if it has no digits left.
template <class S>
STRAHL_INLINE S within_image(const S& x, bool ends, bool mirrors) {
    const S zero(0), one(1), two(2);
    S own = mirrors ? x - two * floor(S(Element<S>(.5)) * x) : ends ? x : x - floor(x);
    if (mirrors) own = select(own > one, two - own, own);
    return select(own >= zero, select(own <= one, own, ends ? one : zero), zero);
}

/// Returns the colour at a point of the pattern's space; where coordinates are too large for the number type, that of a
/// corner.
template <class S>
[[gnu::noinline]] Vec3<S> image_color(const ImageKernel<Element<S>>& image, const Vec3<S>& p) {
    using T = Element<S>;
    const auto [u, v] = place_in_image(image, p);
    const auto in_picture = [&](int axis, const S& x) {
        return within_image(x, image.ends[axis], image.mirrors[axis]);
    };
    const S across(T(image.width)), down(T(image.height));
    const PixelPair<S> column(in_picture(0, u) * across, across, image.ends[0], image.sharp);
    const PixelPair<S> row((S(1) - in_picture(1, v)) * down, down, image.ends[1], image.sharp);
    alignas(64) T values[2][2][3][width<S>];
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
            for (int k = 0; k < width<S>; ++k) {
                const auto y = static_cast<std::ptrdiff_t>(row.numbers[j][k]);
                const auto x = static_cast<std::ptrdiff_t>(column.numbers[i][k]);
                for (int c = 0; c < 3; ++c) values[j][i][c][k] = image.pixels[3 * (image.width * y + x) + c];
            }
    Vec3<S> color;
    const S low(-image.border), high(1 - image.border);
    const Mask<S> inside = (u >= low) & (u < high) & (v >= low) & (v < high);
    for (int c = 0; c < 3; ++c) {
        const auto between = [](const S& a, const S& b, const S& share) { return fma(share, b - a, a); };
        const auto in_row = [&](int j) {
            return between(load_lanes<S>(values[j][0][c]), load_lanes<S>(values[j][1][c]), column.share);
        };
        color[c] = between(in_row(0), in_row(1), row.share);
        if (image.once) color[c] = select(inside, color[c], S(image.around[c]));
    }
    return color;
}

}  // namespace strahl::inline STRAHL_LEVEL
