#include "scene/follow.h"

#include <algorithm>

#include "scene/motion/set_followed.h"

namespace strahl {
namespace {

using strahl::target;
FollowTarget target(Pigment& pigment) { return pigment.pattern ? FollowTarget{} : target(pigment.color); }
FollowTarget target(Relief&) { return {}; }
FollowTarget target(bool&) { return {}; }
template <class T>
FollowTarget target(std::optional<T>& value) {
    return value ? target(*value) : FollowTarget{};
}

/// The parameter of this name in a field table.
template <class Struct>
FollowTarget field_of(Struct& own, const std::string& name) {
    FollowTarget found;
    const auto look = [&](const auto& field) {
        if (name == field.name) found = target(own.*field.member);
    };
    std::apply([&](const auto&... field) { (look(field), ...); }, Struct::fields);
    return found;
}

}  // namespace

void follow(Camera& camera, const std::vector<Follow>& follows, const TrackValues& values) {
    Camera now = camera;
    set_followed(follows, values, [&](const std::string& name) {
        return name == "position"      ? target(now.position)
               : name == "look_at"     ? target(now.look_at)
               : name == "up"          ? target(now.up)
               : name == "fov"         ? target(now.fov)
               : name == "aspectratio" ? target(now.aspectratio)
               : name == "aperture"    ? target(now.aperture)
               : name == "focus"       ? target(now.focus)
               : name == "focus_on"    ? target(now.focus_on)
               : name == "blades"      ? target(now.blades)
               : name == "shutter"     ? target(now.shutter)
               : name == "eyes"        ? target(now.eye_distance)
               : name == "convergence" ? target(now.convergence)
                                       : FollowTarget{};
    });
    if (!degenerate(now)) camera = now;
}

void follow(Light& light, const TrackValues& values) {
    const Light declared = light;
    set_followed(light.follows, values, [&](const std::string& name) {
        if (name == "position") return target(light.position);
        if (name == "direction") return target(light.direction);
        if (name == "color") return target(light.color);
        if (!light.spot) return field_of(light, name);
        if (name == "look_at") return target(light.spot->look_at);
        const FollowTarget of_spot = field_of(*light.spot, name);
        return of_spot.number ? of_spot : field_of(light, name);
    });
    light.follows.clear();
    if (light.direction && *light.direction == DVec3(0)) light.direction = declared.direction;
    if (!light.spot) return;
    if (light.spot->look_at == light.position)
        light.position = declared.position, light.spot->look_at = declared.spot->look_at;
    light.spot->falloff = std::max(light.spot->falloff, light.spot->radius);
}

void follow(Material& material, const TrackValues& values) {
    set_followed(material.follows, values, [&](const std::string& name) { return field_of(material, name); });
    material.follows.clear();
}

void follow(Fog& fog, const TrackValues& values) {
    set_followed(fog.follows, values, [&](const std::string& name) {
        return name == "distance" ? target(fog.distance) : name == "color" ? target(fog.color) : field_of(fog, name);
    });
    fog.follows.clear();
}

void follow(Pigment& color, const std::vector<Follow>& follows, const TrackValues& values) {
    set_followed(follows, values, [&](const std::string&) { return target(color); });
}

}  // namespace strahl
