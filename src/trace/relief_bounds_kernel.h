// By how much normals that reliefs bend may be off. scene/pattern.h says how they bend them.
#pragma once
#include "trace/pattern_bounds_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

/// What a vector v that is off by `off` makes of length 1 is off by no more than twice `off` over the sum of both
/// lengths; where that is not small it may be off by anything.
template <class S>
STRAHL_INLINE S unit_error_of(const Vec3<S>& v, const S& off) {
    const S length = sqrt(dot(v, v));
    const S error = fma(S(Element<S>(1.01)) / length, off, S(4 * unit_error<S>));
    return select(off < S(Element<S>(.01)) * length, error, S(std::numeric_limits<Element<S>>::infinity()));
}

/// With L = |C^T n|, what the columns C of the pattern's space make of the normal, the bent normal is n + L sum v_i b_i
/// before it is brought to length 1. As the longest column has a length of 1, L is off by no more than sqrt(3) times
/// the normal and by the columns. A value v_i is off by what its place is and how steep values are there. Roundings: L
/// has 3 u, each sum and product 1/2 of what there is, of v_i b_i at most.
template <class S>
[[gnu::noinline]] S bent_error(const BumpKernel<Element<S>>& bump, const OffPlace<S>& place, const Vec3<S>& normal,
                               const S& normal_off) {
    using T = Element<S>;
    constexpr T u = unit_error<S>;
    Vec3<S> own, sum = splat<S>(Vec3<T>(0));
    for (int c = 0; c < 3; ++c) own[c] = dot(splat<S>(bump.columns[c]), normal);
    S values(0), values_off(0), bends(0), bends_off(0);  // sums, without and with how long the bends are
    for (int i = 0; i < 4; ++i) {
        OffPlace<S> corner{place.p + splat<S>(bump.steps[i]), {}};
        for (int c = 0; c < 3; ++c) corner.off[c] = place.off[c] + fma(S(u), abs(corner.p[c]), S(bump.slack.steps));
        const bool image = bump.pattern.form == PatternForm::image;
        const S value = value_at(bump.pattern, corner.p), by_image = S(4 * u * bump.pattern.slack.largest);
        const S off =
            image ? fma(S(T(1.01)), image_error(bump.pattern, corner), by_image) : value_error(bump.pattern, corner);
        const T bend = std::sqrt(dot(bump.bends[i], bump.bends[i])) * T(1.001);
        values = values + abs(value), values_off = values_off + off;
        bends = fma(S(bend), abs(value), bends), bends_off = fma(S(bend), off, bends_off);
        sum = fma(value, splat<S>(bump.bends[i]), sum);
    }
    const S length = sqrt(dot(own, own)), length_off = fma(S(T(1.74)), normal_off, S(bump.slack.columns + 4 * u));
    const S sum_off = bends_off + S(bump.slack.bends) * (values + values_off);
    const S off = fma(length_off, sqrt(dot(sum, sum)), fma(length + length_off, sum_off, normal_off));
    return unit_error_of(fma(length, sum, normal), off + S(8 * u) * fma(length, bends, S(1)));
}

