// Colours of pictures, filtered by footprints: means over the part of a picture that a sample's square of the view
// shows.
//
// A footprint is a parallelogram in the picture: how the place there changes from ray to ray (H. Igehy, "Tracing Ray
// Differentials", 1999). It counts as the ellipse with the same variances, as in P. Heckbert, "Fundamentals of Texture
// Mapping and Image Warping", 1989, and its mean is that of several lookups along the longer axis (J. McCormack, R.
// Perry, K. Farkas, N. Jouppi, "Feline: Fast Elliptical Lines for Anisotropic Texture Mapping", 1999), each in mip
// levels as coarse as the shorter axis or the distance between lookups wants it.
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "trace/patterns/image_kernel.h"
#include "trace/patterns/pattern_calls.h"

namespace strahl::inline STRAHL_LEVEL {

/// Most lookups along the longer axis of a footprint, and lookups along the shorter one.
inline constexpr int most_lookups = 32, lookups_beside = 2;
/// How loose means of images count, see Filtering; found by experiment.
inline constexpr double image_loose = .35;

/// Returns how u and v in the picture change along a vector in the pattern's space, at p.
template <class S>
STRAHL_INLINE std::array<S, 2> way_in_image(const ImageKernel<Element<S>>& image, const Vec3<S>& p,
                                            const Vec3<S>& way) {
    using T = Element<S>;
    if (image.map != ImageMap::spherical && image.map != ImageMap::cylindrical) return {way.x, way.y};
    const S turn(T(1) / T(6.283185307179586476925286766559L)), squared = fma(p.x, p.x, p.y * p.y);
    const S around = turn * fma(p.x, way.y, -(p.y * way.x)) / squared;
    if (image.map == ImageMap::cylindrical) return {around, way.z};
    const S outwards = fma(p.x, way.x, p.y * way.y);
    const S up = fma(squared, way.z, -(p.z * outwards)) / (sqrt(squared) * fma(p.z, p.z, squared));
    return {around, S(2) * turn * up};
}

/// The lookups of one lane, and the sum of their colours.
template <class T>
struct ImageLookups {
    const ImageKernel<T>& image;
    const MipMapKernel& map;
    T sum[3] = {};
    T width[2] = {1,
                  1};  // along an axis, of the part that a lookup stands for, in pixels of a sharp picture; at most 1
    bool exact = false, varies = true;  // the mean is; and it is of more than one pixel

    /// Adds the colour at (u, v) to the sum, bilinear in a mip level. In a sharp picture itself a part as wide as a
    /// pixel has that mean, and a narrower one changes from pixel to pixel as fast as it crosses their border.
    STRAHL_INLINE void add(int number, T u, T v, T share) {
        const MipLevel& level = map.levels[number];
        // At the poles only the picture itself continues with its opposite row: in smaller levels that would reach
        // further.
        const bool ends_at_poles = image.map == ImageMap::spherical && number > 0;
        const auto pair = [](T place, std::int32_t size, bool ends, std::int32_t(&numbers)[2]) {
            const T from_middle = place - T(.5), low = std::floor(from_middle);
            const auto first = static_cast<std::int32_t>(low), last = size - 1;
            numbers[0] = first < 0 ? (ends ? 0 : last) : first;
            numbers[1] = first + 1 > last ? (ends ? last : 0) : first + 1;
            return from_middle - low;
        };
        std::int32_t columns[2], rows[2];
        const auto narrowed = [&](T share, T own, T place, std::int32_t size) {
            if (!exact) return share;
            // On a border between two pixels it takes the one that rounding picks.
            if (own <= T(1e4) * std::numeric_limits<T>::epsilon())
                return T(std::floor(std::min(place, static_cast<T>(size - 1))) > std::floor(place - T(.5)));
            const T all = std::clamp(fma(share - T(.5), T(1) / own, T(.5)), T(0), T(1));
            varies = varies || (all > 0 && all < 1);
            return all;
        };
        const T x = u * static_cast<T>(level.width), y = (T(1) - v) * static_cast<T>(level.height);
        const T across = narrowed(pair(x, level.width, image.ends[0], columns), width[0], x, level.width);
        const T down = narrowed(pair(y, level.height, image.ends[1] || ends_at_poles, rows), width[1], y, level.height);
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 2; ++i) {
                const T own = share * (i ? across : T(1) - across) * (j ? down : T(1) - down);
                const float* const pixel =
                    level.pixels + 3 * (static_cast<std::ptrdiff_t>(rows[j]) * level.width + columns[i]);
                for (int c = 0; c < 3; ++c) sum[c] = fma(own, static_cast<T>(pixel[c]), sum[c]);
            }
    }

