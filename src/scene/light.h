// Lights. Their light does not weaken with distance.
#pragma once
#include <optional>
#include <tuple>

#include "scene/field.h"
#include "scene/transformation.h"

namespace strahl {

/// The cone in which a spotlight shines, with POV-Ray's words and falloff: an angle c off its axis, light is multiplied
/// by cos(c)^tightness, and between `radius` and `falloff` by u^2 (3 - 2 u), where u falls from 1 to 0 as cos(c) does.
struct Spot {
    DVec3 look_at{0};
    double radius = 30, falloff = 45;  // half angles in degrees
    double tightness = 0;
    bool operator==(const Spot&) const = default;

    static constexpr auto fields = std::make_tuple(
        Field{"radius", &Spot::radius, "the angle off the axis up to which all its light shines", Range::quarter_turn},
        Field{"falloff", &Spot::falloff, "that from which on none does, not below the radius", Range::quarter_turn},
        Field{"tightness", &Spot::tightness, "exponent by which light weakens off the axis", Range::zero_or_more});
};

/// A point that shines in all directions or, with a spot, in a cone. Or, with a direction, parallel light that shines
/// in it from infinitely far away, and has no position.
struct Light {
    DVec3 position{0};
    Color color{1};
    std::optional<DVec3> direction{};
    std::optional<Spot> spot{};
    std::optional<Motion> motion{};  // of its place, its direction and the point that its spot looks at
    bool operator==(const Light&) const = default;
};

}  // namespace strahl
