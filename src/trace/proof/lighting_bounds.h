// Error bounds of the light of lights at hits: of its angle and its highlight, of whether it arrives, and of how much
// of it.
#pragma once
#include "trace/kernel/illuminate.h"
#include "trace/proof/ray_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// Bounds the error of the cosine of an angle that is off by a: cos(x + a) - cos x is at most a sin x + a^2 / 2. The
/// given cosine may have 16 units of rounding.
template <class S>
STRAHL_INLINE S cosine_error(const S& a, const S& cosine) {
    return S(1.001) * a * (sqrt(max(fma(-cosine, cosine, S(1)), S(0)) + S(32 * unit_error<S>)) + a);
}

/// Bounds how far the light that a light adds to a hit's light is off: by the angle at which it arrives, by its
/// highlight, and by whether it arrives at all.
///
/// The light's position was rounded once. The vector to it has 2 roundings in direction and, in length, 7/4 u of its
/// square's sum and root, 1 u of its inverse and the product with that; with 9/4 by the normal's length the cosine has
/// a relative error of 5 u, and 3/2 u by the scalar product. A mirrored direction is not brought to length 1 here: 16
/// u. (s + d)^p - s^p is at most s^p (e^x - 1) with x = p d / s, and e^x - 1 <= x + x^2 up to x = 1.79 (a p below 1
/// counts as 1); powers have p roundings. Below `shines_from` all is less than u / 64.
template <class S>
struct LitBounds {
    S cosine, highlight;  // errors of these
    S distance;           // error of this
    Doubt<S> ray;         // of the shadow ray
    Mask<S> doubt;        // lanes in which it is undecided whether the light is on the normal's side
    S strength{0};        // error of the share that arrives where nothing is in its way
    bool known = true;    // false if all of its light has been added to the errors of hits
};
/// Returns the hits that may be on the side of their surface that a light is on: all but those whose cosine is below
/// -1e-3, where normal and direction are known better than that.
template <class S>
STRAHL_INLINE Mask<S> may_face(const HitBounds<S>& known, const Hit<S>& hit, const LightKernel<Element<S>>& light,
                               const Vec3<S>& to_light, const S& facing) {
    const S way = norm1(to_light);
    const S off = S(light.finite) * fma(S(unit_error<S>), norm1(splat<S>(light.position)), known.away);
    return hit.active & !((facing < S(-1e-3f) * way) & (off < S(1e-4f) * way) & (known.normal < S(1e-4f)));
}
template <class S>
STRAHL_INLINE LitBounds<S> bound_lit(const HitBounds<S>& known, const Hit<S>& hit, const LightKernel<Element<S>>& light,
                                     const S& length, const S& cosine, const S& shine, const S& highlight) {
    constexpr auto u = unit_error<S>;
    const MaterialKernel<S>& material = hit.material;
    const Vec3<S> place = splat<S>(light.position);
    const S off = S(light.finite) * fma(S(.51 * u), norm1(place), known.away);
    const Mask<S> near = !(off < S(.25) * length);
    LitBounds<S> lit;
    const S turn = off / (length - off) + S(1.5 * u);
    lit.ray = {known.away, turn};
    lit.distance = select(near, length, off + S(8 * u) * length);
    lit.cosine = cosine_error(known.normal + turn, cosine) + fma(S(5 * u), abs(cosine), S(1.5 * u));
    lit.doubt = near | !(abs(cosine) > lit.cosine);
    lit.highlight = S(0);
    if (none(hit.active & (material.specular > S(0)))) return lit;
    // Far from a highlight x is below .5, for the error of a cosine is less than that of the angle.
    const S angle = turn_reflected(known) + turn;
    const Mask<S> off_it =
        (highlight == S(0)) &
        (max(material.pow, S(1)) * fma(S(1.01), angle + angle * angle, S(17 * u)) < S(.49) * material.shines_from);
    if (none(hit.active & !off_it)) {
        lit.highlight = u * material.specular;
        return lit;
    }
    const S error = cosine_error(angle, shine) + S(16 * u);
    const S base = max(shine, material.shines_from), x = max(material.pow, S(1)) * error / base,
            mild_error = fma(x, x, x) + S(.51 * u) * (material.pow + S(4));
    lit.highlight = select(x < S(.5), fma(mild_error, highlight, u * material.specular), material.specular);
    return lit;
}

/// Takes lights behind the surface itself out of `faces`, whatever the bent normal faces. Where the light's side is not
/// certain it is undecided (`lit.doubt`).
template <class S>
[[gnu::noinline]] void bound_side_of_light(const HitBounds<S>& known, const Vec3<S>& flat, const Vec3<S>& l,
                                           LitBounds<S>& lit, Mask<S>& faces) {
    const S cosine = dot(flat, l), off = cosine_error(known.flat + lit.ray.turn, cosine) + S(8 * unit_error<S>);
    const Mask<S> bent = known.flat >= S(0), told = (lit.ray.turn >= S(0)) & (abs(cosine) > off);
    const Mask<S> behind = bent & told & (cosine < S(0));
    faces = faces & !behind;
    lit.doubt = (lit.doubt | (bent & !told)) & !behind;
}

/// Adds all light of a light of which nothing is known to the errors of hits.
template <class S>
STRAHL_INLINE void add_unknown_light(const ProvedShading<S>& shading, const Hit<S>& hit,
                                     const LightKernel<Element<S>>& light, HitBounds<S>& known) {
    const Element<S> tightness = std::min(light.cone.tightness, light.beam.tightness);
    const Element<S> bright = (light.fade_per > 0 ? 2 : 1) * (tightness < 0 ? Element<S>(1e9f) : 1);
    known.off = fma(S(bright * proving(shading.limits).slack.gain) * most_of(splat<S>(light.color)),
                    largest(hit.material.diffuse) + known.diffuse + hit.material.specular, known.off);
}

