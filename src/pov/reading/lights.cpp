// Reads lights.
#include <array>
#include <cmath>

#include "num/vec_math.h"
#include "pov/reading/reader.h"
#include "pov/reading/values.h"
#include "pov/things/numbers.h"

namespace strahl::pov {
namespace {

constexpr std::array light_values{
    value_word<LightThing, &LightThing::radius>("radius"),
    value_word<LightThing, &LightThing::falloff>("falloff"),
    value_word<LightThing, &LightThing::tightness>("tightness"),
    value_word<LightThing, &LightThing::fade_distance>("fade_distance"),
    value_word<LightThing, &LightThing::fade_power>("fade_power"),
    value_word<LightThing, &LightThing::adaptive>("adaptive"),
    value_word<LightThing, &LightThing::jitter>("jitter"),
    value_word<LightThing, &LightThing::circular>("circular"),
    value_word<LightThing, &LightThing::orient>("orient"),
    value_word<LightThing, &LightThing::area_illumination>("area_illumination"),
    value_word<LightThing, &LightThing::dimmed>("media_attenuation"),
};

}  // namespace

/// Reads light_source { ... }, at its word.
std::shared_ptr<const ObjectThing> PovReader::read_light(Interpreter& in) {
    in.take();
    auto object = std::make_shared<ObjectThing>();
    object->kind = ObjectKind::light;
    object->place = in.last_place();
    in.begin_block();
    if (const auto known = in.accept_thing<ObjectThing>(ValueKind::object)) {
        *object = *known;
    } else {
        in.form = "light_source { <place>, colour }";
        LightThing light;
        light.location = in.read_vector();
        in.skip_comma();
        light.color = color_of(in.read_color());
        in.form = "";
        object->light = std::make_shared<LightThing>(light);
    }
    LightThing light = *object->light;
    while (!in.at('}')) {
        if (Steps steps; read_step(in, steps)) {
            append(object->steps, steps);
            continue;
        }
        if (const auto known = in.accept_thing<ObjectThing>(ValueKind::object)) continue;
        if (accept_value(in, light_values, light)) {
            in.skip_comma();
            continue;
        }
        const std::uint16_t code = in.code();
        in.take();
        switch (code) {
            case word("spotlight"):
            case word("cylinder"):
                light.sort = code == word("spotlight") ? LightThing::Sort::spot : LightThing::Sort::cylinder;
                light.parallel |= light.sort == LightThing::Sort::cylinder;
                light.radius = light.falloff = light.tightness = std::nullopt;
                light.shadowless = false;
                break;
            case word("parallel"):
                light.parallel = true;
                break;
            case word("point_at"):
                light.point_at = transform_point(matrix_of(inverse(object->steps)), in.read_vector());
                break;
            case word("shadowless"):  // for POV-Ray a sort of its own: the last word of a sort counts
                light.sort = LightThing::Sort::point, light.shadowless = true;
                break;
            case word("area_light"): {
                Area area;
                area.u = in.read_vector(), in.skip_comma();
                area.v = in.read_vector(), in.skip_comma();
                area.columns = in.read_integer(), in.skip_comma();
                area.rows = in.read_integer();
                light.area = area;
                break;
            }
            case word("media_interaction"):
                in.read_flag();
                break;
            case word("looks_like"):
            case word("projected_through"): {
                const TextPlace place = in.last_place();
                std::vector<std::shared_ptr<const ObjectThing>> all = read_object_block(in);
                auto body = std::make_shared<ObjectThing>();
                while (!all.empty() && read_object_modifier(in, *body)) {
                }
                in.end_block();
                if (code == word("projected_through")) {
                    object->left_out("projected_through: the light shines everywhere");
                } else if (!all.empty()) {
                    body->kind = ObjectKind::unite, body->place = place, body->parts = std::move(all);
                    body->no_shadow = true;
                    transform_object(*body, Steps{Translate{light.location}});
                    object->parts.push_back(std::move(body));
                }
                break;
            }
            case word("photons"):
                in.skip_block();
                break;
            default:
                in.misplaced();
        }
        in.skip_comma();
    }
    in.end_block();
    object->light = std::make_shared<LightThing>(light);
    return object;
}

/// Reads light_group { ... }: its lights shine on its bodies alone, and no others do unless it says so.
std::shared_ptr<const ObjectThing> PovReader::read_light_group(Interpreter& in) {
    in.take();
    auto group = std::make_shared<ObjectThing>();
    group->kind = ObjectKind::unite, group->place = in.last_place(), group->global_lights = false;
    in.begin_block();
    read_parts(in, *group);
    for (;;) {
        if (in.accept("global_lights"))
            group->global_lights = in.read_flag();
        else if (!read_object_modifier(in, *group))
            break;
    }
    in.end_block();
    return group;
}

}  // namespace strahl::pov
