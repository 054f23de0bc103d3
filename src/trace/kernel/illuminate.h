// Direct illumination: the light of all lights that hits scatter.
#pragma once
#include "trace/kernel/layers.h"
#include "trace/kernel/light_at.h"
#include "trace/kernel/sight.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns highlights, Ks (h.l)^p, in the lanes of `glossy`, and 0 in others.
template <class S>
STRAHL_INLINE S highlight_of(const Hit<S>& hit, const Vec3<S>& reflected, const Vec3<S>& l, Mask<S> glossy) {
    const MaterialKernel<S>& material = hit.material;
    const S shine = min(max(dot(reflected, l), S(0)), S(1));  // above 1, high powers would magnify rounding errors
    const Mask<S> shines = glossy & (shine > material.shines_from);
    if (none(shines)) return S(0);
    const S power_of_shine = hit.uniform ? power_of_uniform(shine, lane(material.pow, 0)) : power(shine, material.pow);
    return select(shines, material.specular * power_of_shine, S(0));
}

/// Adds the light of a rectangle to `sum`, at the hits in these lanes.
template <class S, class P>
[[gnu::noinline]] void add_area_light(const Shading<S, P>& shading, const Hit<S>& hit, int number, Mask<S> lanes,
                                      const HitNotes<S, P>& notes, Vec3<S>& sum) {
    using T = Element<S>;
    const MaterialKernel<S>& material = hit.material;
    const LightKernel<T>& light = shading.world.lights[number];
    const Vec3<S> reflected = reflect(hit);
    const LitHits<S> hits{lanes,
                          hit.outside,
                          hit.position,
                          hit.normal,
                          shading.world.patterns.bends ? notes.flat : hit.normal,
                          reflected,
                          hit.surface,
                          hit.weight,
                          largest(material.diffuse),
                          material.specular,
                          material.pow,
                          material.shines_from,
                          hit.bin};
    constexpr T usual = T(1) / 510;
    const T error = shading.limits.error > T(0) ? shading.limits.error : usual;
    const AreaMeans<S> means = AreaLightCalls<S>::means(shading.world, number, hits, error, visibility<S>);
    shading.counts.shadow += means.rays;
    if (notes_sights(shading)) {
        // Signatures tell penumbra from light and from shadow, but not its shades: these differ in colour.
        Vec3<S> share;
        for (int c = 0; c < 3; ++c)
            share[c] = select(means.share[c] > S(0), select(means.share[c] < S(1), S(T(.5)), S(1)), S(0));
        const Vec3<S> way = splat<S>(light.position) - hit.position;
        note_light(shading, hit, notes, number, share, S(dot(reflected, way) / sqrt(dot(way, way))), lanes);
    }
    for (int c = 0; c < 3; ++c)
        sum[c] = fma(S(light.color[c]), fma(material.diffuse[c], means.diffuse[c], means.highlight[c]), sum[c]);
}

/// Adds the light of a special light to `sum`, where it brings more than `faint` of its colour to plain hits.
template <class S, class P>
[[gnu::noinline]] void add_special_light(const Shading<S, P>& shading, const Hit<S>& hit, int number, const S& faint,
                                         HitNotes<S, P>& notes, Vec3<S>& sum) {
    const MaterialKernel<S>& material = hit.material;
    const LightKernel<Element<S>>& light = shading.world.lights[number];
    if (light.group != 0) return;
    const Vec3<S>& flat = flat_normal(shading, hit, notes);
    const Vec3<S> reflected = reflect(hit);
    LightAt<S> at = light_at(shading, hit, light, flat, first_lanes<S>(0));
    const auto own = P::light_of(shading, hit, light, at, flat, notes.own);
    if (none(P::lit(at.faces, hit, own))) return;
    S highlight(0);
    if (!light.shadowless) {
        const Mask<S> glossy = P::lit(at.faces, hit, own) & (material.specular > S(0));
        highlight = highlight_of(hit, reflected, at.way.l, glossy);
    }
    at.faces = at.faces & (at.strength * fma(largest(material.diffuse), at.way.cosine, highlight) > faint);
    if (none(P::lit(at.faces, hit, own))) return;
    const Vec3<S> share = share_at(shading, hit, number, at, flat, reflected);
    if (notes_sights(shading)) note_light(shading, hit, notes, number, share, S(dot(reflected, at.way.l)), at.faces);
    P::special(shading, hit, number, at, share, highlight, own, notes.own);
    for (int c = 0; c < 3; ++c) {
        const S sent = fma(material.diffuse[c], at.way.cosine, highlight);
        sum[c] = select(at.faces, fma(at.strength * share[c] * S(light.color[c]), sent, sum[c]), sum[c]);
    }
}

