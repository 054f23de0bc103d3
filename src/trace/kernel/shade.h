// Shades the hits of a generation: their light goes to the pixels, their rays to the next generation.
#pragma once
#include <algorithm>

#include "trace/kernel/finish.h"
#include "trace/kernel/fog.h"
#include "trace/kernel/footprint.h"
#include "trace/kernel/illuminate.h"
#include "trace/kernel/scatter.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns where rays start.
template <class S>
STRAHL_INLINE Vec3<S> origins_of(const RayQueue<Element<S>>& rays, const LaneIndices<S>& pick) {
    return {pick(rays.origin.x), pick(rays.origin.y), pick(rays.origin.z)};
}

/// Returns the share of the background's light that uneven fog leaves to rays that hit nothing.
template <class S, class P>
[[gnu::noinline]] S fog_before_sky(const Shading<S, P>& shading, const LaneIndices<S>& pick, const S& medium) {
    constexpr Element<S> far = 1e15f;
    const auto& d = shading.rays.open.direction;
    return left_by_fog(shading.world, S(1), medium, origins_of(shading.rays.open, pick),
                       Vec3<S>{pick(d.x), pick(d.y), pick(d.z)}, S(far));
}

/// Adds the background to the pixels of rays that hit nothing. In fog those outside all transparent bodies have its
/// colour.
template <class S, class P>
void shade_misses(const Shading<S, P>& shading) {
    const auto& world = shading.world;
    const auto& hits = shading.hits;
    for (int i = 0, left; (left = hits.count[world.bins] - i) > 0; i += width<S>) {
        const LaneIndices<S> pick(hits.of(world.bins) + i, left);
        const S weight = pick(shading.rays.open.weight);
        const S pixel = pick(shading.rays.open.pixel);
        if (notes_sights(shading)) [[unlikely]]
            note_misses(shading, pick(shading.rays.open.source), S(weight), S(pixel), pick.lanes);
        Vec3<S> color = splat<S>(world.background);
        if (world.patterns.sky) [[unlikely]] {
            const auto& d = shading.rays.open.direction;
            color = filters(shading) ? filtered_sky(shading, pick)
                                     : PatternCalls<S>::sky(world, {pick(d.x), pick(d.y), pick(d.z)});
        }
        S clear(0);
        if (notes_layers(shading)) [[unlikely]]
            clear = clear_share(shading, S(pixel)), color = scale(S(1) - clear, color);
        if (world.fog.any) [[unlikely]] {
            const Vec3<S> fog = splat<S>(world.fog.color);
            const S medium = medium_in_fog(shading, S(pick(shading.rays.open.medium)));
            if (world.fog.even) {
                color = world.nested ? select(medium == S(0), fog, color) : fog;
                clear = world.nested ? select(medium == S(0), S(0), clear) : S(0);
            } else {
                const S left = fog_before_sky(shading, pick, medium);
                color = color * tint_of_fog(world, medium);
                for (int c = 0; c < 3; ++c) color[c] = fma(left, color[c] - fog[c], fog[c]);
                clear = clear * left * gray_of(tint_of_fog(world, medium));
            }
        }
        if (world.finishes.carries) [[unlikely]]
            color = color * carried_by(shading, shading.rays.open, pick).tint;
        add_light(shading.batch, pixel, pick.lanes, scale(weight, color));
        if (notes_layers(shading)) [[unlikely]]
            note_clear(shading, S(pixel), pick.lanes,
                       S(weight * clear * gray_of(carried_by(shading, shading.rays.open, pick).tint)),
                       scale(weight, color));
        P::miss(shading, pick, weight, pixel, color);
    }
}

/// The material of a pack of hits, loaded again only where it differs from that of the pack before.
template <class S>
class HitMaterial {
    using T = Element<S>;

  public:
    MaterialKernel<S> values;
    int numbers[width<S>];  // of each lane's; only set where not all lanes are known to have the same
    bool uniform() const { return number >= 0; }
    STRAHL_INLINE void broadcast(const World<T>& world, int own) {
        if (own == number) return;
        values = splat_item<MaterialKernel<S>, S>(world.materials[own]);
        number = own;
    }
    STRAHL_INLINE void load(const World<T>& world) {
        if (std::all_of(numbers, numbers + width<S>, [&](int m) { return m == numbers[0]; }))
            return broadcast(world, numbers[0]);
        values = gather_items<MaterialKernel<S>, S>(world.materials, numbers);
        number = -1;
    }
    /// Sets the colours that the patterns have at these hits.
    template <class P>
    STRAHL_INLINE void paint(const Shading<S, P>& shading, const SurfaceHit<S>& hit, const RayQueue<T>& from,
                             const LaneIndices<S>& pick, const T* t) {
        MaterialKernel<S> copy = values;
        if (filters(shading))
            paint_filtered(shading, numbers, SurfaceHit<S>(hit), from, pick, pick(t), copy);
        else
            PatternCalls<S>::paint(shading.world, numbers, Vec3<S>(hit.point.position), S(hit.surface), copy);
        values = copy;
    }

