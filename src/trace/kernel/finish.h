// Shades hits in worlds with POV-Ray's finishes: their light, by layers, and their rays, which carry colours.
#pragma once
#include "trace/kernel/faded_light.h"
#include "trace/kernel/fog.h"
#include "trace/kernel/footprint.h"
#include "trace/kernel/illuminate.h"
#include "trace/kernel/scatter.h"
#include "trace/patterns/finish_calls.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns the colours of rays' light, whose largest channel their weights are.
template <class S>
STRAHL_INLINE Vec3<S> tint_of(const RayQueue<Element<S>>& rays, const LaneIndices<S>& pick) {
    return {pick(rays.tint[0]), pick(rays.tint[1]), pick(rays.tint[2])};
}

/// Returns by what layers multiply the light that they scatter.
template <class S>
Vec3<S> color_of(const LayeredHit<S>& layers) {
    Vec3<S> sum = splat<S>(Vec3<Element<S>>(0));
    for (int i = 0; i < most_layers; ++i)
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
    if (!filters(shading)) return void(FinishCalls<S>::look(shading.world, numbers, seen, nullptr, layers));
    if (shading.world.patterns.quick) {
        const Footprint<S> own = footprint_of(notes.cone.width, hit.direction, notes.flat);
        return void(FinishCalls<S>::look(shading.world, numbers, seen, &own, layers));
    }
    const Footprint<S> footprint{hit.direction, notes.flat, notes.beside.place[0], notes.beside.place[1],
                                 pick(from.weight)};
    Filtering<S> filtering = FinishCalls<S>::look(shading.world, numbers, seen, &footprint, layers);
    loosen(filtering, notes.beside.loose);
    note_colors(shading, filtering, color_of(layers), hit.pixel, pick(from.weight), pick.lanes);
}

/// Returns the share of light that is left of an area light, whose shadows alone are soft. Its rays go to the side of
/// `normal` and `flat`, and outside the bodies or inside.
template <class S, class P>
Vec3<S> soft_share(const Shading<S, P>& shading, const Hit<S>& hit, int number, Mask<S> lanes, const S& strength,
                   const Vec3<S>& reflected, const Vec3<S>& normal, const Vec3<S>& flat, Mask<S> outside,
                   Visibility<S> visible) {
    using T = Element<S>;
    const auto& world = shading.world;
    constexpr T error = T(1) / 510;
    const S light = hit.weight * strength;
    const LitHits<S> hits{lanes,     outside,     hit.position, normal,     flat,
                          reflected, hit.surface, light,        S(1),       S(0),
                          S(1),      S(1),        hit.bin,      hit.medium, &mediums(shading.workspace)};
    const AreaMeans<S> means = world.lights[number].columns > 0
                                   ? AreaLightCalls<S>::grid_means(world, number, hits, strength, visible)
                                   : AreaLightCalls<S>::means(world, number, hits, error, visible);
    shading.counts.shadow += means.rays;
    return means.share;
}

