// Lights.
#pragma once
#include <optional>
#include <tuple>
#include <vector>

#include "scene/kinds/field.h"
#include "scene/motion/transformation.h"

namespace strahl {

/// The cone in which a spotlight shines, with POV-Ray's words and falloff: an angle c off its axis, light is multiplied
/// by cos(c)^tightness, and between `radius` and `falloff` by u^2 (3 - 2 u), where u falls from 1 to 0 as cos(c) does.
struct Spot {
    DVec3 look_at{0};
    double radius = 30, falloff = 45;  // half angles in degrees
    double tightness = 0;
    bool operator==(const Spot&) const = default;

    static constexpr auto fields = std::make_tuple(
        Field{"radius", &Spot::radius, "the angle off the axis at which it begins to fade", Range::quarter_turn},
        Field{"falloff", &Spot::falloff, "the angle beyond which there is no light, at least `radius`",
              Range::quarter_turn},
        Field{"tightness", &Spot::tightness, "exponent by which light fades off the axis", Range::zero_or_more});
};

/// A rectangle that shines from all its points, each in all directions, and is not seen itself. With a grid it is that
/// many points instead, the outer ones on its edges.
struct Area {
    DVec3 u{0}, v{0};           // its edges, perpendicular to each other unless it has a grid
    int columns = 0, rows = 0;  // of the grid; 0 if there is none
    bool operator==(const Area&) const = default;
};

/// A point that shines in all directions or, with a spot, in a cone. With a direction: parallel light, which has no
/// position; it comes from infinitely far away or, with `from`, from the plane through that point, behind which bodies
/// cast no shadow. With an area: a rectangle around its position.
struct Light {
    DVec3 position{0};
    Color color{1};
    std::optional<DVec3> direction{};
    std::optional<Spot> spot{};
    std::optional<Area> area{};
    bool shadowless = false;  // it shines through all bodies, and makes no highlights
    /// It shines from its middle, and only its shadows are those of its area, as of POV-Ray's area_light. With a grid
    /// these are means over its points as POV-Ray takes them, by corners of quarters: with `adaptive` quarters are
    /// divided so often, and from then on only if the light of their corners differs. `circular` rounds the grid, and
    /// `orient` turns it towards the points that it lights. With `jitter` the light of each point comes evenly from all
    /// places up to half way to the next points, as much as those points count: the mean over all places.
    bool soft = false, circular = false, orient = false, jitter = false;
    bool mirrored = false;  // said of `orient`: in z, the grid is the mirror image of one. Scene text has no word
    double adaptive = 100;
    std::optional<DVec3> from{};
    /// With `beam` above 0, parallel light from that plane shines only around the axis through `from`: at a distance d
    /// from it, with s = 1 - d / beam, it is multiplied by s^tightness and, beyond a `core` above 0, by
    /// u^2 (3 - 2 u), where u falls from 1 to 0 as s does, as that of POV-Ray's cylinders.
    double beam = 0, core = 0, tightness = 0;
    /// With both above 0 its light is multiplied by 2 / (1 + (distance / fade_distance)^fade_power), as in POV-Ray.
    double fade_distance = 0, fade_power = 0;
    double group = 0;                // it shines only on bodies of this group, see Material, unless it is 0
    std::optional<Motion> motion{};  // of its position, direction, edges, and the point that its spot looks at
    std::vector<Follow> follows{};   // numbers of it and its spot that follow tracks
    bool operator==(const Light&) const = default;
    bool fades() const { return fade_distance > 0 && fade_power > 0 && (!direction || from); }
    /// Does it take light away?
    bool darkens() const { return color.x < 0 || color.y < 0 || color.z < 0; }

    /// Parameters that each have one value, besides `position`, `direction`, `from` and `color`.
    static constexpr auto fields = std::make_tuple(
        Field{"shadowless", &Light::shadowless, "it shines through all bodies, without highlights", Range::any,
              Given::optional, "shadows"},
        Field{"soft", &Light::soft, "light comes from the centre; the size only blurs shadows", Range::any,
              Given::optional, "hard shadows"},
        Field{"adaptive", &Light::adaptive,
              "levels of the `grid` of a `soft` light that are always subdivided; after that only at shadow edges",
              Range::levels, Given::optional, "all its points shine"},
        Field{"circular", &Light::circular, "makes that grid round", Range::any, Given::optional, "it is square"},
        Field{"orient", &Light::orient, "turns that grid towards each point that it lights", Range::any,
              Given::optional, "it stays as it is"},
        Field{"jitter", &Light::jitter, "spreads the points of that grid evenly up to half way to the next", Range::any,
              Given::optional, "they are points"},
        Field{"beam", &Light::beam,
              "the distance from its axis, through `from`, beyond which parallel light does not shine", Range::length,
              Given::optional, "it is as wide as the plane"},
        Field{"core", &Light::core, "the distance from that axis at which it begins to fade", Range::length,
              Given::optional, "it does not fade"},
        Field{"tightness", &Light::tightness, "exponent by which the light of a `beam` fades off its axis",
              Range::zero_or_more, Given::optional, "`0`"},
        Field{"fade_distance", &Light::fade_distance,
              "the distance at which it is as strong as `color`; 0: it does not fade", Range::zero_or_more},
        Field{"fade_power", &Light::fade_power,
              "light is multiplied by 2 / (1 + (distance / `fade_distance`)^`fade_power`)", Range::zero_or_more},
        Field{"group", &Light::group, "it shines only on bodies whose material has the same `group`; 0: on all",
              Range::zero_or_more});
};

/// The number of lights that the tracer makes of one.
inline std::size_t points_of(const Light& light) {
    const bool grid = light.area && light.area->columns > 0 && !light.soft;
    return grid ? std::size_t(light.area->columns) * light.area->rows : 1;
}
/// Returns the lights with grids that are not soft replaced by the points that they consist of, row by row.
inline std::vector<Light> points_of(const std::vector<Light>& lights) {
    std::vector<Light> all;
    for (const Light& light : lights) {
        if (!light.area || light.area->columns == 0 || light.soft) {
            all.push_back(light);
            continue;
        }
        const auto [u, v, columns, rows] = *light.area;
        const auto offset = [](int i, int count) { return count > 1 ? double(i) / (count - 1) - .5 : 0; };
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                Light& own = all.emplace_back(light);
                own.position = light.position + offset(i, columns) * u + offset(j, rows) * v;
                own.color = light.color / (double(columns) * rows), own.area.reset(), own.follows.clear();
            }
    }
    return all;
}

}  // namespace strahl
