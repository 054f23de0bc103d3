// Chooses values within the parser's own bounds.
#include "tests/attack/renderer/wild_materials.h"

#include <type_traits>

#include "tests/referee/random_pattern.h"
#include "text/blocks/bodies.h"

namespace strahl {

/// Returns a pattern of any kind, with any numbers that the parser accepts.
Pattern WildMaterials::pattern() {
    Pattern pattern;
    const auto fill = [&]<class Kind>(Kind kind) {
        const auto fill_field = [&](const auto& field) {
            auto& value = kind.*field.member;
            const NumberRange bounds = range_of(field.range);
            if constexpr (std::is_same_v<decltype(value), DVec3&>) do
                    for (int c = 0; c < 3; ++c) value[c] = number(bounds);
                while (value == DVec3(0));
            else if (!dice.chance(.3))
                value = bounds.whole ? 1 + dice.upto(9) : usual_or(bounds, 0, 1);
        };
        std::apply([&](const auto&... field) { (fill_field(field), ...); }, Kind::fields);
        if constexpr (std::is_same_v<Kind, ImagePattern>) kind = random_image(dice);
        pattern.kind = kind;
        return two_colored<Kind>;
    };
    const bool two = [&]<class... Kinds>(std::type_identity<std::variant<Kinds...>>) {
        const int wanted = dice.upto(sizeof...(Kinds) - 1);
        int number = 0;
        bool two = false;
        ((number++ == wanted ? void(two = fill(Kinds())) : void()), ...);
        return two;
    }(std::type_identity<PatternKind>{});
    const bool image = std::holds_alternative<ImagePattern>(pattern.kind);
    for (int i = image ? -1 : two ? 1 : dice.upto(4); i >= 0; --i) {
        const double before = pattern.colors.empty() ? 0 : pattern.colors.back().at;
        const double at = dice.chance(.2) ? before : dice.in(before, 1);
        pattern.colors.push_back({two ? 1. - i : at, color()});
    }
    const auto allowed = [&] {
        const glm::dmat4 m = matrix(pattern.transformations);
        return transformations_fault(m).empty();
    };
    for (int i = dice.upto(3); i > 0; --i) pattern.transformations.push_back(step());
    while (!allowed()) pattern.transformations.pop_back();
    return pattern;
}

Material WildMaterials::material() {
    Material m;
    const auto fill = [&](auto& value, const NumberRange& bounds) {
        if constexpr (std::is_same_v<decltype(value), Pigment&>) {
            value = dice.chance(.25) ? Pigment(pattern()) : Pigment(color());
        } else if constexpr (std::is_same_v<decltype(value), Bump&>) {
            if (dice.chance(.2)) value = random_bump(dice);
            if (value.pattern && dice.chance(.3)) value.height = number(not_negative);
        } else if constexpr (std::is_same_v<decltype(value), NormalMap&>) {
            if (dice.chance(.2)) value = random_normal_map(dice);
            if (value.pattern && dice.chance(.3)) value.height = number(not_negative);
        } else if constexpr (std::is_same_v<decltype(value), DVec3&>) {
            if (dice.chance(.1)) value = color();
        } else if (!dice.chance(.3)) {  // the default is a value too
            value = dice.chance(.3) ? dice.upto(1) : usual_or(bounds, 0, 1);
            if (!bounds.contains(value)) value = 1;
        }
    };
    std::apply([&](const auto&... field) { (fill(m.*field.member, range_of(field.range)), ...); }, Material::fields);
    // The referee has only the article's terms.
    m.blinn = m.metallic = m.fresnel = m.gilding = 0, m.brilliance = m.facing = m.shadow = 1;
    m.glow = m.mirror = Color(1);
    m.behind = m.both_sides = m.irid = 0, m.clarity = 1, m.share = Pigment(Color(1));
    m.outside = m.inside = m.common = 1, m.group = m.old_opacity = 0;
    m.conserve = m.fade_distance = 0, m.fade_power = m.seen = m.mirrored = 1, m.fade_color = Color(0);
    if (dice.chance(.5)) m.refraction = 0;
    m.pow = usual_or(not_negative, 0, 80);
    m.ior = dice.chance(.3) ? 1 : usual_or(positive, .5, 2.5);
    return m;
}

Transformation WildMaterials::step() {
    switch (dice.upto(3)) {
        case 0:
            return Rotate{{90. * dice.upto(3), 90. * dice.upto(3), 90. * dice.upto(3)}};
        case 1: {
            const double x = number(anything), y = number(anything);
            return Rotate{{x, y, number(anything)}};
        }
        case 2:
            return Translate{point()};
        default: {
            DVec3 by{0};
            for (int i = 0; i < 3; ++i) do
                    by[i] = number(anything);
                while (by[i] == 0);
            return Scale{dice.chance(.5) ? DVec3(by.x) : by};
        }
    }
}

}  // namespace strahl
