// The code of error bounds of POV-Ray's finishes. They follow the formulas of finish/finish_kernel.h.
#pragma once
#include "trace/finish/finish_kernel.h"
#include "trace/proof/finish_bounds.h"
#include "trace/proof/lighting_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// Bounds a metal's share (metal_share) at a cosine whose angle is off by `turn`. With the angle a in quarter turns the
/// share's slope is 2 * .014567 / (1.12 - a)^3: up to a = 2/3, where the cosine is 1/2, at most .32, and 16.9 up to
/// a = 1. A cosine with 6 u of rounding is one of an angle that is off by that over its sine, or by the root of twice
/// that.
template <class S>
STRAHL_INLINE Bounded<S> metal_bounds(const S& cosine, const S& turn) {
    constexpr auto u = unit_error<S>;
    const S sine = sqrt(max(fma(-cosine, cosine, S(1)), S(4 * u))), angle = S(.64f) * (turn + S(12 * u) / sine);
    const S slope = select(cosine - turn > S(.5), S(.33f), S(17));
    return {metal_share(cosine), fma(slope, angle, S(64 * u))};
}
/// Bounds one channel of the tint of a metal.
template <class S>
STRAHL_INLINE Bounded<S> tint_bounds(const Bounded<S>& color, Element<S> metallic, const Bounded<S>& share) {
    const Bounded<S> one{S(1)};
    return one + Bounded<S>{S(metallic)} * share * (color - one);
}
/// Bounds Fresnel's reflectance, see fresnel(). Where it is undecided whether reflection is total it may be all.
template <class S>
STRAHL_INLINE Bounded<S> fresnel_bounds(const S& ior, const Bounded<S>& c) {
    const Bounded<S> one{S(1)}, n{ior, S(unit_error<S>) * abs(ior)}, squared = n * n + c * c - one;
    const Bounded<S> g = root(squared), a = (g - c) / (g + c), b = (c * (g + c) - one) / (c * (g - c) + one);
    const Bounded<S> all = Bounded<S>{S(Element<S>(.5))} * a * a * (b * b + one);
    const Mask<S> told = squared.value > squared.off, total = squared.value < -squared.off;
    return {select(squared.value > S(0), all.value, S(1)),
            select(total, S(0), select(told & (all.off < S(1)), all.off, S(1)))};
}

template <class S>
Mask<S> FinishBounds<S>::known(const World<T>& world, const int* materials) {
    Mask<S> all = first_lanes<S>(0);
    each_finish<S>(world, materials, [&](const FinishKernel<T>& finish, Mask<S> lanes) {
        const LayerKernel<T>& layer = world.finishes.layers[finish.first_layer];
        const PatternKernel<T>& pattern = layer.pattern;
        const bool constant = pattern.form == PatternForm::constant && pattern.stops == 1;
        bool clear = false;
        for (int i = 0; i < pattern.stops; ++i) {
            const ColorStopKernel<T>& stop = world.patterns.stops[pattern.first_stop + i];
            clear |= stop.filter != 0 || stop.transmit != 0;
        }
        const bool simple = finish.layers == 1 && layer.share < 0 && finish.bends == 0 && finish.seen &&
                            finish.mirrored && !finish.behind && !finish.both_sides && finish.fade_per == 0;
        const bool by_angle = layer.fresnel || layer.facing != 1 || layer.gilding != 0;
        const bool smooth = layer.irid == 0 && layer.falloff > 0 && layer.brilliance > 0 && layer.phong_size > 0 &&
                            layer.blinn_size > 0 && !(layer.fresnel && world.nested) &&
                            !(by_angle && world.patterns.bends);
        if (simple && smooth && !pattern.nests && (constant || !clear)) all = all | lanes;
    });
    return all;
}