/// How far the directions in which u and v grow are off that tangents() has; the columns they are made of have lengths
/// of at most 1.
template <class S>
STRAHL_INLINE Tangents<S> tangents_error(const NormalMapKernel<Element<S>>& map, const OffPlace<S>& place) {
    using T = Element<S>;
    constexpr T u = unit_error<S>;
    const S columns(map.slack.columns + 6 * u);
    const auto& [p, off] = place;
    const S across = abs(p.x) + abs(p.y), across_off = off.x + off.y;
    if (map.pattern.image.map == ImageMap::planar) return {{columns, S(0), S(0)}, {columns, S(0), S(0)}};
    const S around = S(T(1.01)) * fma(across, columns, across_off);
    if (map.pattern.image.map == ImageMap::cylindrical) return {{around, S(0), S(0)}, {columns, S(0), S(0)}};
    const S squared = across * across, up = abs(p.z) + off.z;
    const S upwards = S(T(1.01)) * (across_off * (S(2) * across + across_off + up) + off.z * across +
                                    columns * (squared + up * across));
    return {{around, S(0), S(0)}, {upwards, S(0), S(0)}};
}
/// x is the direction of u without what it has of the normal, y = n x x, on the side where v grows, and n stays.
/// Whether u grows along the surface, and on which side v does if it does, must be certain. Roundings: u has 6 of its
/// length without the normal, x 4 u, y 2 u, products and sums of the colours 6 of the largest.
template <class S>
[[gnu::noinline]] S bent_error(const NormalMapKernel<Element<S>>& map, const OffPlace<S>& place, const Vec3<S>& normal,
                               const S& normal_off) {
    using T = Element<S>;
    constexpr T u = unit_error<S>;
    constexpr T least = static_cast<T>(NormalMap::least_sine);
    const auto length = [](const Vec3<S>& v) { return sqrt(dot(v, v)); };
    const Tangents<S> along = tangents(map, place.p), off = tangents_error(map, place);
    const S u_long = length(along.u) + off.u.x, v_long = length(along.v) + off.v.x;
    const Vec3<S> way = fma(-dot(along.u, normal), normal, along.u);
    const S way_off = off.u.x + u_long * fma(S(T(2.01)), normal_off, S(6 * u));
    const Vec3<S> x = scale(S(1) / length(way), way), across = cross(normal, x);
    const S x_off = unit_error_of(way, way_off), across_off = S(T(1.01)) * (normal_off + x_off) + S(4 * u);
    const S side = dot(across, along.v), side_off = fma(across_off + S(4 * u), v_long, off.v.x);
    const Mask<S> grows = length(way) - way_off > S(T(1.01) * least) * u_long;
    const Mask<S> one_side = (side > side_off) | (side < -fma(S(T(1.01) * least), v_long, side_off));
    const Mask<S> told = grows & (one_side | (abs(side) + side_off < S(T(.99) * least) * (v_long - S(2) * off.v.x)));
    const Vec3<S> color = image_color(map.pattern.image, place.p);
    const S share_off = S(T(2.01)) * image_error(map.pattern, place) + S(4 * u);
    const auto share = [](const S& c) { return fma(S(2), c, S(-1)); };
    const S of_x = S(map.height) * share(color.x), up = max(share(color.z), S(0)), height(std::abs(map.height));
    const S of_y = select(side < -side_off, S(-map.height), S(map.height)) * share(color.y);
    const S most_x = abs(of_x) + height * share_off, most_y = abs(of_y) + height * share_off;
    const S wrong = fma(S(2) * height + S(1), share_off,
                        fma(most_x, x_off, fma(most_y, across_off, (up + share_off) * normal_off))) +
                    S(6 * u) * (most_x + most_y + up);
    const S error = unit_error_of(fma(of_x, x, fma(of_y, across, scale(up, normal))), wrong);
    return select(told, error, S(std::numeric_limits<T>::infinity()));
}

/// Where normals are off by as much as a thousandth, and by uv, nothing is known.
template <class S>
BentBounds<S> PatternBounds<S>::of_normals(const World<T>& world, const int* materials, const Vec3<S>& position,
                                           const S& surface, const Vec3<S>& normal, const S& normal_off,
                                           const S& away) {
    BentBounds<S> all{normal_off, first_lanes<S>(0), first_lanes<S>(0)};
    each_pattern<S>(world, materials, [&](int which, Mask<S> lanes) {
        const BendKernel<T>& own = world.bends[which];
        if (own.map.flat && own.bump.flat) return;
        S off = normal_off;
        Vec3<S> bent = normal;
        if (!own.map.flat) {
            off = bent_error(own.map, off_place(own.map.pattern, position, away), normal, off);
            bent = bent_by(world, own.map, position, surface, normal);
        }
        if (!own.bump.flat) off = bent_error(own.bump, off_place(own.bump.pattern, position, away), bent, off);
        const bool by_uv = (!own.map.flat && own.map.pattern.by_uv) || (!own.bump.flat && own.bump.pattern.by_uv);
        all.bent = all.bent | lanes, all.off = select(lanes, off, all.off);
        all.told = all.told | (lanes & (off < S(T(1e-3))) & first_lanes<S>(by_uv ? 0 : width<S>));
    });
    return all;
}

}  // namespace strahl::inline STRAHL_LEVEL
