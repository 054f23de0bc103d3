// Reads the items of a scene, and the right sides of declarations.
#include <algorithm>
#include <array>
#include <cmath>

#include "pov/reading/reader.h"
#include "pov/things/numbers.h"

namespace strahl::pov {

void PovReader::place(std::shared_ptr<const ObjectThing> object) {
    contents.objects.push_back({std::move(object), default_texture});
}

/// Reads global_settings from '{' to '}'.
void PovReader::read_settings(Interpreter& in) {
    in.begin_block();
    while (!in.at('}')) {
        const std::uint16_t code = in.code();
        in.take();
        const TextPlace place = in.last_place();
        switch (code) {
            case word("assumed_gamma"): {
                const bool srgb = in.accept("srgb");
                const double gamma = srgb ? 2.2 : in.read_number();
                if (in.assumed_gamma) break;
                in.assumed_gamma = gamma;
                contents.assumes_srgb = srgb, contents.gamma_place = place;
                break;
            }
            case word("ambient_light"):
                contents.ambient_light = color_of(in.read_color());
                break;
            case word("max_trace_level"):
                contents.max_trace_level = in.read_integer();
                break;
            case word("adc_bailout"):
                contents.adc_bailout = in.read_number();
                break;
            case word("noise_generator"):
                *in.generator_of_functions = in.noise_generator = in.read_integer();
                in.noise_generator_given = true;
                break;
            case word("charset"):
                utf8 = in.at("utf8");
                in.take();
                break;
            case word("irid_wavelength"):
                in.remark(Remark::Kind::approximated, in.last_place(), "irid_wavelength is the usual one");
                in.read_color();
                break;
            case word("hf_gray_16"):
                in.read_flag();
                break;
            case word("number_of_waves"):
                if (in.read_number() != 10)
                    in.remark(Remark::Kind::approximated, in.last_place(), "number_of_waves is the usual one, 10");
                break;
            case word("max_intersections"):
            case word("mm_per_unit"):
                in.read_number();
                break;
            case word("radiosity"):
                contents.radiosity = place;
                in.remark(Remark::Kind::approximated, place, "radiosity: the light between bodies is ambient light");
                in.skip_block();
                break;
            case word("photons"):
                contents.photons = place;
                in.skip_block();
                break;
            case word("subsurface"):
                in.skip_block();
                break;
            default:
                in.misplaced();
        }
        in.skip_comma();
    }
    in.end_block();
}

/// Reads the colour of the background. From version 3.7 on it is before black where it lets light through, but in a
/// picture with alpha, and before that it is never opaque there.
static Color read_background(Interpreter& in, double& opacity) {
    FilterColor own = in.read_color();
    const bool clear = in.version_given() && in.version() >= 3.7;
    const float opaque = clear && !in.options.alpha ? 1 - own.transmit : 1;
    opacity = clear ? std::clamp(1 - decimal(own.transmit), 0., 1.) : 0;
    own.red *= opaque, own.green *= opaque, own.blue *= opaque;
    return color_of(own);
}

/// Reads an item of the scene; reads nothing and returns false if none comes.
bool PovReader::read_item(Interpreter& in) {
    if (auto known = in.accept_thing<ObjectThing>(ValueKind::object)) {
        if (in.at('{')) in.fail("a declared body is placed by object { NAME ... }");
        return place(std::move(known)), true;
    }
    switch (in.code()) {
        case word("camera"):
            in.take();
            contents.camera = read_camera(in);
            return true;
        case word("background"):
            in.take();
            in.form = "background { rgb <red, green, blue> }";
            in.begin_block();
            contents.background = read_background(in, contents.background_opacity);
            in.end_block();
            in.form = "";
            return true;
        case word("global_settings"):
            in.take();
            return read_settings(in), true;
        case word("fog"):
            in.take();
            contents.fogs.push_back(read_fog(in));
            return true;
        case word("sky_sphere"):
            in.take();
            contents.sky = read_sky(in);
            return true;
        case word("light_group"):
            return place(read_light_group(in)), true;
        case word("rainbow"):
        case word("media"): {
            const char* const what = in.at("media") ? "media" : "a rainbow";
            in.take();
            in.remark(Remark::Kind::left_out, in.last_place(), what);
            in.skip_block();
            return true;
        }
        case word("max_trace_level"):
            in.take();
            contents.max_trace_level = in.read_integer();
            return true;
        default:
            break;
    }
    if (auto object = read_object(in)) return place(std::move(object)), true;
    return false;
}

void PovReader::read_all(Interpreter& in) {
    while (!in.at_end())
        if (!read_item(in)) in.expected("a body, a light or a declaration");
    if (!contents.camera)
        in.remark(Remark::Kind::warning, {}, "no camera: POV-Ray's is used, at <0, 0, 0> and looking along z");
}

void PovReader::tell_constants(Interpreter& in) const {
    for (const auto& [place, used] : pattern_functions)
        if (*used) in.remark(Remark::Kind::approximated, place, "a function of a pattern is .5 everywhere");
}

NamedValue PovReader::read_thing(Interpreter& in) {
    const auto value = [](ValueKind kind, auto thing) {
        using Own = std::remove_cvref_t<decltype(thing)>;
        if constexpr (std::is_base_of_v<Thing, Own>)
            return NamedValue{.kind = kind, .thing = std::make_shared<const Own>(std::move(thing))};
        else
            return NamedValue{.kind = kind, .thing = std::move(thing)};
    };
    struct MapWord {
        std::uint16_t code;
        ValueKind kind, level;
    };
    static constexpr std::array maps{
        MapWord{word("color_map"), ValueKind::color_map, ValueKind::none},
        MapWord{word("pigment_map"), ValueKind::pigment_map, ValueKind::pigment},
        MapWord{word("normal_map"), ValueKind::normal_map, ValueKind::normal},
        MapWord{word("texture_map"), ValueKind::texture_map, ValueKind::texture},
        MapWord{word("slope_map"), ValueKind::slope_map, ValueKind::slope_map},
        MapWord{word("density_map"), ValueKind::density_map, ValueKind::none},
    };
    if (const auto map = std::ranges::find(maps, in.code(), &MapWord::code); map != maps.end()) {
        in.take();
        return value(map->kind, read_map(in, map->level));
    }
    switch (in.code()) {
        case value_code: {
            const ValueKind kind = in.kind();
            return kind >= ValueKind::pigment ? in.take_value() : NamedValue{};
        }
        case word("pigment"): {
            in.take();
            PigmentThing pigment = default_texture->layers.back().pigment;
            read_pigment(in, pigment);
            return value(ValueKind::pigment, std::move(pigment));
        }
        case word("normal"): {
            in.take();
            NormalThing normal = default_texture->layers.back().normal;
            read_normal(in, normal);
            return value(ValueKind::normal, std::move(normal));
        }
        case word("finish"): {
            in.take();
            FinishThing finish = default_texture->layers.back().finish;
            read_finish(in, finish);
            return value(ValueKind::finish, std::move(finish));
        }
        case word("texture"): {
            in.take();
            auto texture = read_texture(in);
            while (in.accept_here("texture")) texture = layered(*texture, *read_texture(in));
            return value(ValueKind::texture, std::move(texture));
        }
        case word("material"):
            in.take();
            return value(ValueKind::material, read_material(in));
        case word("interior"): {
            in.take();
            InteriorThing interior;
            read_interior(in, interior);
            return value(ValueKind::interior, std::move(interior));
        }
        case word("media"):
        case word("density"):
        case word("rainbow"): {
            const ValueKind kind = in.at("media")     ? ValueKind::media
                                   : in.at("density") ? ValueKind::density
                                                      : ValueKind::rainbow;
            in.take();
            in.skip_block();
            return value(kind, std::make_shared<Thing>());
        }
        case word("camera"):
            in.take();
            return value(ValueKind::camera, read_camera(in));
        case word("transform"): {
            TransformThing transform;
            read_step(in, transform.steps);
            return value(ValueKind::transform, std::move(transform));
        }
        case word("fog"):
            in.take();
            return value(ValueKind::fog, read_fog(in));
        case word("sky_sphere"):
            in.take();
            return value(ValueKind::sky_sphere, read_sky(in));
        default:
            break;
    }
    if (auto object = read_object(in)) return value(ValueKind::object, std::move(object));
    return {};
}

void PovReader::read_default(Interpreter& in) {
    in.begin_block();
    auto changed = std::make_shared<TextureThing>(*default_texture);
    while (!in.at('}')) {
        if (in.accept("texture"))
            default_texture = read_texture(in), changed = std::make_shared<TextureThing>(*default_texture);
        else if (in.accept("pigment"))
            read_pigment(in, changed->layers.back().pigment);
        else if (in.accept("normal"))
            read_normal(in, changed->layers.back().normal);
        else if (in.accept("finish"))
            read_finish(in, changed->layers.back().finish);
        else if (in.accept("camera"))
            default_camera = read_camera(in);
        else if (in.accept("radiosity"))
            in.skip_block();
        else
            in.expected("'texture', 'pigment', 'normal', 'finish' or 'camera'");
    }
    in.end_block();
    default_texture = std::move(changed);
}

}  // namespace strahl::pov
