// Shades hits in worlds with POV-Ray's finishes: their light, by layers, and their rays, which carry colours.
#pragma once
#include "trace/finish/finish_calls.h"
#include "trace/kernel/faded_light.h"
#include "trace/kernel/fog.h"
#include "trace/kernel/footprint.h"
#include "trace/kernel/illuminate.h"
#include "trace/kernel/scatter.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns by what layers multiply the light that they scatter.
template <class S>
Vec3<S> color_of(const LayeredHit<S>& layers) {
    Vec3<S> sum = splat<S>(Vec3<Element<S>>(0));
    for (int i = 0; i < layers.count; ++i)
        for (int c = 0; c < 3; ++c) sum[c] = fma(layers.above[i][c] * layers.opacity[i], layers.color[i][c], sum[c]);
    return sum;
}

/// Finds the indices of refraction at surfaces in nested worlds, by the bodies that rays are in. As POV-Ray does, it
/// takes the body entered last for what is beyond one of several that a ray leaves, even if it leaves that.
template <class S, class P>
[[gnu::noinline]] void find_indices(const Shading<S, P>& shading, const Hit<S>& hit, SeenSurface<S>& seen) {
    using T = Element<S>;
    MediumStacks& all = mediums(shading.workspace);
    each_stack_and_body(shading.world, hit.medium, hit.body, hit.active, [&](int stack, int body, Mask<S> lanes) {
        const int inner = top(all, stack);
        const bool leaves = contains(all, stack, body);
        const S around(inner < 0 ? T(1) : shading.world.media.iors[inner]);
        seen.enters = (seen.enters & !lanes) | (leaves ? first_lanes<S>(0) : lanes);
        seen.before = select(lanes, around, seen.before);
        const bool last = leaves && top(all, remove(all, stack, body)) < 0;
        seen.beyond = select(lanes, last ? S(1) : around, seen.beyond);
    });
}

/// Finds the layers of hits; where patterns are filtered, their means over footprints.
template <class S, class P>
void look_at_layers(const Shading<S, P>& shading, const Hit<S>& hit, const int* numbers,
                    const RayQueue<Element<S>>& from, const LaneIndices<S>& pick, const HitNotes<S, P>& notes,
                    LayeredHit<S>& layers) {
    SeenSurface<S> seen{hit.position, hit.direction, hit.normal, hit.surface, hit.outside};
    if (shading.world.nested && shading.world.finishes.fresnel) find_indices(shading, hit, seen);
    if (shading.world.patterns.bends && shading.world.finishes.film)
        seen.mirrored = dot(mirrored_direction(shading, hit, notes), hit.normal);
    if (!filters(shading)) return void(FinishCalls<S>::look(shading.world, numbers, seen, nullptr, layers));
    if (shading.world.patterns.quick) {
        const Footprint<S> own = footprint_of(notes.cone.width, hit.direction, notes.flat);
        return void(FinishCalls<S>::look(shading.world, numbers, seen, &own, layers));
    }
    const Footprint<S> footprint = footprint_of(notes.beside, hit.direction, notes.flat, S(pick(from.weight)));
    Filtering<S> filtering = FinishCalls<S>::look(shading.world, numbers, seen, &footprint, layers);
    loosen(filtering, notes.beside.loose);
    note_colors(shading, filtering, color_of(layers), hit.pixel, pick(from.weight), pick.lanes);
}

/// Adds the light of all lights to `sum`. For each one `hit.active` is narrowed to the lanes on which it shines.
template <class S, class P>
void add_lights(const Shading<S, P>& shading, Hit<S>& hit, const int* numbers, const LayeredHit<S>& layers,
                HitNotes<S, P>& notes, Vec3<S>& sum) {
    using T = Element<S>;
    const auto& world = shading.world;
    const Vec3<S>& flat = flat_normal(shading, hit, notes);
    const Vec3<S> reflected = reflect(hit), nothing = splat<S>(Vec3<T>(0));
    const Mask<S> both = world.finishes.behind ? FinishCalls<S>::lit_behind(world, numbers) : first_lanes<S>(0);
    const Mask<S> active = hit.active;
    for (int i = 0; i < world.light_count; ++i) {
        const LightKernel<T>& light = world.lights[i];
        if (notes_layers(shading)) note_light_before(shading, sum);
        if (world.finishes.groups) hit.active = active & FinishCalls<S>::lit_by(world, numbers, light.group);
        const LightAt<S> at = light_at(shading, hit, light, flat, both);
        const auto own = P::light_of(shading, hit, light, at, flat, notes.own);
        if (none(P::lit(at.faces, hit, own))) continue;
        const Vec3<S> share = share_at(shading, hit, i, at, flat, reflected);
        if (notes_sights(shading)) note_light(shading, hit, notes, i, share, S(dot(reflected, at.way.l)), at.faces);
        Vec3<S> arriving;
        for (int c = 0; c < 3; ++c) arriving[c] = at.strength * share[c] * S(light.color[c]);
        arriving = select(at.faces, arriving, nothing);
        const LitSurface<S> lit{hit.direction, hit.normal,        reflected, at.way.l,
                                at.way.cosine, !light.shadowless, at.behind};
        Vec3<S> lighted = sum;
        FinishCalls<S>::scatter(world, numbers, layers, lit, arriving, lighted);
        sum = select(at.faces, lighted, sum);
        P::lit_layers(shading, hit, numbers, layers, i, at, lit, share, own, notes.own);
    }
    hit.active = active;
}

