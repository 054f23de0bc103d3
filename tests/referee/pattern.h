// The referee's patterns, worked out from what scene/pattern.h says of them.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scene/pattern.h"
#include "tests/referee/space.h"

namespace strahl::referee {

template <class R>
R whole_below(R x) {
    const R low = static_cast<R>(static_cast<std::int64_t>(x));
    return low > x ? low - 1 : low;
}

/// Noise at a point, corner by corner of its cell.
template <class R>
R noise(const Vector<R>& p) {
    const auto permute = [](std::int64_t x) { return (34 * x + 1) * x % 289; };
    const auto mod = [](std::int64_t x) { return (x % 289 + 289) % 289; };
    const auto weight = [](R t) { return t * t * t * (6 * t * t - 15 * t + 10); };
    const R at[3] = {p.x, p.y, p.z};
    std::int64_t cell[3];
    R from[3], sum = 0;
    for (int c = 0; c < 3; ++c) {
        const R low = whole_below(at[c]);
        cell[c] = static_cast<std::int64_t>(low), from[c] = at[c] - low;
    }
    for (int corner = 0; corner < 8; ++corner) {
        std::int64_t hash = 0;
        R share = 1, way[3];
        for (int c = 0; c < 3; ++c) {
            const int up = corner >> c & 1;
            hash = permute(mod(hash + cell[c] + up));
            way[c] = from[c] - up;
            share *= up ? weight(from[c]) : 1 - weight(from[c]);
        }
        const R third = R(1) / 3;
        sum += share * ((hash % 7 - 3) * third * way[0] + (hash / 7 % 7 - 3) * third * way[1] +
                        (R(hash / 49) - R(2.5)) / R(2.5) * way[2]);
    }
    return sum / 2;
}
template <class R>
R octaves(const Octaves& own, const Vector<R>& p) {
    R sum = 0, strength = 1, fineness = 1;
    for (int i = 0; i < own.octaves; ++i, strength *= R(own.omega), fineness *= R(own.lambda))
        sum += strength * noise(fineness * p);
    return sum;
}

/// The angle of (x, y) in turns, from -1/2 to 1/2.
template <class R>
R turns(R x, R y) {
    return angle_of(x, y) / (2 * angle_of(R(-1), R(0)));
}
template <class R>
Vector<R> color_in(const ImagePattern& image, const Vector<R>& p) {
    R u = p.x, v = p.y;
    if (image.map == ImageMap::spherical || image.map == ImageMap::cylindrical)
        u = turns(p.x, p.y), u = u < 0 ? u + 1 : u;
    if (image.map == ImageMap::spherical) v = 2 * turns(root(p.x * p.x + p.y * p.y), p.z) + R(.5);
    if (image.map == ImageMap::cylindrical) v = p.z;
    if (image.once && !(u >= 0 && u < 1 && v >= 0 && v < 1)) return *image.once;
    const Pixels& pixels = *image.pixels;
    const auto at = [&](std::int64_t x, std::int64_t y, int c) {
        const auto within = [&](std::int64_t i, std::int64_t size, ImageWrap wrap) {
            const std::int64_t again = (i % (2 * size) + 2 * size) % (2 * size);
            if (!image.once && wrap == ImageWrap::repeat) return again % size;
            if (!image.once && wrap == ImageWrap::mirror) return std::min(again, 2 * size - 1 - again);
            return std::clamp<std::int64_t>(i, 0, size - 1);
        };
        const std::int64_t pixel =
            within(y, pixels.height, image.wrap[1]) * pixels.width + within(x, pixels.width, image.wrap[0]);
        return R(pixels.values[static_cast<std::size_t>(3 * pixel + c)]);
    };
    const R half = image.sharp ? R(0) : R(.5), x = u * pixels.width - half, y = (1 - v) * pixels.height - half;
    if (image.sharp) {
        const auto i = static_cast<std::int64_t>(whole_below(x)), j = static_cast<std::int64_t>(whole_below(y));
        return {at(i, j, 0), at(i, j, 1), at(i, j, 2)};
    }
    const R left = whole_below(x), top = whole_below(y), right = x - left, down = y - top;
    Vector<R> color;
    for (int c = 0; c < 3; ++c) {
        const auto in_row = [&](R row) {
            const auto i = static_cast<std::int64_t>(left), j = static_cast<std::int64_t>(row);
            return (1 - right) * at(i, j, c) + right * at(i + 1, j, c);
        };
        (c == 0 ? color.x : c == 1 ? color.y : color.z) = (1 - down) * in_row(top) + down * in_row(top + 1);
    }
    return color;
}

/// The value of each kind.
template <class R>
struct ValueAt {
    Vector<R> p;
    static constexpr double border = 1e-10;