/// Adds the light of all lights to `sum`. An area light shines from its middle, and only its shadows are soft.
template <class S, class P>
void add_lights(const Shading<S, P>& shading, const Hit<S>& hit, const int* numbers, const LayeredHit<S>& layers,
                const HitNotes<S, P>& notes, Vec3<S>& sum) {
    using T = Element<S>;
    const auto& world = shading.world;
    const S zero(0);
    const Vec3<S>& flat = world.patterns.bends ? notes.flat : hit.normal;
    const Vec3<S> reflected = reflect(hit), nothing = splat<S>(Vec3<T>(0));
    const Visibility<S> visible = world.finishes.follows                                ? faded_visibility<S>
                                  : world.transparent && world.passed_in_shadows > T(0) ? clear_visibility<S>
                                                                                        : visibility<S>;
    const Mask<S> both = world.finishes.behind ? FinishCalls<S>::lit_behind(world, numbers) : first_lanes<S>(0);
    const bool through = lights_bent_sides(world);
    for (int i = 0; i < world.light_count; ++i) {
        const LightKernel<T>& light = world.lights[i];
        const Vec3<S> to_light = fma(S(-light.finite), hit.position, splat<S>(light.position));
        const S squared = dot(to_light, to_light), length = sqrt(squared);
        WayToLight<S> way{scale(S(1) / length, to_light), length * S(light.far), zero};
        way.cosine = dot(hit.normal, way.l);
        const Mask<S> lost = (squared < S(least_square<T>)) | (way.cosine > S(2));
        if (any(lost)) {
            const WayToLight<S> near = way_to_near_light(hit, to_light);
            way.l = select(lost, near.l, way.l), way.cosine = select(lost, near.cosine, way.cosine);
            way.distance = select(lost, near.distance, way.distance);
        }
        if (light.starts) way.distance = S(light.start) - dot(hit.position, way.l);
        const Mask<S> behind = both & (way.cosine < zero);
        const Mask<S> inwards = through ? dot(flat, way.l) < zero : both & (dot(flat, way.l) < zero);
        const Mask<S> outside = (hit.outside & !inwards) | (inwards & !hit.outside);
        way.cosine = select(behind, -way.cosine, way.cosine);
        Mask<S> faces = hit.active & (way.cosine > zero);
        if (world.finishes.groups) faces = faces & FinishCalls<S>::lit_by(world, numbers, light.group);
        // As in POV-Ray a light without shadows also lights bent normals on the side away from it, and so do those
        // points of a grid that face the surface; and others unless the body itself hides them.
        if (world.patterns.bends && !through && !light.shadowless && light.columns == 0)
            faces = faces & (both | (dot(flat, way.l) > zero));
        S strength(1);
        if (light.spot) strength = spot_share(light, way.l);
        if (light.beam > 0) strength = FinishCalls<S>::in_beam(light, hit.position, way.l, way.distance);
        if (light.fade_per > 0) strength = strength * FinishCalls<S>::faded(light, max(way.distance, zero));
        faces = faces & (strength > zero);
        if (none(faces)) continue;
        Vec3<S> share = splat<S>(Vec3<T>(1));
        // Behind the plane from which parallel light comes nothing is in its way.
        Mask<S> shaded = light.shadowless ? first_lanes<S>(0) : faces;
        if (light.starts) shaded = shaded & (way.distance > zero);
        if (any(shaded) && light.area) {
            share = soft_share(shading, hit, i, faces, strength, reflected, select(behind, -hit.normal, hit.normal),
                               select(inwards, -flat, flat), outside, visible);
        } else if (any(shaded)) {
            const Start<S> start{i, hit.bin, outside, ~BodySet(0), hit.medium, &mediums(shading.workspace)};
            const Ray<S> ray{hit.position, way.l, hit.surface};
            share = select(shaded, visible(world, ray, way.distance, shaded, start), share);
            shading.counts.shadow += count(faces);
        }
        if (notes_sights(shading)) note_light(shading, hit, notes, i, share, S(dot(reflected, way.l)), faces);
        Vec3<S> arriving;
        for (int c = 0; c < 3; ++c) arriving[c] = strength * share[c] * S(light.color[c]);
        arriving = select(faces, arriving, nothing);
        const LitSurface<S> lit{hit.direction, hit.normal, reflected, way.l, way.cosine, !light.shadowless, behind};
        Vec3<S> lighted = sum;
        FinishCalls<S>::scatter(world, numbers, layers, lit, arriving, lighted);
        sum = select(faces, lighted, sum);
    }
}

/// Queues a ray that goes on from hits, with its colour, its generation as POV-Ray counts them, and whether it has been
/// reflected.
template <class S, class P>
void push(const Shading<S, P>& shading, RayQueue<Element<S>>& to, const Hit<S>& hit, Branch<S, P> ray,
          const Vec3<S>& tint, const S& level, const S& mirrored, const HitNotes<S, P>& notes) {
    ray.mask = ray.mask & (ray.weight >= S(shading.world.finishes.bailout));
    // Keeps colours finite: infinity times a channel without light is no number.
    for (int c = 0; c < 3; ++c) compress(to.tint[c] + to.count, min(tint[c], S(largest_gain)), ray.mask);
    compress(to.level + to.count, level, ray.mask), compress(to.mirrored + to.count, mirrored, ray.mask);
    push(shading, to, hit, ray, notes);
}

/// Queues rays that go on straight through surfaces which are not there for them. Other surfaces may lie in the same
/// place, so that these rays start a little before. Rays as short as that start a little behind, or two such surfaces
/// in one place would meet them in turn. `t` is their length.
template <class S, class P>
void push_through(const Shading<S, P>& shading, Hit<S> hit, Mask<S> hidden, const S& t, const Vec3<S>& tint,
                  const RayQueue<Element<S>>& from, const LaneIndices<S>& pick, const HitNotes<S, P>& notes) {
    const S one(1), s = -dot(hit.direction, hit.normal), step(4 * shading.world.rounding);
    hit.position = fma(select(t > S(2) * step, -step, step), hit.direction, hit.position);
    Branch<S, P> on = branch<P>(hit, hidden, hit.direction, one, hit.medium);
    P::refract(shading, hit, notes.own, hidden, first_lanes<S>(0), one, s, s * s, on);
    push(shading, shading.refracted, hit, on, tint, pick(from.level), pick(from.mirrored), notes);
}

