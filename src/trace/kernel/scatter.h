// Reflected and refracted rays: the rays that go on from hits.
#pragma once
#include "trace/kernel/differentials.h"
#include "trace/kernel/fog.h"
#include "trace/kernel/layers.h"
#include "trace/kernel/prune.h"

namespace strahl::inline STRAHL_LEVEL {

/// A ray that goes on from a hit.
template <class S, class P>
struct Branch {
    Mask<S> mask;
    Vec3<S> direction;
    S weight, medium;
    [[no_unique_address]] typename P::template OfRay<S> own;  // data of the policy
};
/// Renormalises directions that unit() cannot correct: those that come from normals of bodies too small for this kind
/// of number. Culling of packets relies on unit length. Rays without any direction end.
template <class S, class P>
[[gnu::noinline, gnu::cold]] void normalize(Branch<S, P>& ray, const Vec3<S>& direction, Mask<S> off) {
    const S squared = dot(direction, direction);
    ray.direction = select(off, scale(S(1) / sqrt(squared), direction), ray.direction);
    ray.mask = ray.mask & (dot(ray.direction, ray.direction) < S(2));
}
template <class P, class S>
STRAHL_INLINE Branch<S, P> branch(const Hit<S>& hit, Mask<S> mask, const Vec3<S>& direction, S share, S medium) {
    using T = Element<S>;
    constexpr T mended = T(1) / (std::uint64_t(1) << (std::numeric_limits<T>::digits / 2 - 1));
    const S weight = min(hit.weight * share, S(largest_gain));
    Branch<S, P> ray{Mask<S>(mask & (weight > S(0))), unit(direction), weight, medium, {}};
    const Mask<S> off = ray.mask & !(abs(dot(direction, direction) - S(1)) <= S(mended));
    if (any(off)) [[unlikely]] {
        Branch<S, P> copy = ray;
        normalize(copy, Vec3<S>(direction), off);
        ray = copy;
    }
    return ray;
}

/// Appends what rays carry to the arrays of a queue.
template <class S>
[[gnu::noinline, gnu::cold]] void put_carried(RayQueue<Element<S>>& to, const Carried<S>& carried, Mask<S> lanes) {
    // Keeps colours finite: infinity times a channel without light is no number.
    for (int c = 0; c < 3; ++c) compress(to.tint[c] + to.count, min(carried.tint[c], S(largest_gain)), lanes);
    compress(to.level + to.count, carried.level, lanes), compress(to.mirrored + to.count, carried.mirrored, lanes);
}

/// Returns what rays carry on from plain surfaces: a generation more, and that they were reflected if their direction
/// is on the side of the normal.
template <class S>
STRAHL_INLINE Carried<S> carried_on(const Carried<S>& before, const Vec3<S>& direction, const Vec3<S>& normal) {
    return {before.tint, before.level + S(1), select(dot(direction, normal) > S(0), S(1), before.mirrored)};
}

/// Queues rays that go on from hits; what they carry follows from the notes if it is not given.
template <class S, class P>
STRAHL_INLINE void push(const Shading<S, P>& shading, RayQueue<Element<S>>& to, const Hit<S>& hit,
                        const Branch<S, P>& ray, const HitNotes<S, P>& notes, const Carried<S>* carried = nullptr) {
    using T = Element<S>;
    if (none(ray.mask)) return;
    const int n = to.count;
    S pixel = hit.pixel;
    if (notes_layers(shading)) [[unlikely]]
        pixel = pixel_of_way(S(pixel), Vec3<S>(ray.direction), Vec3<S>(flat_normal(shading, hit, notes)));
    const auto put_with = [&](const auto& put) {
        for (int c = 0; c < 3; ++c) put(to.origin[c] + n, hit.position[c]), put(to.direction[c] + n, ray.direction[c]);
        put(to.source + n, hit.surface), put(to.pixel + n, pixel), put(to.weight + n, ray.weight);
        if (shading.world.nested) put(to.medium + n, ray.medium);
        P::put(put, shading.world, to, ray.own);
    };
    if (all(ray.mask))
        put_with([](T* place, const S& value) { store_lanes(place, value); });
    else
        put_with([&](T* place, const S& value) { compress(place, value, ray.mask); });
    if (filters(shading)) [[unlikely]] {
        if (shading.world.patterns.quick)
            put_cones(to, Hit<S>(hit), Vec3<S>(ray.direction), Mask<S>(ray.mask), notes);
        else
            put_differentials(shading, to, Hit<S>(hit), Vec3<S>(ray.direction), Mask<S>(ray.mask), notes);
    }
    if (shading.world.finishes.carries) [[unlikely]] {
        const Vec3<S>& flat = flat_normal(shading, hit, notes);
        put_carried(to, carried ? *carried : carried_on(notes.carried, Vec3<S>(ray.direction), Vec3<S>(flat)),
                    Mask<S>(ray.mask));
    }
    to.count += count(ray.mask);
}

/// Finds the ratio of indices and the medium stack beyond the surface, by the bodies entered, as POV-Ray does. A ray
/// that enters a body comes from the one entered last; a ray that leaves the body entered last goes into the one below
/// it in the stack; a ray that leaves one entered before that goes straight on.
template <class S, class P>
[[gnu::noinline]] void change_medium(const Shading<S, P>& shading, const Hit<S>& hit, Mask<S> glass, S& ratio,
                                     S& medium) {
    MediumStacks& all = mediums(shading.workspace);
    const auto ior = [&](int body) { return body < 0 ? Element<S>(1) : shading.world.media.iors[body]; };
    each_stack_and_body(shading.world, S(medium), hit.body, glass, [&](int before, int body, Mask<S> lanes) {
        const int inner = top(all, before);
        const bool leaving = contains(all, before, body);
        const int after = leaving ? remove(all, before, body) : push(all, before, body);
        // Leaving a body that was not entered last changes nothing.
        const Element<S> own = leaving && body != inner ? 1 : ior(inner) / ior(top(all, after));
        ratio = select(lanes, S(own), ratio);
        medium = select(lanes, S(static_cast<Element<S>>(after)), medium);
    });
}

/// From this ratio of indices on refract_far is used. Below it unit() corrects the lengths of refracted directions.
inline constexpr float far_ratio = 16;

/// Returns refracted directions, and cos^2 beyond the surface, where the ratio of indices is large. There b^2 (1 - s^2)
/// is all rounding error, and the usual direction neither right nor of length 1. The sine comes from the part of the
/// direction across the normal instead, from which the part along the normal is removed twice: once leaves a rounding
/// error that the ratio magnifies (L. Giraud, J. Langou, M. Rozloznik, "The Loss of Orthogonality in the Gram-Schmidt
/// Orthogonalization Process", 2005).
template <class S>
[[gnu::noinline]] Vec3<S> refract_far(const Hit<S>& hit, const Vec3<S>& normal, const S& ratio, const S& s,
                                      S& cosine_squared) {
    Vec3<S> across = fma(s, normal, hit.direction);
    across = fma(-dot(across, normal), normal, across);
    const Vec3<S> beyond = scale(ratio, across);
    cosine_squared = S(1) - dot(beyond, beyond);
    return fma(-sqrt(max(cosine_squared, S(0))), normal, beyond);
}

/// Returns where rays that start on the one item of a bin leave it.
template <class S>
STRAHL_INLINE Span<S> span_of_item(const World<Element<S>>& world, const SortBin& bin, const Ray<S>& ray) {
    Span<S> span;
    const auto inline_code = [&](const auto& group) __attribute__((always_inline)) {
        span = crossings_of(group.items[bin.item], ray, all_lanes<S>());
    };
    if (!if_hot(world, bin.form, inline_code)) {
        const Ray<S> copy = ray;
        span = calls<S>(bin.form).span(world, bin.item, copy);
    }
    return span;
}

/// Queues the ray inside an enclosed body apart, be it the reflected or the refracted one, with the distance at which
/// it leaves: nothing else can be in its way. For what it carries see push().
template <class S, class P>
STRAHL_INLINE void keep_inside(const Shading<S, P>& shading, const Hit<S>& hit, Branch<S, P>& reflected,
                               Branch<S, P>& refracted, const HitNotes<S, P>& notes,
                               const Carried<S>* carried = nullptr) {
    RayQueue<Element<S>>& queue = shading.next.inside;
    const Mask<S> in = hit.outside;
    Branch<S, P> within{
        Mask<S>((reflected.mask & !in) | (refracted.mask & in)), select(in, refracted.direction, reflected.direction),
        select(in, refracted.weight, reflected.weight), S(0), P::either(in, refracted.own, reflected.own)};
    const Span<S> span = span_of_item(shading.world, shading.world.sort_bins[hit.bin],
                                      Ray<S>{hit.position, within.direction, hit.surface});
    within.mask = within.mask & span.hit & (span.far > S(shading.world.passed_over));
    reflected.mask = reflected.mask & (in | !within.mask);
    refracted.mask = refracted.mask & !(in & within.mask);
    compress(queue.t + queue.count, span.far, within.mask);
    push(shading, queue, hit, within, notes, carried);
}

/// Returns mirrored directions where there are bumps. One that would go under the surface is mirrored by the surface
/// itself, as POV-Ray does: instead of by the bent normal if it also goes behind that, else after it.
template <class S>
[[gnu::noinline, gnu::cold]] Vec3<S> reflect_bent(const Hit<S>& hit, const Vec3<S>& flat) {
    const Vec3<S> mirrored = reflect(hit);
    const Mask<S> under = dot(mirrored, flat) < S(0), turned = dot(mirrored, hit.normal) < S(0);
    const Vec3<S> from = select(turned, hit.direction, mirrored);
    return select(under, fma(S(-2) * dot(from, flat), flat, from), mirrored);
}

/// What of a pack of hits sends rays on.
template <class S>
struct Onward {
    Mask<S> lanes;
    S weight;
};
/// Finds which hits send rays on where rays carry more than weights, notes what these carry, and bounds what is lost
/// with the others, if they are to be bounded.
template <class S, class P>
[[gnu::noinline]] void carry_on(const Shading<S, P>& shading, const Hit<S>& hit, const RayQueue<Element<S>>& from,
                                const LaneIndices<S>& pick, bool bounds, Carried<S>& carried, Onward<S>& on) {
    using T = Element<S>;
    const auto& world = shading.world;
    carried = carried_by(shading, from, pick);
    on = {hit.active, hit.weight};
    if (world.fog.any) {
        carried.tint = carried.tint * tint_of_fog(world, medium_in_fog(shading, S(hit.medium)));
        if (world.finishes.bailout > T(0)) {
            // POV-Ray follows rays by their strength before fog dims them.
            on.weight = pick(from.weight);
            carried.tint = scale(hit.weight / on.weight, carried.tint);
        }
    }
    on.lanes = on.lanes & (carried.level < S(static_cast<T>(shading.limits.depth)));
    if (shading.depth >= deepest_ray) on.lanes = first_lanes<S>(0);
    if (!bounds) return;
    Hit<S> ended = hit;
    ended.active = hit.active & !on.lanes, ended.weight = on.weight * most_of(carried.tint);
    truncate(shading, ended);
}

/// Drops rays from plain surfaces that POV-Ray drops as too weak. It takes those of total reflection for as strong as
/// the light that would come through.
template <class S, class P>
[[gnu::noinline, gnu::cold]] void bail_out(const Shading<S, P>& shading, const Hit<S>& hit, Mask<S> total,
                                           Branch<S, P>& reflected, Carried<S>& carried) {
    const S least(shading.world.finishes.bailout);
    const MaterialKernel<S>& material = hit.material;
    reflected.mask = reflected.mask & (total | (material.reflection >= least));
    if (any(total)) {
        const S more = (material.reflection + material.refraction) / material.refraction;
        reflected.weight = select(total, hit.weight * material.refraction, reflected.weight);
        carried.tint = select(total, scale(more, carried.tint), carried.tint);
    }
    reflected.mask = reflected.mask & (reflected.weight >= least);
}

/// Holds the direction of refracted rays, and what it was computed of.
template <class S>
struct Refraction {
    Vec3<S> direction;
    S ratio, medium, cosine, k;  // of indices, before the surface to beyond it; the medium and k = cos^2 beyond it
    Mask<S> far, total;
};
template <class S, class P>
STRAHL_INLINE Refraction<S> refract(const Shading<S, P>& shading, const Hit<S>& hit, Mask<S> glass) {
    const auto& world = shading.world;
    const MaterialKernel<S>& material = hit.material;
    S b = select(hit.outside, S(1) / material.ior, material.ior), medium = hit.medium;
    if (world.nested) change_medium(shading, hit, glass, b, medium);
    Vec3<S> normal = hit.normal;
    if (shading.has_notes && world.patterns.bends) [[unlikely]]
        normal = select(dot(hit.direction, normal) > S(0), -normal, normal);  // bent away from the ray: its other side
    const S s = -dot(hit.direction, normal);
    S k = fma(b * b, fma(s, s, S(-1)), S(1));
    Vec3<S> beyond = fma(fma(b, s, -sqrt(max(k, S(0)))), normal, scale(b, hit.direction));
    const Mask<S> far = glass & (b > S(far_ratio));
    if (any(far)) {
        S far_k;
        const Vec3<S> far_beyond = refract_far(hit, Vec3<S>(normal), b, s, far_k);
        k = select(far, far_k, k), beyond = select(far, far_beyond, beyond);
    }
    return {beyond, b, medium, s, k, far, Mask<S>(glass & (k < S(0)))};
}

/// Returns the directions of reflected rays.
template <class S, class P>
STRAHL_INLINE Vec3<S> mirrored_direction(const Shading<S, P>& shading, const Hit<S>& hit, const HitNotes<S, P>& notes) {
    if (shading.has_notes && shading.world.patterns.bends) [[unlikely]]
        return reflect_bent(hit, notes.flat);
    return reflect(hit);
}

/// Queues reflected and refracted rays that are not pruned. Returns the lanes whose direct light is pruned.
template <class S, class P>
STRAHL_INLINE Mask<S> scatter(const Shading<S, P>& shading, const Hit<S>& hit, HitNotes<S, P>& notes) {
    const MaterialKernel<S>& material = hit.material;
    const auto& [world, limits, rays, hits, batch, next, refracted_queue, workspace, counts, depth, has_notes] =
        shading;
    const S zero(0);
    S brightest(limits.brightest_beyond(depth)), seen = hit.weight;
    if (world.finishes.carries) [[unlikely]]
        seen = seen * most_of(notes.carried.tint);
    Contribution<S> light(seen * material.scattered, hit.active & (material.scattered > zero));
    const Mask<S> glass = hit.active & (material.refraction > S(world.finishes.bailout));
    if (none(glass | (hit.active & (material.reflection > zero)))) {
        prune(shading, hit.pixel, light);
        return light.pruned;
    }
    const auto bound_rays = [&](Mask<S> total, Branch<S, P> & reflected, Branch<S, P> * refracted)
        __attribute__((always_inline)) {
        Branch<S, P> copy = reflected;
        if (world.finishes.bailout > 0) {
            bail_out(shading, Hit<S>(hit), total, copy, notes.carried);
            if (refracted) refracted->mask = refracted->mask & (refracted->weight >= S(world.finishes.bailout));
        }
        reflected = copy;
        if (world.finishes.carries) brightest = brightest * most_of(notes.carried.tint);
    };
    if (!world.transparent || none(glass)) {
        Branch<S, P> reflected =
            branch<P>(hit, hit.active, mirrored_direction(shading, hit, notes), material.reflection, hit.medium);
        if (world.finishes.carries) [[unlikely]]
            bound_rays(first_lanes<S>(0), reflected, nullptr);
        P::reflect(shading, hit, notes, S(material.reflection), reflected);
        Contribution<S> part(reflected.weight * brightest, reflected.mask);
        prune(shading, hit.pixel, part, light);
        reflected.mask = reflected.mask & !part.pruned;
        counts.reflected += count(reflected.mask);
        push(shading, next.open, hit, reflected, notes);
        return light.pruned;
    }
    const Refraction<S> way = refract(shading, hit, glass);
    const S all = material.reflection + material.refraction, share = select(way.total, all, material.reflection);
    Branch<S, P> reflected = branch<P>(hit, hit.active, mirrored_direction(shading, hit, notes), share, hit.medium);
    Branch<S, P> refracted = branch<P>(hit, glass & !way.total, way.direction, material.refraction, way.medium);
    P::reflect(shading, hit, notes, share, reflected);
    P::refract(shading, hit, notes.own, glass, way.far, way.ratio, way.cosine, way.k, refracted);
    if (world.finishes.carries) [[unlikely]]
        bound_rays(way.total, reflected, &refracted);
    Contribution<S> reflected_part(reflected.weight * brightest, reflected.mask);
    Contribution<S> refracted_part(refracted.weight * brightest, refracted.mask);
    prune(shading, hit.pixel, reflected_part, refracted_part, light);
    reflected.mask = reflected.mask & !reflected_part.pruned;
    refracted.mask = refracted.mask & !refracted_part.pruned;
    counts.reflected += count(reflected.mask);
    counts.refracted += count(refracted.mask);
    if (world.few.enclosed >> hit.bin & 1) keep_inside(shading, hit, reflected, refracted, notes);
    push(shading, refracted_queue, hit, refracted, notes);
    push(shading, next.open, hit, reflected, notes);
    return light.pruned;
}

}  // namespace strahl::inline STRAHL_LEVEL
