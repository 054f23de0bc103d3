// POV-Ray's finishes: layers of colours that let light through, highlights, and reflection. The formulas are those that
// POV-Ray 3.7 follows.
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "num/lane_angles.h"
#include "trace/finish/finish_calls.h"
#include "trace/patterns/pattern_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

/// Calls visit(finish, lanes) for each different material of a pack.
template <class S, class Visit>
STRAHL_INLINE void each_finish(const World<Element<S>>& world, const int* materials, const Visit& visit) {
    using T = Element<S>;
    alignas(64) T numbers[width<S>];
    bool uniform = true;
    for (int k = 0; k < width<S>; ++k)
        numbers[k] = static_cast<T>(materials[k]), uniform &= materials[k] == materials[0];
    if (uniform) return visit(world.finishes.list[materials[0]], first_lanes<S>(width<S>));
    const S number = load_lanes<S>(numbers);
    for (Mask<S> left = first_lanes<S>(width<S>); any(left);) {
        const T own = lane(number, first(left));
        const Mask<S> lanes = left & (number == S(own));
        visit(world.finishes.list[static_cast<int>(own)], lanes);
        left = left & !lanes;
    }
}

/// Returns by how much a metal tints light that meets it at an angle with this cosine: 1 if it comes straight, 0 if it
/// grazes, and more again from behind a bent normal, where F = .014567225 / (a - 1.12)^2 - .011612903 of the angle a in
/// quarter turns is 1.
template <class S>
STRAHL_INLINE S metal_share(const S& cosine) {
    using T = Element<S>;
    const S off = quarter_turns(min(max(cosine, S(-1)), S(1))) - S(T(1.12));
    return S(1) - min(max(S(T(.014567225)) / (off * off) - S(T(.011612903)), S(0)), S(1));
}
/// Returns the colour that light gets from a metal of this colour.
template <class S>
STRAHL_INLINE Vec3<S> tint_of(const Vec3<S>& color, Element<S> metallic, const S& cosine) {
    const S share = S(metallic) * metal_share(cosine);
    Vec3<S> tint;
    for (int c = 0; c < 3; ++c) tint[c] = fma(share, color[c] - S(1), S(1));
    return tint;
}

/// Returns the reflectance of unpolarised light by Fresnel's equations, for a ratio of indices `ior` beyond the surface
/// to before it; 1 for total reflection.
template <class S>
STRAHL_INLINE S fresnel(const S& ior, const S& c) {
    const S squared = fma(ior, ior, fma(c, c, S(-1)));
    const S g = sqrt(max(squared, S(0))), a = (g - c) / (g + c);
    const S b = fma(c, g + c, S(-1)) / fma(c, g - c, S(1));
    return select(squared > S(0), S(Element<S>(.5)) * a * a * fma(b, b, S(1)), S(1));
}

/// Returns the colours that a thin film gives light, see Material; `cosines` is the sum of
/// those of the angles at which it comes and goes.
template <class S>
STRAHL_INLINE Vec3<S> film_colors(const LayerKernel<Element<S>>& layer, const S& cosines) {
    using T = Element<S>;
    constexpr T waves[3] = {T(.7), T(.52), T(.48)};
    Vec3<S> colors;
    for (int c = 0; c < 3; ++c)
        colors[c] = fma(S(layer.irid), cosine_of_turns(S(layer.film / waves[c]) * cosines), S(1));
    return colors;
}