/// Adds the light of hits to their pixels, and queues their rays: that of layers with this bend, see LayerKernel.
/// Nothing is pruned. `t` is the length of the rays.
template <class S, class P>
[[gnu::noinline]] void shade_finish(const Shading<S, P>& shading, Hit<S> hit, const int* numbers,
                                    const RayQueue<Element<S>>& from, const LaneIndices<S>& pick, const S& t,
                                    HitNotes<S, P>& notes, int bend = 0) {
    using T = Element<S>;
    const auto& world = shading.world;
    const S zero(0), one(1);
    constexpr int deepest = 256;  // also of rays that go straight on, whose level stays
    const Vec3<S> before = tint_of(from, pick);
    Vec3<S> tint = world.fog.any ? before * tint_of_fog(world, medium_in_fog(shading, S(hit.medium))) : before;
    if (world.finishes.hides) {
        const Mask<S> hidden = hit.active & FinishCalls<S>::hidden(world, numbers, pick(from.mirrored));
        if (bend == 0 && any(hidden) && shading.depth < deepest)
            push_through(shading, hit, hidden, t, tint, from, pick, notes);
        hit.active = hit.active & !hidden;
    }
    LayeredHit<S> layers;
    layers.bend = bend;
    look_at_layers(shading, hit, numbers, from, pick, notes, layers);
    Vec3<S> light = layers.ambient;
    add_lights(shading, hit, numbers, layers, notes, light);
    light = select(hit.active, scale(hit.weight, light), splat<S>(Vec3<T>(0)));
    if (world.fog.any) {
        light = light * tint_of_fog(world, medium_in_fog(shading, S(hit.medium)));
        if (bend == 0) light = fma(pick(from.weight) - hit.weight, splat<S>(world.fog.color), light);
    }
    add_light(shading.batch, hit.pixel, pick.lanes, light * before);

    const S level = pick(from.level);
    const Mask<S> deeper = hit.active & (level < S(static_cast<T>(shading.limits.depth)));
    if (none(deeper) || shading.depth >= deepest) return bend == 0 ? truncate(shading, hit) : void();
    if (world.fog.any && world.finishes.bailout > T(0)) {
        // POV-Ray follows rays by their strength before fog dims them.
        const S strength = pick(from.weight);
        tint = scale(hit.weight / strength, tint), hit.weight = strength;
    }
    const S least(std::numeric_limits<T>::min());  // so that 1 / share is finite
    const Mask<S> glass = deeper & (largest(layers.through) > least);
    const bool bends = world.patterns.bends;
    const Vec3<S> away = bends ? reflect_bent(hit, notes.flat) : reflect(hit);
    Vec3<S> mirrored = layers.mirrored, faded = splat<S>(Vec3<T>(1));
    Branch<S, P> refracted{};
    Mask<S> total = first_lanes<S>(0);
    if (world.finishes.follows && any(glass))
        faded = FinishCalls<S>::faded_inside(
            world, numbers, t, from_inside(world, &mediums(shading.workspace), hit.medium, hit.body, hit.outside));
    if (any(glass)) {
        S b = select(hit.outside, one / hit.material.ior, hit.material.ior), medium = hit.medium;
        if (world.nested) change_medium(shading, hit, glass, b, medium);
        Vec3<S> normal = hit.normal;
        if (bends) normal = select(dot(hit.direction, normal) > zero, -normal, normal);
        const S s = -dot(hit.direction, normal);
        S k = fma(b * b, fma(s, s, S(-1)), one);
        Vec3<S> beyond = fma(fma(b, s, -sqrt(max(k, zero))), normal, scale(b, hit.direction));
        const Mask<S> far = glass & (b > S(far_ratio)), straight = b == one;
        if (any(far)) {
            S far_k;
            const Vec3<S> far_beyond = refract_far(hit, normal, b, s, far_k);
            k = select(far, far_k, k), beyond = select(far, far_beyond, beyond);
        }
        beyond = select(straight, hit.direction, beyond);
        total = glass & (k < zero);
        const Vec3<S> all(layers.total, layers.total, layers.total);
        mirrored = select(total, all, mirrored);
        const S share = largest(layers.through);
        refracted = branch<P>(hit, glass & !total, beyond, share, medium);
        P::refract(shading, hit, notes.own, glass, far, b, s, k, refracted);
        const S counted = one - select(straight, layers.clear, zero);
        push(shading, shading.refracted, hit, refracted, tint * faded * scale(one / share, layers.through),
             level + counted, pick(from.mirrored), notes);
        shading.counts.refracted += count(refracted.mask);
    }
    // POV-Ray takes rays for as strong as light that grazes the surface, or that comes through it.
    const S share = select(total, largest(layers.through), layers.most_mirrored);
    const Mask<S> sends = deeper & (share > least) & (largest(mirrored) > zero);
    Branch<S, P> reflected = branch<P>(hit, sends, away, share, hit.medium);
    P::reflect(shading, hit, notes, share, reflected);
    const Vec3<S> sent = tint * scale(one / share, mirrored);
    push(shading, shading.next.open, hit, reflected, select(total, sent * faded, sent), level + one, one, notes);
    shading.counts.reflected += count(reflected.mask);
}

}  // namespace strahl::inline STRAHL_LEVEL
