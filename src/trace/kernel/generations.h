// Traces a batch of pixels: camera rays, their hits, light and new rays, generation by generation.
#pragma once
#include <algorithm>
#include <array>

#include "trace/kernel/shade.h"
#include "trace/kernel/touching.h"

namespace strahl::inline STRAHL_LEVEL {
namespace {  // a copy for each kernel, so that functions which are called once are inlined

/// Generates the camera rays of a batch, one through each of its places (x, y). `carry`: rays carry colours and counts.
template <class S, class T>
void generate_camera_rays(const Eye<T>& eye, const PixelBatch<T>& batch, bool carry, Workspace<T>& workspace,
                          RayQueue<T>& rays) {
    for (int i = 0; i < batch.count; i += width<S>) {
        const S u = fma(load_lanes<S>(batch.x + i), S(eye.scale_x), S(eye.bias_x));
        const S v = fma(load_lanes<S>(batch.y + i), S(eye.scale_y), S(eye.bias_y));
        const Vec3<S> d = fma(u, splat<S>(eye.right), fma(v, splat<S>(eye.down), splat<S>(eye.forward)));
        const Vec3<S> direction = scale(S(1) / sqrt(dot(d, d)), d);
        for (int c = 0; c < 3; ++c) {
            store_lanes(rays.origin[c] + i, S(eye.position[c]));
            store_lanes(rays.direction[c] + i, direction[c]);
        }
        store_lanes(rays.source + i, S(-1));
        store_lanes(rays.pixel + i, iota<S>() + S(static_cast<T>(i)));
        store_lanes(rays.weight + i, S(1));
        store_lanes(rays.medium + i, S(eye.medium));
    }
    rays.count = batch.count;
    if (carry)
        for (T* const array : {rays.tint[0], rays.tint[1], rays.tint[2], rays.level, rays.mirrored})
            std::fill_n(array, batch.count, T(array != rays.mirrored));
    if (eye.rays) [[unlikely]]
        make_camera_rays(*eye.rays, batch, workspace, rays);
}

/// Returns the bodies that these rays of a pack, one at least, can meet, and perhaps more: the rays start in a ball
/// around the first one's origin and leave within a cone around its direction, both widened by the policy. All bodies
/// if that cone is 60 degrees or wider on each side of its axis. Bodies are tested side by side.
template <class S, class T, class Widening>
STRAHL_INLINE BodySet cull_cone(const World<T>& world, const Ray<S>& ray, Mask<S> active, const Widening& widening) {
    const int number = first(active);
    const auto first_of = [&](const Vec3<S>& v) {
        return Vec3<S>(S(lane(v.x, number)), S(lane(v.y, number)), S(lane(v.z, number)));
    };
    const Vec3<S> origin = first_of(ray.origin), axis = first_of(ray.direction), off = ray.origin - origin;
    const T rounding = 16 * std::numeric_limits<T>::epsilon();
    const T cosine = widening.turned(least(select(active, dot(ray.direction, axis), S(1))) - rounding);
    if (!(cosine > T(.5))) return ~BodySet(0);
    const T spread = widening.moved(sqrt(-least(select(active, -dot(off, off), S(0)))));
    const S tangent(sqrt(1 - cosine * cosine) / cosine);
    BodySet set = 0;
    for (int i = 0; i < world.bins; i += width<S>) {
        const auto at = [i](const T* values) { return load_lanes<S>(values + i); };
        const Vec3<S> way = Vec3<S>(at(world.few.centres.x), at(world.few.centres.y), at(world.few.centres.z)) - origin;
        const S reach = at(world.few.radii) + S(spread), along = dot(way, axis);
        const Vec3<S> across = fma(-along, axis, way);
        const S widest = fma(max(along + reach, S(0)), tangent, reach);
        const Mask<S> met = (dot(across, across) <= widest * widest) & (along >= -reach);
        set |= BodySet(bits(met)) << i;
    }
    return set;
}

/// Returns the bodies that a quarter of a pack's rays can meet, or another one. Rays from bent mirrors go far apart,
/// but those of neighbours less so.
template <class S, class T, class Widening>
[[gnu::noinline]] BodySet cull_quarters(const World<T>& world, const Ray<S>& ray, Mask<S> active,
                                        const Widening& widening) {
    constexpr int quarter = std::max(1, width<S> / 4);
    BodySet set = 0;
    for (int i = 0; i < width<S> && set != ~BodySet(0); i += quarter) {
        const Mask<S> own = active & first_lanes<S>(i + quarter) & !first_lanes<S>(i);
        if (any(own)) set |= cull_cone(world, ray, own, widening);
    }
    return set;
}

/// Returns the bodies that rays of a pack can meet, and perhaps more.
template <class S, class T, class Widening>
STRAHL_INLINE BodySet cull_packet(const World<T>& world, const Ray<S>& ray, Mask<S> active, const Widening& widening) {
    constexpr int few = 16;  // so many bodies take no longer to test than to cull
    const BodySet set = cull_cone(world, ray, active, widening);
    if (set != ~BodySet(0) || width<S> == 1 || world.bins <= few) return set;
    return cull_quarters(world, ray, active, widening);
}

/// Calls visit(bin, lanes) for each different bin of a pack.
template <class S, class Visit>
STRAHL_INLINE void each_bin(const S& bins, Mask<S> active, const Visit& visit) {
    while (any(active)) {
        const Element<S> bin = lane(bins, first(active));
        const Mask<S> lanes = active & (bins == S(bin));
        visit(static_cast<int>(bin), lanes);
        active = active & !lanes;
    }
}

/// Finds the nearest surfaces in a world with a hierarchy, for the rays from `first` on: `packs` packs, or as many as
/// there are.
template <class S, int packs, class PackOf>
[[gnu::noinline]] void nearest_of_many(const World<Element<S>>& world, const PackOf& pack_of, int first, int rays,
                                       Nearest<S> (&found)[packs]) {
    static_assert(packs % together<S> == 0);
    for (int n = 0; n < packs && first + n * width<S> < rays; n += together<S>) {
        Ray<S> own[together<S>];
        Mask<S> active[together<S>];
        Nearest<S> best[together<S>];
        for (int h = 0; h < together<S>; ++h) {
            const int i = first + (n + h) * width<S>;
            own[h] = i < rays ? pack_of(i) : own[0];
            active[h] = first_lanes<S>(rays - i);
            best[h] = nearest_in_loops(world, own[h], active[h], 0);
        }
        nearest_beyond_loops(world, own, active, 0, best);
        for (int h = 0; h < together<S>; ++h) found[n + h] = best[h];
    }
}

/// Finds the nearest surfaces that rays meet, and sorts the rays stably by the bins of these.
template <class P, class S, class T>
void intersect(const World<T>& world, const RayQueue<T>& rays, HitList<T>& hits, const Limits<T>& limits, int depth,
               const PixelBatch<T>& batch) {
    for (int k = 0; k <= world.bins; ++k) hits.count[k] = 0;
    const auto pack_of = [&](int i) { return rays_at<S>(rays, i); };
    constexpr int packs = 8;  // so many are culled before one is traced, so that the processor need not wait for each
    for (int first = 0; first < rays.count; first += packs * width<S>) {
        const int last = std::min(rays.count, first + packs * width<S>);
        BodySet sets[packs];
        const auto cull = [&](int i, Mask<S> active) __attribute__((always_inline)) {
            return P::culls(limits) ? cull_packet(world, pack_of(i), active, P::template widening<S>(rays, i, active))
                                    : ~BodySet(0);
        };
        for (int i = first; i < last; i += width<S>)
            sets[(i - first) / width<S>] = world.bin_per_item ? cull(i, first_lanes<S>(rays.count - i)) : BodySet(0);
        const auto keep = [&](int i, Mask<S> active, Nearest<S> hit) __attribute__((always_inline)) {
            if (P::passes_touching && world.passed_over > 0) [[unlikely]] {
                const Mask<S> near = active & (hit.t < S(world.passed_over));
                if (any(near)) {
                    Nearest<S> copy = hit;
                    pass_near(world, rays, i, near, copy);
                    hit = copy;
                }
            }
            if (P::passes_touching && world.farthest < std::numeric_limits<T>::infinity()) [[unlikely]] {
                const Mask<S> far = hit.t >= S(world.farthest);
                hit.t = select(far, S(std::numeric_limits<T>::infinity()), hit.t);
                hit.surface = select(far, S(T(-1)), hit.surface);
                hit.bin = select(far, S(static_cast<T>(world.bins)), hit.bin);
            }
            if (P::passes_touching && depth > 1) {
                const Mask<S> touching = active & (hit.t <= touching_distance(pack_of(i).origin));
                if (any(touching)) [[unlikely]] {
                    Nearest<S> copy = hit;
                    pass_touching(world, rays, i, touching, copy);
                    hit = copy;
                }
            }
            store_lanes(hits.t + i, hit.t);
            store_lanes(hits.surface + i, hit.surface);
            const S number = iota<S>() + S(static_cast<T>(i));
            each_bin(hit.bin, active, [&](int bin, Mask<S> lanes) {
                compress(hits.of(bin) + hits.count[bin], number, lanes);
                hits.count[bin] += count(lanes);
            });
        };
        if (P::joins && together<S> != 1 && world.nodes) {
            Nearest<S> found[packs];
            nearest_of_many(world, pack_of, first, rays.count, found);
            for (int i = first; i < last; i += width<S>)
                keep(i, first_lanes<S>(rays.count - i), found[(i - first) / width<S>]);
            continue;
        }
        for (int i = first; i < last; i += width<S>) {
            const Mask<S> active = first_lanes<S>(rays.count - i);
            keep(i, active,
                 P::nearest(world, limits, rays, i, pack_of(i), active, sets[(i - first) / width<S>], depth, batch));
        }
    }
}

/// Appends the open rays of one queue to those of another.
template <class T>
void append(RayQueue<T>& to, const RayQueue<T>& from) {
    each_array(
        [&](RayPart part, T* own, const T* added) {
            if (added && part != RayPart::inside) __builtin_memcpy(own + to.count, added, from.count * sizeof(T));
        },
        to, from);
    to.count += from.count;
}

/// Returns the hits of a bin: those on plain bodies, and those on bodies with finishes if there are any; the order of
/// either does not change. The list of misses is used up.
template <class T>
[[gnu::noinline]] std::array<BinHits<T>, 2> plain_first(const World<T>& world, const HitList<T>& hits, int bin) {
    const int count = hits.count[bin], material = world.sort_bins[bin].material;
    if (material >= 0) return {{{bin, hits.of(bin), count, !world.finishes.list[material].plain}, {}}};
    T *const list = hits.of(bin), *const later = hits.of(world.bins);
    int plain = 0, finished = 0;
    for (int i = 0; i < count; ++i) {
        const T ray = list[i];
        if (world.finishes.finished[static_cast<int>(hits.surface[static_cast<int>(ray)])])
            later[finished++] = ray;
        else
            list[plain++] = ray;
    }
    std::copy_n(later, finished, list + plain);
    return {{{bin, list, plain, false}, {bin, list + plain, finished, true}}};
}

/// Traces one generation: adds its light to the pixels and makes the next one, of its reflected and then its refracted
/// rays, those inside enclosed bodies apart. The order of a pixel's rays, and so its sum, depends on that pixel alone.
/// Returns false if the next generation does not fit.
template <class P, class S, class T>
bool trace_generation(const World<T>& world, const Limits<T>& limits, const Generation<T>& rays, Generation<T>& next,
                      int depth, const PixelBatch<T>& batch, Workspace<T>& workspace, Counts& counts) {
    counts.depth = counts.depth < depth ? depth : counts.depth;
    HitList<T>& list = hits(workspace);
    intersect<P, S>(world, rays.open, list, limits, depth, batch);
    RayQueue<T>& refracted = refracted_queue(workspace);
    next.open.count = next.inside.count = refracted.count = 0;
    const Shading<S, P> shading{world,
                                limits,
                                rays,
                                list,
                                batch,
                                next,
                                refracted,
                                workspace,
                                counts,
                                depth,
                                batch.sights || batch.footprints || world.patterns.bends};
    shade_misses(shading);
    for (int bin = 0; bin < world.bins; ++bin) {
        std::array<BinHits<T>, 2> parts{{{bin, list.of(bin), list.count[bin], false}, {}}};
        if (world.finishes.finished) [[unlikely]]
            parts = plain_first(world, list, bin);
        for (int i = 0; i < 2; ++i)
            if ((i == 0 || parts[i].count > 0) && !shade_bin(shading, parts[i])) return false;
    }
    if (shading.full()) return false;
    append(next.open, refracted);
    return true;
}

/// Returns rays [begin, begin + count) of a queue.
template <class T>
RayQueue<T> part_of(RayQueue<T> rays, int begin, int count) {
    each_array(
        [begin](RayPart, T*& values) {
            if (values) values += begin;
        },
        rays);
    rays.count = count;
    return rays;
}

/// Traces the generations of one pixel that are too large to hold, a part at a time. Parts are the same on any machine.
template <class P, class S, class T>
void trace_in_parts(const World<T>& world, const Limits<T>& limits, int slot, int depth, const PixelBatch<T>& batch,
                    Workspace<T>& workspace, Counts& counts) {
    if (limits.stopped()) return;
    const int part = room_of_queue(world, batch_rays) / rays_of_hit(world);
    const Generation<T>& all = generation(workspace, slot);
    Generation<T>& next = generation(workspace, slot + 1);
    const auto go = [&](const Generation<T>& some) {
        trace_generation<P, S>(world, limits, some, next, depth, batch, workspace, counts);
        if (next.rays()) trace_in_parts<P, S>(world, limits, slot + 1, depth + 1, batch, workspace, counts);
    };
    std::int32_t begins[most_item_bins] = {}, ends[most_item_bins] = {};
    for (int begin = 0; begin < all.open.count; begin += part)
        go({part_of(all.open, begin, std::min(part, all.open.count - begin)), part_of(all.inside, 0, 0), begins, ends});
    for (int begin = 0; begin < all.inside.count; begin += part) {
        const int count = std::min(part, all.inside.count - begin);
        for (int bin = 0; bin < std::min(world.bins, most_item_bins); ++bin) {
            begins[bin] = std::clamp(all.inside_begin[bin] - begin, 0, count);
            ends[bin] = std::clamp(all.inside_end[bin] - begin, 0, count);
        }
        go({part_of(all.open, 0, 0), part_of(all.inside, begin, count), begins, ends});
    }
}

/// Traces a batch (see TraceBatch) by a kernel of policy P.
template <class P, class S, class T>
bool trace(const World<T>& world, const Eye<T>& eye, const Limits<T>& limits, const PixelBatch<T>& batch,
           Workspace<T>& workspace, Counts& counts) {
    const Counts before = counts;
    const auto start = [&](int slot) {
        Generation<T>& first = generation(workspace, slot);
        batch.clear();
        generate_camera_rays<S>(eye, batch, world.finishes.carries, workspace, first.open);
        P::start(world, eye, limits, batch, first.open);
        first.inside.count = 0;
        std::fill_n(first.inside_begin, world.bins, 0);
        std::fill_n(first.inside_end, world.bins, 0);
        counts.camera += batch.count;
    };
    int slot = 0;
    start(slot);
    for (int depth = 1; generation(workspace, slot).rays() > 0 && !limits.stopped(); ++depth, slot = 1 - slot)
        if (!trace_generation<P, S>(world, limits, generation(workspace, slot), generation(workspace, 1 - slot), depth,
                                    batch, workspace, counts)) {
            counts = before;
            if (batch.count > 1) return false;
            constexpr int first_of_parts = 2;
            start(first_of_parts);
            trace_in_parts<P, S>(world, limits, first_of_parts, 1, batch, workspace, counts);
            break;
        }
    return true;
}

}  // namespace
}  // namespace strahl::inline STRAHL_LEVEL
