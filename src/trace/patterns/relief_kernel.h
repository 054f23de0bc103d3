// Normals that reliefs bend. scene/pattern.h defines the reliefs.
#pragma once
#include <limits>

#include "scene/pattern.h"
#include "trace/patterns/pattern_value_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns v brought to length 1, or `otherwise` if its length is 0 or not finite.
template <class S>
STRAHL_INLINE Vec3<S> unit_or(const Vec3<S>& v, const Vec3<S>& otherwise) {
    const S squared = dot(v, v), length = sqrt(squared);
    return select((squared > S(0)) & (squared < S(std::numeric_limits<Element<S>>::max())), scale(S(1) / length, v),
                  otherwise);
}

/// Returns the normal as a bump bends it, at a point of the pattern's space; of length 1 or as it was.
template <class S>
[[gnu::noinline]] Vec3<S> bent_at(const BumpKernel<Element<S>>& bump, const Vec3<S>& p, const Vec3<S>& normal) {
    Vec3<S> sum = splat<S>(Vec3<Element<S>>(0)), own;
    for (int c = 0; c < 3; ++c) own[c] = dot(splat<S>(bump.columns[c]), normal);
    if (bump.by_vectors) {
        const auto bend_of = [&](const auto* at) { return solid_bend(*bump.pattern.solid, at[0], at[1]); };
        const Vec3<S> bend = in_double<3>({p, unit_or(own, own)}, bend_of);
        for (int c = 0; c < 3; ++c) sum = fma(bend[c], splat<S>(bump.bends[c]), sum);
        return unit_or(fma(sqrt(dot(own, own)), sum, normal), normal);
    }
    for (int i = 0; i < 4; ++i)
        sum = fma(value_at(bump.pattern, p + splat<S>(bump.steps[i])), splat<S>(bump.bends[i]), sum);
    return unit_or(fma(sqrt(dot(own, own)), sum, normal), normal);
}

/// Returns a normal, which may be bent already, as a bump bends it at a position; of length 1 or as it was. `flat` is
/// the normal of the surface.
template <class S>
Vec3<S> bent_by(const World<Element<S>>& world, const BumpKernel<Element<S>>& bump, const Vec3<S>& position,
                const S& surface, const Vec3<S>& flat, const Vec3<S>& normal) {
    if (!bump.pattern.by_uv) return bent_at(bump, in_space_of(bump.pattern, position), normal);
    if (bump.by_vectors && bump.pattern.solid->function) {  // it knows the directions of the scene
        const Vec3<S> place = place_in(placed_triangles(world, bump.pattern.places, surface), position);
        return bent_at(bump, in_space_of(bump.pattern, place), normal);
    }
    // The space of u, v and the normal is left-handed where the picture is mirrored or seen from behind.
    const PlacedTriangles<S> triangles = placed_triangles(world, bump.pattern.places, surface);
    const Tangents<S> along = tangents(triangles, flat);
    const S area = dot(cross(along.u, along.v), flat), side = select(area < S(0), S(-1), S(1));
    const Vec3<S> own = bent_at(bump, in_space_of(bump.pattern, place_in(triangles, position)), {S(0), S(0), side});
    const Vec3<S> of_u = scale(own.x, cross(along.v, flat)), of_v = scale(own.y, cross(flat, along.u));
    return unit_or(scale(side, fma(own.z, normal, scale(S(1) / sqrt(abs(area)), of_u + of_v))), normal);
}

/// Returns two directions along the surface: that in which u grows, and any on the side where v does.
template <class S>
STRAHL_INLINE Tangents<S> tangents(const NormalMapKernel<Element<S>>& map, const Vec3<S>& p) {
    const Vec3<S> x = splat<S>(map.columns[0]), y = splat<S>(map.columns[1]), z = splat<S>(map.columns[2]);
    if (map.pattern.image.map == ImageMap::planar) return {x, y};
    const Tangents<S> around{fma(p.x, y, scale(-p.y, x)), z};
    if (map.pattern.image.map == ImageMap::cylindrical) return around;
    const Vec3<S> outwards = fma(p.x, x, scale(p.y, y));
    return {around.u, fma(fma(p.x, p.x, p.y * p.y), z, scale(-p.z, outwards))};
}
template <class S>
Vec3<S> bent_by(const World<Element<S>>& world, const NormalMapKernel<Element<S>>& map, const Vec3<S>& position,
                const S& surface, const Vec3<S>& normal) {
    using T = Element<S>;
    const Vec3<S> zero = splat<S>(Vec3<T>(0));
    Vec3<S> p;
    Tangents<S> along;
    if (map.pattern.by_uv) {
        const PlacedTriangles<S> triangles = placed_triangles(world, map.pattern.places, surface);
        const Tangents<S> own = tangents(triangles, normal);
        const auto way = [&](const Vec3<T>& v) { return fma(S(v.x), own.u, scale(S(v.y), own.v)); };
        p = in_space_of(map.pattern, place_in(triangles, position));
        along = {way(map.columns[0]), way(map.columns[1])};
    } else {
        p = in_space_of(map.pattern, position);
        along = tangents(map, p);
    }
    const S least(static_cast<T>(NormalMap::least_sine * NormalMap::least_sine));
    const Vec3<S> way = fma(-dot(along.u, normal), normal, along.u);
    const Vec3<S> x = unit_or(way, zero), across = cross(normal, x);
    const Mask<S> known = (dot(x, x) > S(0)) & (dot(way, way) > least * dot(along.u, along.u));
    const S side = dot(across, along.v);
    const Mask<S> mirrored = (side < S(0)) & (side * side > least * dot(along.v, along.v));
    const Vec3<S> color = image_color(map.pattern.image, p);
    const auto share = [](const S& c) { return fma(S(2), c, S(-1)); };
    const S of_y = select(mirrored, S(-map.height), S(map.height)) * share(color.y);
    const Vec3<S> bent =
        fma(S(map.height) * share(color.x), x, fma(of_y, across, scale(max(share(color.z), S(0)), normal)));
    return select(known, unit_or(bent, normal), normal);
}

}  // namespace strahl::inline STRAHL_LEVEL