    static R fraction(R x) { return x - whole_below(x); }
    static R up_and_down(R x) {
        const R part = fraction(x);
        return part < R(.5) ? 2 * part : 2 - 2 * part;
    }
    R operator()(const Checker&) const {
        std::int64_t sum = 0;
        for (const R x : {p.x, p.y, p.z}) sum += static_cast<std::int64_t>(whole_below(x + R(border)));
        return sum % 2 != 0 ? 1 : 0;
    }
    R operator()(const Brick& brick) const {
        const R mortar = brick.mortar;
        const auto shifted = [&](R x) { return x + R(border) + mortar; };
        const auto in_mortar = [&](R x, R size) { return fraction(x / size) * size <= mortar; };
        const R x = shifted(p.x), y = shifted(p.y), z = shifted(p.z);
        if (in_mortar(y, brick.size.y)) return 0;
        const bool odd = static_cast<std::int64_t>(whole_below(y / R(brick.size.y))) % 2 != 0;
        const R half_x = R(brick.size.x) / 2, half_z = R(brick.size.z) / 2;
        return in_mortar(odd ? x + half_x : x, brick.size.x) || in_mortar(odd ? z : z + half_z, brick.size.z) ? 0 : 1;
    }
    R operator()(const Gradient& gradient) const {
        const R value = fraction(dot(unit(Vector<R>(gradient.axis)), p) + R(border)) - R(border);
        return value > 0 ? value : 0;
    }
    R operator()(const ImagePattern& image) const {
        const Vector<R> color = color_in(image, p);
        return R(brightness[0]) * color.x + R(brightness[1]) * color.y + R(brightness[2]) * color.z;
    }
    R operator()(const Noise& own) const {
        const R value = R(.5) + octaves(own, p);
        return value < 0 ? 0 : value > 1 ? 1 : value;
    }
    R operator()(const Marble& marble) const { return up_and_down(p.x + R(marble.turbulence) * octaves(marble, p)); }
    /// In double, as it is defined. Its values are checked beside POV-Ray's.
    R operator()(const SolidPattern& solid) const {
        return value_at(solid, DVec3(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)));
    }
    R operator()(const Wood& wood) const {
        return up_and_down(root(p.x * p.x + p.y * p.y) + R(wood.turbulence) * octaves(wood, p));
    }
};

/// Makes sRGB-encoded images linear light.
inline void decode(Pigment& pigment, double gamma) {
    const auto* const image = pigment.pattern ? std::get_if<ImagePattern>(&pigment.pattern->kind) : nullptr;
    if (!image) return;
    Pixels pixels = *image->pixels;
    for (float& v : pixels.values) {
        if (!pixels.linear) v = static_cast<float>(v <= .04045 ? v / 12.92 : std::pow((v + .055) / 1.055, 2.4));
        if (gamma != 1) v = static_cast<float>(std::pow(v, 1 / gamma));
    }
    Pattern pattern = *pigment.pattern;
    std::get<ImagePattern>(pattern.kind).pixels = std::make_shared<const Pixels>(std::move(pixels));
    pigment = Pigment(std::move(pattern));
}

template <class R>
struct Paint;

/// The colour of a pigment at a point of its pattern's space.
template <class R>
Vector<R> color_of(const Pigment& pigment, const Vector<R>& p) {
    if (const auto* const image = std::get_if<ImagePattern>(&pigment.pattern->kind)) return color_in(*image, p);
    const R value = std::visit(ValueAt<R>{p}, pigment.pattern->kind);
    const std::vector<ColorStop>& stops = pigment.pattern->colors;
    std::size_t next = 0;
    while (next < stops.size() && value > R(stops[next].at)) ++next;
    const auto own = [&](const ColorStop& stop) {
        return stop.pattern ? Paint<R>(Pigment(*stop.pattern), glm::dmat4(1)).at(p) : Vector<R>(stop.color);
    };
    if (next == 0) return own(stops.front());
    if (next == stops.size()) return own(stops.back());
    const ColorStop &from = stops[next - 1], &to = stops[next];
    const R share = (value - R(from.at)) / (R(to.at) - R(from.at));
    return (1 - share) * own(from) + share * own(to);
}
/// The colour of a pigment at a point of its own space, before the pattern's transformations are undone.
template <class R>
struct Paint {
    Pigment pigment;
    std::array<Vector<R>, 3> rows;
    Vector<R> offset;

