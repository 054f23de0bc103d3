// Patterns as colours of random worlds for proofs, skies and fog.
#pragma once
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "scene/scene.h"
#include "tests/proof/bodies.h"
#include "tests/referee/random_pattern.h"

namespace strahl::proof {

/// Decides about colours: bodies stay what they are without.
inline Dice dice_of_paint(std::uint64_t seed) { return Dice(seed ^ 0x2545f4914f6cdd1dull); }

/// Any pattern, in a space of this size around a place.
inline Pigment random_paint(Dice& dice, double size, const DVec3& at) {
    Pattern pattern = random_pattern(dice);
    pattern.transformations.push_back(Scale{DVec3(size)});
    if (dice.chance(.8)) pattern.transformations.push_back(Translate{at});
    return Pigment(std::move(pattern));
}

/// Gives a world of this size around a place patterns and fog.
inline void paint_world(Dice& dice, double size, const DVec3& at, Scene& scene) {
    for (Material& material : scene.materials)
        if (dice.chance(.4)) material.rgb = random_paint(dice, size, at);
    if (dice.chance(.3)) scene.background = random_paint(dice, .3, DVec3(0));
    if (dice.chance(.4)) scene.fog = Fog{size * std::pow(10, dice.in(0, 3)), dice.vector(0, 1)};
}

/// Colours of which the border between two passes through a place, but for rounding.
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
/// A body on whose surface the place is.
inline Shape body_through(Dice& dice, const DVec3& place, const DVec3& way, double size) {
    DVec3 out = dice.direction();
    if (out.x * way.x + out.y * way.y + out.z * way.z > 0) out = -out;
    if (dice.chance(.4)) return Sphere{place - size * out, size};
    return Disc{place, out, size, 0};
}

}  // namespace strahl::proof