template <class S>
Filtering<S> FinishCalls<S>::look(const World<T>& world, const int* materials, const SeenSurface<S>& seen,
                                  const Footprint<S>* footprint, LayeredHit<S>& hit) {
    Filtering<S> all{S(0), S(-1)};
    const Vec3<S> none = splat<S>(Vec3<T>(0));
    hit.ambient = hit.through = hit.mirrored = none, hit.total = hit.clear = hit.most_mirrored = S(0);
    hit.count = 0;
    const S one(1), zero(0), least(T(world.patterns.bends ? -1 : 0));  // below 0: behind a bent normal
    const S cosine = min(max(-dot(seen.direction, seen.normal), least), one);
    const S away = abs(world.patterns.bends ? seen.mirrored : cosine);
    each_finish<S>(world, materials, [&](const FinishKernel<T>& finish, Mask<S> lanes) {
        Vec3<S> through = splat<S>(Vec3<T>(1)), factor = through, passed = none, ambient = none, mirrored = none;
        S most(0), side = one, total(0);
        const T bailout = world.finishes.bailout;
        const Mask<S> enters =
            finish.always_enters && !world.finishes.enclosed ? first_lanes<S>(width<S>) : seen.enters;
        const int layers = std::min(finish.layers, most_layers);
        for (int& i = hit.count; i < layers; ++i) hit.color[i] = hit.above[i] = none, hit.opacity[i] = S(0);
        Mask<S> open = lanes;    // those whose light is followed to this layer
        S weight(1);             // weight of the rays that the layer reflects
        bool shown = true;       // is the bend of the stack's uppermost layer this one?
        const auto pass = [&] {  // the light that all layers of a stack let through
            const Mask<S> strong = gray_of<S>(through) > S(bailout) * factor.y;
            passed = passed + (bailout > 0 ? select(strong, through, none) : through);
            total = select(strong, total + factor.y, total);
        };
        for (int i = layers; i-- > 0;) {
            const LayerKernel<T>& layer = world.finishes.layers[finish.first_layer + i];
            const auto color_at = [&](const PatternKernel<T>& pattern) {
                ClearColor<S> own;
                const ColorStopKernel<T>& stop = world.patterns.stops[pattern.first_stop];
                if (pattern.form == PatternForm::constant && pattern.stops == 1 && !pattern.nests)
                    return ClearColor<S>{splat<S>(stop.color), S(stop.filter), S(stop.transmit)};
                if (!footprint) return clear_color_at<true>(world, pattern, seen.position, seen.surface);
                const Filtering<S> filtering =
                    filtered_at(world, pattern, seen.position, seen.surface, *footprint, lanes, own);
                const Mask<S> known = lanes & (filtering.length > zero);
                all.length = select(known, max(all.length, filtering.length), all.length);
                all.loose = select(known, max(all.loose, filtering.loose), all.loose);
                all.doubt = select(known, max(all.doubt, filtering.doubt), all.doubt);
                return own;
            };
            if (layer.share >= 0) {
                if (i + 1 < finish.layers && shown) pass();
                side = select(seen.outside, S(layer.outside), S(layer.inside));
                through = factor = scale(side, color_at(world.finishes.shares[layer.share]).color);
                open = lanes, weight = one;
            } else if (i + 1 < finish.layers) {
                weight = gray_of<S>(through) / max(factor.y, S(std::numeric_limits<T>::min()));
                open = open & (weight > S(bailout));
                through = select(open, through, none), factor = select(open, factor, none);
            }
            const bool apart = layer.bend != hit.bend;
            if (layer.share >= 0 || i + 1 == layers) shown = !apart;
            const ClearColor<S> own = color_at(layer.pattern);
            const S filtered = layer.old_opacity ? own.filter * largest(own.color) : own.filter;
            const S opacity = apart ? zero : one - filtered - own.transmit;
            for (int c = 0; c < 3; ++c) {
                hit.color[i][c] = select(lanes, own.color[c], hit.color[i][c]);
                hit.above[i][c] = select(lanes, through[c], hit.above[i][c]);
                ambient[c] = fma(through[c] * opacity * own.color[c], S(layer.ambient[c]), ambient[c]);
            }
            hit.opacity[i] = select(lanes, opacity, hit.opacity[i]);
            if (largest(layer.mirror) > 0 && (!apart || layer.conserves)) {
                S x = one;
                if (layer.fresnel)
                    x = min(fresnel(select(enters, S(finish.ior) / seen.before, seen.beyond / S(finish.ior)), cosine),
                            one);
                else if (layer.facing != 1)
                    x = signed_power(one - cosine, layer.falloff);
                const S share = fma(S(1 - layer.facing), x, S(layer.facing));
                const S strength = side * weight * S(largest(layer.mirror)) * (layer.fresnel ? share : one);
                const Mask<S> sends = apart ? first_lanes<S>(0) : open & (strength >= S(bailout));
                most = select(sends, max(most, strength), most);
                Vec3<S> tint = splat<S>(Vec3<T>(1));
                if (layer.gilding != 0) tint = tint_of(own.color, layer.gilding, cosine);
                Vec3<S> film = splat<S>(Vec3<T>(1));
                if (layer.irid > 0) film = film_colors<S>(layer, abs(cosine) + away);
                for (int c = 0; c < 3; ++c) {
                    const S gray = share * S(layer.mirror[c]);
                    mirrored[c] = select(sends, fma(factor[c] * gray * film[c], tint[c], mirrored[c]), mirrored[c]);
                    if (layer.conserves) through[c] = through[c] * max(one - gray * tint[c], zero);
                }
            }
            const S more = own.transmit + S(i == 0 ? finish.refraction : T(0));
            for (int c = 0; c < 3; ++c) through[c] = through[c] * fma(own.filter, own.color[c], more);
        }
        hit.ambient = select(lanes, ambient, hit.ambient);
        if (shown) pass();
        hit.through = select(lanes, scale(S(finish.clarity), passed), hit.through);
        hit.mirrored = select(lanes, mirrored, hit.mirrored);
        hit.most_mirrored = select(lanes, most, hit.most_mirrored);
        hit.total = select(lanes, S(finish.total) * total, hit.total);
        hit.clear = select(lanes, S(finish.clear ? 1 : 0), hit.clear);
    });
    return all;
}

