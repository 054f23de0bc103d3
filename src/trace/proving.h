// How bounds travel with rays: what their hits do to them, and what the pixels get.
#pragma once
#include "trace/proving_query.h"
#include "trace/shading.h"

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

/// How far the cosine of an angle is off that is off by a: cos(x + a) - cos x is at most a sin x + a^2 / 2. The cosine
/// that is known may have 16 units of rounding.
template <class S>
STRAHL_INLINE S cosine_error(const S& a, const S& cosine) {
    return S(1.001) * a * (sqrt(max(fma(-cosine, cosine, S(1)), S(0)) + S(32 * unit_error<S>)) + a);
}

/// What a light may add to a hit's light in exact arithmetic other than in computed: by the angle at which it comes, by
/// its highlight, and by whether it comes at all.
///
/// The light's place was rounded once. The way to it has 2 roundings in direction and, in length, of its square's sum
/// and root 7/4 u, its inverse and the product with it 1 u; with 9/4 by the normal's length the cosine has 5 u as a
/// share, and 3/2 u by the scalar product. A mirrored direction is not brought to length 1 here: 16 u. Of (s + d)^p -
/// s^p with x = p d / s no more than s^p (e^x - 1) is left, e^x - 1 <= x + x^2 up to x = 1.79 (a p below 1 counts as
/// 1); powers have p roundings. Below `shines_from` all is less than u / 64.
template <class S>
struct LitBounds {
    S cosine, highlight;  // how far these are off
    S distance;           // likewise
    Doubt<S> ray;         // of the shadow ray
    Mask<S> doubt;        // lanes in which it can't be told whether it is on the normal's side
};
/// The hits that may be on the side of their surface that a light is on: all but those whose cosine is below -1e-3,
/// where normal and light are better known than that.
template <class S>
STRAHL_INLINE Mask<S> may_face(const HitBounds<S>& known, const Hit<S>& hit, const LightKernel<Element<S>>& light,
                               const Vec3<S>& to_light, const S& facing) {
    const S way = norm1(to_light);
    const S off = S(light.finite) * fma(S(unit_error<S>), norm1(splat<S>(light.position)), known.away);
    return hit.active & !((facing < S(-1e-3f) * way) & (off < S(1e-4f) * way) & (known.normal < S(1e-4f)));
}
template <class S>
STRAHL_INLINE LitBounds<S> bound_lit(const HitBounds<S>& known, const Hit<S>& hit, const LightKernel<Element<S>>& light,
                                     const S& length, const S& cosine, const S& shine, const S& highlight) {
    constexpr auto u = unit_error<S>;
    const MaterialKernel<S>& material = hit.material;
    const Vec3<S> place = splat<S>(light.position);
    const S off = S(light.finite) * fma(S(.51 * u), norm1(place), known.away);
    const Mask<S> near = !(off < S(.25) * length);
    LitBounds<S> lit;
    const S turn = off / (length - off) + S(1.5 * u);
    lit.ray = {known.away, turn};
    lit.distance = select(near, length, off + S(8 * u) * length);
    lit.cosine = cosine_error(known.normal + turn, cosine) + fma(S(5 * u), abs(cosine), S(1.5 * u));
    lit.doubt = near | !(abs(cosine) > lit.cosine);
    lit.highlight = S(0);
    if (none(hit.active & (material.specular > S(0)))) return lit;
    // Nowhere near a highlight x is below .5, for an angle's cosine is off by less than the angle.
    const S angle = turn_reflected(known) + turn;
    const Mask<S> off_it =
        (highlight == S(0)) &
        (max(material.pow, S(1)) * fma(S(1.01), angle + angle * angle, S(17 * u)) < S(.49) * material.shines_from);
    if (none(hit.active & !off_it)) {
        lit.highlight = u * material.specular;
        return lit;
    }
    const S error = cosine_error(angle, shine) + S(16 * u);
    const S base = max(shine, material.shines_from), x = max(material.pow, S(1)) * error / base,
            mild_error = fma(x, x, x) + S(.51 * u) * (material.pow + S(4));
    lit.highlight = select(x < S(.5), fma(mild_error, highlight, u * material.specular), material.specular);
    return lit;
}

/// Adds a light of which nothing is known to the errors of hits.
template <class S>
STRAHL_INLINE void add_unknown_light(const Shading<S>& shading, const Hit<S>& hit, const LightKernel<Element<S>>& light,
                                     HitBounds<S>& known) {
    const Vec3<S> most = splat<S>(light.color);
    known.off = fma(S(shading.limits.slack.gain) * largest(most),
                    largest(hit.material.diffuse) + known.diffuse + hit.material.specular, known.off);
}

