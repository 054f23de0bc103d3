// Light at hits, and the rays that go on from them.
#pragma once
#include <cmath>

#include "trace/kernel.h"
#include "trace/query.h"

namespace strahl::inline STRAHL_LEVEL {

/// x^p for x > 0, p >= 0. Whole exponents, which is what scenes have, by squaring: the same bits on every machine.
template <class S>
STRAHL_INLINE S power(S x, S p) {
    using T = Element<S>;
    const Mask<S> whole = (floor(p) == p) & (p <= S(1024));
    S result(1), base = x, e = select(whole, p, S(0));
    while (any(e > S(0))) {
        const S half = floor(e * S(T(.5)));
        result = select(half + half < e, result * base, result);
        base *= base;
        e = half;
    }
    if (!all(whole)) {
        T bases[width<S>], exponents[width<S>];
        store_lanes(bases, x), store_lanes(exponents, p);
        for (int i = 0; i < width<S>; ++i) bases[i] = std::pow(bases[i], exponents[i]);
        result = select(whole, result, load_lanes<S>(bases));
    }
    return result;
}

/// Puts lengths that are right but for rounding back to 1.
template <class S>
STRAHL_INLINE Vec3<S> unit(const Vec3<S>& v) {
    using T = Element<S>;
    return scale(fma(S(T(-.5)), dot(v, v), S(T(1.5))), v);
}

template <class T>
STRAHL_INLINE T largest(const Vec3<T>& v) {
    return max(v.x, max(v.y, v.z));
}

/// The shading of one generation.
template <class S>
struct Shading {
    using T = Element<S>;
    const World<T>& world;
    const Eye<T>& eye;
    const RayQueue<T>& rays;
    const HitList<T>& hits;
    const PixelBatch<T>& batch;
    RayQueue<T>&reflected, &refracted;
    Workspace<T>& workspace;
    KernelCounts& counts;
    int depth;

    /// What is known of a pack of hits.
    struct Hit {
        Mask<S> active;
        Vec3<S> direction, position, normal;  // the normal is turned towards the incoming ray
        Mask<S> outside;                      // it comes from the side the surface faces
        S surface, body, pixel, weight, path, interior;
        MaterialKernel<S> material;
    };

    /// Shades hits [begin, end) of the order, all on items of this group. False if the queues are full.
    template <class Group>
    bool shade(const Group& group, int begin, int end) {
        for (int i = begin; i < end; i += width<S>) {
            if (reflected.count + refracted.count > batch_rays) return false;
            const int lanes = end - i < width<S> ? end - i : width<S>;
            int index[width<S>];
            for (int k = 0; k < width<S>; ++k) index[k] = hits.order[i + (k < lanes ? k : 0)];
            const bool consecutive = lanes == width<S> && index[width<S> - 1] - index[0] == width<S> - 1;
            const auto fetch = [&](const T* values) {
                return consecutive ? load_lanes<S>(values + index[0]) : gather<S>(values, index);
            };
            const Hit hit = meet(group, index, first_lanes<S>(lanes), fetch);
            add(illumination(hit), hit, lanes, consecutive && depth == 1);
            if (depth < eye.depth) spawn(hit);
        }
        return true;
    }

  private:
    template <class Group, class Fetch>
    STRAHL_INLINE Hit meet(const Group& group, const int* index, Mask<S> active, const Fetch& fetch) const {
        const Ray<S> ray{{fetch(rays.origin.x), fetch(rays.origin.y), fetch(rays.origin.z)},
                         {fetch(rays.direction.x), fetch(rays.direction.y), fetch(rays.direction.z)},
                         fetch(rays.source)};
        int items[width<S>];
        for (int k = 0; k < width<S>; ++k) items[k] = world.places[static_cast<int>(hits.surface[index[k]])].item;
        using PackItem = typename Group::template ItemOf<S>;
        const PackItem item = world.key_per_item ? splat_item<PackItem, S>(group.items[items[0]])
                                                 : gather_items<PackItem, S>(group.items, items);
        int materials[width<S>];
        for (int k = 0; k < width<S>; ++k) materials[k] = static_cast<int>(group.items[items[k]].material);
        const SurfacePoint<S> point = item.shape.at(ray, fetch(hits.t), ray.source - item.surface);
        const Mask<S> outside = dot(ray.direction, point.normal) < S(0);
        return {active,
                ray.direction,
                point.position,
                select(outside, point.normal, -point.normal),
                outside,
                item.surface + point.face,
                item.surface,
                fetch(rays.pixel),
                fetch(rays.weight),
                fetch(rays.path),
                world.nested ? fetch(rays.interior) : S(0),
                world.key_per_item ? splat_item<MaterialKernel<S>, S>(world.materials[materials[0]])
                                   : gather_items<MaterialKernel<S>, S>(world.materials, materials)};
    }
    /// Ia Ka Of + sum over lights S Il [Kd Of (n.l) + Ks (h.l)^p]
    STRAHL_INLINE Vec3<S> illumination(const Hit& hit) {
        const MaterialKernel<S>& material = hit.material;
        const S zero(0);
        Vec3<S> light = material.ambient;
        const Vec3<S> mirrored = reflect(hit);
        const S strongest = largest(material.diffuse);
        if (none(hit.active & ((strongest > zero) | (material.specular > zero)))) return light;
        for (int i = 0; i < world.light_count; ++i) {
            const LightKernel<T>& lamp = world.lights[i];
            const Vec3<S> to_lamp = splat<S>(lamp.position) - hit.position;
            const S distance = sqrt(dot(to_lamp, to_lamp));
            const Vec3<S> l = scale(S(1) / distance, to_lamp);
            S cosine = dot(hit.normal, l);
            const S shine = min(max(dot(mirrored, l), zero), S(1));  // or sharp highlights blow rounding up
            const Mask<S> glossy = hit.active & (shine > zero) & (material.specular > zero);
            S highlight = any(glossy) ? select(glossy, material.specular * power(shine, material.pow), zero) : zero;
            // Whether anything is between only matters where there is light to lose.
            const S most = S(largest(lamp.color)) * fma(strongest, cosine, highlight);
            const Mask<S> faces = hit.active & (cosine > zero) & (most * hit.path > S(eye.faint));
            if (none(faces)) continue;
            counts.shadow += count(faces);
            const Vec3<S> share = visibility(world, Ray<S>{hit.position, l, hit.surface}, distance, faces);
            cosine = select(faces, cosine, zero);  // at the lamp itself it is NaN
            highlight = select(faces, highlight, zero);
            for (int c = 0; c < 3; ++c)
                light[c] = fma(share[c] * S(lamp.color[c]), fma(material.diffuse[c], cosine, highlight), light[c]);
        }
        return light;
    }

