// Lights as hits see them: the way there, and how much of their light arrives.
#pragma once
#include "trace/kernel/faded_light.h"
#include "trace/lights/light_strength.h"

namespace strahl::inline STRAHL_LEVEL {

/// Squares below this lose bits to underflow.
template <class T>
inline constexpr T least_square = std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon();

/// Finds the way to a light so near that the square of the distance underflows. The cosine is 0 if it is not below 2:
/// then the normal is not of length 1, as of a body too small or too large for this kind of number.
template <class S>
[[gnu::noinline]] WayToLight<S> way_to_near_light(const Hit<S>& hit, const Vec3<S>& to_light) {
    const S longest = max(abs(to_light.x), max(abs(to_light.y), abs(to_light.z)));
    const Vec3<S> way(to_light.x / longest, to_light.y / longest, to_light.z / longest);
    const S length = sqrt(dot(way, way));
    const Vec3<S> l = scale(S(1) / length, way);
    const S cosine = dot(hit.normal, l);
    return {l, longest * length, select(cosine < S(2), cosine, S(0))};
}

/// Returns the share of light that is left of an area light, whose shadows alone are soft. Its rays go to the side of
/// `normal` and `flat`, and outside the bodies or inside.
template <class S, class P>
Vec3<S> soft_share(const Shading<S, P>& shading, const Hit<S>& hit, int number, Mask<S> lanes, const S& strength,
                   const Vec3<S>& reflected, const Vec3<S>& normal, const Vec3<S>& flat, Mask<S> outside) {
    using T = Element<S>;
    const auto& world = shading.world;
    constexpr T error = T(1) / 510;
    const LitHits<S> hits{lanes,     outside,     hit.position, normal,     flat,
                          reflected, hit.surface, hit.weight,   strength,   S(0),
                          S(1),      S(1),        hit.bin,      hit.medium, &mediums(shading.workspace)};
    const AreaKernel<T>& area = world.lights[number].rectangle;
    const AreaMeans<S> means = area.columns > 0 && !area.jitter
                                   ? AreaLightCalls<S>::grid_means(world, number, hits, strength, visibility<S>)
                                   : AreaLightCalls<S>::means(world, number, hits, error, visibility<S>);
    shading.counts.shadow += means.rays;
    return means.share;
}

/// Are points with bent normals lit from behind the surface too, unless their body itself is in the way? So it is in
/// POV-Ray's scenes.
template <class T>
bool lights_bent_sides(const World<T>& world) {
    return world.patterns.bends && world.passed_over > 0;
}

/// Finds the way to a light of any kind. Those of the hits in `both` are lit from behind too.
template <class S, class P>
[[gnu::noinline]] LightAt<S> light_at(const Shading<S, P>& shading, const Hit<S>& hit,
                                      const LightKernel<Element<S>>& light, const Vec3<S>& flat, Mask<S> both) {
    using T = Element<S>;
    const auto& world = shading.world;
    const S zero(0);
    const bool through = lights_bent_sides(world);
    const Vec3<S> to_light = fma(S(-light.finite), hit.position, splat<S>(light.position));
    const S squared = dot(to_light, to_light), length = sqrt(squared);
    LightAt<S> at{{scale(S(1) / length, to_light), length * S(light.far), zero}, hit.active, {}, {}, S(1)};
    WayToLight<S>& way = at.way;
    way.cosine = dot(hit.normal, way.l);
    const Mask<S> lost = (squared < S(least_square<T>)) | (way.cosine > S(2));
    if (any(lost)) {
        const WayToLight<S> near = way_to_near_light(hit, to_light);
        way.l = select(lost, near.l, way.l), way.cosine = select(lost, near.cosine, way.cosine);
        way.distance = select(lost, near.distance, way.distance);
    }
    if (light.starts) way.distance = S(light.start) - dot(hit.position, way.l);
    at.behind = both & (way.cosine < zero);
    at.inwards = through ? dot(flat, way.l) < zero : both & (dot(flat, way.l) < zero);
    way.cosine = select(at.behind, -way.cosine, way.cosine);
    at.faces = hit.active & (way.cosine > zero);
    // As in POV-Ray a light without shadows also lights bent normals on the side away from it, and so do those points
    // of a grid that face the surface; and others unless the body itself hides them.
    if (world.patterns.bends && !through && !light.shadowless && light.rectangle.columns == 0)
        at.faces = at.faces & (both | (dot(flat, way.l) > zero));
    if (none(at.faces)) return at;
    if (light.spot) at.strength = spot_share(light.cone, way.l);
    if (light.beam.radius > 0) at.strength = share_of_beam(light.beam, hit.position, way.l, way.distance);
    if (light.fade_per > 0) at.strength = at.strength * faded_share(light, way.distance);
    at.faces = at.faces & (at.strength > zero);
    return at;
}

/// Returns the share of a light that bodies in its way leave. An area light shines from its middle, and only its
/// shadows are soft.
template <class S, class P>
[[gnu::noinline]] Vec3<S> share_at(const Shading<S, P>& shading, const Hit<S>& hit, int number, const LightAt<S>& at,
                                   const Vec3<S>& flat, const Vec3<S>& reflected) {
    const LightKernel<Element<S>>& light = shading.world.lights[number];
    const Vec3<S> whole = splat<S>(Vec3<Element<S>>(1));
    const Mask<S> outside = (hit.outside & !at.inwards) | (at.inwards & !hit.outside);
    // Behind the plane from which parallel light comes nothing is in its way.
    Mask<S> shaded = light.shadowless ? first_lanes<S>(0) : at.faces;
    if (light.starts) shaded = shaded & (at.way.distance > S(0));
    if (none(shaded)) return whole;
    if (light.area)
        return soft_share(shading, hit, number, at.faces, at.strength, reflected,
                          select(at.behind, -hit.normal, hit.normal), select(at.inwards, -flat, flat), outside);
    shading.counts.shadow += count(at.faces);
    const Start<S> start{number, hit.bin, outside, ~BodySet(0), hit.medium, &mediums(shading.workspace)};
    const Ray<S> ray{hit.position, at.way.l, hit.surface};
    return select(shaded, visibility(shading.world, ray, at.way.distance, shaded, start), whole);
}

}  // namespace strahl::inline STRAHL_LEVEL