  private:
    int number = -1;  // number of the material that all lanes have, else -1
};

/// Hits of a bin: the numbers of their rays, all on plain bodies or all on bodies with finishes.
template <class T>
struct BinHits {
    int bin;
    const T* rays;
    int count;
    bool finished;
};

template <class S, class P>
STRAHL_INLINE Hit<S> make_hit(const Shading<S, P>& shading, int bin, bool finished, const RayQueue<Element<S>>& from,
                              const LaneIndices<S>& pick, const Element<S>* t, HitMaterial<S>& material) {
    const auto& world = shading.world;
    const SortBin& own = world.sort_bins[bin];
    const Ray<S> ray{{pick(from.origin.x), pick(from.origin.y), pick(from.origin.z)},
                     {pick(from.direction.x), pick(from.direction.y), pick(from.direction.z)},
                     pick(from.source)};
    SurfaceHit<S> hit;
    if (own.material >= 0) {
        hit = surface_at(world, own, ray, pick(t));
        material.broadcast(world, own.material);
        if (finished || world.patterns.list) [[unlikely]] {
            std::fill_n(material.numbers, width<S>, own.material);
            if (patterned(world, own.material) && !finished) material.paint(shading, hit, from, pick, t);
        }
    } else {
        hit = surfaces_at(world, own.form, shading.hits.surface, pick, ray, pick(t), material.numbers);
        material.load(world);
        if (world.patterns.list && !finished) [[unlikely]]
            material.paint(shading, hit, from, pick, t);
    }
    const Mask<S> outside = dot(ray.direction, hit.point.normal) < S(0);
    return {first_lanes<S>(pick.lanes),
            ray.direction,
            hit.point.position,
            select(outside, hit.point.normal, -hit.point.normal),
            outside,
            hit.surface,
            hit.body,
            pick(from.pixel),
            pick(from.weight),
            world.nested ? pick(from.medium) : S(0),
            material.values,
            material.uniform(),
            bin};
}

/// Returns by what the light of hits is multiplied on its way to the eye.
template <class S, class P>
Vec3<S> factor_of(const Shading<S, P>& shading, const Hit<S>& hit, const RayQueue<Element<S>>& from,
                  const LaneIndices<S>& pick) {
    Vec3<S> factor = scale(hit.weight, carried_by(shading, from, pick).tint);
    if (shading.world.finishes.carries)
        factor = factor * tint_of_fog(shading.world, medium_in_fog(shading, S(hit.medium)));
    return factor;
}

/// Returns the mean directions of bent normals over footprints. Light that falls on all of them is less than on one in
/// that direction.
template <class S, class P>
[[gnu::noinline, gnu::cold]] Vec3<S> bend_filtered(const Shading<S, P>& shading, const Hit<S>& hit, const S& weight,
                                                   const HitNotes<S, P>& notes, HitMaterial<S>& material) {
    const Footprint<S> footprint = footprint_of(notes.beside, hit.direction, notes.flat, weight);
    S length;
    const Vec3<S> normal =
        PatternCalls<S>::bent_filtered(shading.world, material.numbers, hit.position, hit.surface, footprint, length);
    material.values.diffuse = scale(length, material.values.diffuse);  // painted anew for each pack
    return normal;
}