    /// Sums up the mean around (u, v) over a square with sides a and b, taken for an ellipse. Returns the length along
    /// its longer axis, in pixels. If the image is there once, none of what is around it is seen: lookups end at its
    /// edges.
    STRAHL_INLINE T filter(T u, T v, const T (&a)[2], const T (&b)[2]) {
        // Finds the axes of the ellipse, in pixels: a square with sides a and b has the variances of a a^T + b b^T.
        const T size[2] = {static_cast<T>(image.width), static_cast<T>(image.height)};
        const T x[2] = {a[0] * size[0], b[0] * size[0]}, y[2] = {a[1] * size[1], b[1] * size[1]};
        const T xx = fma(x[0], x[0], x[1] * x[1]), yy = fma(y[0], y[0], y[1] * y[1]), xy = fma(x[0], y[0], x[1] * y[1]);
        const T half = T(.5) * (xx - yy), middle = T(.5) * (xx + yy), root = std::sqrt(fma(half, half, xy * xy));
        const T longer = std::sqrt(middle + root), shorter = std::sqrt(std::max(middle - root, T(0)));
        T along[2] = {half > 0 ? half + root : xy, half > 0 ? xy : root - half};
        const T length = std::sqrt(fma(along[0], along[0], along[1] * along[1]));
        for (T& share : along) share = length > 0 ? share / length : T(0);
        if (image.sharp && !(length > 0)) along[0] = 1;  // of a circle any axis will do
        const T beside[2] = {-along[1] * shorter / size[0], along[0] * shorter / size[1]};
        for (int i = 0; i < 2; ++i) along[i] *= longer / size[i];
        // Parts shorter than half a pixel would see the same.
        const T wanted = std::ceil(longer / std::max(shorter / T(lookups_beside), T(.5)));
        const T parts = std::clamp(wanted, T(1), T(most_lookups)), per = T(1) / parts;
        const T part = std::max(shorter / T(lookups_beside), longer * per);
        // Means over squares with sides s, bilinear in between, have the variance s^2 / 4 - 1/12 in pixels; the picture
        // itself has 1/6, and the part adds 1/12 of its square. Variances of two levels mix as the levels do.
        const T squared = fma(part * part, T(1) / T(3), T(1));
        const int last = map.count - 1, level = std::min(std::ilogb(squared) / 2, last);
        T coarse = level < last ? (std::ldexp(squared, -2 * level) - T(1)) / T(3) : T(0);
        if (image.sharp && part < 1) {
            coarse = 0, exact = true, varies = parts > 1;
            for (int i = 0; i < 2; ++i)
                width[i] = std::clamp(size[i] * fma(std::abs(along[i]), per, std::abs(beside[i]) / T(lookups_beside)),
                                      std::numeric_limits<T>::epsilon(), T(1));
        }
        const T share = per / T(lookups_beside);
        for (int i = 0; i < static_cast<int>(parts); ++i)
            for (int j = 0; j < lookups_beside; ++j) {
                const T x_at = fma(static_cast<T>(i) + T(.5), per, T(-.5));
                const T y_at = (static_cast<T>(j) + T(.5)) / T(lookups_beside) - T(.5);
                const T own_u = within(fma(x_at, along[0], fma(y_at, beside[0], u)), image.ends[0], image.mirrors[0]);
                const T own_v = within(fma(x_at, along[1], fma(y_at, beside[1], v)),
                                       image.ends[1] || image.map == ImageMap::spherical, image.mirrors[1]);
                add(level, own_u, own_v, share * (T(1) - coarse));
                if (coarse > 0) add(level + 1, own_u, own_v, share * coarse);
            }
        return longer;
    }

    STRAHL_INLINE static T within(T x, bool ends, bool mirrors) {
        T own = mirrors ? x - 2 * std::floor(x / 2) : ends ? x : x - std::floor(x);
        if (mirrors && own > 1) own = 2 - own;
        return own >= 0 ? std::min(own, T(1)) : T(0);
    }
};

/// Finds the colours of a picture at points of the pattern's space; `across` and `down` lead to the points of rays
/// beside. Returns how many of the picture's pixels long footprints are, 0 outside of it, and how loose the filter is.
/// A sharp picture's footprints count as a pixel long at least, because its colours are as abrupt as those of checks.
template <class S>
[[gnu::noinline]] Filtering<S> filtered_color(const ImageKernel<Element<S>>& image, const MipMapKernel& map,
                                              const Vec3<S>& p, const Vec3<S>& across, const Vec3<S>& down,
                                              Mask<S> lanes, Vec3<S>& color) {
    using T = Element<S>;
    const auto [u, v] = place_in_image(image, p);
    const std::array<S, 2> ways[2] = {way_in_image(image, p, across), way_in_image(image, p, down)};
    // For longer vectors, or NaN, all that is seen is the picture's mean.
    const auto limited = [](T way) { return way < T(1000) ? std::max(way, T(-1000)) : T(1000); };
    const S low(-image.border), high(1 - image.border);
    const Mask<S> around = (u < low) | !(u < high) | (v < low) | !(v < high);
    alignas(64) T values[3][width<S>], lengths[width<S>] = {}, looseness[width<S>];
    store_lanes(looseness, S(T(image_loose)));
    for (int c = 0; c < 3; ++c) store_lanes(values[c], S(image.around[c]));
    for (unsigned left = bits(image.once ? lanes & !around : lanes); left != 0; left &= left - 1) {
        const int k = std::countr_zero(left);
        ImageLookups<T> lookups{image, map};
        const auto way = [&](int i, int j) { return limited(lane(ways[i][j], k)); };
        lengths[k] = lookups.filter(lane(u, k), lane(v, k), {way(0, 0), way(0, 1)}, {way(1, 0), way(1, 1)});
        if (lookups.exact) looseness[k] = T(lookups.varies ? 0 : -1);
        if (image.sharp) lengths[k] = std::max(lengths[k], T(1));
        for (int c = 0; c < 3; ++c) values[c][k] = lookups.sum[c];
    }
    for (int c = 0; c < 3; ++c) color[c] = load_lanes<S>(values[c]);
    return {load_lanes<S>(lengths), load_lanes<S>(looseness)};
}

}  // namespace strahl::inline STRAHL_LEVEL
