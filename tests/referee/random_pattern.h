// Random patterns, of moderate numbers.
#pragma once
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include "scene/pattern.h"
#include "tests/referee/dice.h"

namespace strahl {

/// Reads the "file" of a random image: its content is made up from its name, "folder/W-H-NUMBER".
inline Pixels made_up_pixels(const std::string& path) {
    unsigned width = 1, height = 1, number = 0;
    std::sscanf(path.c_str() + path.rfind('/') + 1, "%u-%u-%u", &width, &height, &number);
    width = std::clamp(width, 1u, 8u), height = std::clamp(height, 1u, 8u);
    Dice dice(number);
    Pixels pixels{static_cast<int>(width), static_cast<int>(height), number % 3 == 0, {}};
    for (unsigned i = 0; i < 3 * width * height; ++i) {
        pixels.values.push_back(static_cast<float>(dice.in(0, 1)));
        pixels.largest[static_cast<int>(i % 3)] = std::max<double>(pixels.largest[i % 3], pixels.values.back());
    }
    return pixels;
}
/// Makes an image of any map but uv, for which most bodies lack coordinates.
inline ImagePattern random_image(Dice& dice) {
    ImagePattern image;
    const auto number = [&](int most) { return std::to_string(1 + dice.upto(most)); };
    image.file = number(8) + "-" + number(8) + "-" + number(1000);
    image.pixels = std::make_shared<const Pixels>(made_up_pixels(image.file));
    image.map = static_cast<ImageMap>(dice.upto(2));
    if (dice.chance(.3))
        image.once = dice.vector(0, 1);
    else if (dice.chance(.3))
        for (ImageWrap& wrap : image.wrap) wrap = static_cast<ImageWrap>(dice.upto(2));
    return image;
}

/// Makes one of POV-Ray's own patterns. The usual random scenes have none: they are not averaged, and proofs do not
/// know them.
inline SolidPattern random_solid(Dice& dice) {
    SolidPattern own;
    own.solid = static_cast<Solid>(dice.upto(static_cast<int>(solid_names.size()) - 1));
    if (own.solid == Solid::cells) own.solid = Solid::bozo;  // cells have edges everywhere
    own.axis = dice.direction();
    if (dice.chance(.4)) own.turbulence = dice.vector(0, .6);
    own.octaves = 1 + dice.upto(3), own.wave = dice.upto(4), own.phase = dice.chance(.3) ? dice.in(0, 1) : 0;
    return own;
}

/// Makes a pattern of any kind.
inline PatternKind random_pattern_kind(Dice& dice) {
    const auto octaves = [&](auto kind, int most) {
        kind.octaves = 1 + dice.upto(most - 1), kind.omega = dice.in(.2, .8);
        kind.lambda = dice.chance(.5) ? 2 : dice.in(1, 3);
        if constexpr (requires { kind.turbulence; }) kind.turbulence = dice.chance(.2) ? 0 : dice.in(0, 2);
        return kind;
    };
    switch (dice.upto(6)) {
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
        case 5:
            return octaves(Wood{}, 6);
        default:
            return random_image(dice);
    }
}

inline Pattern random_pattern(Dice& dice) {
    Pattern pattern{random_pattern_kind(dice), {}, {}};
    const bool two = std::visit([]<class Kind>(const Kind&) { return two_colored<Kind>; }, pattern.kind);
    auto* const image = std::get_if<ImagePattern>(&pattern.kind);
    if (image) image->sharp = image->pixels->width % 4 == 0;
    const int stops = image ? 0 : two ? 2 : 1 + dice.upto(3);
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

inline Bump random_bump(Dice& dice) {
    Pattern pattern = random_pattern(dice);
    const auto bends = []<class Kind>(const Kind&) { return can_bend<Kind>; };
    while (!std::visit(bends, pattern.kind)) pattern.kind = random_pattern_kind(dice);
    if (auto* const image = std::get_if<ImagePattern>(&pattern.kind)) image->sharp = false;
    pattern.colors.clear();
    return {std::make_shared<const Pattern>(std::move(pattern)), dice.in(.01, .3)};
}

inline NormalMap random_normal_map(Dice& dice) {
    Pattern pattern = random_pattern(dice);
    pattern.kind = random_image(dice), pattern.colors.clear();
    NormalMap map;
    map.pattern = std::make_shared<const Pattern>(std::move(pattern));
    if (dice.chance(.5)) map.height = dice.in(.1, 3);
    return map;
}

}  // namespace strahl
