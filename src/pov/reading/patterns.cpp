// Reads patterns, their modifiers and their maps, which are alike in pigments, normals and textures.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "num/vec_math.h"
#include "pov/reading/reader.h"
#include "pov/reading/values.h"

namespace strahl::pov {
namespace {

/// Does a number come next, and neither a vector nor a colour?
bool at_single(Interpreter& in) {
    const ValueKind kind = in.kind();
    return in.at_expression() && !in.at('<') && !in.at_color() && kind != ValueKind::uv && kind != ValueKind::vector &&
           kind != ValueKind::vector4 && kind != ValueKind::color;
}

constexpr std::uint16_t nested_word(ValueKind level) {
    return level == ValueKind::pigment  ? word("pigment")
           : level == ValueKind::normal ? word("normal")
                                        : word("texture");
}

constexpr std::array plain_patterns{
    word("agate"),   word("average"),     word("boxed"),  word("bozo"),     word("bumps"),   word("cells"),
    word("crackle"), word("cylindrical"), word("dents"),  word("facets"),   word("granite"), word("leopard"),
    word("marble"),  word("onion"),       word("planar"), word("radial"),   word("ripples"), word("spherical"),
    word("spotted"), word("waves"),       word("wood"),   word("wrinkles"), word("aoi")};
constexpr std::array numbers_without_effect{word("interpolate"),     word("map_type"),        word("use_alpha"),
                                            word("use_color"),       word("use_index"),       word("once"),
                                            word("number_of_sides"), word("number_of_tiles"), word("pattern")};
/// Words with a number, which is not shown, and the number that changes nothing.
struct Usual {
    std::uint16_t code;
    double value;
};
constexpr std::array numbers_not_shown{Usual{word("accuracy"), .02}, Usual{word("strength"), 1},
                                       Usual{word("number_of_waves"), 10}, Usual{word("no_bump_scale"), 0}};

constexpr int most_iterations = 1'000'000;  // of a fractal

DVec3 unit_of(const DVec3& v) { return v == DVec3(0) ? v : normalize(v); }

TurbulenceWarp read_turbulence_warp(Interpreter& in) {
    TurbulenceWarp own{.by = in.read_vector()};
    for (;;)
        if (in.accept("octaves"))
            own.octaves = std::clamp(in.read_integer(), 1, 10);
        else if (in.accept("omega"))
            own.omega = in.read_number();
        else if (in.accept("lambda"))
            own.lambda = in.read_number();
        else
            return own;
}
RepeatWarp read_repeat_warp(Interpreter& in) {
    const DVec3 by = in.read_vector();
    RepeatWarp own;
    int axes = 0;
    for (int c = 0; c < 3; ++c)
        if (by[c] != 0) ++axes, own.axis = c, own.width = by[c];
    if (axes != 1) in.fail("the vector of 'repeat' has to lie along one axis");
    for (;;)
        if (in.accept("offset")) {
            own.offset = in.read_vector();
        } else if (in.accept("flip")) {
            const DVec3 flip = in.read_vector();
            for (int c = 0; c < 3; ++c) own.flip[c] = flip[c] != 0 ? -1 : 1;
        } else {
            return own;
        }
}
BlackHoleWarp read_black_hole(Interpreter& in) {
    BlackHoleWarp own{.centre = in.read_vector()};
    in.skip_comma();
    own.radius = in.read_number();
    // As POV-Ray does, keeps balls that are repeated apart from each other.
    const auto spread = [&] {
        for (int c = 0; own.repeats && c < 3; ++c) {
            if (!(own.repeat[c] > 0)) continue;
            own.centre[c] = std::max(own.centre[c], own.radius);
            own.repeat[c] = std::max(own.repeat[c], own.centre[c] + own.radius + own.uncertain[c]);
        }
    };
    for (;;)
        if (in.accept("strength"))
            own.strength = in.read_number();
        else if (in.accept("falloff"))
            own.falloff = in.read_number();
        else if (in.accept("inverse"))
            own.inverse = true;
        else if (in.accept("type"))
            in.read_number();
        else if (in.accept("repeat"))
            own.repeat = in.read_vector(), own.repeats = true, spread();
        else if (in.accept("turbulence"))
            own.uncertain = in.read_vector(), spread();
        else
            return own;
}
RoundWarp read_round_warp(Interpreter& in, RoundWarp::Shape shape) {
    RoundWarp own{.shape = shape};
    for (;;)
        if (in.accept("orientation"))
            own.orientation = unit_of(in.read_vector());
        else if (in.accept("dist_exp"))
            own.exponent = in.read_number();
        else if (shape == RoundWarp::Shape::torus && in.accept("major_radius"))
            own.major_radius = in.read_number();
        else
            return own;
}

}  // namespace

/// Reads what comes after the value of a map's entry, or a block of a list: a pigment, a normal or a texture.
std::shared_ptr<const Thing> PovReader::read_nested(Interpreter& in, ValueKind level) {
    if (level == ValueKind::texture) return read_texture_body(in);
    if (level == ValueKind::normal) {
        auto normal = std::make_shared<NormalThing>();
        read_normal_body(in, *normal);
        return normal;
    }
    auto pigment = std::make_shared<PigmentThing>(default_texture->layers.back().pigment);
    read_pigment_body(in, *pigment);
    return pigment;
}

/// Reads a map from '{' to '}'. A map of colours has no `level`.
std::shared_ptr<const MapThing> PovReader::read_map(Interpreter& in, ValueKind level) {
    in.begin_block();
    if (in.code() == value_code && in.kind() >= ValueKind::color_map && in.kind() <= ValueKind::slope_map) {
        const auto known = std::static_pointer_cast<const MapThing>(in.take_value().thing);
        if (in.at('}')) return in.end_block(), known;
    }
    auto map = std::make_shared<MapThing>();
    while (in.accept('[')) {
        MapEntry entry;
        // In a list of which the mean is taken a weight of 1 may be left out.
        entry.at = at_single(in) ? static_cast<float>(in.read_number()) : 1;
        in.skip_comma();
        if (level == ValueKind::slope_map) {
            const auto [height, slope] = in.read_uv();
            entry.height = height, entry.slope = slope;
        } else if (level != ValueKind::none) {
            entry.thing = read_nested(in, level);
        } else if (at_single(in)) {
            const Components own = in.read_components();
            if (own.count == 1) {  // the old form: two values and two colours
                in.skip_comma();
                entry.color = in.read_color();
                in.skip_comma();
                map->entries.push_back(entry);
                entry.at = static_cast<float>(own.value[0]), entry.color = in.read_color();
            } else {  // an expression that begins with a number, such as .5*Red
                const auto part = [&](std::size_t i) { return static_cast<float>(own.value[i]); };
                entry.color = {part(0), part(1), part(2), part(3), part(4)};
            }
        } else {
            entry.color = in.read_color();
        }
        map->entries.push_back(std::move(entry));
        in.expect(']');
        in.skip_comma();
    }
    if (map->entries.empty()) in.expected("an entry of the map, such as [0.5 rgb 1]");
    in.end_block();
    return map;
}

/// Reads a warp from '{' to '}'.
Warp PovReader::read_warp(Interpreter& in) {
    in.begin_block();
    Warp warp;
    const std::uint16_t code = in.code();
    if (code != end_code && code != '}') in.take();
    switch (code) {
        case word("turbulence"):
            warp = read_turbulence_warp(in);
            break;
        case word("repeat"):
            warp = read_repeat_warp(in);
            break;
        case word("black_hole"):
            warp = read_black_hole(in);
            break;
        case word("cylindrical"):
            warp = read_round_warp(in, RoundWarp::Shape::cylinder);
            break;
        case word("spherical"):
            warp = read_round_warp(in, RoundWarp::Shape::ball);
            break;
        case word("toroidal"):
            warp = read_round_warp(in, RoundWarp::Shape::torus);
            break;
        case word("planar"): {
            PlanarWarp planar;
            if (!in.at('}')) {
                planar.orientation = unit_of(in.read_vector());
                in.skip_comma();
                planar.offset = in.read_number();
            }
            warp = planar;
            break;
        }
        case word("cubic"):
            warp = CubicWarp{};
            break;
        default:
            in.fail("the name of a warp, such as 'turbulence' or 'repeat', expected");
    }
    in.end_block();
    return warp;
}

/// Reads the colours or blocks after the word of a pattern that has a fixed number of them.
void PovReader::read_list(Interpreter& in, Blend& blend, ValueKind level) {
    auto map = std::make_shared<MapThing>();
    for (;;) {
        MapEntry entry;
        entry.at = double(map->entries.size());
        if (in.code() == nested_word(level)) {
            in.take();
            in.begin_block();
            entry.thing = read_nested(in, level);
            in.end_block();
        } else if (level == ValueKind::pigment && (in.at_color() || in.at_expression())) {
            entry.color = in.read_color();
        } else {
            break;
        }
        map->entries.push_back(std::move(entry));
        in.skip_comma();
    }
    if (!map->entries.empty()) blend.map = std::move(map);
}

/// Reads the word of a pattern with its arguments; reads nothing and returns false if none comes.
bool PovReader::read_pattern_word(Interpreter& in, Blend& blend, ValueKind level) {
    const std::uint16_t code = in.code();
    // The frequency of some is 0, which a pattern in their place keeps: its values do not repeat every 1.00001.
    const auto take = [&](bool never_repeats = false) {
        in.take();
        if (never_repeats) blend.frequency = 0;
        blend.word = code, blend.place = in.last_place();
        blend.function = nullptr, blend.pigment = nullptr, blend.image = nullptr;
        return true;
    };
    if (is_one_of(code, plain_patterns)) return take();
    switch (code) {
        case word("brick"):
        case word("checker"):
        case word("hexagon"):
        case word("square"):
        case word("triangular"):
        case word("cubic"):
            take(true);
            read_list(in, blend, level);
            return true;
        case word("gradient"):
            take();
            blend.axis = in.read_vector();
            in.skip_comma();
            return true;
        case word("spiral1"):
        case word("spiral2"):
            take();
            blend.arms = in.read_number();
            return true;
        case word("quilted"):
        case word("pavement"):
        case word("tiling"):
            take(code == word("quilted"));
            if (code != word("quilted") && at_single(in)) in.read_number();
            return true;
        case word("mandel"):
        case word("magnet"):
        case word("julia"):
            take();
            blend.fractal = {.julia = code == word("julia")};
            if (code == word("magnet")) {
                blend.fractal.magnet = std::clamp(in.read_integer(), 1, 2);
                blend.fractal.julia = in.at("julia");
                if (!in.accept("julia") && !in.accept("mandel")) in.expected("'mandel' or 'julia'");
            }
            if (blend.fractal.julia) {
                const auto [re, im] = in.read_uv();
                blend.fractal.re = re, blend.fractal.im = im;
                in.skip_comma();
            }
            blend.fractal.iterations = std::clamp(in.read_integer(), 0, most_iterations);
            in.skip_comma();
            return true;
        case word("object"):
            take(true);
            in.begin_block();
            blend.function = read_inside(in);
            in.skip_comma();
            read_list(in, blend, level);
            in.end_block();
            return true;
        case word("slope"):
            take();
            if (!in.at('{')) {
                in.read_vector();
                return true;
            }
            in.skip_block();
            return true;
        case word("function"):
            blend.word = code, blend.place = in.place();
            blend.pigment = nullptr, blend.image = nullptr;
            blend.function = in.read_function();
            return true;
        case word("density_file"):
            take();
            if (in.accept("df3")) in.read_file_name();
            while (in.accept("interpolate")) in.read_number();
            return true;
        case word("pigment_pattern"):
            take();
            in.begin_block();
            blend.pigment = std::static_pointer_cast<const PigmentThing>(read_nested(in, ValueKind::pigment));
            in.end_block();
            return true;
        case word("image_map"):
        case word("bump_map"):
        case word("image_pattern"):
            take(code != word("bump_map"));
            blend.image = pictures.read(in, code == word("image_map"), contents.assumes_srgb);
            return true;
        default:
            return false;
    }
}

constexpr std::array modifier_values{
    value_word<Blend, &Blend::turbulence>("turbulence"),
    value_word<Blend, &Blend::agate_turbulence>("agate_turb"),
    value_word<Blend, &Blend::octaves>("octaves"),
    value_word<Blend, &Blend::omega>("omega"),
    value_word<Blend, &Blend::lambda>("lambda"),
    value_word<Blend, &Blend::frequency>("frequency"),
    value_word<Blend, &Blend::phase>("phase"),
    value_word<Blend, &Blend::mortar>("mortar"),
    value_word<Blend, &Blend::brick_size>("brick_size"),
    value_word<Blend, &Blend::crackle, &CrackleForm::form>("form"),
    value_word<Blend, &Blend::facets, &FacetForm::size>("size"),
    value_word<Blend, &Blend::facets, &FacetForm::coords>("coords"),
    value_word<Blend, &Blend::crackle, &CrackleForm::metric>("metric"),
    value_word<Blend, &Blend::crackle, &CrackleForm::offset>("offset"),
    value_word<Blend, &Blend::crackle, &CrackleForm::solid>("solid"),
    value_word<Blend, &Blend::noise_generator>("noise_generator"),
};

/// Reads a word that changes how a pattern is laid out, or its map; reads nothing and returns false if none comes.
bool PovReader::read_modifier(Interpreter& in, Blend& blend, ValueKind level) {
    const auto wave = [&](Wave own) {
        in.take();
        blend.wave = own;
        return true;
    };
    const auto number = [&](double& value) {
        in.take();
        value = in.read_number();
        return true;
    };
    const std::uint16_t code = in.code();
    if (is_one_of(code, numbers_without_effect)) return in.take(), in.read_number_or(0), true;
    if (const auto own = std::ranges::find(numbers_not_shown, code, &Usual::code); own != numbers_not_shown.end()) {
        in.take();
        if (in.read_number_or(1) != own->value) blend.ignored = code;
        return true;
    }
    if (accept_value(in, modifier_values, blend)) return true;
    switch (code) {
        case word("control0"):
            return number(blend.controls[0]);
        case word("control1"):
            return number(blend.controls[1]);
        case word("ramp_wave"):
            return wave(Wave::ramp);
        case word("triangle_wave"):
            return wave(Wave::triangle);
        case word("sine_wave"):
            return wave(Wave::sine);
        case word("scallop_wave"):
            return wave(Wave::scallop);
        case word("cubic_wave"):
            return wave(Wave::cubic);
        case word("poly_wave"):
            wave(Wave::poly);
            blend.exponent = in.read_number_or(1);
            return true;
        case word("uv_mapping"):
            in.take();
            return blend.uv = true;
        case word("warp"):
            in.take();
            blend.warps.push_back({std::exchange(blend.steps, {}), read_warp(in)});
            return true;
        case word("color_map"):
            in.take();
            blend.map = in.at('{') ? read_map(in, ValueKind::none) : in.accept_thing<MapThing>(ValueKind::color_map);
            return true;
        case word("pigment_map"):
        case word("normal_map"):
        case word("texture_map"):
            in.take();
            blend.map = read_map(in, code == word("pigment_map")  ? ValueKind::pigment
                                     : code == word("normal_map") ? ValueKind::normal
                                                                  : ValueKind::texture);
            return true;
        case word("slope_map"):
            in.take();
            blend.slopes = read_map(in, ValueKind::slope_map);
            return true;
        case word("exponent"):
            in.take();
            blend.fractal.exponent = std::clamp(in.read_integer(), 2, 33);
            return true;
        case word("interior"):
        case word("exterior"): {
            in.take();
            const int type = in.read_integer();
            if (blend.word == word("pavement")) return true;
            in.skip_comma();
            const double factor = in.read_number();
            if (code == word("interior"))
                blend.fractal.inside = type, blend.fractal.inside_factor = factor;
            else
                blend.fractal.outside = type, blend.fractal.outside_factor = factor;
            return true;
        }
        case word("altitude"):
            in.take();
            in.read_vector();
            return true;
        default:
            break;
    }
    if (level != ValueKind::none && in.kind() == ValueKind::color_map)
        return blend.map = std::static_pointer_cast<const MapThing>(in.take_value().thing), true;
    return read_step(in, blend.steps);
}

}  // namespace strahl::pov