    /// `to_world` takes the space of the material into the world.
    Paint(const Pigment& pigment, const glm::dmat4& to_world) : pigment(pigment) {
        if (!pigment.pattern) return;
        const glm::dmat4 own = matrix(pigment.pattern->transformations),
                         m = pigment.pattern->by_uv ? own : to_world * own;
        const Vector<R> a{m[0].x, m[0].y, m[0].z}, b{m[1].x, m[1].y, m[1].z}, c{m[2].x, m[2].y, m[2].z};
        const R scale = R(1) / dot(a, cross(b, c));
        rows = {scale * cross(b, c), scale * cross(c, a), scale * cross(a, b)};
        offset = {m[3].x, m[3].y, m[3].z};
    }
    Vector<R> at(const Vector<R>& point) const {
        if (!pigment.pattern) return pigment.color;
        const Vector<R> moved = point - offset;
        return color_of(pigment, Vector<R>{dot(rows[0], moved), dot(rows[1], moved), dot(rows[2], moved)});
    }
};

/// A normal, bent where it turns towards the eye, by a pattern in this space.
template <class R>
Vector<R> bent(const Bump& bump, const Space<R>& space, const Vector<R>& point, const Vector<R>& normal) {
    const auto& [a, b, c, origin] = space;
    const R volume = dot(a, cross(b, c));
    const Vector<R> x = R(1) / volume * cross(b, c), y = R(1) / volume * cross(c, a), z = R(1) / volume * cross(a, b);
    const Vector<R> moved = point - origin, p{dot(x, moved), dot(y, moved), dot(z, moved)};
    Vector<R> own = unit(Vector<R>{dot(a, normal), dot(b, normal), dot(c, normal)});
    const R step = R(bump.step());
    for (const DVec3& corner : Bump::corners) {
        const R value = std::visit(ValueAt<R>{p + step * Vector<R>(corner)}, bump.pattern->kind);
        own = own - R(bump.height) * value * 3 / (4 * step) * Vector<R>(corner);
    }
    return unit(own.x * x + own.y * y + own.z * z);
}

/// The same by a normal map.
template <class R>
Vector<R> bent(const NormalMap& map, const Space<R>& space, const Vector<R>& point, const Vector<R>& normal) {
    const auto& [a, b, c, origin] = space;
    const R volume = dot(a, cross(b, c));
    const Vector<R> moved = point - origin;
    const Vector<R> p{dot(cross(b, c), moved) / volume, dot(cross(c, a), moved) / volume,
                      dot(cross(a, b), moved) / volume};
    const auto& image = std::get<ImagePattern>(map.pattern->kind);
    const R rho = p.x * p.x + p.y * p.y;
    Vector<R> along_u = a, along_v = b;
    if (image.map != ImageMap::planar) along_u = p.x * b - p.y * a, along_v = c;
    if (image.map == ImageMap::spherical) along_v = rho * c - (p.x * p.z) * a - (p.y * p.z) * b;
    const auto flat = [&](const Vector<R>& v) { return v - dot(v, normal) * normal; };
    const Vector<R> u = flat(along_u), v = flat(along_v), color = color_in(image, p);
    const R least = R(NormalMap::least_sine * NormalMap::least_sine);
    if (!(dot(u, u) > least * dot(along_u, along_u))) return normal;
    const Vector<R> across = cross(normal, unit(u));
    const R up = dot(across, v);
    const bool mirrored = up < 0 && up * up > least * dot(along_v, along_v);
    const R of_x = R(map.height) * (2 * color.x - 1), of_y = R(map.height) * (2 * color.y - 1);
    const R of_z = color.z > R(.5) ? 2 * color.z - 1 : R(0);
    return unit(of_x * unit(u) + (mirrored ? -of_y : of_y) * across + of_z * normal);
}

}  // namespace strahl::referee