/// Returns Ia Ka Of + sum over lights S Il [Kd Of (n.l) + Ks (h.l)^p]. At `dim` hits lights are skipped that bring no
/// more than `faint_share` times the diffuse term of that light straight above, together no more than
/// `MaterialKernel::scattered`. Of `notes` all but the policy's data are only read if `Shading::has_notes`.
template <class S, class P>
STRAHL_INLINE Vec3<S> illumination(const Shading<S, P>& shading, const Hit<S>& hit, Mask<S> dim,
                                   HitNotes<S, P>& notes) {
    const MaterialKernel<S>& material = hit.material;
    const auto& world = shading.world;
    const S zero(0);
    Vec3<S> sum = material.ambient;
    const bool through = lights_bent_sides(world);
    const Vec3<S> reflected = reflect(hit);
    const S strongest = largest(material.diffuse);
    const S possible = P::diffuse(notes.own, strongest);
    const Mask<S> glossy = hit.active & (material.specular > zero);
    if (none(glossy | (hit.active & (possible > zero)))) return sum;
    const S faint = select(dim, S(faint_share) * strongest, zero);
    for (int i = 0; i < world.light_count; ++i) {
        const LightKernel<Element<S>>& light = world.lights[i];
        if (notes_layers(shading)) [[unlikely]]
            note_light_before(shading, Vec3<S>(sum));
        if (light.special) [[unlikely]] {
            if (light.area) P::area(shading, hit, light, notes.own);
            Vec3<S> copy = sum;
            if (light.area && !light.rectangle.soft)
                add_area_light(shading, hit, i, hit.active & ((strongest > faint) | glossy), notes, copy);
            else
                add_special_light(shading, hit, i, S(faint), notes, copy);
            sum = copy;
            continue;
        }
        const Vec3<S> to_light = fma(S(-light.finite), hit.position, splat<S>(light.position));
        const S facing = dot(hit.normal, to_light);
        if (none(P::may_face(notes.own, hit, light, to_light, facing))) continue;
        const S squared = dot(to_light, to_light);
        const S length = sqrt(squared), inverse = S(1) / length;
        S distance = length * S(light.far);
        Vec3<S> l = scale(inverse, to_light);
        S cosine = facing * inverse;
        S highlight = zero;
        if (any(glossy)) highlight = highlight_of(hit, reflected, l, glossy);
        // Looks for shadows only where there is light to lose.
        Mask<S> faces = hit.active & (cosine > zero) & (fma(possible, cosine, highlight) > faint);
        auto own = P::light(notes.own, hit, light, length, cosine, S(dot(reflected, l)), highlight);
        if (none(P::lit(faces, hit, own))) continue;
        const Mask<S> lost = faces & ((squared < S(least_square<Element<S>>)) | (cosine > S(2)));
        if (any(lost)) {
            const WayToLight<S> way = way_to_near_light(hit, to_light);
            distance = select(lost, way.distance, distance), l = select(lost, way.l, l);
            cosine = select(lost, way.cosine, cosine);
            faces = faces & (cosine > zero);
            if (any(glossy)) highlight = highlight_of(hit, reflected, l, glossy);
        }
        if (world.patterns.bends) [[unlikely]]
            P::side(notes.own, notes.flat, Vec3<S>(l), own, faces);
        if (light.spot) [[unlikely]] {
            faces = faces & (spot_share(light.cone, Vec3<S>(l)) > zero);
            P::spot(shading, hit, light, own, Vec3<S>(l), cosine, highlight, notes.own);
            if (none(P::lit(faces, hit, own))) continue;
        }
        shading.counts.shadow += count(faces);
        Mask<S> outside = hit.outside;
        if (through) [[unlikely]] {
            const Mask<S> inwards = dot(notes.flat, l) < S(0);
            outside = (outside & !inwards) | (inwards & !outside);
        }
        Start<S> start{i, hit.bin, outside};
        if (world.shadow_rays == ShadowRays::followed) [[unlikely]]
            start.medium = hit.medium, start.mediums = &mediums(shading.workspace);
        Vec3<S> share = P::arriving(shading, hit, own, l, distance, faces, cosine, highlight, start, notes.own);
        if (shading.has_notes) [[unlikely]] {
            // A light that the bent normal faces and the surface does not is behind the surface.
            if (world.patterns.bends && !through)
                share = select(dot(notes.flat, l) > S(0), share, splat<S>(Vec3<Element<S>>(0)));
            if (notes_sights(shading)) note_light(shading, hit, notes, i, Vec3<S>(share), S(dot(reflected, l)), faces);
        }
        if (light.spot) [[unlikely]]
            share = scale(spot_share(light.cone, Vec3<S>(l)), share);
        cosine = select(faces, cosine, zero);  // at the light itself it is NaN
        highlight = select(faces, highlight, zero);
        for (int c = 0; c < 3; ++c)
            sum[c] = fma(share[c] * S(light.color[c]), fma(material.diffuse[c], cosine, highlight), sum[c]);
    }
    return sum;
}

}  // namespace strahl::inline STRAHL_LEVEL