template <class S>
LayerErrors<S> FinishBounds<S>::of_layers(const World<T>& world, const int* materials, const SeenSurface<S>& seen,
                                          const SeenErrors<S>& off, const LayeredHit<S>& hit) {
    constexpr T u = unit_error<S>;
    LayerErrors<S> all;
    const S c = min(max(-dot(seen.direction, seen.normal), S(0)), S(1)), turn = off.turn + off.normal;
    const Bounded<S> cosine{c, cosine_error(turn, c) + S(4 * u)}, one{S(1)};
    each_finish<S>(world, materials, [&](const FinishKernel<T>& finish, Mask<S> lanes) {
        const LayerKernel<T>& layer = world.finishes.layers[finish.first_layer];
        const ColorStopKernel<T>& stop = world.patterns.stops[layer.pattern.first_stop];
        const S opacity = abs(hit.opacity[0]);
        const T ambient = std::max({std::abs(layer.ambient.x), std::abs(layer.ambient.y), std::abs(layer.ambient.z)});
        const T strongest = std::max({layer.mirror.x, layer.mirror.y, layer.mirror.z}),
                bailout = world.finishes.bailout;
        Bounded<S> share = one, metal{S(0)};
        if (strongest > 0) {
            Bounded<S> x = one;
            if (layer.fresnel)
                x = least_of(fresnel_bounds(select(seen.enters, S(finish.ior), S(1 / finish.ior)), cosine), S(1));
            else if (layer.facing != 1)
                x = power_bounds(one - cosine, layer.falloff);
            share = Bounded<S>{S(1 - layer.facing), S(u)} * x + Bounded<S>{S(layer.facing)};
            if (layer.gilding != 0) metal = metal_bounds(c, turn);
        }
        // The strength by which rays are dropped as too weak.
        const Bounded<S> strength = Bounded<S>{S(strongest)} * (layer.fresnel ? share : one);
        const Mask<S> weak = abs(strength.value - S(bailout)) <= fma(S(1e-6f), S(bailout), strength.off);
        S reflected(0), refracted(0), through_most(0), mirrored_most(0);
        Bounded<S> gray{S(0)};  // by which light that comes through is dropped, see gray_of
        constexpr T grays[3] = {T(.297), T(.589), T(.114)};
        for (int i = 0; i < 3; ++i) {
            const Bounded<S> color{hit.color[0][i], off.color};
            const Bounded<S> tint = layer.gilding != 0 ? tint_bounds(color, layer.gilding, metal) : one;
            const Bounded<S> mirrored = Bounded<S>{S(layer.mirror[i]), S(u * layer.mirror[i])} * share * tint;
            reflected = max(reflected, mirrored.off);
            mirrored_most = max(mirrored_most, abs(mirrored.value) + mirrored.off);
            const T more = stop.transmit + finish.refraction;
            Bounded<S> through = Bounded<S>{S(stop.filter)} * color + Bounded<S>{S(more), S(u * more)};
            if (layer.conserves) through = through * most_of(one - mirrored, S(0));
            gray = gray + Bounded<S>{S(grays[i])} * through;
            through = Bounded<S>{S(finish.clarity)} * through;
            refracted = max(refracted, through.off);
            through_most = max(through_most, abs(through.value) + through.off);
        }
        if (bailout > 0) {
            reflected = select(weak, mirrored_most, reflected);
            const Mask<S> faint = abs(gray.value - S(bailout)) <= fma(S(1e-6f), S(bailout), gray.off);
            refracted = select(faint, through_most, refracted);
        }
        all.ambient = select(lanes, S(ambient) * opacity * (off.color + S(4 * u)), all.ambient);
        all.reflected = select(lanes, reflected, all.reflected);
        all.refracted = select(lanes, refracted, all.refracted);
        all.reflected = all.reflected + select(lanes, S(u * finish.total), S(0));
        all.sent = select(lanes, S(finish.total) + through_most + mirrored_most, all.sent);
    });
    return all;
}

/// Half vectors of a direction that is off by `turn` and of one that is off by `lit.turn` are off by the sum over the
/// length of the vector between both.
template <class S>
Bounded<S> FinishBounds<S>::of_light(const World<T>& world, const int* materials, const LayeredHit<S>& hit,
                                     const LitSurface<S>& lit, const SeenErrors<S>& off, const LitErrors<S>& lit_off) {
    constexpr T u = unit_error<S>;
    const S shine = dot(lit.reflected, lit.l);
    const Vec3<S> between = lit.l - lit.direction;
    const S length = sqrt(dot(between, between)), half = dot(between, lit.normal) / length;
    const S half_turn = (off.turn + lit_off.turn + S(8 * u)) / length + off.normal;
    const Bounded<S> one{S(1)}, cosine{lit.cosine, lit_off.cosine};
    const Bounded<S> mirrored_cosine{shine, cosine_error(lit_off.mirrored, shine) + S(16 * u)};
    const Bounded<S> half_cosine{half, cosine_error(half_turn, half) + S(16 * u)};
    Bounded<S> all{S(0)};
    each_finish<S>(world, materials, [&](const FinishKernel<T>& finish, Mask<S> lanes) {
        const LayerKernel<T>& layer = world.finishes.layers[finish.first_layer];
        const Bounded<S> scattered = Bounded<S>{S(layer.diffuse)} * Bounded<S>{hit.opacity[0], S(4 * u)} *
                                     (layer.brilliance == 1 ? cosine : power_bounds(cosine, layer.brilliance));
        Bounded<S> highlight{S(0)}, metal{S(0)};
        if (lit.highlights && layer.phong > 0)
            highlight = Bounded<S>{S(layer.phong)} * power_bounds(mirrored_cosine, layer.phong_size);
        if (lit.highlights && layer.blinn > 0)
            highlight = highlight + Bounded<S>{S(layer.blinn)} * power_bounds(half_cosine, layer.blinn_size);
        if (layer.metallic != 0) metal = metal_bounds(lit.cosine, off.normal + lit_off.turn);
        for (int c = 0; c < 3; ++c) {
            const Bounded<S> color{hit.color[0][c], off.color};
            const Bounded<S> tint = layer.metallic != 0 ? tint_bounds(color, layer.metallic, metal) : one;
            const Bounded<S> sent = scattered * color + highlight * tint;
            all.value = select(lanes, max(all.value, abs(sent.value)), all.value);
            all.off = select(lanes, max(all.off, sent.off), all.off);
        }
    });
    return all;
}

}  // namespace strahl::inline STRAHL_LEVEL
