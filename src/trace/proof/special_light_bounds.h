// Error bounds of the light of special lights, and of all lights at hits with finishes.
#pragma once
#include "trace/lights/light_strength.h"
#include "trace/proof/lighting_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// Bounds the error of the share of a fading light that is left: s = 2 / (1 + x^p) changes by no more than p s times
/// the relative change of x, as long as p times that is small. x has 4 u of rounding, the power p times
/// that and some more.
template <class S>
STRAHL_INLINE S fading_error(const LightKernel<Element<S>>& light, const S& strength, const S& distance, const S& off) {
    using T = Element<S>;
    const T p = max(light.fade_power, T(1));
    const S change = S(p) * (off / distance + S(4 * unit_error<S>));
    return select(change < S(T(.1)), S(T(1.2)) * strength * (change + S(32 * unit_error<S>)), S(2));
}

/// Bounds the errors of a light's direction and strength, and finds where it is undecided whether it shines on hits at
/// all. All of the light is added to the errors of hits if it is a rectangle or a beam, or comes from a plane.
template <class S>
[[gnu::noinline]] LitBounds<S> bound_light_of(const ProvedShading<S>& shading, const Hit<S>& hit,
                                              const LightKernel<Element<S>>& light, const LightAt<S>& at,
                                              const Vec3<S>& flat, HitBounds<S>& known) {
    using T = Element<S>;
    LitBounds<S> lit{};
    lit.doubt = first_lanes<S>(0);
    if (light.area || light.beam.radius > 0 || light.starts || light.cone.tightness < 0) {
        // A hit with finishes sends back at most `scattered` of the light of all lights together.
        lit.known = false;
        add_unknown_light(shading, hit, light, known);
        known.off = known.off + hit.material.scattered;
        return lit;
    }
    const S length = light.finite == T(0) ? S(1) : at.way.distance;
    lit = bound_lit(known, hit, light, length, at.way.cosine, S(0), S(0));
    lit.highlight = S(0);
    const Mask<S> near = !(lit.distance < S(T(.25)) * length);
    if (shading.world.patterns.bends && !light.shadowless && light.rectangle.columns == 0) {
        Mask<S> faces = at.faces;
        bound_side_of_light(known, flat, at.way.l, lit, faces);
    }
    if (light.spot) lit.strength = select(near, S(1), spot_error(light.cone, at.way.l, lit.ray.turn));
    if (light.fade_per > 0) {
        const S fading = select(near, S(2), fading_error(light, S(2), at.way.distance, lit.distance));
        lit.strength = fma(S(2), lit.strength, fading);
    }
    lit.doubt = hit.active & (lit.doubt | ((at.way.cosine > S(0)) & (at.strength == S(0)) & (lit.strength > S(0))));
    return lit;
}

/// Adds the error of a light at hits: they send back `sent` of what arrives, in its largest channel. `share` is what
/// the kernel found to come through what is in the way.
template <class S>
[[gnu::noinline]] void bound_arriving(const ProvedShading<S>& shading, const Hit<S>& hit, int number,
                                      const LightAt<S>& at, const Vec3<S>& share, const Bounded<S>& sent,
                                      const LitBounds<S>& lit, HitBounds<S>& known) {
    using T = Element<S>;
    if (!lit.known) return;
    const auto& world = shading.world;
    const LightKernel<T>& light = world.lights[number];
    const Slack<T>& slack = proving(shading.limits).slack;
    Mask<S> doubt = lit.doubt;
    S off(0), through(1);
    if (!light.shadowless && any(at.faces)) {
        const Start<S> start{number, hit.bin, hit.outside};
        const LightBounds<S> found =
            light_bounds(world, DoubtfulRay<S>{{hit.position, at.way.l, hit.surface}, lit.ray}, at.way.distance,
                         lit.distance, at.faces & known.followed, start, slack);
        doubt = doubt | (at.faces & in_doubt(world, found));
        const Vec3<S> exact = select(found.dark, Vec3<S>(S(0), S(0), S(0)), found.share);
        through = largest(exact);
        off = select(found.dark, S(0), fma(S(unit_error<S>) * found.crossings, through, found.off)) +
              most_of(share - exact);
    }
    const S color = most_of(splat<S>(light.color)), most = sent.value + sent.off;
    const S certain =
        fma(at.strength * through, sent.off, most * fma(at.strength + lit.strength, off, lit.strength * through));
    const S strength =
        select(at.faces | (at.strength == S(0)), at.strength + lit.strength, S(light.fade_per > 0 ? 2 : 1));
    const S undecided = S(slack.gain) * most * strength;
    known.off = known.off + color * select(doubt, undecided, select(at.faces, certain, S(0)));
}

/// Bounds the light of a special light at plain hits.
template <class S>
[[gnu::noinline]] void bound_special(const ProvedShading<S>& shading, const Hit<S>& hit, int number,
                                     const LightAt<S>& at, const Vec3<S>& share, const S& highlight,
                                     const LitBounds<S>& own, HitBounds<S>& known) {
    if (!own.known) return;
    const LightKernel<Element<S>>& light = shading.world.lights[number];
    const S shine = dot(reflect(hit), at.way.l);
    LitBounds<S> lit = own;
    if (!light.shadowless) {
        const S length = light.finite == Element<S>(0) ? S(1) : at.way.distance;
        lit.highlight = bound_lit(known, hit, light, length, at.way.cosine, shine, highlight).highlight;
    }
    const S value = fma(largest(hit.material.diffuse), abs(at.way.cosine), highlight);
    bound_arriving(shading, hit, number, at, share, Bounded<S>{value, light_error(hit, lit, at.way.cosine, known)}, lit,
                   known);
}

/// Bounds the errors of the layers of hits.
template <class S>
[[gnu::noinline]] void bound_layers(const ProvedShading<S>& shading, const Hit<S>& hit, const int* materials,
                                    const LayeredHit<S>& layers, HitBounds<S>& known) {
    if (none(known.followed)) return;
    const SeenSurface<S> seen{hit.position, hit.direction, hit.normal, hit.surface, hit.outside};
    const LayerErrors<S> errors =
        FinishBounds<S>::of_layers(shading.world, materials, seen, {known.normal, known.turn, known.color}, layers);
    known.off = errors.ambient;
    known.reflected = errors.reflected, known.refracted = errors.refracted, known.sent = errors.sent;
}

/// Bounds the light of a light at hits with finishes.
template <class S>
[[gnu::noinline]] void bound_lit_layers(const ProvedShading<S>& shading, const Hit<S>& hit, const int* materials,
                                        const LayeredHit<S>& layers, int number, const LightAt<S>& at,
                                        const LitSurface<S>& lit, const Vec3<S>& share, const LitBounds<S>& own,
                                        HitBounds<S>& known) {
    if (!own.known || none(known.followed)) return;
    const Bounded<S> sent =
        FinishBounds<S>::of_light(shading.world, materials, layers, lit, {known.normal, known.turn, known.color},
                                  {own.ray.turn, own.cosine, turn_reflected(known) + own.ray.turn});
    bound_arriving(shading, hit, number, at, share, sent, own, known);
}

}  // namespace strahl::inline STRAHL_LEVEL