template <class S>
void FinishCalls<S>::scatter(const World<T>& world, const int* materials, const LayeredHit<S>& hit,
                             const LitSurface<S>& lit, const Vec3<S>& arriving, Vec3<S>& sum) {
    const S zero(0);
    each_finish<S>(world, materials, [&](const FinishKernel<T>& finish, Mask<S> lanes) {
        for (int i = 0; i < std::min(finish.layers, most_layers); ++i) {
            const LayerKernel<T>& layer = world.finishes.layers[finish.first_layer + i];
            if (layer.bend != hit.bend) continue;
            S coefficient(layer.diffuse), highlight(0);
            if (world.finishes.behind && !finish.both_sides)
                coefficient = select(lit.behind, S(layer.behind), coefficient);
            const S diffuse = coefficient * hit.opacity[i] *
                              (layer.brilliance == 1 ? lit.cosine : power_or_zero(lit.cosine, layer.brilliance));
            if (lit.highlights && layer.phong > 0)
                highlight = S(layer.phong) * power_or_zero(dot(lit.reflected, lit.l), layer.phong_size);
            if (lit.highlights && layer.blinn > 0) {
                const Vec3<S> between = lit.l - lit.direction;
                const S half = dot(between, lit.normal) / sqrt(dot(between, between));
                highlight = fma(S(layer.blinn), power_or_zero(half, layer.blinn_size), highlight);
            }
            if (world.finishes.behind && !finish.both_sides) highlight = select(lit.behind, zero, highlight);
            Vec3<S> tint = splat<S>(Vec3<T>(1));
            const Mask<S> shines = lanes & (highlight > zero);
            if (layer.metallic != 0 && any(shines)) tint = tint_of(hit.color[i], layer.metallic, lit.cosine);
            Vec3<S> film = splat<S>(Vec3<T>(1));
            if (layer.irid > 0) film = film_colors<S>(layer, lit.cosine + abs(dot(lit.direction, lit.normal)));
            for (int c = 0; c < 3; ++c) {
                const S sent = film[c] * fma(diffuse, hit.color[i][c], highlight * tint[c]);
                sum[c] = select(lanes, fma(arriving[c] * hit.above[i][c], sent, sum[c]), sum[c]);
            }
        }
    });
}

template <class S>
Vec3<S> FinishCalls<S>::through(const World<T>& world, int material, const Vec3<S>& position, const S& surface,
                                Mask<S> outside) {
    const FinishKernel<T>& finish = world.finishes.list[material];
    Vec3<S> through = splat<S>(Vec3<T>(1)), passed = splat<S>(Vec3<T>(0));
    if (!finish.shadow) return through;
    for (int i = 0; i < finish.layers; ++i) {
        const LayerKernel<T>& layer = world.finishes.layers[finish.first_layer + i];
        const ClearColor<S> own = clear_color_at<true>(world, layer.pattern, position, surface);
        const S filter = own.filter + S(i == 0 ? finish.refraction : T(0));
        for (int c = 0; c < 3; ++c) through[c] = through[c] * fma(filter, own.color[c], own.transmit);
        if (layer.share < 0) continue;
        const Vec3<S> share = color_at(world, world.finishes.shares[layer.share], position, surface);
        passed = passed + scale(select(outside, S(layer.outside), S(layer.inside)), through * share);
        through = splat<S>(Vec3<T>(i + 1 < finish.layers ? 1 : 0));
    }
    return passed + through;
}

