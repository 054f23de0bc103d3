// The code of error bounds of normals that reliefs bend. scene/pattern.h defines the reliefs.
#pragma once
#include "trace/proof/pattern_bounds_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

/// Bounds the error of v brought to length 1, of a v that is off by `off`: at most twice `off` over the sum of both
/// lengths. Infinite where that is not small.
template <class S>
STRAHL_INLINE S unit_error_of(const Vec3<S>& v, const S& off) {
    const S length = sqrt(dot(v, v));
    const S error = fma(S(Element<S>(1.01)) / length, off, S(4 * unit_error<S>));
    return select(off < S(Element<S>(.01)) * length, error, S(std::numeric_limits<Element<S>>::infinity()));
}

/// Bounds the error of a normal that a bump bends. With L = |C^T n|, C being the columns of the pattern's space, the
/// bent normal is n + L sum v_i b_i before it is brought to length 1. As the longest column has a length of 1, L is off
/// by at most sqrt(3) times the error of the normal, and by the errors of the columns. A value v_i is off by the error
/// of its place times how steep values are there. Roundings: L has 3 u, each sum and product 1/2 of what there is, of
/// v_i b_i at most.
template <class S>
[[gnu::noinline]] S bent_error(const BumpKernel<Element<S>>& bump, const OffPlace<S>& place, const Vec3<S>& normal,
                               const S& normal_off) {
    using T = Element<S>;
    constexpr T u = unit_error<S>;
    Vec3<S> own, sum = splat<S>(Vec3<T>(0));
    for (int c = 0; c < 3; ++c) own[c] = dot(splat<S>(bump.columns[c]), normal);
    S values(0), values_off(0), bends(0), bends_off(0);  // sums, plain and weighted by the lengths of bends
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

/// The directions along which u and v grow, and their error bounds. `told` where it is certain whether the picture is
/// mirrored.
template <class S>
struct OffTangents {
    Tangents<S> along;
    S u_off, v_off;
    Mask<S> told;
};
/// Bounds the errors of a map's directions in space. The columns they are made of have lengths of at most 1.
template <class S>
STRAHL_INLINE OffTangents<S> off_tangents(const NormalMapKernel<Element<S>>& map, const OffPlace<S>& place) {
    using T = Element<S>;
    const S columns(map.slack.columns + 6 * unit_error<S>);
    const auto& [p, off] = place;
    const S across = abs(p.x) + abs(p.y), across_off = off.x + off.y;
    const Mask<S> told = first_lanes<S>(width<S>);
    if (map.pattern.image.map == ImageMap::planar) return {tangents(map, p), columns, columns, told};
    const S around = S(T(1.01)) * fma(across, columns, across_off);
    if (map.pattern.image.map == ImageMap::cylindrical) return {tangents(map, p), around, columns, told};
    const S squared = across * across, up = abs(p.z) + off.z;
    const S upwards = S(T(1.01)) * (across_off * (S(2) * across + across_off + up) + off.z * across +
                                    columns * (squared + up * across));
    return {tangents(map, p), around, upwards, told};
}
/// Bounds the errors of directions by uv, whose parts along the normal are removed: they consist of sides of a
/// triangle, both of whose ends have the errors of corners, times how much further they are in the picture. Roundings:
/// sides and what is further 1/2 u each, products and sums 2, the part without the normal 6.
template <class S>
[[gnu::noinline]] OffTangents<S> off_tangents(const PlacedTriangles<S>& t, const Vec3<S>& normal, const S& normal_off,
                                              const Slack<Element<S>>& slack) {
    using T = Element<S>;
    constexpr T u = unit_error<S>;
    const S e_long = sqrt(dot(t.e, t.e)), f_long = sqrt(dot(t.f, t.f));
    const S corner = S(T(1.01) * slack.share) * (S(3) * norm1(t.corner) + norm1(t.e) + norm1(t.f));
    const auto off = [&](int j) {
        const S e = abs(t.on_e[j]), f = abs(t.on_f[j]);
        return fma(S(T(2.02)) * corner, e + f, fma(f, e_long, e * f_long) * fma(S(T(2.01)), normal_off, S(10 * u)));
    };
    const S one = t.on_e[0] * t.on_f[1], other = t.on_e[1] * t.on_f[0];
    return {tangents(t, normal), off(1), off(0), Mask<S>(abs(one - other) > S(4 * u) * (abs(one) + abs(other)))};
}
/// Bounds the errors of a map's directions by uv. Its columns must have no part along the normal.
template <class S>
STRAHL_INLINE OffTangents<S> off_tangents(const NormalMapKernel<Element<S>>& map, const OffTangents<S>& own) {
    using T = Element<S>;
    const auto& [u, v] = own.along;
    const S columns(map.slack.columns + 4 * unit_error<S>);
    const S both = sqrt(dot(u, u)) + sqrt(dot(v, v)) + own.u_off + own.v_off;
    const auto way = [&](const Vec3<T>& c) { return fma(S(c.x), u, scale(S(c.y), v)); };
    const auto off = [&](const Vec3<T>& c) {
        return S(T(1.01)) * fma(S(std::abs(c.x)), own.u_off, fma(S(std::abs(c.y)), own.v_off, columns * both));
    };
    const auto& [x, y, z] = map.columns;
    const bool flat = x.z == 0 && y.z == 0;
    return {{way(x), way(y)}, off(x), off(y), Mask<S>(own.told & first_lanes<S>(flat ? width<S> : 0))};
}
/// Bounds the error of a normal that a map bends. x is the direction of u without its part along the normal, y = n x x,
/// on the side where v grows, and n stays. It must be certain whether u grows along the surface, and on which side v
/// does if it does. Roundings: u has 6 of its length without the normal, x 4 u, y 2 u, products and sums of the colours
/// 6 of the largest.
template <class S>
[[gnu::noinline]] S bent_error(const NormalMapKernel<Element<S>>& map, const OffPlace<S>& place,
                               const OffTangents<S>& off_along, const Vec3<S>& normal, const S& normal_off) {
    using T = Element<S>;
    constexpr T u = unit_error<S>;
    constexpr T least = static_cast<T>(NormalMap::least_sine);
    const auto length = [](const Vec3<S>& v) { return sqrt(dot(v, v)); };
    const auto& [along, u_off, v_off, mirrored_told] = off_along;
    const S u_long = length(along.u) + u_off, v_long = length(along.v) + v_off;
    const Vec3<S> way = fma(-dot(along.u, normal), normal, along.u);
    const S way_off = u_off + u_long * fma(S(T(2.01)), normal_off, S(6 * u));
    const Vec3<S> x = scale(S(1) / length(way), way), across = cross(normal, x);
    const S x_off = unit_error_of(way, way_off), across_off = S(T(1.01)) * (normal_off + x_off) + S(4 * u);
    const S side = dot(across, along.v), side_off = fma(across_off + S(4 * u), v_long, v_off);
    const Mask<S> grows = length(way) - way_off > S(T(1.01) * least) * u_long;
    const Mask<S> one_side = (side > side_off) | (side < -fma(S(T(1.01) * least), v_long, side_off));
    const Mask<S> told =
        mirrored_told & grows & (one_side | (abs(side) + side_off < S(T(.99) * least) * (v_long - S(2) * v_off)));
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

/// Bounds the error of a normal that a bump by uv bends. It is made in the space of u, v and the surface's normal, and
/// from its axes x and y, across v and across u, both over the square root of the area that they span, and the normal
/// bent before. Roundings: each of the axes has 6 u, the sum 8 u of what is summed.
template <class S>
[[gnu::noinline]] S bent_error(const BumpKernel<Element<S>>& bump, const OffPlace<S>& place,
                               const OffTangents<S>& off_along, const Vec3<S>& flat, const S& flat_off,
                               const Vec3<S>& normal, const S& normal_off) {
    using T = Element<S>;
    constexpr T u = unit_error<S>;
    const auto length = [](const Vec3<S>& v) { return sqrt(dot(v, v)); };
    const auto& [along, u_off, v_off, told] = off_along;
    const S u_long = length(along.u) + u_off, v_long = length(along.v) + v_off;
    const S area = dot(cross(along.u, along.v), flat), size = abs(area);
    const S area_off = fma(u_off, v_long, fma(v_off, u_long, (flat_off + S(8 * u)) * (u_long * v_long)));
    const Vec3<S> up(S(0), S(0), select(area < S(0), S(-1), S(1))), own = bent_at(bump, place.p, up);
    const S own_off = bent_error(bump, place, up, S(0)), per = S(1) / sqrt(size);
    const Vec3<S> x = scale(per, cross(along.v, flat)), y = scale(per, cross(flat, along.u));
    const S share = fma(S(T(.51)), area_off / size, S(6 * u)), turned = flat_off + S(2 * u);
    const S x_off = S(T(1.01)) * fma(per, fma(v_long, turned, v_off), share * length(x));
    const S y_off = S(T(1.01)) * fma(per, fma(u_long, turned, u_off), share * length(y));
    const S axes = S(1) + length(x) + length(y);
    const S off =
        fma(own_off, axes + x_off + y_off, fma(abs(own.z), normal_off, fma(abs(own.x), x_off, abs(own.y) * y_off)));
    const Vec3<S> sum = fma(own.z, normal, fma(own.x, x, scale(own.y, y)));
    const S error = unit_error_of(sum, fma(S(8 * u), axes, off));
    return select(told & (area_off < S(T(.01)) * size), error, S(std::numeric_limits<T>::infinity()));
}

/// A normal that is off by a thousandth or more counts as unknown.
template <class S>
BentBounds<S> PatternBounds<S>::of_normals(const World<T>& world, const int* materials, const Vec3<S>& position,
                                           const S& surface, const Vec3<S>& normal, const S& normal_off, const S& away,
                                           const Slack<T>& slack) {
    BentBounds<S> all{normal_off, first_lanes<S>(0), first_lanes<S>(0)};
    each_pattern<S>(world, materials, [&](int which, Mask<S> lanes) {
        const auto& [map, bump] = world.patterns.bends[which];
        if (map.flat && bump.flat) return;
        const auto place = [&](const PatternKernel<T>& own) {
            return off_place(world, own, position, surface, away, slack);
        };
        const auto by_uv = [&](const PatternKernel<T>& own) {
            return off_tangents(placed_triangles(world, own.places, surface), normal, normal_off, slack);
        };
        S off = normal_off;
        Vec3<S> bent = normal;
        if (!map.flat) {
            const OffPlace<S> at = place(map.pattern);
            const auto along = map.pattern.by_uv ? off_tangents(map, by_uv(map.pattern)) : off_tangents(map, at);
            off = bent_error(map, at, along, normal, off);
            bent = bent_by(world, map, position, surface, normal);
        }
        if (!bump.flat && bump.pattern.by_uv)
            off = bent_error(bump, place(bump.pattern), by_uv(bump.pattern), normal, normal_off, bent, off);
        else if (!bump.flat)
            off = bent_error(bump, place(bump.pattern), bent, off);
        all.bent = all.bent | lanes, all.off = select(lanes, off, all.off);
        all.told = all.told | (lanes & (off < S(T(1e-3))));
    });
    return all;
}

}  // namespace strahl::inline STRAHL_LEVEL
