// How error bounds travel with rays: what hits do to them, and what they add to the bounds of pixels.
#pragma once
#include <algorithm>
#include <limits>

#include "trace/kernel/shade.h"
#include "trace/proof/finish_bounds.h"
#include "trace/proof/pattern_bounds.h"
#include "trace/proof/proving_kernel.h"
#include "trace/proof/query_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// The policy of proving kernels, see proving.h.
struct Proving;
template <class S>
using ProvedShading = Shading<S, Proving>;

/// Return the limits and the pixels that a proving kernel was given.
template <class T>
STRAHL_INLINE const ProvingLimits<T>& proving(const Limits<T>& limits) {
    return static_cast<const ProvingLimits<T>&>(limits);
}
template <class T>
STRAHL_INLINE const ProvingBatch<T>& proving(const PixelBatch<T>& batch) {
    return static_cast<const ProvingBatch<T>&>(batch);
}

/// The arrays of a queue that hold the doubts of its rays.
template <class T>
struct DoubtArrays {
    T *away, *turn, *side, *spin;
    STRAHL_INLINE DoubtArrays(const RayQueue<T>& rays)
        : away(rays.extra[0]), turn(rays.extra[1]), side(rays.extra[2]), spin(rays.extra[3]) {}
};

/// The error bounds of a pack of hits.
template <class S>
struct HitBounds {
    S away{0}, normal{0}, mirrored{0}, side{0}, height{0};  // see PointBounds
    S spin{std::numeric_limits<Element<S>>::infinity()};
    S flat{-1};    // error of bent normals before they were bent; -1 of others
    S turn{0};     // turn of the incident rays
    S off{0};      // bound of the error of the light that the hit sends back, before its weight
    S diffuse{0};  // error bound of the largest channel of the diffuse colour
    S color{0};    // bound of the error of a pattern's colour
    S tint{1};     // the largest channel of colours that the ray carries
    // For hits with finishes: errors of the shares of light that are reflected and refracted, and the largest sum of
    // both.
    S reflected{0}, refracted{0}, sent{0};
    Mask<S> followed;  // lanes whose errors are bounded; all light of the others is in their pixels' bounds
};

/// Adds error bounds to those of a pack's pixels, and the rounding error of one addition to their sums.
template <class S>
STRAHL_INLINE void add_bounds(const PixelBatch<Element<S>>& batch, const S& pixel, int lanes, const S& bound) {
    using T = Element<S>;
    alignas(64) T pixels[width<S>], bounds[width<S>];
    store_lanes(pixels, pixel), store_lanes(bounds, bound);
    for (int k = 0; k < lanes; ++k) {
        const int i = static_cast<int>(pixels[k]);
        const T* const rgb = batch.sums[i].rgb;
        proving(batch).bounds[i] += bounds[k] + T(.5) * unit_error<S> * max(rgb[0], max(rgb[1], rgb[2]));
    }
}

/// Returns the most light that a ray of this generation can bring back: its error if anything is decided wrongly from
/// here on.
template <class T>
STRAHL_INLINE T brightest_of(const Limits<T>& limits, int depth) {
    return limits.brightest_beyond(depth - 1);
}

/// Bounds the rounding error of a hit's light: of its colours, products and sums, 6 roundings and one for each light,
/// and of its weight, two for each generation but the first. share_proved bounds that of the share of a light that
/// comes through.
template <class S>
STRAHL_INLINE S rounding_of(const Vec3<S>& light, int depth, int lights) {
    using T = Element<S>;
    return S((T(2) + T(depth) + T(.5) * T(lights)) * unit_error<S>) * most_of(light);
}
/// Returns the generations whose roundings count: where rays carry colours, these have four more in each.
template <class S>
STRAHL_INLINE int rounded_depth(const ProvedShading<S>& shading) {
    return (shading.world.finishes.carries ? 3 : 1) * shading.depth;
}
/// Returns the most by which colours multiply the light of rays that carry some, those of fog included, and 1 of
/// others.
template <class S, class Load>
STRAHL_INLINE S tint_of(const World<Element<S>>& world, const RayQueue<Element<S>>& rays, const Load& load) {
    if (!world.finishes.carries) return S(1);
    const S fog(max(Element<S>(1), largest(world.fog.tint)));
    return fog * most_of(Vec3<S>(load(rays.tint[0]), load(rays.tint[1]), load(rays.tint[2])));
}