/// How far what a hit sends back of a light is off by its angles and its colours, as a share of the light.
template <class S>
STRAHL_INLINE S light_error(const Hit<S>& hit, const LitBounds<S>& lit, const S& cosine, const HitBounds<S>& known) {
    const S most = largest(hit.material.diffuse) + known.diffuse;
    return fma(most, lit.cosine, fma(known.diffuse, abs(cosine), lit.highlight));
}

/// By how much the share of its light that a spot sends along -l may be off, between 0 and 1.
///
/// x = |l + a|^2 / 2, if l and the axis are off by q, is by q |l + a| + q^2 / 2. The axis has 7/2 u; the cosines of the
/// cone's angles, less 1, 4 u; what x has of them, and its own, counts 8 u. Between the angles the share grows with
/// their way to x, so it is between what it is at the ends of that, and exactly 0 beyond the larger. The exponent
/// counts as a highlight's does.
template <class S>
[[gnu::noinline]] S spot_error(const LightKernel<Element<S>>& light, const Vec3<S>& l, const S& turn) {
    using T = Element<S>;
    constexpr auto u = unit_error<S>;
    const Vec3<S> off = l + splat<S>(light.axis);
    const S from_axis = dot(off, off) * S(T(.5)), q = turn + S(4 * u), way = S(light.falloff) - from_axis;
    const T most = light.radius + light.falloff;
    const S wrong = fma(S(1.01) * q, sqrt(from_axis + from_axis) + q, S(8 * u) * (from_axis + S(most))) +
                    abs(way) * S(light.radius < light.falloff ? 8 * u * most * light.per : T(0));
    const auto share = [&](const S& at) {
        const S part = min(max(at * S(light.per), S(0)), S(1));
        return part * part * fma(S(-2), part, S(3));
    };
    S error = share(way + wrong) - share(way - wrong) + S(8 * u);
    if (light.tightness != 0) {
        const S base = S(1) - from_axis, p(max(light.tightness, T(1))), x = p * wrong / base;
        const Mask<S> mild = (base > S(1e-3f)) & (x < S(.5));
        error = error + select(mild, fma(x, x, x) + S(.51 * u) * (p + S(8)), S(1));
    }
    return select(way + wrong < S(0), S(0), select(error < S(1), error, S(1)));
}
/// Adds it to the errors of hits, as far as they may be lit.
template <class S>
STRAHL_INLINE void add_spot_error(const Shading<S>& shading, const Hit<S>& hit, const LightKernel<Element<S>>& light,
                                  const LitBounds<S>& lit, const Vec3<S>& l, const S& cosine, const S& highlight,
                                  HitBounds<S>& known) {
    const S diffuse = largest(hit.material.diffuse), error = light_error(hit, lit, cosine, known);
    const S most = fma(diffuse, max(cosine, S(0)), highlight) + error, color = largest(splat<S>(light.color));
    const Mask<S> told = lit.ray.turn >= S(0);
    known.off = fma(S(shading.limits.slack.gain) * color * most,
                    select(told, spot_error(light, l, lit.ray.turn), S(1)), known.off);
}

/// The share of a light that reaches hits, in the lanes of `faces`. Adds the light's error to that of the hits.
template <class S>
STRAHL_INLINE Vec3<S> share_proved(const Shading<S>& shading, const Hit<S>& hit, const LitBounds<S>& lit,
                                   const Vec3<S>& l, const S& distance, Mask<S> faces, const S& cosine,
                                   const S& highlight, const Start<S>& start, HitBounds<S>& known) {
    const Ray<S> ray{hit.position, l, hit.surface};
    const Slack<Element<S>>& slack = shading.limits.slack;
    LightBounds<S> found = light_bounds(shading.world, DoubtfulRay<S>{ray, lit.ray}, distance, lit.distance,
                                        faces & known.followed, start, slack);
    Mask<S> doubt = faces & ((found.doubt & !found.dark) | !known.followed);
    Vec3<S> share = select(found.dark, Vec3<S>(S(0), S(0), S(0)), found.share);
    if (any(doubt)) share = select(doubt, visibility(shading.world, ray, distance, doubt, start), share);
    doubt = doubt | (hit.active & lit.doubt);
    const Vec3<S> color = splat<S>(shading.world.lights[start.light].color);
    const S diffuse = largest(hit.material.diffuse), error = light_error(hit, lit, cosine, known);
    const S light = fma(diffuse, abs(cosine), highlight);
    const S rounding = S(unit_error<S>) * found.crossings * light;
    const S certain = select(found.dark, S(0), fma(found.off, light + error, largest(share) * (error + rounding)));
    known.off = known.off + select(doubt, S(slack.gain) * largest(color) * (light + error),
                                   select(faces, largest(color) * certain, S(0)));
    return share;
}

}  // namespace strahl::inline STRAHL_LEVEL::inline STRAHL_INSTANCE