/// Shades hits of a bin, first those of rays inside an enclosed body. Returns false if the queues are full.
template <class S, class P>
bool shade_bin(const Shading<S, P>& shading, const BinHits<Element<S>>& own) {
    const auto& world = shading.world;
    const Generation<Element<S>>& rays = shading.rays;
    Generation<Element<S>>& next = shading.next;
    const int bin = own.bin, found = own.count;
    const int inside = world.few.enclosed ? rays.inside_end[bin] - rays.inside_begin[bin] : 0;
    next.inside_begin[bin] = next.inside.count;
    HitMaterial<S> material;
    for (int i = -inside, left; i < found; i += std::min(left, width<S>)) {
        left = i < 0 ? -i : found - i;
        if (shading.full()) return false;
        const bool within = i < 0;
        const LaneIndices<S> pick =
            within ? LaneIndices<S>(rays.inside_end[bin] + i, left) : LaneIndices<S>(own.rays + i, left);
        const RayQueue<Element<S>>& from = within ? rays.inside : rays.open;
        const Element<S>* const t = within ? rays.inside.t : shading.hits.t;
        Hit<S> hit = make_hit(shading, bin, own.finished, from, pick, t, material);
        if (world.fog.any) [[unlikely]]
            hit.weight = left_by_fog(world, S(hit.weight), medium_in_fog(shading, S(hit.medium)),
                                     origins_of(from, pick), Vec3<S>(hit.direction), pick(t));
        HitNotes<S, P> notes;
        P::meet(shading, hit, from, pick, t, within, material, notes.own);
        if (shading.has_notes) [[unlikely]] {
            notes.flat = hit.normal;
            Mask<S> filtered = first_lanes<S>(0);
            const bool exact = filters(shading) && !world.patterns.quick;
            if (exact) {
                note_differentials(shading, from, pick, hit, pick(t), notes);
                filtered = notes.beside.loose >= S(0);
            }
            if (world.patterns.bends) {
                if (exact)
                    hit.normal = bend_filtered(shading, hit, pick(from.weight), notes, material);
                else
                    hit.normal = PatternCalls<S>::bent(world, material.numbers, hit.position, hit.surface, notes.flat);
                P::bend(shading, material.numbers, hit, notes.flat, pick(from.weight), pick.lanes, notes.own);
            }
            if (filters(shading) && !exact) note_cones(shading, from, pick, hit, pick(t), notes);
            if (notes_sights(shading)) {
                S seen_from = pick(from.source);
                if (world.patterns.list)
                    seen_from = seen_from +
                                PatternCalls<S>::piece(world, material.numbers, hit.position, hit.surface, filtered);
                note_hits(shading, hit, seen_from, pick(t), pick.lanes, material.numbers, notes);
            }
        }
        if (own.finished) [[unlikely]] {
            shade_finish(shading, Hit<S>(hit), material.numbers, from, pick, pick(t), notes);
            for (int bend = 1; bend <= world.finishes.most_bends; ++bend) {
                Hit<S> layer = hit;
                layer.active = hit.active & FinishCalls<S>::bent(world, material.numbers, bend, hit.position,
                                                                 hit.surface, notes.flat, layer.normal);
                if (any(layer.active)) shade_finish(shading, layer, material.numbers, from, pick, pick(t), notes, bend);
            }
            continue;
        }
        Mask<S> dim = first_lanes<S>(0);
        const S weight = hit.weight;
        bool goes_on = shading.depth < shading.limits.depth;
        if (world.finishes.carries) [[unlikely]] {
            Onward<S> on;
            carry_on(shading, Hit<S>(hit), from, pick, true, notes.carried, on);
            hit.active = on.lanes, hit.weight = on.weight;
            goes_on = true;
        }
        if (goes_on)
            dim = scatter(shading, hit, notes);
        else
            truncate(shading, hit);
        if (world.finishes.carries) [[unlikely]]
            hit.active = first_lanes<S>(pick.lanes), hit.weight = weight;
        const Vec3<S> sum = illumination(shading, hit, dim, notes);
        Vec3<S> light = scale(hit.weight, sum);
        if (world.finishes.carries) [[unlikely]]
            light = light * tint_of_fog(world, medium_in_fog(shading, S(hit.medium)));
        if (world.fog.any) [[unlikely]]
            light = fma(pick(from.weight) - hit.weight, splat<S>(world.fog.color), light);
        if (world.finishes.carries) [[unlikely]]
            light = light * carried_by(shading, from, pick).tint;
        add_light(shading.batch, hit.pixel, pick.lanes, light);
        if (notes_layers(shading)) [[unlikely]]
            note_layers(shading, Hit<S>(hit), pick(t), pick.lanes, material.numbers, true, Vec3<S>(light), Vec3<S>(sum),
                        factor_of(shading, Hit<S>(hit), from, pick));
        P::shade(shading, hit, from, pick, pick(t), light, notes.own);
    }
    next.inside_end[bin] = next.inside.count;
    return true;
}

}  // namespace strahl::inline STRAHL_LEVEL
