// The kernel: camera rays, hits, light and new rays, generation by generation. Compiled once per instruction set.
#include "trace/kernel.h"

#include <algorithm>

#include "trace/query.h"
#include "trace/shade.h"

namespace strahl::inline STRAHL_LEVEL {
namespace {

/// Camera rays of a batch.
template <class S, class T>
void aim(const Eye<T>& eye, const PixelBatch<T>& batch, RayQueue<T>& rays) {
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

/// The bodies that rays of a pack can meet, those apart from all its rays left out: these start in a ball around the
/// first one's origin and leave within a cone around its direction. The bodies are looked at side by side.
template <class S, class T>
STRAHL_INLINE BodySet in_view(const World<T>& world, const Ray<S>& ray, Mask<S> active) {
    const auto first_of = [](const Vec3<S>& v) { return Vec3<S>(S(lane(v.x, 0)), S(lane(v.y, 0)), S(lane(v.z, 0))); };
    const Vec3<S> origin = first_of(ray.origin), axis = first_of(ray.direction), off = ray.origin - origin;
    const T rounding = 16 * std::numeric_limits<T>::epsilon();
    const T cosine = least(select(active, dot(ray.direction, axis), S(1))) - rounding;
    if (!(cosine > T(.5))) return ~BodySet(0);
    const T spread = sqrt(-least(select(active, -dot(off, off), S(0))));
    const S tangent(sqrt(1 - cosine * cosine) / cosine);
    BodySet set = 0;
    for (int i = 0; i < world.keys; i += width<S>) {
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

/// Calls visit(key, lanes) for the different keys of a pack.
template <class S, class Visit>
STRAHL_INLINE void each_key(const S& keys, Mask<S> active, const Visit& visit) {
    while (any(active)) {
        const Element<S> key = lane(keys, first(active));
        const Mask<S> lanes = active & (keys == S(key));
        visit(static_cast<int>(key), lanes);
        active = active & !lanes;
    }
}

/// Meets the nearest surfaces, and sorts the rays by the keys of these, stably.
template <class S, class T>
void find(const World<T>& world, const RayQueue<T>& rays, HitList<T>& hits) {
    for (int k = 0; k <= world.keys; ++k) hits.count[k] = 0;
    const auto pack_of = [&](int i) {
        const auto at = [i](const T* values) { return load_lanes<S>(values + i); };
        return Ray<S>{{at(rays.origin.x), at(rays.origin.y), at(rays.origin.z)},
                      {at(rays.direction.x), at(rays.direction.y), at(rays.direction.z)},
                      at(rays.source)};
    };
    constexpr int packs = 8;  // looked over together: what one waits for does not hold up the next
    for (int first = 0; first < rays.count; first += packs * width<S>) {
        const int last = std::min(rays.count, first + packs * width<S>);
        BodySet sets[packs];
        for (int i = first; i < last; i += width<S>)
            sets[(i - first) / width<S>] =
                world.key_per_item ? in_view(world, pack_of(i), first_lanes<S>(rays.count - i)) : ~BodySet(0);
        for (int i = first; i < last; i += width<S>) {
            const Mask<S> active = first_lanes<S>(rays.count - i);
            const Nearest<S> hit = nearest(world, pack_of(i), active, sets[(i - first) / width<S>]);
            store_lanes(hits.t + i, hit.t);
            store_lanes(hits.surface + i, hit.surface);
            const S number = iota<S>() + S(static_cast<T>(i));
            each_key(hit.key, active, [&](int key, Mask<S> lanes) {
                compress(hits.of(key) + hits.count[key], number, lanes);
                hits.count[key] += count(lanes);
            });
        }
    }
}

template <class T>
void append(RayQueue<T>& to, const RayQueue<T>& from) {
    const auto copy = [&](T* a, const T* b) { __builtin_memcpy(a + to.count, b, from.count * sizeof(T)); };
    for (int c = 0; c < 3; ++c) copy(to.origin[c], from.origin[c]), copy(to.direction[c], from.direction[c]);
    copy(to.source, from.source), copy(to.pixel, from.pixel), copy(to.weight, from.weight);
    copy(to.medium, from.medium);
    to.count += from.count;
}

/// One generation: its light is added to the pixels; its mirrored and then its refracted rays are the next, those
/// inside enclosed bodies apart. The order of a pixel's rays, and so its sum, depends on that pixel alone. False if the
/// next generation has no room.
template <class S, class T>
bool step(const World<T>& world, const Eye<T>& eye, const Generation<T>& rays, Generation<T>& next, int depth,
          const PixelBatch<T>& batch, Workspace<T>& workspace, KernelCounts& counts) {
    counts.depth = counts.depth < depth ? depth : counts.depth;
    HitList<T>& list = hits(workspace);
    find<S>(world, rays.open, list);
    RayQueue<T>& refracted = refracted_queue(workspace);
    next.open.count = next.inside.count = refracted.count = 0;
    Shading<S> shading{world, eye, rays, list, batch, next, refracted, workspace, counts, depth};
    shading.leave();
    bool room = true;
    world.groups.each([&](const auto& group) {
        for (int key = group.first_key; room && key < group.last_key; ++key) room = shading.shade(group, key);
    });
    if (!room || next.open.count + refracted.count > batch_rays || next.inside.count > batch_rays) return false;
    append(next.open, refracted);
    return true;
}

/// Rays [begin, begin + count) of a queue.
template <class T>
RayQueue<T> part_of(RayQueue<T> rays, int begin, int count) {
    const auto skip = [begin](T*& values) { values += begin; };
    for (int c = 0; c < 3; ++c) skip(rays.origin[c]), skip(rays.direction[c]);
    skip(rays.source), skip(rays.pixel), skip(rays.weight), skip(rays.medium), skip(rays.t);
    rays.count = count;
    return rays;
}

/// Generations of one pixel that are too large to hold, a part at a time. Parts are the same on any machine.
template <class S, class T>
void descend(const World<T>& world, const Eye<T>& eye, int slot, int depth, const PixelBatch<T>& batch,
             Workspace<T>& workspace, KernelCounts& counts) {
    constexpr int part = batch_rays / 2;
    const Generation<T>& all = generation(workspace, slot);
    Generation<T>& next = generation(workspace, slot + 1);
    const auto go = [&](const Generation<T>& some) {
        step<S>(world, eye, some, next, depth, batch, workspace, counts);
        if (next.rays()) descend<S>(world, eye, slot + 1, depth + 1, batch, workspace, counts);
    };
    std::int32_t begins[most_item_keys] = {}, ends[most_item_keys] = {};
    for (int begin = 0; begin < all.open.count; begin += part)
        go({part_of(all.open, begin, std::min(part, all.open.count - begin)), part_of(all.inside, 0, 0), begins, ends});
    for (int begin = 0; begin < all.inside.count; begin += part) {
        const int count = std::min(part, all.inside.count - begin);
        for (int key = 0; key < std::min(world.keys, most_item_keys); ++key) {
            begins[key] = std::clamp(all.inside_begin[key] - begin, 0, count);
            ends[key] = std::clamp(all.inside_end[key] - begin, 0, count);
        }
        go({part_of(all.open, 0, 0), part_of(all.inside, begin, count), begins, ends});
    }
}

template <class S>
bool trace(const World<Element<S>>& world, const Eye<Element<S>>& eye, const PixelBatch<Element<S>>& batch,
           Workspace<Element<S>>& workspace, KernelCounts& counts) {
    using T = Element<S>;
    const KernelCounts before = counts;
    const auto start = [&](int slot) {
        Generation<T>& first = generation(workspace, slot);
        aim<S>(eye, batch, first.open);
        first.inside.count = 0;
        std::fill_n(first.inside_begin, world.keys, 0);
        std::fill_n(first.inside_end, world.keys, 0);
        counts.camera += batch.count;
    };
    int slot = 0;
    start(slot);
    for (int depth = 1; generation(workspace, slot).rays() > 0; ++depth, slot = 1 - slot)
        if (!step<S>(world, eye, generation(workspace, slot), generation(workspace, 1 - slot), depth, batch, workspace,
                     counts)) {
            counts = before;
            if (batch.count > 1) return false;
            std::fill_n(batch.rgb, 4, T(0)), batch.past[0] = 0;
            constexpr int first_of_descent = 2;
            start(first_of_descent);
            descend<S>(world, eye, first_of_descent, 1, batch, workspace, counts);
            break;
        }
    return true;
}

template <class T>
using Widest =
#ifdef STRAHL_SCALAR
    T;
#else
    Pack<T>;
#endif

}  // namespace

Kernel<float> kernel_float() { return {trace<Widest<float>>, width<Widest<float>>}; }
Kernel<double> kernel_double() { return {trace<Widest<double>>, width<Widest<double>>}; }
#ifdef STRAHL_SCALAR
Kernel<long double> kernel_extended() { return {trace<long double>, 1}; }
#endif

}  // namespace strahl::inline STRAHL_LEVEL