/// Rays whose direction may be off by more than this are not followed.
inline constexpr float most_turn = 1e-3f;

/// Returns the largest `away` and `turn` of a pack.
template <class S, class T>
STRAHL_INLINE Doubt<T> most_doubt(const RayQueue<T>& rays, int i, Mask<S> active) {
    const auto most = [&](const T* values) {
        return -least(select(active, min(-load_lanes<S>(values + i), S(0)), S(0)));
    };
    const DoubtArrays<T> doubts(rays);
    return {most(doubts.away), most(doubts.turn)};
}

/// Finds what a generation's rays meet. Where that is undecided the plain kernel decides, the pixel's bound grows by
/// all light that the ray may bring, and the ray is not followed any more.
template <class S, class T>
STRAHL_INLINE Nearest<S> nearest_proved(const World<T>& world, const Limits<T>& limits, const RayQueue<T>& rays, int i,
                                        const Ray<S>& ray, Mask<S> active, BodySet set, int depth,
                                        const PixelBatch<T>& batch) {
    const DoubtArrays<T> doubts(rays);
    const S away = load_lanes<S>(doubts.away + i), turn = load_lanes<S>(doubts.turn + i);
    const Mask<S> followed = active & (away >= S(0));
    const Candidates<S> found =
        candidates(world, DoubtfulRay<S>{ray, {max(away, S(0)), turn}}, followed, set, proving(limits).slack);
    Nearest<S> best;
    best.t = found.t, best.surface = found.surface, best.bin = found.bin;
    const Mask<S> told = followed & (found.hits() | found.misses()) & (turn < S(most_turn)), open = active & !told;
    if (none(open)) return best;
    const Nearest<S> plain = nearest(world, ray, open, set);
    best.t = select(open, plain.t, best.t), best.surface = select(open, plain.surface, best.surface);
    best.bin = select(open, plain.bin, best.bin);
    const Mask<S> lost = open & followed;
    if (none(lost)) return best;
    const S weight =
        load_lanes<S>(rays.weight + i) * tint_of<S>(world, rays, [i](const T* of) { return load_lanes<S>(of + i); });
    add_bounds(batch, load_lanes<S>(rays.pixel + i), std::min(width<S>, rays.count - i),
               select(lost, weight * S(brightest_of(limits, depth)), S(0)));
    store_lanes(doubts.away + i, select(lost, S(-1), away)), store_lanes(doubts.turn + i, select(lost, S(0), turn));
    return best;
}