/// Bounds the error of what a hit sends back of a light, as a share of the light: by its angles and its colours.
template <class S>
STRAHL_INLINE S light_error(const Hit<S>& hit, const LitBounds<S>& lit, const S& cosine, const HitBounds<S>& known) {
    const S most = largest(hit.material.diffuse) + known.diffuse;
    return fma(most, lit.cosine, fma(known.diffuse, abs(cosine), lit.highlight));
}

/// Bounds the error of the share of its light that a spotlight sends along -l, between 0 and 1.
///
/// If l and the axis a are off by q, x = |l + a|^2 / 2 is off by q |l + a| + q^2 / 2. The axis has 7/2 u; the cosines
/// of the cone's angles, less 1, 4 u; what x has of them, and its own, counts 8 u. Between the angles the share changes
/// monotonically with x, so it is between its values at the ends of x's interval, and exactly 0 beyond the larger
/// angle. The exponent counts as a highlight's does.
template <class S>
[[gnu::noinline]] S spot_error(const SpotKernel<Element<S>>& cone, const Vec3<S>& l, const S& turn) {
    using T = Element<S>;
    constexpr auto u = unit_error<S>;
    const Vec3<S> off = l + splat<S>(cone.axis);
    const S from_axis = dot(off, off) * S(T(.5)), q = turn + S(4 * u), way = S(cone.falloff) - from_axis;
    const T most = cone.radius + cone.falloff;
    const S wrong = fma(S(1.01) * q, sqrt(from_axis + from_axis) + q, S(8 * u) * (from_axis + S(most))) +
                    abs(way) * S(cone.radius < cone.falloff ? 8 * u * most * cone.per : T(0));
    const auto share = [&](const S& at) {
        const S part = min(max(at * S(cone.per), S(0)), S(1));
        return part * part * fma(S(-2), part, S(3));
    };
    S error = share(way + wrong) - share(way - wrong) + S(8 * u);
    if (cone.tightness != 0) {
        const S base = S(1) - from_axis, p(max(cone.tightness, T(1))), x = p * wrong / base;
        const Mask<S> mild = (base > S(1e-3f)) & (x < S(.5));
        error = cone.tightness < 0 ? S(1e9f) : error + select(mild, fma(x, x, x) + S(.51 * u) * (p + S(8)), S(1));
    }
    return select(way + wrong < S(0), S(0), select(error < S(1), error, S(1)));
}
/// Adds the error of a spotlight's share to the errors of hits, times the most light that they may send back of it.
template <class S>
STRAHL_INLINE void add_spot_error(const ProvedShading<S>& shading, const Hit<S>& hit,
                                  const LightKernel<Element<S>>& light, const LitBounds<S>& lit, const Vec3<S>& l,
                                  const S& cosine, const S& highlight, HitBounds<S>& known) {
    const S diffuse = largest(hit.material.diffuse), error = light_error(hit, lit, cosine, known);
    const S most = fma(diffuse, max(cosine, S(0)), highlight) + error, color = most_of(splat<S>(light.color));
    const Mask<S> told = lit.ray.turn >= S(0);
    known.off = fma(S(proving(shading.limits).slack.gain) * color * most,
                    select(told, spot_error(light.cone, l, lit.ray.turn), S(1)), known.off);
}

/// Returns the lanes in which it is undecided how much of a light arrives: also those with a surface in the way that
/// lets light through, where that depends on the side or on the way inside the body.
template <class S>
STRAHL_INLINE Mask<S> in_doubt(const World<Element<S>>& world, const LightBounds<S>& found) {
    const Mask<S> doubt = found.doubt & !found.dark;
    return world.shadow_rays == ShadowRays::whole ? doubt : Mask<S>(doubt | ((found.crossings > S(0)) & !found.dark));
}

/// Returns the share of a light that reaches hits, in the lanes of `faces`. Adds the error of the light to those of the
/// hits.
template <class S>
STRAHL_INLINE Vec3<S> share_proved(const ProvedShading<S>& shading, const Hit<S>& hit, const LitBounds<S>& lit,
                                   const Vec3<S>& l, const S& distance, Mask<S> faces, const S& cosine,
                                   const S& highlight, const Start<S>& start, HitBounds<S>& known) {
    const Ray<S> ray{hit.position, l, hit.surface};
    const Slack<Element<S>>& slack = proving(shading.limits).slack;
    LightBounds<S> found = light_bounds(shading.world, DoubtfulRay<S>{ray, lit.ray}, distance, lit.distance,
                                        faces & known.followed, start, slack);
    Mask<S> doubt = faces & (in_doubt(shading.world, found) | !known.followed);
    Vec3<S> share = select(found.dark, Vec3<S>(S(0), S(0), S(0)), found.share);
    if (any(doubt)) share = select(doubt, visibility(shading.world, ray, distance, doubt, start), share);
    doubt = doubt | (hit.active & lit.doubt);
    const Vec3<S> color = splat<S>(shading.world.lights[start.light].color);
    const S diffuse = largest(hit.material.diffuse), error = light_error(hit, lit, cosine, known);
    const S light = fma(diffuse, abs(cosine), highlight);
    const S rounding = S(unit_error<S>) * found.crossings * light;
    const S certain = select(found.dark, S(0), fma(found.off, light + error, largest(share) * (error + rounding)));
    known.off = known.off + select(doubt, S(slack.gain) * most_of(color) * (light + error),
                                   select(faces, most_of(color) * certain, S(0)));
    return share;
}

}  // namespace strahl::inline STRAHL_LEVEL
