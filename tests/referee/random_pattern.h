// Random patterns, of moderate numbers.
#pragma once
#include <algorithm>

#include "scene/pattern.h"
#include "tests/referee/dice.h"

namespace strahl {

/// One of every kind, by its place in the list.
inline PatternKind random_pattern_kind(Dice& dice) {
    const auto octaves = [&](auto kind, int most) {
        kind.octaves = 1 + dice.upto(most - 1), kind.omega = dice.in(.2, .8);
        kind.lambda = dice.chance(.5) ? 2 : dice.in(1, 3);
        if constexpr (requires { kind.turbulence; }) kind.turbulence = dice.chance(.2) ? 0 : dice.in(0, 2);
        return kind;
    };
    switch (dice.upto(5)) {
        case 0:
            return Checker{};
        case 1:
            return Gradient{dice.direction()};
        case 2:
            return Brick{dice.vector(1, 6), dice.in(0, .8)};
        case 3:
            return octaves(Noise{}, 4);
        case 4:
            return octaves(Marble{}, 6);
        default:
            return octaves(Wood{}, 6);
    }
}

inline Pattern random_pattern(Dice& dice) {
    Pattern pattern{random_pattern_kind(dice), {}, {}};
    const bool two = std::visit([]<class Kind>(const Kind&) { return two_colored<Kind>; }, pattern.kind);
    const int stops = two ? 2 : 1 + dice.upto(3);
    for (double at = two ? 0 : dice.in(0, .5); static_cast<int>(pattern.colors.size()) < stops;) {
        pattern.colors.push_back({at, dice.vector(0, 1)});
        at = two ? 1 : dice.chance(.1) ? at : std::min(1., at + dice.in(.08, .5));  // or a jump
    }
    const double size = std::holds_alternative<Brick>(pattern.kind) ? .2 : dice.in(.3, 2);
    pattern.transformations.push_back(Scale{DVec3(size)});
    if (dice.chance(.6)) pattern.transformations.push_back(Rotate{dice.vector(-180, 180)});
    if (dice.chance(.4)) pattern.transformations.push_back(Translate{dice.vector(-3, 3)});
    if (dice.chance(.2)) pattern.transformations.push_back(Scale{{dice.in(.5, 2), -dice.in(.5, 2), dice.in(.5, 2)}});
    return pattern;
}

}  // namespace strahl