/// Bounds the errors of the hits of one bin, found at `t`. Hits that have no bounds, among them those not in `known`,
/// are not followed any more: their pixels' bounds grow by all light that they may bring.
template <class S>
STRAHL_INLINE HitBounds<S> bound_hits(const ProvedShading<S>& shading, const Hit<S>& hit, const Ray<S>& ray,
                                      const Doubt<S>& doubt, const S& t, const S& weight, int lanes, Mask<S> known) {
    const auto& world = shading.world;
    const Mask<S> followed = hit.active & (doubt.away >= S(0));
    const SortBin& bin = world.sort_bins[hit.bin];
    int items[width<S>] = {};
    if (bin.material < 0) {
        alignas(64) Element<S> surfaces[width<S>];
        store_lanes(surfaces, hit.surface);
        for (int k = 0; k < width<S>; ++k) items[k] = world.references[static_cast<int>(surfaces[k])].item;
    }
    PointBounds<S> found{S(0), S(0), S(0), S(0), S(0), first_lanes<S>(0)};
    if_known(world, bin.form, [&](const auto& group) {
        using Item = typename std::remove_cvref_t<decltype(group)>::template ItemOf<S>;
        const Item own =
            bin.material >= 0 ? splat_item<Item, S>(group.items[bin.item]) : gather_items<Item, S>(group.items, items);
        found = point_bounds(own.shape, Ray<S>{ray.origin, ray.direction, ray.source - own.surface}, doubt, t,
                             SurfacePoint<S>{hit.position, hit.normal}, S(hit.surface - own.surface),
                             proving(shading.limits).slack);
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

/// Bounds the error by fog of light that comes by way of hits at `t`, where `left` of the rays' weight is left. All of
/// that light has the relative error of the weight, which follows from that of the distance: from the errors of its
/// ends and the difference between `t` and the distance between them. Roundings: the distance has 3 u, 1 over the fog's
/// distance 1, their product 1/2, the exponential 2, the weight 1/2. Rays in glass lose nothing. Which rays are in
/// glass is certain as long as hits are, see bound_refraction, if it is certain for the eye.
template <class S>
[[gnu::noinline]] S fog_error(const ProvedShading<S>& shading, const Vec3<S>& way, const S& away, const S& t,
                              const S& weight, const S& left) {
    constexpr auto u = unit_error<S>;
    const auto& world = shading.world;
    const S distance = sqrt(dot(way, way)), off = away + abs(t - distance) + S(4 * u) * (t + distance);
    const S share = fma(S(Element<S>(1.01) * world.fog.per), off, S(2 * u * world.fog.per) * t + S(4 * u));
    const S least(std::numeric_limits<Element<S>>::min());  // for weights that underflow
    const S lost = select(share < S(.01f), fma(left, share, least), weight);
    return lost * (S(brightest_of(shading.limits, shading.depth)) + largest(splat<S>(world.fog.color)));
}

/// Bounds the errors of normals that materials bend. Bends make normals steeper than what is known of the surface, so
/// `height` is as for any direction. Hits whose normals have no bound are not followed any more.
template <class S>
[[gnu::noinline]] void bound_bent(const ProvedShading<S>& shading, const int* materials, const Hit<S>& hit,
                                  const Vec3<S>& flat, const S& weight, int lanes, HitBounds<S>& known) {
    const BentBounds<S> found = PatternBounds<S>::of_normals(shading.world, materials, hit.position, hit.surface, flat,
                                                             known.normal, known.away, proving(shading.limits).slack);
    const Mask<S> bent = known.followed & found.bent, lost = bent & !found.told, told = bent & found.told;
    known.flat = select(told, known.normal, S(-1));
    known.normal = select(told, found.off, known.normal), known.mirrored = select(told, found.off, known.mirrored);
    known.height = select(told, known.away, known.height), known.spin = select(bent, HitBounds<S>{}.spin, known.spin);
    if (none(lost)) return;
    const auto leave = [&](S& value) { value = select(lost, S(0), value); };
    leave(known.away), leave(known.normal), leave(known.mirrored), leave(known.turn), leave(known.side);
    leave(known.height);
    known.followed = known.followed & !lost;
    const S most = weight * known.tint * S(brightest_of(shading.limits, shading.depth));
    add_bounds(shading.batch, hit.pixel, lanes, select(lost, most, S(0)));
}

/// Returns the hits whose finishes have bounds: all plain ones have.
template <class S>
[[gnu::noinline]] Mask<S> known_finishes(const World<Element<S>>& world, int bin, const int* materials) {
    const int own = world.sort_bins[bin].material, first = own >= 0 ? own : materials[0];
    return plain(world, first) ? first_lanes<S>(width<S>) : FinishBounds<S>::known(world, materials);
}

/// Bounds the errors of hits; except in uneven fog, in fog if it is not certain whether the eye is in glass, and inside
/// enclosed bodies if slack exceeds the margins of culling.
template <class S>
STRAHL_INLINE void bound_hit(const ProvedShading<S>& shading, const Hit<S>& hit, const RayQueue<Element<S>>& from,
                             const LaneIndices<S>& pick, const Element<S>* t, bool within,
                             const HitMaterial<S>& material, HitBounds<S>& bounds) {
    const auto& world = shading.world;
    const Ray<S> ray{{pick(from.origin.x), pick(from.origin.y), pick(from.origin.z)}, hit.direction, pick(from.source)};
    const Slack<Element<S>>& slack = proving(shading.limits).slack;
    const bool unknown = (world.fog.any && !(slack.medium && world.fog.even)) || (within && !slack.fits());
    const DoubtArrays<Element<S>> doubts(from);
    const Doubt<S> doubt{pick(doubts.away), pick(doubts.turn), pick(doubts.side),
                         world.transparent ? pick(doubts.spin) : Doubt<S>{}.spin};
    Mask<S> told = first_lanes<S>(unknown ? 0 : width<S>);
    if (world.finishes.list) [[unlikely]]
        told = told & known_finishes<S>(world, hit.bin, material.numbers);
    const S tint = tint_of<S>(world, from, pick);
    bounds = bound_hits(shading, hit, ray, doubt, pick(t), pick(from.weight) * tint, pick.lanes, told);
    bounds.tint = tint, bounds.sent = hit.material.refraction;
    if (world.patterns.list) [[unlikely]] {
        const ColorErrors<S> errors = PatternBounds<S>::of_hits(world, material.numbers, Vec3<S>(hit.position),
                                                                S(hit.surface), S(bounds.away), slack);
        bounds.off = errors.ambient, bounds.diffuse = errors.diffuse, bounds.color = errors.color;
    }
}

/// Bounds the error of the background, or of the colour of fog, which rays that hit nothing bring back.
template <class S>
STRAHL_INLINE void bound_miss(const ProvedShading<S>& shading, const LaneIndices<S>& pick, const S& weight,
                              const S& pixel, const Vec3<S>& color) {
    const auto& world = shading.world;
    const auto& d = shading.rays.open.direction;
    const DoubtArrays<Element<S>> doubts(shading.rays.open);
    const Mask<S> followed = first_lanes<S>(pick.lanes) & (pick(doubts.away) >= S(0));
    const S tint = tint_of<S>(world, shading.rays.open, pick);
    S off = rounding_of(scale(weight, color), rounded_depth(shading), 0);
    if (world.fog.any && !(proving(shading.limits).slack.medium && world.fog.even)) [[unlikely]]
        off = weight * tint * S(brightest_of(shading.limits, shading.depth));
    else if (world.patterns.sky && (!world.fog.any || world.nested)) [[unlikely]]
        off = fma(weight * tint, PatternBounds<S>::of_sky(world, {pick(d.x), pick(d.y), pick(d.z)}, pick(doubts.turn)),
                  off);
    add_bounds(shading.batch, pixel, pick.lanes, select(followed, off, S(0)));
}

/// Adds the error of hits' light to the bounds of their pixels. `t` is the length of the rays.
template <class S>
STRAHL_INLINE void bound_light(const ProvedShading<S>& shading, const Hit<S>& hit, const RayQueue<Element<S>>& from,
                               const LaneIndices<S>& pick, const S& t, const Vec3<S>& light,
                               const HitBounds<S>& known) {
    S off =
        fma(hit.weight * known.tint, known.off, rounding_of(light, rounded_depth(shading), shading.world.light_count));
    if (shading.world.fog.any) [[unlikely]] {
        const Vec3<S> origin(pick(from.origin.x), pick(from.origin.y), pick(from.origin.z));
        const S lost =
            fog_error(shading, Vec3<S>(hit.position - origin), S(known.away + pick(DoubtArrays<Element<S>>(from).away)),
                      t, S(known.tint * pick(from.weight)), S(known.tint * hit.weight));
        off = off + select(hit.medium == S(0), lost, S(0));
    }
    add_bounds(shading.batch, hit.pixel, pick.lanes, select(known.followed, off, S(0)));
}

}  // namespace strahl::inline STRAHL_LEVEL
