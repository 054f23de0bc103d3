// How bounds travel with rays: what their hits do to them, and what the pixels get.
#pragma once
#include "trace/kernel/shading.h"
#include "trace/proof/proving_query.h"

namespace strahl::inline STRAHL_LEVEL::inline STRAHL_INSTANCE {

/// Adds to the bounds of a pack's pixels, and for what follows the rounding of their sums.
template <class S>
STRAHL_INLINE void add_bounds(const PixelBatch<Element<S>>& batch, const S& pixel, int lanes, const S& bound) {
    using T = Element<S>;
    alignas(64) T pixels[width<S>], bounds[width<S>];
    store_lanes(pixels, pixel), store_lanes(bounds, bound);
    for (int k = 0; k < lanes; ++k) {
        const int i = static_cast<int>(pixels[k]);
        const T* const rgb = batch.sums[i].rgb;
        batch.bounds[i] += bounds[k] + T(.5) * unit_error<S> * max(rgb[0], max(rgb[1], rgb[2]));
    }
}

/// The most that rays of a generation bring back, of all that is decided at random from here on.
template <class T>
STRAHL_INLINE T brightest_of(const Limits<T>& limits, int depth) {
    return limits.brightest[limits.depth - depth + 1];
}

/// Rounding of a hit's light: of its colours, products and sums, 6 and one for each light, and of its weight, two for
/// each generation but the first. What is rounded in the share of a light that comes through, share_proved knows.
template <class S>
STRAHL_INLINE S rounding_of(const Vec3<S>& light, int depth, int lights) {
    using T = Element<S>;
    return S((T(2) + T(depth) + T(.5) * T(lights)) * unit_error<S>) * largest(light);
}

/// Rays that may be turned by more than this are not followed.
inline constexpr float most_turn = 1e-3f;

/// Finds what a generation's rays meet. Where that can't be told the plain kernel decides, the pixel's bound grows by
/// all that the ray may bring, and it is not followed any more.
template <class S, class T>
STRAHL_INLINE Nearest<S> nearest_proved(const World<T>& world, const Limits<T>& limits, const RayQueue<T>& rays, int i,
                                        const Ray<S>& ray, Mask<S> active, BodySet set, int depth,
                                        const PixelBatch<T>& batch) {
    const S away = load_lanes<S>(rays.away + i), turn = load_lanes<S>(rays.turn + i);
    const Mask<S> followed = active & (away >= S(0));
    const Candidates<S> found =
        candidates(world, DoubtfulRay<S>{ray, {max(away, S(0)), turn}}, followed, set, limits.slack);
    Nearest<S> best;
    best.t = found.t, best.surface = found.surface, best.bin = found.bin;
    const Mask<S> told = followed & (found.hits() | found.misses()) & (turn < S(most_turn)), open = active & !told;
    if (none(open)) return best;
    const Nearest<S> plain = nearest(world, ray, open, set);
    best.t = select(open, plain.t, best.t), best.surface = select(open, plain.surface, best.surface);
    best.bin = select(open, plain.bin, best.bin);
    const Mask<S> lost = open & followed;
    if (none(lost)) return best;
    const S weight = load_lanes<S>(rays.weight + i);
    add_bounds(batch, load_lanes<S>(rays.pixel + i), std::min(width<S>, rays.count - i),
               select(lost, weight * S(brightest_of(limits, depth)), S(0)));
    store_lanes(rays.away + i, select(lost, S(-1), away)), store_lanes(rays.turn + i, select(lost, S(0), turn));
    return best;
}

/// What is known of hits of one bin, found at `t`. Those of which nothing is are left, with all that they may bring.
template <class S>
STRAHL_INLINE HitBounds<S> bound_hits(const Shading<S>& shading, const Hit<S>& hit, const Ray<S>& ray,
                                      const Doubt<S>& doubt, const S& t, const S& weight, int lanes, Mask<S> known) {
    const auto& world = shading.world;
    const Mask<S> followed = hit.active & (doubt.away >= S(0));
    const SortBin& bin = world.sort_bins[hit.bin];
    int items[width<S>] = {};
    if (!world.bin_per_item) {
        alignas(64) Element<S> surfaces[width<S>];
        store_lanes(surfaces, hit.surface);
        for (int k = 0; k < width<S>; ++k) items[k] = world.references[static_cast<int>(surfaces[k])].item;
    }
    PointBounds<S> found{S(0), S(0), S(0), S(0), S(0), first_lanes<S>(0)};
    if_known(world, bin.form, [&](const auto& group) {
        using Item = typename std::remove_cvref_t<decltype(group)>::template ItemOf<S>;
        const Item own =
            world.bin_per_item ? splat_item<Item, S>(group.items[bin.item]) : gather_items<Item, S>(group.items, items);
        found =
            point_bounds(own.shape, Ray<S>{ray.origin, ray.direction, ray.source - own.surface}, doubt, t,
                         SurfacePoint<S>{hit.position, hit.normal}, S(hit.surface - own.surface), shading.limits.slack);
    });
    HitBounds<S> bounds;
    bounds.followed = followed & known & found.sure & (doubt.turn < S(most_turn));
    const auto keep = [&](const S& value) { return select(bounds.followed, value, S(0)); };
    bounds.away = keep(found.away), bounds.normal = keep(found.normal), bounds.turn = keep(doubt.turn);
    bounds.mirrored = keep(found.mirrored), bounds.spin = found.spin;
    bounds.side = keep(found.side), bounds.height = keep(found.height);
    const Mask<S> lost = followed & !bounds.followed;
    if (any(lost)) {
        const S most = weight * S(brightest_of(shading.limits, shading.depth));
        add_bounds(shading.batch, hit.pixel, lanes, select(lost, most, S(0)));
    }
    return bounds;
}

/// By how much fog makes the light off that comes by way of hits at `t`: `left` of the rays' weight is left there. All
/// of that light is as far off as the weight, by what the way is off, which is what its ends are and `t` misses between
/// them. Roundings: the distance has 3 u, 1 over the fog's distance 1, the product with the way 1/2, the exponential 2,
/// the weight 1/2. Rays in glass lose nothing. Which those are is certain as long as hits are, see bound_refraction, if
/// it is for the eye.
template <class S>
[[gnu::noinline]] S fog_error(const Shading<S>& shading, const Vec3<S>& way, const S& away, const S& t, const S& weight,
                              const S& left) {
    constexpr auto u = unit_error<S>;
    const auto& world = shading.world;
    const S distance = sqrt(dot(way, way)), off = away + abs(t - distance) + S(4 * u) * (t + distance);
    const S share = fma(S(Element<S>(1.01) * world.fog_per), off, S(2 * u * world.fog_per) * t + S(4 * u));
    const S least(std::numeric_limits<Element<S>>::min());  // of what underflows
    const S lost = select(share < S(.01f), fma(left, share, least), weight);
    return lost * (S(brightest_of(shading.limits, shading.depth)) + largest(splat<S>(world.fog_color)));
}

/// By how much a mirrored or a refracted direction may be turned; b is the ratio of indices, c and k the cosine before
/// and the squared cosine beyond the surface, which is off by no more than `k_error`.
///
/// Mirrors turn by twice what the normal is turned, or less, see point_bounds. Roundings: e n is off by 3/2 u, which
/// counts twice, the normal's length by 9/4 u, also twice; two products and sums.
template <class S>
STRAHL_INLINE S turn_reflected(const HitBounds<S>& known) {
    return fma(S(2.002), known.mirrored, known.turn) + S(10 * unit_error<S>);
}
/// k = 1 - b^2 (1 - c^2). Roundings: c is off by 3/2 u, so c^2 by 3; b twice by 1/2, sums and products by 2.
template <class S>
STRAHL_INLINE S error_beyond(const HitBounds<S>& known, const S& b, const S& c) {
    const S off = known.turn + known.normal;
    return S(1.001) * b * b * off * fma(S(2), abs(c), off) + S(8 * unit_error<S>) * fma(b, b, S(1));
}
/// In the plane of incidence a turn by q becomes one by A q, where A = b c / sqrt(k) by Snell's law, across it by b q.
/// A turn of the normal by N becomes one by |1 - A| N or |b c - sqrt(k)| N. All within what c and k may be. Roundings:
/// lengths of directions, c and k itself count b^2 / sqrt(k) times.
template <class S>
STRAHL_INLINE S turn_refracted(const HitBounds<S>& known, const S& b, const S& c, const S& k, const S& k_error) {
    const S off = known.turn + known.normal, least = sqrt(max(k - k_error, S(0))), most = sqrt(max(k, S(0)) + k_error);
    const S low_c = b * (c - off), high_c = b * (c + off), low = low_c / most, high = high_c / least;
    const S by_normal = max(max(abs(S(1) - low), abs(S(1) - high)), max(abs(high_c - least), abs(low_c - most)));
    return S(1.01) * fma(max(b, high), known.turn, by_normal * known.normal) +
           S(8 * unit_error<S>) * (S(1) + b + fma(b, b, S(1)) / least);
}

/// How far the exact ray's line passes the computed one's origin p, from where x is the exact one. Mirrored by the
/// plane that touches the surface at x the way from x to p changes by twice its height, and so does its part across the
/// ray.
template <class S>
STRAHL_INLINE S side_reflected(const HitBounds<S>& known) {
    return min(S(1.001) * fma(S(2), known.height, known.side), known.away);
}
/// In the plane of incidence the way along the surface is the way across the ray divided by its cosine c before it, and
/// this multiplied by that of the cosine beyond is the way across the refracted ray; k is the square of the latter.
template <class S>
STRAHL_INLINE S side_refracted(const HitBounds<S>& known, const S& c, const S& k, const S& k_error) {
    const S least = max(abs(c) - known.turn - known.normal - S(8 * unit_error<S>), S(0));
    const S most = sqrt(max(k, S(0)) + k_error), ratio = max(S(1), most / least);
    const S side = min(S(1.001) * fma(ratio, known.side + known.height, known.height), known.away);
    return select(least > S(0), side, known.away);
}

}  // namespace strahl::inline STRAHL_LEVEL::inline STRAHL_INSTANCE
