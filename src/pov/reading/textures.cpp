// Reads pigments, normals, finishes, interiors, and textures made of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "pov/reading/reader.h"
#include "pov/reading/values.h"
#include "pov/things/numbers.h"
#include "pov/things/solids.h"

namespace strahl::pov {
namespace {

DVec3 read_rgb(Interpreter& in) { return color_of(in.read_color()); }

/// Reads `albedo`, if it comes, and a number; returns whether it was an albedo.
bool read_albedo(Interpreter& in, double& value) {
    const bool albedo = in.accept("albedo");
    value = in.read_number();
    return albedo;
}

/// Reads what follows the word `reflection`.
ReflectionValues read_reflection(Interpreter& in) {
    ReflectionValues own;
    if (!in.at('{')) {
        own.least = own.most = read_rgb(in);
        return own;
    }
    in.begin_block();
    bool two = false;
    if (!in.at('}')) own.least = own.most = read_rgb(in);
    in.skip_comma();
    if (in.at_color() || in.at_expression()) own.most = read_rgb(in), two = true;
    while (!in.at('}')) {
        if (in.accept("falloff"))
            own.falloff = in.read_number();
        else if (in.accept("exponent"))
            own.exponent = in.read_number();
        else if (in.accept("metallic"))
            own.metallic = in.read_number_or(1);
        else if (in.accept("fresnel"))
            own.fresnel = in.read_flag();
        else
            in.expected("'falloff', 'exponent', 'metallic' or 'fresnel'");
    }
    in.end_block();
    if (own.fresnel && !two) own.least = DVec3(0);
    return own;
}

}  // namespace

/// Reads the inside of a pigment, up to before what does not belong to it.
void PovReader::read_pigment_body(Interpreter& in, PigmentThing& pigment) {
    if (const auto known = in.accept_thing<PigmentThing>(ValueKind::pigment)) pigment = *known;
    for (bool changed = false;; changed = true) {
        if (in.accept("quick_color")) {
            in.read_color();
        } else if (in.at_color()) {
            pigment.color = in.read_color();
            pigment.blend.word = end_code;
        } else if (in.accept("uv_mapping")) {
            if (const auto known = in.accept_thing<PigmentThing>(ValueKind::pigment)) pigment = *known;
            pigment.blend.uv = true;
        } else if (!read_pattern_word(in, pigment.blend, ValueKind::pigment) &&
                   !read_modifier(in, pigment.blend, ValueKind::pigment)) {
            if (changed) keep_values(pigment.blend, false, in.noise_generator);
            return;
        }
        if (pigment.blend.word == word("brick") || pigment.blend.map) in.skip_comma();
    }
}
void PovReader::read_pigment(Interpreter& in, PigmentThing& pigment) {
    in.begin_block();
    read_pigment_body(in, pigment);
    in.end_block();
}

void PovReader::read_normal_body(Interpreter& in, NormalThing& normal) {
    const auto read_amount = [&] {
        in.skip_comma();
        normal.amount = in.read_number_or(normal.amount);
    };
    const auto read_known = [&] {
        if (const auto known = in.accept_thing<NormalThing>(ValueKind::normal)) normal = *known;
        read_amount();
    };
    read_known();
    for (bool changed = false;; changed = true) {
        if (in.accept("bump_size")) {
            normal.amount = in.read_number();
        } else if (in.accept("uv_mapping")) {
            read_known();
            normal.blend.uv = true;
        } else if (read_pattern_word(in, normal.blend, ValueKind::normal)) {
            if (normal.blend.image) normal.amount = normal.blend.image->bump_size.value_or(normal.amount);
            read_amount();
        } else if (!read_modifier(in, normal.blend, ValueKind::normal)) {
            if (changed) keep_values(normal.blend, true, in.noise_generator);
            return;
        }
    }
}
void PovReader::read_normal(Interpreter& in, NormalThing& normal) {
    in.begin_block();
    read_normal_body(in, normal);
    in.end_block();
}

namespace {

/// Says which numbers of a finish are albedos.
struct Albedos {
    bool diffuse = false, phong = false, specular = false;
};

constexpr std::array finish_values{
    value_word<FinishThing, &FinishThing::brilliance>("brilliance"),
    value_word<FinishThing, &FinishThing::phong_size>("phong_size"),
    value_word<FinishThing, &FinishThing::roughness>("roughness"),
    value_word<FinishThing, &FinishThing::crand>("crand"),
    value_word<FinishThing, &FinishThing::conserve_energy>("conserve_energy"),
    value_word<FinishThing, &FinishThing::ior>("ior"),
    value_word<FinishThing, &FinishThing::refraction>("refraction"),
};

/// Reads a word of a finish and what follows it.
void read_finish_word(Interpreter& in, FinishThing& finish, Albedos& albedos) {
    if (accept_value(in, finish_values, finish)) return;
    const std::uint16_t code = in.code();
    in.take();
    switch (code) {
        case word("ambient"):
            finish.ambient = read_rgb(in);
            break;
        case word("emission"):
            finish.emission = read_rgb(in);
            break;
        case word("diffuse"):
            albedos.diffuse = read_albedo(in, finish.diffuse);
            in.skip_comma();
            finish.diffuse_behind = in.read_number_or(finish.diffuse_behind);
            break;
        case word("phong"):
            albedos.phong = read_albedo(in, finish.phong);
            break;
        case word("specular"):
            albedos.specular = read_albedo(in, finish.specular);
            break;
        case word("metallic"):
            finish.metallic = in.read_number_or(1);
            break;
        case word("reflection"): {
            const double exponent = finish.reflection.exponent;
            const bool block = in.at('{');
            finish.reflection = read_reflection(in);
            if (!block) finish.reflection.exponent = exponent;
            break;
        }
        case word("reflection_exponent"):
            finish.reflection.exponent = in.read_number();
            break;
        case word("irid"):
            in.begin_block();
            finish.irid = in.read_number();
            while (!in.at('}'))
                if (in.accept("thickness"))
                    finish.film = in.read_number();
                else if (in.accept("turbulence"))
                    finish.swirls = in.read_vector().x != 0;
                else
                    in.expected("'thickness', 'turbulence' or '}'");
            in.end_block();
            break;
        case word("subsurface"):
            finish.subsurface = true;
            in.skip_block();
            break;
        case word("caustics"):
        case word("fade_distance"):
        case word("fade_power"):
            in.read_number();
            break;
        case word("use_alpha"):
            in.read_flag();
            break;
        default:
            in.misplaced();
    }
}

constexpr std::array old_finish_words{word("ambient"),  word("brilliance"), word("diffuse"),  word("reflection"),
                                      word("phong"),    word("phong_size"), word("specular"), word("roughness"),
                                      word("metallic"), word("crand"),      word("ior"),      word("refraction")};
constexpr std::array old_normal_words{word("bumps"), word("dents"),    word("ripples"),   word("waves"),
                                      word("phase"), word("wrinkles"), word("frequency"), word("bump_map")};

}  // namespace

void PovReader::read_finish(Interpreter& in, FinishThing& finish) {
    in.begin_block();
    if (const auto known = in.accept_thing<FinishThing>(ValueKind::finish)) finish = *known;
    finish.place = in.place();
    Albedos albedos;
    while (!in.at('}')) {
        if (const auto known = in.accept_thing<FinishThing>(ValueKind::finish)) {
            finish = *known;
            continue;
        }
        read_finish_word(in, finish, albedos);
        in.skip_comma();
    }
    in.end_block();
    contents.emits |= finish.emission != DVec3(0);
    if (albedos.diffuse) finish.diffuse *= (finish.brilliance + 1) / 2;
    if (albedos.phong) finish.phong *= (finish.phong_size + 1) / 2;
    const double e = 1 / finish.roughness;
    if (albedos.specular) finish.specular *= (e + 2) / (4 * (2 - std::exp2(-e / 2)));
}

/// Reads what stands in textures of before version 3 without the word of its block: a number is crand. Reads nothing
/// and returns false if none of it comes.
bool PovReader::read_old_texture_word(Interpreter& in, LayerValues& layer) {
    const std::uint16_t code = in.code();
    if (is_one_of(code, old_finish_words)) {
        layer.finish.place = in.place();
        Albedos none;
        read_finish_word(in, layer.finish, none);
    } else if (is_one_of(code, old_normal_words)) {
        if (!read_pattern_word(in, layer.normal.blend, ValueKind::normal))
            return read_modifier(in, layer.normal.blend, ValueKind::normal);
        in.skip_comma();
        layer.normal.amount = in.read_number_or(layer.normal.amount);
    } else if (in.at_color()) {
        layer.pigment.color = in.read_color(), layer.pigment.blend.word = end_code;
    } else if (in.accept("quick_color")) {
        in.read_color();
    } else if (in.at_expression()) {
        layer.finish.place = in.place();
        layer.finish.crand = in.read_number();
    } else {
        Blend& blend = layer.pigment.blend;
        if (!read_pattern_word(in, blend, ValueKind::pigment)) return read_modifier(in, blend, ValueKind::pigment);
        blend.wave = Wave::ramp;  // also for marble and wood
    }
    return true;
}

constexpr std::array interior_values{
    value_word<InteriorThing, &InteriorThing::ior>("ior"),
    value_word<InteriorThing, &InteriorThing::fade_distance>("fade_distance"),
    value_word<InteriorThing, &InteriorThing::fade_power>("fade_power"),
};
void PovReader::read_interior(Interpreter& in, InteriorThing& interior) {
    in.begin_block();
    interior.place = in.place();
    while (!in.at('}')) {
        if (const auto known = in.accept_thing<InteriorThing>(ValueKind::interior)) {
            interior = *known;
            continue;
        }
        if (in.kind() == ValueKind::media) {
            in.take_value();
            interior.media = true;
            continue;
        }
        if (Steps steps; read_step(in, steps)) continue;
        if (accept_value(in, interior_values, interior)) continue;
        const std::uint16_t code = in.code();
        in.take();
        switch (code) {
            case word("fade_color"):
                interior.fade_color = color_of(in.read_color());
                break;
            case word("caustics"):
                interior.caustics = in.read_number() != 0;
                break;
            case word("dispersion"):
                interior.dispersion = in.read_number() != 1;
                break;
            case word("dispersion_samples"):
            case word("refraction"):
                in.read_number();
                break;
            case word("media"):
                interior.media = true;
                in.skip_block();
                break;
            default:
                in.misplaced();
        }
    }
    in.end_block();
}

/// Reads the inside of a texture.
std::shared_ptr<const TextureThing> PovReader::read_texture_body(Interpreter& in) {
    if (in.accept("texture")) return read_texture(in);
    if (in.accept("uv_mapping")) return by_uv(*read_texture_body(in), Steps());
    const auto known = in.accept_thing<TextureThing>(ValueKind::texture);
    if (known && (in.at('}') || in.at(']'))) return known;
    auto texture = std::make_shared<TextureThing>(known ? *known : *default_texture);
    LayerValues& layer = texture->layers.back();
    if (!known) layer.place = in.place();
    const bool old = in.version() < 3;
    for (;;) {
        if (in.accept("pigment")) {
            read_pigment(in, layer.pigment);
        } else if (in.accept("normal")) {
            read_normal(in, layer.normal);
        } else if (in.accept("finish")) {
            read_finish(in, layer.finish);
        } else if (const auto pigment = in.accept_thing<PigmentThing>(ValueKind::pigment)) {
            layer.pigment = *pigment;
        } else if (const auto normal = in.accept_thing<NormalThing>(ValueKind::normal)) {
            layer.normal = *normal;
        } else if (const auto finish = in.accept_thing<FinishThing>(ValueKind::finish)) {
            layer.finish = *finish;
        } else if (in.accept("tiles")) {
            read_tiles(in, layer.blend);
        } else if (in.accept("material_map")) {
            read_material_map(in, layer);
        } else if (Steps steps; read_step(in, steps)) {
            for (LayerValues& each : texture->layers) transform(each, steps);
        } else if (old) {
            if (!read_old_texture_word(in, layer)) break;
        } else if (!read_pattern_word(in, layer.blend, ValueKind::texture) &&
                   !read_modifier(in, layer.blend, ValueKind::texture)) {
            break;
        }
    }
    if (old) keep_values(layer.pigment.blend, false, in.noise_generator);
    if (old) keep_values(layer.normal.blend, true, in.noise_generator);
    if (layer.blend && !layer.blend.map) layer.blend.word = end_code;
    keep_values(layer.blend, false, in.noise_generator);
    return texture;
}
std::shared_ptr<const TextureThing> PovReader::read_texture(Interpreter& in) {
    in.begin_block();
    auto texture = read_texture_body(in);
    in.end_block();
    return texture;
}

/// Reads tiles { texture { ... } tile2 texture { ... } }, the old form of a checker.
void PovReader::read_tiles(Interpreter& in, Blend& blend) {
    blend.word = word("checker"), blend.place = in.last_place();
    in.begin_block();
    auto map = std::make_shared<MapThing>();
    while (in.accept("texture") || in.accept("tile2"))
        if (in.at('{')) map->entries.push_back({.at = double(map->entries.size()), .thing = read_texture(in)});
    in.end_block();
    std::ranges::reverse(map->entries);  // unlike those of a checker
    blend.map = std::move(map);
}

/// Reads material_map { "picture" texture { ... } ... }, whose pixels choose textures: the first one is taken.
void PovReader::read_material_map(Interpreter& in, LayerValues& layer) {
    in.begin_block();
    for (bool first = true; !in.at('}') && !in.at_end();) {
        auto texture = in.accept_thing<TextureThing>(ValueKind::texture);
        if (!texture && in.accept("texture")) texture = read_texture(in);
        if (texture && std::exchange(first, false))
            layer = texture->layers.back();
        else if (!texture)
            in.take();
    }
    in.end_block();
    layer.blend.ignored = word("material_map");
}

std::shared_ptr<const MaterialThing> PovReader::read_material(Interpreter& in) {
    in.begin_block();
    auto material = std::make_shared<MaterialThing>();
    for (;;) {
        if (const auto known = in.accept_thing<MaterialThing>(ValueKind::material)) {
            *material = *known;
        } else if (const auto known = in.accept_thing<TextureThing>(ValueKind::texture)) {
            material->texture = known;
        } else if (in.accept("texture")) {
            auto more = read_texture(in);
            material->texture = material->texture ? layered(*material->texture, *more) : more;
        } else if (in.accept("interior_texture")) {
            material->interior_texture = read_texture(in);
        } else if (in.accept("interior")) {
            auto interior = std::make_shared<InteriorThing>(material->interior ? *material->interior : InteriorThing());
            read_interior(in, *interior);
            material->interior = std::move(interior);
        } else if (Steps steps; read_step(in, steps)) {
            if (!material->texture) continue;
            // As in POV-Ray its interior_texture stays where it is.
            material->texture = moved(*material->texture, steps);
        } else {
            break;
        }
    }
    in.end_block();
    return material;
}

}  // namespace strahl::pov