/// Queues rays that go on from hits, with what they carry.
template <class S, class P>
[[gnu::noinline]] void push_carried(const Shading<S, P>& shading, RayQueue<Element<S>>& to, const Hit<S>& hit,
                                    const Branch<S, P>& ray, const HitNotes<S, P>& notes, const Carried<S>& carried) {
    push(shading, to, hit, ray, notes, &carried);
}

/// Queues rays that go on straight through surfaces which are not there for them. Other surfaces may lie in the same
/// place, so that these rays start a little before. Rays as short as that start a little behind, or two such surfaces
/// in one place would meet them in turn. `t` is their length.
template <class S, class P>
void push_through(const Shading<S, P>& shading, Hit<S> hit, const S& t, const Carried<S>& carried,
                  const HitNotes<S, P>& notes) {
    const S one(1), s = -dot(hit.direction, hit.normal), step(4 * shading.world.rounding);
    hit.position = fma(select(t > S(2) * step, -step, step), hit.direction, hit.position);
    Branch<S, P> on = branch<P>(hit, hit.active, hit.direction, one, hit.medium);
    P::refract(shading, hit, notes.own, hit.active, first_lanes<S>(0), one, s, s * s, on);
    on.mask = on.mask & (on.weight >= S(shading.world.finishes.bailout));
    Element<S>* const pixels = shading.refracted.pixel + shading.refracted.count;
    push_carried(shading, shading.refracted, hit, on, notes, carried);
    if (notes_layers(shading)) compress(pixels, hit.pixel, on.mask);  // their way from the eye goes on
}

/// Queues the rays that go on from hits with finishes, and are not pruned. `t` is the length of the rays that hit.
/// Returns the lanes whose direct light is pruned.
template <class S, class P>
[[gnu::noinline]] Mask<S> scatter_layers(const Shading<S, P>& shading, const Hit<S>& hit, const int* numbers,
                                         const LayeredHit<S>& layers, const S& t, const HitNotes<S, P>& notes) {
    using T = Element<S>;
    const auto& world = shading.world;
    const Carried<S>& before = notes.carried;
    const S zero(0), one(1), bailout(world.finishes.bailout), most = most_of(before.tint);
    const S least(std::numeric_limits<T>::min());  // so that 1 / share is finite
    const S brightest(shading.limits.brightest_beyond(shading.depth));
    const Mask<S> glass = hit.active & (largest(layers.through) > least);
    Vec3<S> mirrored = layers.mirrored, through = before.tint, faded = splat<S>(Vec3<T>(1));
    Branch<S, P> refracted{};
    Mask<S> total = first_lanes<S>(0);
    S counted = one;
    if (any(glass)) {
        if (world.finishes.follows)
            faded = FinishCalls<S>::faded_inside(
                world, numbers, t, from_inside(world, &mediums(shading.workspace), hit.medium, hit.body, hit.outside));
        const Refraction<S> way = refract(shading, hit, glass);
        const Mask<S> straight = way.ratio == one;
        total = way.total;
        mirrored = select(total, Vec3<S>(layers.total, layers.total, layers.total), mirrored);
        const S share = largest(layers.through);
        refracted = branch<P>(hit, glass & !total, select(straight, hit.direction, way.direction), share, way.medium);
        P::refract(shading, hit, notes.own, glass, way.far, way.ratio, way.cosine, way.k, refracted);
        refracted.mask = refracted.mask & (refracted.weight >= bailout);
        counted = one - select(straight, layers.clear, zero);
        through = before.tint * faded * scale(one / share, layers.through);
    }
    // POV-Ray takes rays for as strong as light that grazes the surface, or that comes through it.
    const S share =
        select(total, world.finishes.carries ? largest(layers.through) : layers.total, layers.most_mirrored);
    const Mask<S> sends = hit.active & (share > least) & (largest(mirrored) > zero);
    Branch<S, P> reflected = branch<P>(hit, sends, mirrored_direction(shading, hit, notes), share, hit.medium);
    P::reflect(shading, hit, notes, share, reflected);
    reflected.mask = reflected.mask & (reflected.weight >= bailout);
    const Vec3<S> sent = before.tint * scale(one / share, mirrored), sent_faded = select(total, sent * faded, sent);

    Contribution<S> reflected_part(reflected.weight * most_of(sent_faded) * brightest, reflected.mask);
    Contribution<S> refracted_part(refracted.weight * most_of(through) * brightest, refracted.mask);
    Contribution<S> light(hit.weight * most * hit.material.scattered, hit.active & (hit.material.scattered > zero));
    prune(shading, hit.pixel, reflected_part, refracted_part, light);
    reflected.mask = reflected.mask & !reflected_part.pruned;
    refracted.mask = refracted.mask & !refracted_part.pruned;
    shading.counts.reflected += count(reflected.mask);
    shading.counts.refracted += count(refracted.mask);
    const Carried<S> beyond{through, before.level + counted, before.mirrored},
        away{sent_faded, before.level + one, one};
    if (world.few.enclosed >> hit.bin & 1) {
        const Mask<S> in = hit.outside;
        const Carried<S> within{select(in, beyond.tint, away.tint), select(in, beyond.level, away.level),
                                select(in, beyond.mirrored, away.mirrored)};
        keep_inside(shading, hit, reflected, refracted, notes, &within);
    }
    push_carried(shading, shading.refracted, hit, refracted, notes, beyond);
    push_carried(shading, shading.next.open, hit, reflected, notes, away);
    return light.pruned;
}

