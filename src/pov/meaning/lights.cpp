// Makes a scene's lights of POV-Ray's.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "num/vec_math.h"
#include "pov/meaning/scene_maker.h"

namespace strahl::pov {
namespace {

/// Returns the rectangle or the grid of an area light. Its edges become perpendicular.
std::optional<Area> area_of(const LightThing& light, const glm::dmat3& m, bool mirrored) {
    Area area = *light.area;
    area.u = mirror(m * area.u, mirrored), area.v = mirror(m * area.v, mirrored);
    area.columns = std::clamp(area.columns, 1, 64), area.rows = std::clamp(area.rows, 1, 64);
    const auto across = [](const DVec3& v) {
        return cross_product(std::fabs(v.x) < .5 * length(v) ? DVec3(1, 0, 0) : DVec3(0, 1, 0), v);
    };
    if (!(length(area.u) > 0)) area.columns = 1;
    if (!(length(area.v) > 0)) area.rows = 1;
    if (area.columns == 1 && area.rows == 1) return std::nullopt;
    if (!(length(area.u) > 0)) area.u = across(area.v);
    if (!(length(area.v) > 0)) area.v = across(area.u);
    area.v = area.v - dot_product(area.u, area.v) / dot_product(area.u, area.u) * area.u;
    if (!(length(area.v) > 1e-9 * length(area.u))) return std::nullopt;
    // Drops the number of points if POV-Ray moves them at random or takes only some of many: it then means nothing.
    constexpr int most_points = 36;
    const bool flat = area.columns > 1 && area.rows > 1;
    if (flat && (light.jitter || area.columns * area.rows > most_points)) area.columns = area.rows = 0;
    return area;
}

}  // namespace

void SceneMaker::add_light(const ObjectThing& object, const Around& around) {
    const LightThing& own = *object.light;
    tell_notes(object);
    Steps steps = object.steps;
    append(steps, around.after);
    const glm::dmat4 m = matrix_of(steps);
    const auto approximated = [&](bool applies, const char* text) {
        if (applies) notes.approximated(object.place, text);
    };
    for (const auto& body : object.parts) {
        ObjectThing moved = *body;
        append(moved.steps, object.steps);
        if (moved.texture) append(moved.texture->steps, object.steps);
        add(moved, around);
    }
    Light light{.position = mirror(transform_point(m, own.location), mirrored), .color = own.color};
    if (std::min({own.color.x, own.color.y, own.color.z}) < 0)
        return notes.left_out(object.place, "a light of a negative colour");
    if (own.color == DVec3(0)) return;
    const DVec3 target = mirror(transform_point(m, own.point_at), mirrored);
    if (own.fade_distance > 0 && own.fade_power > 0)
        light.fade_distance = own.fade_distance, light.fade_power = own.fade_power;
    light.shadowless = own.shadowless;
    approximated(own.dimmed && !contents.fogs.empty(), "fog does not dim a light");
    if (own.parallel && target != light.position) {
        light.direction = target - light.position;
        light.position = DVec3(0);
        approximated(own.sort != LightThing::Sort::point, "a parallel light shines everywhere");
    } else if (own.sort != LightThing::Sort::point && target != light.position) {
        Spot spot{.look_at = target};
        const double angle = 180 / std::numbers::pi, distance = length(target - light.position);
        if (own.sort == LightThing::Sort::cylinder) {
            spot.radius = std::atan(own.radius.value_or(.75) / distance) * angle;
            spot.falloff = std::atan(own.falloff.value_or(1) / distance) * angle;
            approximated(true, "a cylinder light is a spotlight");
        } else {
            spot.radius = own.radius.value_or(30), spot.falloff = own.falloff.value_or(45);
            spot.tightness = std::clamp(own.tightness.value_or(0), 0., 1e9);
        }
        approximated(std::max(spot.radius, spot.falloff) > 90, "a spotlight shines at most 90 degrees off its axis");
        spot.falloff = std::clamp(spot.falloff, 0., 90.);
        spot.radius = std::clamp(spot.radius, 0., spot.falloff);
        light.spot = spot;
    }
    if (own.area && !light.direction) light.area = area_of(own, glm::dmat3(m), mirrored);
    approximated(own.area && light.direction, "an area_light that is parallel is a point");
    approximated(light.area.has_value(),
                 "each point of an area_light shines by itself, also where nothing is in its way");
    approximated(light.area && own.circular, "a circular area_light is a rectangle");
    approximated(light.area && own.orient, "an area_light that turns to the bodies stays as it is");
    const double reach =
        std::max({std::fabs(light.position.x), std::fabs(light.position.y), std::fabs(light.position.z)});
    if (!(reach <= 1e9)) {
        light.direction = -light.position, light.position = DVec3(0), light.spot.reset(), light.area.reset();
        approximated(true, "a light further away than 1e9 is parallel light");
    }
    light.color = {std::min(light.color.x, 1e9), std::min(light.color.y, 1e9), std::min(light.color.z, 1e9)};
    if (!light.area || !light.spot) return scene.lights.push_back(light);
    // A rectangle cannot be a spotlight: it is a grid of some.
    if (light.area->columns == 0) light.area->columns = light.area->rows = 4;
    for (Light& point : points_of(std::vector<Light>{light})) {
        point.spot = light.spot;
        scene.lights.push_back(point);
    }
}

}  // namespace strahl::pov
