// Light at hits, and the rays that go on from them.
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

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

/// The same where all lanes have the same exponent.
template <class S>
STRAHL_INLINE S power_of_all(S x, Element<S> p) {
    if (!(std::floor(p) == p && p <= 1024)) return power(x, S(p));
    S result(1);
    for (int e = static_cast<int>(p); e > 0; e >>= 1) {
        if (e & 1) result *= x;
        x *= x;
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

/// What is left out at once is no more than this share of what a pixel may still lack: later and weaker rays, of which
/// there are more, want some of it too.
inline constexpr float weak_share = .25f;

/// The shading of one generation.
template <class S>
struct Shading {
    using T = Element<S>;
    const World<T>& world;
    const Eye<T>& eye;
    const Generation<T>& rays;
    const HitList<T>& hits;  // of the open rays
    const PixelBatch<T>& batch;
    Generation<T>& next;
    RayQueue<T>& refracted;  // open rays, to follow the mirrored ones in `next`
    Workspace<T>& workspace;
    KernelCounts& counts;
    int depth;

    /// What is known of a pack of hits.
    struct Hit {
        Mask<S> active;
        Vec3<S> direction, position, normal;  // the normal is turned towards the incoming ray
        Mask<S> outside;                      // it comes from the side the surface faces
        S surface, body, pixel, weight, medium;
        const MaterialKernel<S>& material;
        bool alike;  // all lanes have the same material
        int key;
    };

    /// Rays that hit nothing bring back the background.
    void leave() {
        for (int i = 0, left; (left = hits.count[world.keys] - i) > 0; i += width<S>) {
            const Pick pick(hits.of(world.keys) + i, left);
            const S weight = pick(rays.open.weight);
            add_lanes(batch.rgb, pick(rays.open.pixel), pick.lanes, scale(weight, splat<S>(world.background)));
        }
    }

    /// Shades the hits of a key, all on items of this group. False if the queues are full.
    template <class Group>
    bool shade(const Group& group, int key) {
        const int found = hits.count[key];
        const int inside = world.enclosed ? rays.inside_end[key] - rays.inside_begin[key] : 0;
        next.inside_begin[key] = next.inside.count;
        using PackItem = typename Group::template ItemOf<S>;
        PackItem item;
        MaterialKernel<S> material;
        int spread = -1;  // number of the material that all lanes have
        const auto spread_material = [&](int number) {
            if (number == spread) return;
            material = splat_item<MaterialKernel<S>, S>(world.materials[number]);
            spread = number;
        };
        if (world.key_per_item && found + inside > 0) {
            const auto& only = group.items[key - group.first_key];
            item = splat_item<PackItem, S>(only);
            spread_material(static_cast<int>(only.material));
        }
        for (int i = -inside, left; i < found; i += std::min(left, width<S>)) {
            left = i < 0 ? -i : found - i;
            if (next.open.count + refracted.count > batch_rays || next.inside.count > batch_rays) return false;
            const bool within = i < 0;
            const Pick pick = within ? Pick(rays.inside_end[key] + i, left) : Pick(hits.of(key) + i, left);
            if (!world.key_per_item) {
                int items[width<S>], materials[width<S>];
                for (int k = 0; k < width<S>; ++k) {
                    items[k] = world.places[static_cast<int>(hits.surface[pick.index[k]])].item;
                    materials[k] = static_cast<int>(group.items[items[k]].material);
                }
                item = gather_items<PackItem, S>(group.items, items);
                if (std::all_of(materials, materials + width<S>, [&](int m) { return m == materials[0]; })) {
                    spread_material(materials[0]);
                } else {
                    material = gather_items<MaterialKernel<S>, S>(world.materials, materials);
                    spread = -1;
                }
            }
            const RayQueue<T>& from = within ? rays.inside : rays.open;
            const Hit hit = meet(item, material, spread >= 0, key, from, pick, within ? from.t : hits.t);
            Mask<S> dim = first_lanes<S>(0);
            if (depth < eye.depth)
                dim = spawn(item, hit);
            else
                truncate(hit);
            add_lanes(batch.rgb, hit.pixel, pick.lanes, scale(hit.weight, illumination(hit, dim)));
        }
        next.inside_end[key] = next.inside.count;
        return true;
    }

  private:
    /// A pack's part of values by ray: up to `lanes` rays, in the lanes left over any others.
    struct Pick {
        int index[width<S>] = {};
        int lanes;
        bool consecutive = true;
        STRAHL_INLINE Pick(int first, int left) : lanes(left < width<S> ? left : width<S>) { index[0] = first; }
        STRAHL_INLINE Pick(const T* order, int left) : Pick(static_cast<int>(order[0]), left) {
            for (int k = 1; k < width<S>; ++k) index[k] = static_cast<int>(order[k < lanes ? k : 0]);
            consecutive = lanes == width<S> && index[width<S> - 1] - index[0] == width<S> - 1;
        }
        STRAHL_INLINE S operator()(const T* values) const {
            return consecutive ? load_lanes<S>(values + index[0]) : gather<S>(values, index);
        }
    };

    template <class PackItem>
    STRAHL_INLINE Hit meet(const PackItem& item, const MaterialKernel<S>& material, bool alike, int key,
                           const RayQueue<T>& from, const Pick& pick, const T* t) const {
        const Ray<S> ray{{pick(from.origin.x), pick(from.origin.y), pick(from.origin.z)},
                         {pick(from.direction.x), pick(from.direction.y), pick(from.direction.z)},
                         pick(from.source)};
        const SurfacePoint<S> point = item.shape.at(ray, pick(t), ray.source - item.surface);
        const Mask<S> outside = dot(ray.direction, point.normal) < S(0);
        return {first_lanes<S>(pick.lanes),
                ray.direction,
                point.position,
                select(outside, point.normal, -point.normal),
                outside,
                item.surface + point.face,
                item.surface,
                pick(from.pixel),
                pick(from.weight),
                world.nested ? pick(from.medium) : S(0),
                material,
                alike,
                key};
    }

    /// Ia Ka Of + sum over lights S Il [Kd Of (n.l) + Ks (h.l)^p]; at `dim` hits without lamps that bring no more than
    /// `MaterialKernel::scattered`.
    STRAHL_INLINE Vec3<S> illumination(const Hit& hit, Mask<S> dim) {
        const MaterialKernel<S>& material = hit.material;
        const S zero(0);
        Vec3<S> light = material.ambient;
        const Vec3<S> mirrored = reflect(hit);
        const S strongest = largest(material.diffuse);
        const Mask<S> glossy = hit.active & (material.specular > zero);
        if (none(glossy | (hit.active & (strongest > zero)))) return light;
        const S faint = select(dim, S(faint_share) * strongest, zero);
        for (int i = 0; i < world.light_count; ++i) {
            const LightKernel<T>& lamp = world.lights[i];
            const Vec3<S> to_lamp = splat<S>(lamp.position) - hit.position;
            const S facing = dot(hit.normal, to_lamp);
            if (none(hit.active & (facing > zero))) continue;
            const S distance = sqrt(dot(to_lamp, to_lamp)), inverse = S(1) / distance;
            const Vec3<S> l = scale(inverse, to_lamp);
            S cosine = facing * inverse;
            S highlight = zero;
            if (any(glossy)) {
                const S shine = min(max(dot(mirrored, l), zero), S(1));  // or sharp highlights blow rounding up
                const Mask<S> shines = glossy & (shine > material.shines_from);
                if (any(shines))
                    highlight = select(shines,
                                       material.specular * (hit.alike ? power_of_all(shine, lane(material.pow, 0))
                                                                      : power(shine, material.pow)),
                                       zero);
            }
            // Whether anything is between only matters where there is light to lose.
            const Mask<S> faces = hit.active & (cosine > zero) & (fma(strongest, cosine, highlight) > faint);
            if (none(faces)) continue;
            counts.shadow += count(faces);
            const Vec3<S> share =
                visibility(world, Ray<S>{hit.position, l, hit.surface}, distance, faces, {i, hit.key, hit.outside});
            cosine = select(faces, cosine, zero);  // at the lamp itself it is NaN
            highlight = select(faces, highlight, zero);
            for (int c = 0; c < 3; ++c)
                light[c] = fma(share[c] * S(lamp.color[c]), fma(material.diffuse[c], cosine, highlight), light[c]);
        }
        return light;
    }

    STRAHL_INLINE static Vec3<S> reflect(const Hit& hit) {
        return fma(S(-2) * dot(hit.direction, hit.normal), hit.normal, hit.direction);
    }

    /// A ray that goes on from a hit.
    struct Branch {
        Mask<S> mask;
        Vec3<S> direction;
        S weight, list;
    };
    STRAHL_INLINE static Branch branch(const Hit& hit, Mask<S> mask, const Vec3<S>& direction, S share, S list) {
        const S weight = min(hit.weight * share, S(largest_gain));
        return {Mask<S>(mask & (weight > S(0))), unit(direction), weight, list};
    }

    /// Something that a hit need not do if its pixel can do without the light: at most so much, in the lanes that have
    /// it at all.
    struct Part {
        S most;
        Mask<S> lanes, spared;
        T share[width<S>], gone[width<S>];
        Part(S light, Mask<S> mask) : most(light), lanes(mask), spared(first_lanes<S>(0)) {}
    };

    /// Spares parts that are weak beside what the pixel may still lack, and adds them to what it does. One lane after
    /// the other, so that what happens to a pixel depends on its own rays alone.
    template <class... Parts>
    STRAHL_INLINE void spare(const S& pixel, Parts&... parts) {
        const T error = eye.error;
        if (error == 0) return;
        const auto weak = [&](const Part& part) { return bits(part.lanes & (part.most <= S(weak_share * error))); };
        unsigned some = (weak(parts) | ...);
        if (some == 0) return;
        T pixels[width<S>];
        store_lanes(pixels, pixel);
        const auto lay_out = [&](Part& part) {
            store_lanes(part.share, select(part.lanes, part.most, S(std::numeric_limits<T>::infinity())));
            store_lanes(part.gone, S(0));
        };
        (lay_out(parts), ...);
        for (; some != 0; some &= some - 1) {
            const int k = std::countr_zero(some);
            T& lacks = batch.rgb[4 * static_cast<int>(pixels[k]) + 3];
            const auto decide = [&](Part& part) {
                if (part.share[k] <= weak_share * (error - lacks)) lacks += part.share[k], part.gone[k] = 1;
            };
            (decide(parts), ...);
        }
        ((parts.spared = load_lanes<S>(parts.gone) > S(0)), ...);
    }

    /// In the last generation: what further ones could bring.
    STRAHL_INLINE void truncate(const Hit& hit) {
        const S share = hit.material.reflection + hit.material.refraction;
        const Mask<S> more = hit.active & (hit.weight * share > S(0));
        if (none(more)) return;
        T pixels[width<S>], most[width<S>];
        store_lanes(pixels, hit.pixel), store_lanes(most, hit.weight * share * S(eye.brightest_limit));
        for (unsigned left = bits(more); left != 0; left &= left - 1) {
            const int k = std::countr_zero(left);
            batch.past[static_cast<int>(pixels[k])] += most[k];
        }
    }

    /// Mirrored and refracted rays that can still be seen. The lanes whose own light can hardly be.
    template <class PackItem>
    STRAHL_INLINE Mask<S> spawn(const PackItem& item, const Hit& hit) {
        const MaterialKernel<S>& material = hit.material;
        const S zero(0);
        const T brightest = eye.brightest[eye.depth - depth];
        const auto ray = [&](const Branch& b) { return Part(b.weight * S(brightest), b.mask); };
        Part light(hit.weight * material.scattered, hit.active & (material.scattered > zero));
        const Mask<S> glass = hit.active & (material.refraction > zero);
        if (none(glass | (hit.active & (material.reflection > zero)))) {
            spare(hit.pixel, light);
            return light.spared;
        }
        if (!world.transparent || none(glass)) {
            Branch mirrored = branch(hit, hit.active, reflect(hit), material.reflection, hit.medium);
            Part part = ray(mirrored);
            spare(hit.pixel, part, light);
            mirrored.mask = mirrored.mask & !part.spared;
            counts.reflected += count(mirrored.mask);
            push(next.open, hit, mirrored);
            return light.spared;
        }
        S b = select(hit.outside, S(1) / material.ior, material.ior), list = hit.medium;
        if (world.nested) change_medium(hit, glass, b, list);
        const S s = -dot(hit.direction, hit.normal);
        const S k = fma(b * b, fma(s, s, S(-1)), S(1));
        const Mask<S> total = glass & (k < zero);
        const S all = material.reflection + material.refraction;
        Branch mirrored = branch(hit, hit.active, reflect(hit), select(total, all, material.reflection), hit.medium);
        Branch bent =
            branch(hit, glass & !total, fma(fma(b, s, -sqrt(max(k, zero))), hit.normal, scale(b, hit.direction)),
                   material.refraction, list);
        Part mirrored_part = ray(mirrored), bent_part = ray(bent);
        spare(hit.pixel, mirrored_part, bent_part, light);
        mirrored.mask = mirrored.mask & !mirrored_part.spared;
        bent.mask = bent.mask & !bent_part.spared;
        counts.reflected += count(mirrored.mask);
        counts.refracted += count(bent.mask);
        if (world.enclosed >> hit.key & 1) {  // the one inside need not look for what it meets
            const Mask<S> in = hit.outside;
            Branch within{Mask<S>((mirrored.mask & !in) | (bent.mask & in)),
                          select(in, bent.direction, mirrored.direction), select(in, bent.weight, mirrored.weight),
                          zero};
            const Span<S> span =
                item.shape.span(Ray<S>{hit.position, within.direction, hit.surface}, hit.surface - hit.body);
            within.mask = within.mask & span.hit & (span.far > zero);
            mirrored.mask = mirrored.mask & (in | !within.mask);
            bent.mask = bent.mask & !(in & within.mask);
            compress(next.inside.t + next.inside.count, span.far, within.mask);
            push(next.inside, hit, within);
        }
        push(refracted, hit, bent);
        push(next.open, hit, mirrored);
        return light.spared;
    }

    STRAHL_INLINE void push(RayQueue<T>& to, const Hit& hit, const Branch& ray) {
        if (none(ray.mask)) return;
        const int n = to.count;
        const auto put_with = [&](const auto& put) {
            for (int c = 0; c < 3; ++c)
                put(to.origin[c] + n, hit.position[c]), put(to.direction[c] + n, ray.direction[c]);
            put(to.source + n, hit.surface), put(to.pixel + n, hit.pixel), put(to.weight + n, ray.weight);
            if (world.nested) put(to.medium + n, ray.list);
        };
        if (all(ray.mask))
            put_with([](T* place, const S& value) { store_lanes(place, value); });
        else
            put_with([&](T* place, const S& value) { compress(place, value, ray.mask); });
        to.count += count(ray.mask);
    }

    /// The ratio of indices and the list beyond the surface, by the list of bodies entered (as POV-Ray does): from
    /// outside all, into the body; from the body entered last, out of it; from one entered before, straight on.
    void change_medium(const Hit& hit, Mask<S> glass, S& ratio, S& list) {
        T ratios[width<S>], lists[width<S>], bodies[width<S>], wanted[width<S>];
        store_lanes(ratios, ratio), store_lanes(lists, list), store_lanes(bodies, hit.body);
        store_lanes(wanted, select(glass, S(1), S(0)));
        MediumStacks& mediums = strahl::mediums(workspace);
        const auto ior = [&](int body) { return body < 0 ? T(1) : world.iors[body]; };
        for (int k = 0; k < width<S>; ++k) {
            if (wanted[k] == 0) continue;
            const int before = static_cast<int>(lists[k]), body = static_cast<int>(bodies[k]);
            const int inner = top(mediums, before);
            if (body == inner) {
                const int after = remove(mediums, before, body);
                ratios[k] = ior(body) / ior(top(mediums, after));
                lists[k] = static_cast<T>(after);
            } else if (contains(mediums, before, body)) {
                ratios[k] = 1;
                lists[k] = static_cast<T>(remove(mediums, before, body));
            } else {
                ratios[k] = ior(inner) / ior(body);
                lists[k] = static_cast<T>(strahl::push(mediums, before, body));
            }
        }
        ratio = load_lanes<S>(ratios), list = load_lanes<S>(lists);
    }
};

}  // namespace strahl::inline STRAHL_LEVEL