/// Adds the light of hits with finishes to their pixels, and queues their rays: that of layers with this bend, see
/// LayerKernel. `t` is the length of the rays.
template <class S, class P>
[[gnu::noinline]] void shade_finish(const Shading<S, P>& shading, Hit<S> hit, const int* numbers,
                                    const RayQueue<Element<S>>& from, const LaneIndices<S>& pick, const S& t,
                                    HitNotes<S, P>& notes, int bend = 0) {
    const auto& world = shading.world;
    const Carried<S> before = carried_by(shading, from, pick);
    if (world.finishes.hides) {
        Hit<S> hidden = hit;
        hidden.active = hit.active & FinishCalls<S>::hidden(world, numbers, before.mirrored);
        if (bend == 0 && any(hidden.active) && shading.depth < deepest_ray)
            push_through(shading, hidden, t, before, notes);  // fog filters the light of the whole ray, at its end
        hit.active = hit.active & !hidden.active;
        // Notes are taken of hidden surfaces too: what lies beside each other in a pack must not matter to them. The
        // fog before them shines.
        if (P::notes && none(hit.active) && !world.fog.any && !filters(shading) && !notes_layers(shading)) return;
    }
    LayeredHit<S> layers;
    layers.bend = bend;
    look_at_layers(shading, hit, numbers, from, pick, notes, layers);
    P::layers(shading, hit, numbers, layers, notes.own);
    Onward<S> on;
    carry_on(shading, hit, from, pick, bend == 0, notes.carried, on);
    const Mask<S> active = hit.active;
    if (any(on.lanes)) {
        const S weight = hit.weight;
        hit.active = on.lanes, hit.weight = on.weight;
        const Mask<S> dim = scatter_layers(shading, hit, numbers, layers, t, notes);
        hit.active = active & !dim, hit.weight = weight;
    }
    Vec3<S> light = layers.ambient;
    add_lights(shading, hit, numbers, layers, notes, light);
    hit.active = active;
    const Vec3<S> sum = light;
    light = select(hit.active, scale(hit.weight, light), splat<S>(Vec3<Element<S>>(0)));
    if (world.fog.any) {
        light = light * tint_of_fog(world, medium_in_fog(shading, S(hit.medium)));
        if (bend == 0) light = fma(pick(from.weight) - hit.weight, splat<S>(world.fog.color), light);
    }
    light = light * before.tint;
    add_light(shading.batch, hit.pixel, pick.lanes, light);
    if (notes_layers(shading)) {
        Vec3<S> factor = scale(select(hit.active, hit.weight, S(0)), before.tint);
        if (world.fog.any) factor = factor * tint_of_fog(world, medium_in_fog(shading, S(hit.medium)));
        note_layers(shading, hit, t, pick.lanes, numbers, bend == 0, light, sum, factor);
    }
    P::shade(shading, hit, from, pick, t, light, notes.own);
}

}  // namespace strahl::inline STRAHL_LEVEL
