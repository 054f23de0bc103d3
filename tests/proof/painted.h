// Patterns as colours of random worlds for proofs, skies and fog.
#pragma once
#include <cmath>
#include <memory>
#include <utility>

#include "scene/scene.h"
#include "tests/proof/bodies.h"
#include "tests/referee/random_pattern.h"

namespace strahl::proof {

/// Decides about colours: bodies stay what they are without.
inline Dice dice_of_paint(std::uint64_t seed) { return Dice(seed ^ 0x2545f4914f6cdd1dull); }

/// Returns any pattern, in a space of this size around a place.
inline Pigment random_paint(Dice& dice, double size, const DVec3& at) {
    Pattern pattern = random_pattern(dice);
    pattern.transformations.push_back(Scale{DVec3(size)});
    if (dice.chance(.8)) pattern.transformations.push_back(Translate{at});
    return Pigment(std::move(pattern));
}

/// Gives a mesh places and a material a pattern by uv, and as often as `bent` says a normal map and a bump.
inline void paint_by_uv(Dice& dice, Mesh& mesh, Material& material, double bent) {
    MeshData data = *mesh.data;
    const bool apart = dice.chance(.4);
    const double far = dice.chance(.7) ? 2 : std::pow(10, dice.in(0, 4));
    const std::size_t count = apart ? 3 * data.triangles.size() : data.points.size();
    for (std::size_t i = 0; i < count; ++i) data.places.push_back({dice.in(-far, far), dice.in(-far, far)});
    for (int i = 0; apart && i < std::ssize(data.triangles); ++i)
        data.corner_places.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    mesh.data = std::make_shared<const MeshData>(std::move(data));
    Pattern pattern = random_pattern(dice);
    pattern.by_uv = true;
    if (ImagePattern* const image = std::get_if<ImagePattern>(&pattern.kind)) image->map = ImageMap::planar;
    material.rgb = Pigment(std::move(pattern));
    const auto by_uv = [&](auto relief) {
        Pattern own = *relief.pattern;
        own.by_uv = true;
        if (ImagePattern* const image = std::get_if<ImagePattern>(&own.kind)) image->map = ImageMap::planar;
        if (dice.chance(.7)) own.transformations = {Scale{dice.vector(.3, 2)}, Rotate{{0, 0, dice.in(-180, 180)}}};
        relief.pattern = std::make_shared<const Pattern>(std::move(own));
        return relief;
    };
    if (dice.chance(bent)) material.normal = by_uv(random_normal_map(dice));
    if (dice.chance(bent)) material.bump = by_uv(random_bump(dice));
}

/// Bends the normals of a material, in a space of this size around a place.
inline void bend(Dice& dice, double size, const DVec3& at, Material& material) {
    const auto in_space = [&](auto relief) {
        Pattern pattern = *relief.pattern;
        pattern.transformations.push_back(Scale{DVec3(size)});
        if (dice.chance(.8)) pattern.transformations.push_back(Translate{at});
        relief.pattern = std::make_shared<const Pattern>(std::move(pattern));
        return relief;
    };
    const int which = dice.upto(4);
    if (which < 2) material.normal = in_space(random_normal_map(dice));
    if (which > 0) material.bump = in_space(random_bump(dice));
}

/// Gives a world of this size around a place patterns and fog.
inline void paint_world(Dice& dice, double size, const DVec3& at, Scene& scene) {
    for (Material& material : scene.materials)
        if (dice.chance(.4)) material.rgb = random_paint(dice, size, at);
    if (dice.chance(.3)) scene.background = random_paint(dice, .3, DVec3(0));
    if (dice.chance(.4)) scene.fog = Fog{size * std::pow(10, dice.in(0, 3)), dice.vector(0, 1)};
    for (Primitive& primitive : scene.primitives)
        if (Mesh* const mesh = std::get_if<Mesh>(&primitive.shape); mesh && dice.chance(.6))
            paint_by_uv(dice, *mesh, scene.materials[primitive.material], .2);
    if (dice.chance(.3))
        for (Material& material : scene.materials)
            if (dice.chance(.5)) bend(dice, size, at, material);
}

/// Returns colours with a border between two of them that passes through a place, up to rounding.
inline Pigment edge_paint(Dice& dice, double size, const DVec3& at) {
    constexpr double border = 1e-10;
    DVec3 place = -dice.vector(.1, .4);  // in the pattern's space
    const int axis = dice.upto(2), kind = dice.upto(4);
    Pattern pattern{Checker{}, {{0, dice.vector(0, 1)}, {1, dice.vector(0, 1)}}, {}};
    if (kind == 0) place[axis] = -border - dice.upto(3);
    if (kind == 1) {
        pattern.kind = Brick{DVec3(1), .1};
        place[axis] = -border - (dice.chance(.5) ? .1 : 0);
    }
    if (kind == 2) pattern.kind = Gradient{}, place.x = -border;
    if (kind > 2) {  // a jump
        pattern.colors.insert(pattern.colors.begin() + 1, {{.5, pattern.colors[1].color}, {.5, dice.vector(0, 1)}});
        const double turn = dice.in(0, 6);
        pattern.kind = Gradient{}, place.x = .5;
        if (kind == 4 && dice.chance(.5)) {
            Marble marble;
            pattern.kind = marble, place.x = .25;
        } else if (kind == 4) {
            Wood wood;
            pattern.kind = wood, place = {.25 * std::cos(turn), .25 * std::sin(turn), place.z};
        }
    }
    pattern.transformations = {Translate{-place}, Scale{DVec3(size * std::pow(10, dice.in(-.5, 1)))},
                               Rotate{dice.vector(-180, 180)}, Translate{at}};
    return Pigment(std::move(pattern));
}
/// Returns such a pattern by uv, and a mesh of one triangle in whose middle the place is.
inline std::pair<Mesh, Pigment> edge_paint_by_uv(Dice& dice, double size, const DVec3& at) {
    constexpr double border = 1e-10;
    Pattern pattern{Checker{}, {{0, dice.vector(0, 1)}, {1, dice.vector(0, 1)}}, {}, true};
    MeshData::Place place{dice.in(.1, .4), dice.in(.1, .4)};
    const bool brick = dice.chance(.3);
    if (brick) pattern.kind = Brick{DVec3(1), .1};
    if (!brick && dice.chance(.4)) pattern.kind = Gradient{};
    place[std::holds_alternative<Gradient>(pattern.kind) ? 0 : dice.upto(1)] =
        -border - (brick && dice.chance(.5) ? .1 : 0);
    const double angle = dice.in(0, 6), wide = std::pow(10, dice.in(-1, 1));
    const DVec3 a = size * dice.direction(), b = size * dice.direction();
    const MeshData::Place u{wide * std::cos(angle), wide * std::sin(angle)}, v{-dice.in(.2, 2) * u[1], u[0]};
    MeshData data{{at + a, at + b, at - a - b}, {}, {{0, 1, 2}}, {}};
    for (const auto& [x, y] : {std::pair(1, 0), {0, 1}, {-1, -1}})
        data.places.push_back({place[0] + x * u[0] + y * v[0], place[1] + x * u[1] + y * v[1]});
    return {Mesh{std::make_shared<const MeshData>(std::move(data)), ""}, Pigment(std::move(pattern))};
}
/// A body on whose surface the place is.
inline Shape body_through(Dice& dice, const DVec3& place, const DVec3& way, double size) {
    DVec3 out = dice.direction();
    if (out.x * way.x + out.y * way.y + out.z * way.z > 0) out = -out;
    if (dice.chance(.4)) return Sphere{place - size * out, size};
    return Disc{place, out, size, 0};
}

}  // namespace strahl::proof