    STRAHL_INLINE void add(const Vec3<S>& light, const Hit& hit, int lanes, bool in_a_row) {
        T pixel[width<S>], sum[width<S>];
        store_lanes(pixel, hit.pixel);
        for (int c = 0; c < 3; ++c) {
            T* const to = batch.rgb[c];
            if (in_a_row) {  // the pixels of consecutive camera rays are consecutive
                T* const first = to + static_cast<int>(pixel[0]);
                store_lanes(first, load_lanes<S>(first) + hit.weight * light[c]);
                continue;
            }
            store_lanes(sum, hit.weight * light[c]);
            for (int k = 0; k < lanes; ++k) to[static_cast<int>(pixel[k])] += sum[k];
        }
    }

    STRAHL_INLINE static Vec3<S> reflect(const Hit& hit) {
        return fma(S(-2) * dot(hit.direction, hit.normal), hit.normal, hit.direction);
    }

    /// Mirrored and refracted rays of what can still be seen.
    STRAHL_INLINE void spawn(const Hit& hit) {
        const MaterialKernel<S>& material = hit.material;
        const S zero(0);
        S reflection = material.reflection, path = hit.path * material.path_reflected;
        const Mask<S> glass = hit.active & (material.refraction > zero);
        if (world.transparent && any(glass)) {
            S b = select(hit.outside, S(1) / material.ior, material.ior), list = hit.interior;
            if (world.nested) change_medium(hit, glass, b, list);
            const S s = -dot(hit.direction, hit.normal);
            const S k = fma(b * b, fma(s, s, S(-1)), S(1));
            const Mask<S> total = glass & (k < zero);
            const S all = reflection + material.refraction;
            reflection = select(total, all, reflection);
            path = select(total, hit.path * all, path);
            const Vec3<S> g = fma(fma(b, s, -sqrt(max(k, zero))), hit.normal, scale(b, hit.direction));
            push(refracted, hit, glass & !total, g, material.refraction, hit.path * material.path_refracted, list);
        }
        push(reflected, hit, hit.active, reflect(hit), reflection, path, hit.interior);
    }

    STRAHL_INLINE void push(RayQueue<T>& to, const Hit& hit, Mask<S> mask, const Vec3<S>& direction, S share, S path,
                            S list) {
        const S weight = min(hit.weight * share, S(largest_gain));
        mask = mask & (weight > S(0)) & (path > S(eye.cutoff));
        if (none(mask)) return;
        const Vec3<S> d = unit(direction);
        const int n = to.count;
        for (int c = 0; c < 3; ++c) {
            compress(to.origin[c] + n, hit.position[c], mask);
            compress(to.direction[c] + n, d[c], mask);
        }
        compress(to.source + n, hit.surface, mask);
        compress(to.pixel + n, hit.pixel, mask);
        compress(to.weight + n, weight, mask);
        compress(to.path + n, path, mask);
        if (world.nested) compress(to.interior + n, list, mask);
        to.count += count(mask);
    }

    /// The ratio of indices and the list beyond the surface, by the list of bodies entered (as POV-Ray does): from
    /// outside all, into the body; from the body entered last, out of it; from one entered before, straight on.
    void change_medium(const Hit& hit, Mask<S> glass, S& ratio, S& list) {
        T ratios[width<S>], lists[width<S>], bodies[width<S>], wanted[width<S>];
        store_lanes(ratios, ratio), store_lanes(lists, list), store_lanes(bodies, hit.body);
        store_lanes(wanted, select(glass, S(1), S(0)));
        Interiors& interiors = strahl::interiors(workspace);
        const auto ior = [&](int body) { return body < 0 ? T(1) : world.iors[body]; };
        for (int k = 0; k < width<S>; ++k) {
            if (wanted[k] == 0) continue;
            const int before = static_cast<int>(lists[k]), body = static_cast<int>(bodies[k]);
            const int inner = innermost(interiors, before);
            if (body == inner) {
                const int after = left(interiors, before, body);
                ratios[k] = ior(body) / ior(innermost(interiors, after));
                lists[k] = static_cast<T>(after);
            } else if (contains(interiors, before, body)) {
                ratios[k] = 1;
                lists[k] = static_cast<T>(left(interiors, before, body));
            } else {
                ratios[k] = ior(inner) / ior(body);
                lists[k] = static_cast<T>(entered(interiors, before, body));
            }
        }
        ratio = load_lanes<S>(ratios), list = load_lanes<S>(lists);
    }
};

}  // namespace strahl::inline STRAHL_LEVEL
