// The kernel: camera rays, hits, light and new rays, generation by generation. Compiled once per instruction set and
// element type (STRAHL_LEVEL, STRAHL_ELEMENT), and once more for proofs (STRAHL_PROVES).
#include "trace/kernel/kernel.h"

#include <algorithm>

#include "trace/kernel/shade.h"
#include "trace/proof/eye_bounds.h"

namespace strahl::inline STRAHL_LEVEL::inline STRAHL_INSTANCE {
namespace {

/// Camera rays of a batch.
template <class S, class T>
void generate_camera_rays(const Eye<T>& eye, const PixelBatch<T>& batch, RayQueue<T>& rays) {
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
}

/// The bodies that rays of a pack can meet: the rays start in a ball around the first one's origin and leave within a
/// cone around its direction. The bodies are tested side by side.
template <class S, class T>
STRAHL_INLINE BodySet cull_packet(const World<T>& world, const Ray<S>& ray, Mask<S> active,
                                  [[maybe_unused]] const IfProving<Doubt<T>>& most = {}) {
    const auto first_of = [](const Vec3<S>& v) { return Vec3<S>(S(lane(v.x, 0)), S(lane(v.y, 0)), S(lane(v.z, 0))); };
    const Vec3<S> origin = first_of(ray.origin), axis = first_of(ray.direction), off = ray.origin - origin;
    const T rounding = 16 * std::numeric_limits<T>::epsilon();
    T cosine = least(select(active, dot(ray.direction, axis), S(1))) - rounding;
    if constexpr (proves) cosine -= most.turn;
    if (!(cosine > T(.5))) return ~BodySet(0);
    T spread = sqrt(-least(select(active, -dot(off, off), S(0))));
    if constexpr (proves) spread += most.away;
    const S tangent(sqrt(1 - cosine * cosine) / cosine);
    BodySet set = 0;
    for (int i = 0; i < world.bins; i += width<S>) {
        const auto at = [i](const T* values) { return load_lanes<S>(values + i); };
        const Vec3<S> way = Vec3<S>(at(world.centres.x), at(world.centres.y), at(world.centres.z)) - origin;
        const S reach = at(world.radii) + S(spread), along = dot(way, axis);
        const Vec3<S> across = fma(-along, axis, way);
        const S widest = fma(max(along + reach, S(0)), tangent, reach);
        const Mask<S> met = (dot(across, across) <= widest * widest) & (along >= -reach);
        set |= BodySet(bits(met)) << i;
    }
    return set;
}

/// Calls visit(bin, lanes) for the different bins of a pack.
template <class S, class Visit>
STRAHL_INLINE void each_bin(const S& bins, Mask<S> active, const Visit& visit) {
    while (any(active)) {
        const Element<S> bin = lane(bins, first(active));
        const Mask<S> lanes = active & (bins == S(bin));
        visit(static_cast<int>(bin), lanes);
        active = active & !lanes;
    }
}

/// The largest doubts of a pack.
template <class S, class T>
STRAHL_INLINE Doubt<T> most_doubt(const RayQueue<T>& rays, int i, Mask<S> active) {
    const auto most = [&](const T* values) {
        return -least(select(active, min(-load_lanes<S>(values + i), S(0)), S(0)));
    };
    return {most(rays.away), most(rays.turn)};
}

/// The nearest surfaces in a world with a hierarchy, of rays from `first` on: `packs` packs, or as many as there are.
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

/// Finds the nearest surfaces, and sorts the rays by the bins of these, stably. The last three are for proofs.
template <class S, class T>
void intersect(const World<T>& world, const RayQueue<T>& rays, HitList<T>& hits,
               [[maybe_unused]] const Limits<T>& limits, [[maybe_unused]] int depth,
               [[maybe_unused]] const PixelBatch<T>& batch) {
    for (int k = 0; k <= world.bins; ++k) hits.count[k] = 0;
    const auto pack_of = [&](int i) {
        const auto at = [i](const T* values) { return load_lanes<S>(values + i); };
        return Ray<S>{{at(rays.origin.x), at(rays.origin.y), at(rays.origin.z)},
                      {at(rays.direction.x), at(rays.direction.y), at(rays.direction.z)},
                      at(rays.source)};
    };
    const auto find = [&](int i, Mask<S> active, BodySet set) __attribute__((always_inline)) {
        if constexpr (proves)
            return nearest_proved(world, limits, rays, i, pack_of(i), active, set, depth, batch);
        else
            return nearest(world, pack_of(i), active, set);
    };
    constexpr int packs = 8;  // culled together: what one waits for does not hold up the next
    for (int first = 0; first < rays.count; first += packs * width<S>) {
        const int last = std::min(rays.count, first + packs * width<S>);
        BodySet sets[packs];
        const auto cull = [&](int i, Mask<S> active) __attribute__((always_inline)) {
            if constexpr (proves)
                return limits.slack.fits() ? cull_packet(world, pack_of(i), active, most_doubt<S>(rays, i, active))
                                           : ~BodySet(0);
            else
                return cull_packet(world, pack_of(i), active);
        };
        for (int i = first; i < last; i += width<S>)
            sets[(i - first) / width<S>] = world.bin_per_item ? cull(i, first_lanes<S>(rays.count - i)) : BodySet(0);
        const auto keep = [&](int i, Mask<S> active, const Nearest<S>& hit) __attribute__((always_inline)) {
            store_lanes(hits.t + i, hit.t);
            store_lanes(hits.surface + i, hit.surface);
            const S number = iota<S>() + S(static_cast<T>(i));
            each_bin(hit.bin, active, [&](int bin, Mask<S> lanes) {
                compress(hits.of(bin) + hits.count[bin], number, lanes);
                hits.count[bin] += count(lanes);
            });
        };
        if (together<S> > 1 && !proves && world.nodes) {
            Nearest<S> found[packs];
            nearest_of_many(world, pack_of, first, rays.count, found);
            for (int i = first; i < last; i += width<S>)
                keep(i, first_lanes<S>(rays.count - i), found[(i - first) / width<S>]);
            continue;
        }
        for (int i = first; i < last; i += width<S>) {
            const Mask<S> active = first_lanes<S>(rays.count - i);
            keep(i, active, find(i, active, sets[(i - first) / width<S>]));
        }
    }
}

template <class T>
void append(RayQueue<T>& to, const RayQueue<T>& from) {
    const auto copy = [&](T* a, const T* b) { __builtin_memcpy(a + to.count, b, from.count * sizeof(T)); };
    for (int c = 0; c < 3; ++c) copy(to.origin[c], from.origin[c]), copy(to.direction[c], from.direction[c]);
    copy(to.source, from.source), copy(to.pixel, from.pixel), copy(to.weight, from.weight);
    copy(to.medium, from.medium);
    if constexpr (proves)
        copy(to.away, from.away), copy(to.turn, from.turn), copy(to.side, from.side), copy(to.spin, from.spin);
    if (to.width) [[unlikely]]
        copy(to.width, from.width), copy(to.spread, from.spread);
    to.count += from.count;
}

/// One generation: its light is added to the pixels; its reflected and then its refracted rays are the next, those
/// inside enclosed bodies apart. The order of a pixel's rays, and so its sum, depends on that pixel alone. False if the
/// next generation does not fit.
template <class S, class T>
bool trace_generation(const World<T>& world, const Limits<T>& limits, const Generation<T>& rays, Generation<T>& next,
                      int depth, const PixelBatch<T>& batch, Workspace<T>& workspace, Counts& counts) {
    counts.depth = counts.depth < depth ? depth : counts.depth;
    HitList<T>& list = hits(workspace);
    intersect<S>(world, rays.open, list, limits, depth, batch);
    RayQueue<T>& refracted = refracted_queue(workspace);
    next.open.count = next.inside.count = refracted.count = 0;
    const Shading<S> shading{world,
                             limits,
                             rays,
                             list,
                             batch,
                             next,
                             refracted,
                             workspace,
                             counts,
                             depth,
                             batch.sights != nullptr || world.bends != nullptr};
    shade_misses(shading);
    for (int bin = 0; bin < world.bins; ++bin)
        if (!shade_bin(shading, bin)) return false;
    if (shading.full()) return false;
    append(next.open, refracted);
    return true;
}

/// Rays [begin, begin + count) of a queue.
template <class T>
RayQueue<T> part_of(RayQueue<T> rays, int begin, int count) {
    const auto skip = [begin](T*& values) { values += begin; };
    for (int c = 0; c < 3; ++c) skip(rays.origin[c]), skip(rays.direction[c]);
    skip(rays.source), skip(rays.pixel), skip(rays.weight), skip(rays.medium), skip(rays.t);
    if constexpr (proves) skip(rays.away), skip(rays.turn), skip(rays.side), skip(rays.spin);
    if (rays.width) skip(rays.width), skip(rays.spread);
    rays.count = count;
    return rays;
}

/// Generations of one pixel that are too large to hold, a part at a time. Parts are the same on any machine.
template <class S, class T>
void trace_in_parts(const World<T>& world, const Limits<T>& limits, int slot, int depth, const PixelBatch<T>& batch,
                    Workspace<T>& workspace, Counts& counts) {
    if (limits.stopped()) return;
    constexpr int part = batch_rays / 2;
    const Generation<T>& all = generation(workspace, slot);
    Generation<T>& next = generation(workspace, slot + 1);
    const auto go = [&](const Generation<T>& some) {
        trace_generation<S>(world, limits, some, next, depth, batch, workspace, counts);
        if (next.rays()) trace_in_parts<S>(world, limits, slot + 1, depth + 1, batch, workspace, counts);
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

template <class S, class T>
bool trace(const World<T>& world, const Eye<T>& eye, const Limits<T>& limits, const PixelBatch<T>& batch,
           Workspace<T>& workspace, Counts& counts) {
    const Counts before = counts;
    const auto start = [&](int slot) {
        Generation<T>& first = generation(workspace, slot);
        generate_camera_rays<S>(eye, batch, first.open);
        if constexpr (proves) {
            std::fill_n(first.open.away, batch.count, limits.slack.eye_away);
            std::fill_n(first.open.side, batch.count, limits.slack.eye_away);
            for (int i = 0; i < batch.count; i += width<S>)
                store_lanes(first.open.turn + i,
                            camera_turn(eye, limits.slack, load_lanes<S>(batch.x + i), load_lanes<S>(batch.y + i)));
        }
        first.inside.count = 0;
        std::fill_n(first.inside_begin, world.bins, 0);
        std::fill_n(first.inside_end, world.bins, 0);
        counts.camera += batch.count;
    };
    int slot = 0;
    start(slot);
    for (int depth = 1; generation(workspace, slot).rays() > 0 && !limits.stopped(); ++depth, slot = 1 - slot)
        if (!trace_generation<S>(world, limits, generation(workspace, slot), generation(workspace, 1 - slot), depth,
                                 batch, workspace, counts)) {
            counts = before;
            if (batch.count > 1) return false;
            batch.sums[0] = {}, batch.past[0] = 0;
            if constexpr (proves) batch.bounds[0] = 0;
            constexpr int first_of_parts = 2;
            start(first_of_parts);
            trace_in_parts<S>(world, limits, first_of_parts, 1, batch, workspace, counts);
            break;
        }
    return true;
}

}  // namespace
}  // namespace strahl::inline STRAHL_LEVEL::inline STRAHL_INSTANCE

namespace strahl::inline STRAHL_LEVEL {

template <>
Kernel<STRAHL_ELEMENT> kernel<STRAHL_ELEMENT, proves>() {
    using S = Widest<STRAHL_ELEMENT>;
    return {trace<S, STRAHL_ELEMENT>, width<S>};
}

}  // namespace strahl::inline STRAHL_LEVEL