template <class S>
void FinishCalls<S>::filter(const World<T>& world, int material, const S& surface, const Ray<S>& ray, const S& t,
                            Mask<S> lanes, Vec3<S>& share) {
    if (none(lanes)) return;
    if (!plain(world, material)) {
        const Vec3<S> kept = through(world, material, fma(t, ray.direction, ray.origin), surface, lanes);
        for (int c = 0; c < 3; ++c) share[c] = select(lanes, min(share[c] * kept[c], S(largest_gain)), share[c]);
        return;
    }
    const PatternKernel<T>& pattern = world.patterns.list[material - world.patterns.first];
    const Vec3<S> color = color_at(world, pattern, fma(t, ray.direction, ray.origin), surface);
    for (int c = 0; c < 3; ++c)
        share[c] = select(lanes, min(share[c] * (S(pattern.refraction) * color[c]), S(largest_gain)), share[c]);
}

template <class S>
Vec3<S> FinishCalls<S>::faded_inside(const World<T>& world, int material, const S& way, Mask<S> lanes) {
    const FinishKernel<T>& finish = world.finishes.list[material];
    if (finish.fade_per == 0) return splat<S>(Vec3<T>(1));
    constexpr T exponential = 1000;  // powers from here on are no powers
    constexpr int log_terms = std::is_same_v<T, float> ? 5 : 12, power_terms = std::is_same_v<T, float> ? 8 : 14;
    const S ways = select(lanes, way * S(finish.fade_per), S(0)), one(1);
    Vec3<S> kept;
    if (finish.fade_power < exponential) {
        // 1 / (1 + x^p), by powers of what is below 1.
        const S below = max(min(ways, one / ways), S(std::numeric_limits<T>::min()));
        const S power = power_by_series<log_terms, power_terms>(below, S(finish.fade_power));
        const S left = select(ways < one, one, power) / (one + power);
        for (int c = 0; c < 3; ++c) kept[c] = fma(S(1 - finish.fade_color[c]), left, S(finish.fade_color[c]));
    } else {
        const S e(T(1 / std::numbers::e));
        for (int c = 0; c < 3; ++c)
            kept[c] = power_by_series<log_terms, power_terms>(e, max(S(1 - finish.fade_color[c]) * ways, S(-80)));
    }
    return kept;
}
template <class S>
Vec3<S> FinishCalls<S>::faded_inside(const World<T>& world, const int* materials, const S& way, Mask<S> inside) {
    Vec3<S> share = splat<S>(Vec3<T>(1));
    each_finish<S>(world, materials, [&](const FinishKernel<T>& finish, Mask<S> lanes) {
        const Mask<S> own = lanes & inside;
        if (finish.fade_per == 0 || none(own)) return;
        share = select(own, faded_inside(world, static_cast<int>(&finish - world.finishes.list), way, own), share);
    });
    return share;
}

template <class S>
Mask<S> FinishCalls<S>::bent(const World<T>& world, const int* materials, int bend, const Vec3<S>& position,
                             const S& surface, const Vec3<S>& flat, Vec3<S>& normal) {
    Mask<S> all = first_lanes<S>(0);
    each_finish<S>(world, materials, [&](const FinishKernel<T>& finish, Mask<S> lanes) {
        if (bend > finish.bends) return;
        const BumpKernel<T>& bump = world.finishes.bends[finish.first_bend + bend - 1].bump;
        normal = select(lanes, bent_by(world, bump, position, surface, flat, flat), normal);
        all = all | lanes;
    });
    return all;
}

template <class S>
Mask<S> FinishCalls<S>::lit_behind(const World<T>& world, const int* materials) {
    Mask<S> all = first_lanes<S>(0);
    each_finish<S>(world, materials, [&](const FinishKernel<T>& finish, Mask<S> lanes) {
        if (finish.both_sides || finish.behind) all = all | lanes;
    });
    return all;
}

template <class S>
Mask<S> FinishCalls<S>::lit_by(const World<T>& world, const int* materials, std::int32_t group) {
    Mask<S> all = first_lanes<S>(0);
    each_finish<S>(world, materials, [&](const FinishKernel<T>& finish, Mask<S> lanes) {
        if (group == 0 ? finish.common : finish.group == group) all = all | lanes;
    });
    return all;
}

template <class S>
Mask<S> FinishCalls<S>::hidden(const World<T>& world, const int* materials, const S& mirrored) {
    Mask<S> all = first_lanes<S>(0);
    each_finish<S>(world, materials, [&](const FinishKernel<T>& finish, Mask<S> lanes) {
        if (!finish.seen) all = all | (lanes & !(mirrored > S(0)));
        if (!finish.mirrored) all = all | (lanes & (mirrored > S(0)));
    });
    return all;
}

}  // namespace strahl::inline STRAHL_LEVEL
