#include "scene/follow.h"

#include <algorithm>
#include <cmath>

namespace strahl {
namespace {

/// What a parameter is: a number or a vector.
struct Place {
    double* number = nullptr;
    DVec3* vector = nullptr;
};
Place place(double& number) { return {&number, nullptr}; }
Place place(DVec3& vector) { return {nullptr, &vector}; }
Place place(Pigment& pigment) { return pigment.pattern ? Place{} : place(pigment.color); }
Place place(Relief&) { return {}; }
template <class T>
Place place(std::optional<T>& value) {
    return value ? place(*value) : Place{};
}

template <class Find>
void set(const std::vector<Follow>& follows, const TrackValues& values, const Find& find) {
    for (const Follow& f : follows) {
        const double* const value = values.find(f.track);
        if (!value) continue;
        const Place at = find(f.parameter);
        double* const number = at.vector ? &(*at.vector)[f.component] : at.number;
        if (number) *number = std::clamp(f.factor * *value, f.low, f.high);
    }
}

/// The parameter of this name in a field table.
template <class Struct>
Place field_of(Struct& own, const std::string& name) {
    Place found;
    const auto look = [&](const auto& field) {
        if (name == field.name) found = place(own.*field.member);
    };
    std::apply([&](const auto&... field) { (look(field), ...); }, Struct::fields);
    return found;
}

double safe_factor(double factor) {
    return std::copysign(std::clamp(std::fabs(factor), 1e-4, 1e4), factor);
}

}  // namespace

void follow(Camera& camera, const std::vector<Follow>& follows, const TrackValues& values) {
    Camera now = camera;
    set(follows, values, [&](const std::string& name) {
        return name == "position"      ? place(now.position)
               : name == "look_at"     ? place(now.look_at)
               : name == "up"          ? place(now.up)
               : name == "fov"         ? place(now.fov)
               : name == "aspectratio" ? place(now.aspectratio)
                                       : Place{};
    });
    if (!degenerate(now)) camera = now;
}

void follow(Light& light, const TrackValues& values) {
    const Light declared = light;
    set(light.follows, values, [&](const std::string& name) {
        return name == "position"    ? place(light.position)
               : name == "direction" ? place(light.direction)
               : name == "color"     ? place(light.color)
               : name == "look_at"   ? (light.spot ? place(light.spot->look_at) : Place{})
               : light.spot          ? field_of(*light.spot, name)
                                     : Place{};
    });
    light.follows.clear();
    if (light.direction && *light.direction == DVec3(0)) light.direction = declared.direction;
    if (!light.spot) return;
    if (light.spot->look_at == light.position)
        light.position = declared.position, light.spot->look_at = declared.spot->look_at;
    light.spot->falloff = std::max(light.spot->falloff, light.spot->radius);
}

void follow(Material& material, const TrackValues& values) {
    set(material.follows, values, [&](const std::string& name) { return field_of(material, name); });
    material.follows.clear();
}

void follow(Fog& fog, const TrackValues& values) {
    set(fog.follows, values,
        [&](const std::string& name) { return name == "distance" ? place(fog.distance) : place(fog.color); });
    fog.follows.clear();
}

void follow(Pigment& color, const std::vector<Follow>& follows, const TrackValues& values) {
    set(follows, values, [&](const std::string&) { return place(color); });
}

void follow(MotionKey& key, const TrackValues& values) {
    set(key.follows, values, [&](const std::string& name) {
        return name == "translate" ? place(key.translate) : name == "rotate" ? place(key.rotate) : place(key.scale);
    });
    if (any_follows(key.follows, "scale"))
        for (int c = 0; c < 3; ++c) key.scale[c] = safe_factor(key.scale[c]);
    key.follows.clear();
}

}  // namespace strahl
