// How much of a light arrives at points where nothing is in its way: of spotlights, of beams, and of lights that fade.
#pragma once
#include <cmath>

#include "num/lane_math.h"
#include "num/memory.h"
#include "trace/world/world.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns the share of its light that a spotlight sends along -l. 1 - cosine is computed from the difference of the
/// directions: in a narrow cone, cosines have few digits.
template <class S>
[[gnu::noinline]] S spot_share(const SpotKernel<Element<S>>& cone, const Vec3<S>& l) {
    using T = Element<S>;
    const Vec3<S> off = l + splat<S>(cone.axis);
    const S from_axis = dot(off, off) * S(T(.5)), cosine = S(1) - from_axis;
    const S u = min(max((S(cone.falloff) - from_axis) * S(cone.per), S(0)), S(1));
    S share = select(from_axis > S(cone.radius), u * u * fma(S(-2), u, S(3)), S(1));
    if (cone.tightness != 0) share = share * signed_power(max(cosine, S(0)), cone.tightness);
    return select(cosine > S(0), share, S(0));
}

/// Returns the share of a light that is left after a distance, which is below 0 behind the plane that parallel light
/// starts from: there POV-Ray's formula fades it as well, if the power is 2.
template <class S>
[[gnu::noinline]] S faded_share(const LightKernel<Element<S>>& light, const S& distance) {
    using T = Element<S>;
    constexpr int log_terms = std::is_same_v<T, float> ? 5 : 12, power_terms = std::is_same_v<T, float> ? 8 : 14;
    const S one(1), signed_way = distance * S(light.fade_per), way = max(signed_way, S(0));
    if (light.fade_power == 1) return S(2) / (one + way);
    if (light.fade_power == 2) return S(2) / fma(signed_way, signed_way, one);
    // By powers of what is below 1.
    const S below = max(min(way, one / way), S(std::numeric_limits<T>::min()));
    const S power = power_by_series<log_terms, power_terms>(below, S(light.fade_power));
    return S(2) * select(way < one, one, power) / (one + power);
}

/// Returns the share of a light with a beam at points, in the direction `l` to it and so far from its plane.
template <class S>
[[gnu::noinline]] S share_of_beam(const BeamKernel<Element<S>>& beam, const Vec3<S>& position, const Vec3<S>& l,
                                  const S& distance) {
    const Vec3<S> off = fma(distance, l, position - splat<S>(beam.on_axis));
    const S s = S(1) - sqrt(dot(off, off)) * S(1 / beam.radius), zero(0);
    S share = select((s > zero) & (distance > zero), S(1), zero);
    if (beam.core > 0 && beam.core < beam.radius) {
        const S u = min(max(s * S(beam.radius / (beam.radius - beam.core)), zero), S(1));
        share = share * u * u * fma(S(-2), u, S(3));
    }
    return beam.tightness == 0 ? share : share * power_or_zero(s, beam.tightness);
}

}  // namespace strahl::inline STRAHL_LEVEL
