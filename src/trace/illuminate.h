// The light that surfaces scatter.
#pragma once
#include "trace/shading.h"

namespace strahl::inline STRAHL_LEVEL {

/// Ks (h.l)^p in the lanes of `glossy`.
template <class S>
STRAHL_INLINE S highlight_of(const Hit<S>& hit, const Vec3<S>& reflected, const Vec3<S>& l, Mask<S> glossy) {
    const MaterialKernel<S>& material = hit.material;
    const S shine = min(max(dot(reflected, l), S(0)), S(1));  // or sharp highlights blow rounding up
    const Mask<S> shines = glossy & (shine > material.shines_from);
    if (none(shines)) return S(0);
    const S power_of_shine = hit.uniform ? power_of_uniform(shine, lane(material.pow, 0)) : power(shine, material.pow);
    return select(shines, material.specular * power_of_shine, S(0));
}

/// Ia Ka Of + sum over lights S Il [Kd Of (n.l) + Ks (h.l)^p]; at `dim` hits without lights that bring no more than
/// `MaterialKernel::scattered`.
template <class S>
STRAHL_INLINE Vec3<S> illumination(const Shading<S>& shading, const Hit<S>& hit, Mask<S> dim) {
    const MaterialKernel<S>& material = hit.material;
    const auto& world = shading.world;
    const S zero(0);
    Vec3<S> sum = material.ambient;
    const Vec3<S> reflected = reflect(hit);
    const S strongest = largest(material.diffuse);
    const Mask<S> glossy = hit.active & (material.specular > zero);
    if (none(glossy | (hit.active & (strongest > zero)))) return sum;
    const S faint = select(dim, S(faint_share) * strongest, zero);
    for (int i = 0; i < world.light_count; ++i) {
        const LightKernel<Element<S>>& light = world.lights[i];
        const Vec3<S> to_light = splat<S>(light.position) - hit.position;
        const S facing = dot(hit.normal, to_light);
        if (none(hit.active & (facing > zero))) continue;
        const S distance = sqrt(dot(to_light, to_light)), inverse = S(1) / distance;
        const Vec3<S> l = scale(inverse, to_light);
        S cosine = facing * inverse;
        S highlight = zero;
        if (any(glossy)) highlight = highlight_of(hit, reflected, l, glossy);
        // Whether anything is between only matters where there is light to lose.
        const Mask<S> faces = hit.active & (cosine > zero) & (fma(strongest, cosine, highlight) > faint);
        if (none(faces)) continue;
        shading.counts.shadow += count(faces);
        const Vec3<S> share =
            visibility(world, Ray<S>{hit.position, l, hit.surface}, distance, faces, {i, hit.bin, hit.outside});
        cosine = select(faces, cosine, zero);  // at the light itself it is NaN
        highlight = select(faces, highlight, zero);
        for (int c = 0; c < 3; ++c)
            sum[c] = fma(share[c] * S(light.color[c]), fma(material.diffuse[c], cosine, highlight), sum[c]);
    }
    return sum;
}

}  // namespace strahl::inline STRAHL_LEVEL
