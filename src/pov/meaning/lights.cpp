// Makes a scene's lights of POV-Ray's.
#include <algorithm>
#include <cmath>
#include <utility>

#include "num/vec_math.h"
#include "pov/meaning/scene_maker.h"

namespace strahl::pov {
namespace {

/// Returns the rectangle of an area light, with a grid or, in perpendicular edges, without. That of a row of points is
/// hardly wide.
std::optional<Area> area_of(const LightThing& light, const glm::dmat3& m, bool grid, bool mirrored) {
    const auto edge = [&](const DVec3& v, int points) { return points < 2 ? DVec3(0) : mirror(m * v, mirrored); };
    Area area{edge(light.area->u, light.area->columns), edge(light.area->v, light.area->rows)};
    if (grid) area.columns = light.area->columns, area.rows = light.area->rows;
    const auto strip = [](const DVec3& v) {
        constexpr double narrow = 1e-6;
        return narrow * cross_product(std::fabs(v.x) < .5 * length(v) ? DVec3(1, 0, 0) : DVec3(0, 1, 0), v);
    };
    if (!(length(area.u) > 0)) std::swap(area.u, area.v), std::swap(area.columns, area.rows);
    if (!(length(area.u) > 0)) return std::nullopt;
    const DVec3 across = area.v - dot_product(area.u, area.v) / dot_product(area.u, area.u) * area.u;
    const bool longer = length(area.v) > length(area.u), thin = !(length(across) > 1e-6 * length(area.u));
    if (!grid)
        area.v = thin ? strip(area.u) : across;
    else if (!(length(across) > 4e-6 * length(longer ? area.v : area.u)))  // points need no right angles
        area.v = area.v + (area.v == DVec3(0) ? 1. : 4.) * strip(longer ? area.v : area.u);
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
    light.group = around.group;
    if (own.color == DVec3(0)) return;
    const DVec3 target = mirror(transform_point(m, own.point_at), mirrored);
    if (own.fade_distance > 0 && own.fade_power > 0)
        light.fade_distance = own.fade_distance, light.fade_power = own.fade_power;
    light.shadowless = own.shadowless;
    approximated(own.dimmed && !contents.fogs.empty(), "fog does not dim a light");
    const bool as_text = in.options.as_text;
    const double tightness = std::clamp(own.tightness.value_or(0), as_text ? 0 : -1e9, 1e9);
    approximated(as_text && own.sort != LightThing::Sort::point && own.tightness.value_or(0) < 0,
                 "a light that is brighter off its axis, of a tightness below 0, is as bright there");
    if (own.parallel && target != light.position) {
        light.direction = target - light.position;
        light.from = std::exchange(light.position, DVec3(0));
        if (own.sort == LightThing::Sort::cylinder) {
            light.beam = own.falloff.value_or(1), light.core = std::max(own.radius.value_or(.75), 0.);
            light.tightness = tightness;
            if (!(light.beam > 0)) return;
        } else if (own.sort == LightThing::Sort::spot) {
            light.beam = 1e9;  // it has no cone, but does not shine behind its plane
        }
    } else if (own.sort != LightThing::Sort::point && target != light.position) {
        Spot spot{.look_at = target};
        // Angles count by their cosines: a radius of 90 degrees or more leaves no cone, only what is before the light.
        const auto off_axis = [](double degrees) { return std::fabs(std::remainder(degrees, 360)); };
        spot.radius = off_axis(own.radius.value_or(30)), spot.falloff = off_axis(own.falloff.value_or(45));
        spot.tightness = tightness;
        approximated(spot.radius < 90 && spot.falloff > 90, "a spotlight shines at most 90 degrees off its axis");
        spot.radius = std::min(spot.radius, 90.);
        spot.falloff = std::clamp(spot.falloff, spot.radius, 90.);  // light ends at a radius beyond the falloff
        light.spot = spot;
    }
    const bool round = own.area && (own.circular || own.orient) && std::min(own.area->columns, own.area->rows) > 1;
    const bool soft = light.spot || !own.area_illumination;
    const bool grid = own.area && soft && std::max(own.area->columns, own.area->rows) <= 64;
    if (own.area && !light.direction) light.area = area_of(own, glm::dmat3(m), grid, mirrored);
    approximated(own.area && light.direction, "an area_light that is parallel is a point");
    light.soft = light.area && soft;
    approximated(light.area && !grid, "the shadows of an area_light are smooth");
    approximated(light.area && own.area_illumination && light.spot,
                 "a spotlight with area_illumination shines from its middle");
    approximated(light.area && !grid && own.circular, "a circular area_light is a rectangle");
    approximated(light.area && !grid && own.orient, "an area_light that turns to the bodies stays as it is");
    if (light.area && grid) {
        light.circular = round, light.orient = round && own.orient;
        light.mirrored = light.orient && mirrored && !as_text;
        approximated(light.orient && mirrored && as_text,
                     "'orient': the points are off by a thousandth of the light's size");
        light.adaptive = std::clamp(own.adaptive, 0, 100);
        light.jitter = own.jitter;
        if (own.jitter)
            in.remark(Remark::Kind::warning, object.place,
                      "'jitter': its shadows are the mean of POV-Ray's, without grain");
    }
    const double reach =
        std::max({std::fabs(light.position.x), std::fabs(light.position.y), std::fabs(light.position.z)});
    if (!(reach <= 1e9)) {
        light.direction = -light.position, light.position = DVec3(0), light.spot.reset(), light.area.reset(),
        light.beam = 0;
        light.from.reset(), light.soft = light.circular = light.orient = light.mirrored = false,
                            light.adaptive = Light{}.adaptive;
        approximated(true, "a light further away than 1e9 is parallel light");
    }
    light.color = max(min(light.color, Color(1e9)), Color(-1e9));
    scene.lights.push_back(light);
    light_places.push_back(object.place);
}

}  // namespace strahl::pov
