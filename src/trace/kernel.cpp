// The kernel: camera rays, hits, light and new rays, generation by generation. Compiled once per instruction set.
#include "trace/kernel.h"

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
        store_lanes(rays.path + i, S(1));
        store_lanes(rays.interior + i, S(eye.interior));
    }
    rays.count = batch.count;
}

template <class S, class T>
void find(const World<T>& world, const RayQueue<T>& rays, HitList<T>& hits) {
    for (int i = 0; i < rays.count; i += width<S>) {
        const auto at = [i](const T* values) { return load_lanes<S>(values + i); };
        const Ray<S> ray{{at(rays.origin.x), at(rays.origin.y), at(rays.origin.z)},
                         {at(rays.direction.x), at(rays.direction.y), at(rays.direction.z)},
                         at(rays.source)};
        const Nearest<S> hit = nearest(world, ray, first_lanes<S>(rays.count - i));
        store_lanes(hits.t + i, hit.t);
        store_lanes(hits.surface + i, hit.surface);
    }
}

/// Sorts hits by key, stably; rays that hit nothing bring back the background.
template <class T>
void sort(const World<T>& world, const RayQueue<T>& rays, HitList<T>& hits, const PixelBatch<T>& batch) {
    for (int k = 0; k < world.keys; ++k) hits.key_end[k] = 0;
    for (int i = 0; i < rays.count; ++i) {
        if (hits.surface[i] >= 0)
            ++hits.key_end[world.places[static_cast<int>(hits.surface[i])].key];
        else
            for (int c = 0; c < 3; ++c)
                batch.rgb[c][static_cast<int>(rays.pixel[i])] += rays.weight[i] * world.background[c];
    }
    int begin = 0;
    for (int k = 0; k < world.keys; ++k) {
        const int count = hits.key_end[k];
        hits.key_end[k] = begin;
        begin += count;
    }
    for (int i = 0; i < rays.count; ++i)
        if (hits.surface[i] >= 0) hits.order[hits.key_end[world.places[static_cast<int>(hits.surface[i])].key]++] = i;
}

template <class T>
void append(RayQueue<T>& to, const RayQueue<T>& from) {
    const auto copy = [&](T* a, const T* b) { __builtin_memcpy(a + to.count, b, from.count * sizeof(T)); };
    for (int c = 0; c < 3; ++c) copy(to.origin[c], from.origin[c]), copy(to.direction[c], from.direction[c]);
    copy(to.source, from.source), copy(to.pixel, from.pixel), copy(to.weight, from.weight);
    copy(to.path, from.path), copy(to.interior, from.interior);
    to.count += from.count;
}

/// One generation: its light is added to the pixels, its mirrored and then its refracted rays are the next. The order
/// of a pixel's rays, and so its sum, depends on that pixel alone. False if the next generation has no room.
template <class S, class T>
bool step(const World<T>& world, const Eye<T>& eye, const RayQueue<T>& rays, RayQueue<T>& next, RayQueue<T>& aside,
          int depth, const PixelBatch<T>& batch, Workspace<T>& workspace, KernelCounts& counts) {
    counts.depth = counts.depth < depth ? depth : counts.depth;
    HitList<T>& list = hits(workspace);
    find<S>(world, rays, list);
    sort(world, rays, list, batch);
    next.count = aside.count = 0;
    Shading<S> shading{world, eye, rays, list, batch, next, aside, workspace, counts, depth};
    bool room = true;
    world.groups.each([&](const auto& group) {
        for (int key = group.first_key; room && key < group.last_key; ++key)
            room = shading.shade(group, key ? list.key_end[key - 1] : 0, list.key_end[key]);
    });
    if (!room || next.count + aside.count > batch_rays) return false;
    counts.reflected += next.count;
    counts.refracted += aside.count;
    append(next, aside);
    return true;
}

/// Generations of one pixel that are too large to hold, a part at a time. Parts are the same on any machine.
template <class S, class T>
void descend(const World<T>& world, const Eye<T>& eye, int slot, int depth, const PixelBatch<T>& batch,
             Workspace<T>& workspace, KernelCounts& counts) {
    constexpr int part = batch_rays / 2;
    RayQueue<T>& rays = queue(workspace, slot);
    for (int begin = 0; begin < rays.count; begin += part) {
        RayQueue<T> some = rays;
        const auto skip = [begin](T*& values) { values += begin; };
        for (int c = 0; c < 3; ++c) skip(some.origin[c]), skip(some.direction[c]);
        skip(some.source), skip(some.pixel), skip(some.weight), skip(some.path), skip(some.interior);
        some.count = rays.count - begin < part ? rays.count - begin : part;
        RayQueue<T>& next = queue(workspace, slot + 1);
        step<S>(world, eye, some, next, queue(workspace, 2), depth, batch, workspace, counts);
        if (next.count) descend<S>(world, eye, slot + 1, depth + 1, batch, workspace, counts);
    }
}

template <class S>
bool trace(const World<Element<S>>& world, const Eye<Element<S>>& eye, const PixelBatch<Element<S>>& batch,
           Workspace<Element<S>>& workspace, KernelCounts& counts) {
    using T = Element<S>;
    const KernelCounts before = counts;
    int slot = 0;
    aim<S>(eye, batch, queue(workspace, slot));
    counts.camera += batch.count;
    for (int depth = 1; queue(workspace, slot).count > 0; ++depth, slot = 1 - slot)
        if (!step<S>(world, eye, queue(workspace, slot), queue(workspace, 1 - slot), queue(workspace, 2), depth, batch,
                     workspace, counts)) {
            counts = before;
            if (batch.count > 1) return false;
            for (T* channel : batch.rgb) channel[0] = 0;
            constexpr int first_of_descent = 3;
            aim<S>(eye, batch, queue(workspace, first_of_descent));
            counts.camera += 1;
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
