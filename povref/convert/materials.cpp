#include "povref/convert/materials.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "num/decimal.h"
#include "povref/convert/layout.h"
#include "povref/convert/material_names.h"
#include "povref/convert/pigments.h"

namespace strahl {
namespace {

/// Properties of the scene that affect how materials are written.
struct Circumstances {
    bool bends = false;        // some ior is not 1: there may be total reflection
    bool lights = false;       // there may be shadows
    bool depth_shows = false;  // the last generation still carries light that a 16-bit picture shows
};

Circumstances circumstances_of(const Scene& scene, int depth) {
    Circumstances all;
    double most = 0;
    for (const Material& m : scene.materials) {
        all.bends |= m.refraction > 0 && m.ior != 1;
        most = std::max(most, m.reflection + m.refraction);
    }
    all.lights = !scene.lights.empty();
    all.depth_shows = std::pow(most, depth) > 1e-6;
    return all;
}

/// Returns the share of light that continues from a transparent body, Kr + Kt, in single precision as in POV-Ray.
std::string weight_of(const Material& m) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, static_cast<float>(m.reflection + m.refraction)).ptr};
}

/// Returns the terms of a finish. POV-Ray multiplies ambient and diffuse light by the opacity of the pigment, so they
/// are divided by it. `opacity` is text, "" for 1; `weight` is that of the keyword `refraction`, "" without it.
std::vector<std::string> finish(const Material& m, const std::string& opacity, const std::string& weight) {
    const auto lit = [&](double k) { return text_of(k) + (k == 0 || opacity.empty() ? "" : "/" + opacity); };
    std::vector<std::string> terms{"ambient " + lit(m.ambient), "diffuse " + lit(m.diffuse)};
    if (m.specular > 0) terms.push_back("phong " + text_of(m.specular) + " phong_size " + text_of(m.pow));
    if (m.reflection > 0) terms.push_back("reflection { rgb " + text_of(m.reflection) + " }");
    if (!weight.empty()) terms.push_back("refraction " + weight);
    return terms;
}

std::string texture(const std::string& pigment, const std::vector<std::string>& finish, const std::string& indent,
                    const Bump& bump = {}) {
    const std::string normal = normal_text(bump);
    return "texture {\n" + indent + "  pigment { " + pigment + " }\n" + indent +
           (normal.empty() ? "" : "  " + normal + "\n" + indent) + block("  finish {", finish, indent + "  ") + indent +
           "}";
}

/// Returns the transmitted share for the pigment. With the keyword, which also applies to total reflection, it is
/// relative to its weight.
double transmitted(const Material& m, const std::string& weight) {
    return weight.empty() ? m.refraction : m.refraction / std::stod(weight);
}
std::string transmitted_text(const Material& m, const std::string& weight) {
    if (weight.empty()) return text_of(m.refraction);
    return m.reflection == 0 && weight == weight_of(m) ? "1" : text_of(m.refraction) + "/" + weight;
}

/// Returns whether the material needs two layers: POV-Ray does not light a pigment that is (almost) clear.
bool needs_layers(const Material& m, const std::string& weight) {
    return transmitted(m, weight) > 0.95 && (m.ambient > 0 || m.diffuse > 0);
}

/// Returns the texture of a transparent body, but for its shadow.
std::string seen_through(const Material& m, const std::string& weight, const std::string& indent) {
    const std::string share = transmitted_text(m, weight);
    if (!needs_layers(m, weight))
        return texture(pigment_text(m.rgb, " transmit " + share), finish(m, "(1 - " + share + ")", weight), indent,
                       m.bump);
    return texture("rgb 0 transmit 2" + (share == "1" ? "" : "*" + share), {"ambient 0", "diffuse 0"}, indent, m.bump) +
           "\n" + indent + texture(pigment_text(m.rgb, " transmit 0.5"), finish(m, "0.5", weight), indent, m.bump);
}

/// Returns a layer of POV-Ray's finish.
std::vector<std::string> layer_finish(const Material& m) {
    std::vector<std::string> terms{"ambient rgb " + text_of(m.ambient * m.glow),
                                   "diffuse " + text_of(m.diffuse) + (m.behind > 0 ? ", " + text_of(m.behind) : "")};
    const auto add = [&](bool applies, const std::string& term) {
        if (applies) terms.push_back(term);
    };
    add(m.brilliance != 1, "brilliance " + text_of(m.brilliance));
    add(m.specular > 0, "phong " + text_of(m.specular) + " phong_size " + text_of(m.pow));
    add(m.blinn > 0, "specular " + text_of(m.blinn) + " roughness " + text_of(m.roughness));
    add(m.metallic > 0, "metallic " + text_of(m.metallic));
    add(m.conserve > 0, "conserve_energy");
    add(m.clarity != 1, "refraction " + text_of(m.clarity));
    add(m.irid > 0, "irid { " + text_of(m.irid) + " thickness " + text_of(m.film) + " }");
    if (m.reflection > 0) {
        const Color most = m.reflection * m.mirror;
        std::string text = "reflection { rgb " + text_of(m.facing * most) + ", rgb " + text_of(most);
        if (m.fresnel > 0)
            text += " fresnel";
        else if (m.falloff != 1)
            text += " falloff " + text_of(m.falloff);
        if (m.gilding > 0) text += " metallic " + text_of(m.gilding);
        terms.push_back(text + " }");
    }
    return terms;
}
/// Returns the layers of a material with POV-Ray's finish, which says all of it but Kt.
std::string layers_of(const Material& m, const std::string& indent) {
    Material lowest = m;
    lowest.rgb.transmit += m.refraction;
    std::string text = texture(pigment_text(lowest.rgb), layer_finish(m), indent, m.bump);
    for (const Material& coat : m.coats)
        text += "\n" + indent +
                texture(pigment_text(coat.rgb), layer_finish(coat), indent, coat.bump.pattern ? coat.bump : m.bump);
    return text;
}

/// Returns the stacks of layers of a material that mixes some, as materials of their own.
std::vector<Material> stacks_of(const Material& m) {
    std::vector<Material> stacks{m};
    stacks[0].coats.clear();
    for (const Material& coat : m.coats)
        if (coat.shares())
            stacks.push_back(coat), stacks.back().bump = coat.bump.pattern ? coat.bump : m.bump;
        else
            stacks.back().coats.push_back(coat),
                stacks.back().coats.back().bump = coat.bump.pattern ? coat.bump : m.bump;
    return stacks;
}

/// Returns a pattern of textures with these names that has these shares: patterns that differ in their colours, which
/// are black where the texture is not shown. Of shares of several patterns the first one is shown, and others are
/// `lost`.
std::string mixed_text(const std::vector<std::pair<std::string, Pigment>>& shares, bool& lost) {
    std::vector<std::pair<std::string, Pigment>> some;
    for (const auto& own : shares)
        if (own.second.pattern || own.second.color != Color(0)) some.push_back(own);
    if (some.size() < 2) return some.empty() ? shares[0].first : some[0].first;
    const auto alike = [&](const auto& own) {
        const Pattern *const first = some[0].second.pattern.get(), *const other = own.second.pattern.get();
        return !first == !other &&
               (!first || (first->kind == other->kind && first->by_uv == other->by_uv &&
                           first->transformations == other->transformations &&
                           std::ranges::equal(first->colors, other->colors, {}, &ColorStop::at, &ColorStop::at)));
    };
    if (!std::ranges::all_of(some, alike)) return lost = true, some[0].first;
    if (!some[0].second.pattern) {
        std::string text = "average texture_map {";
        for (const auto& [name, share] : some) text += " [" + text_of(share.color.x) + " " + name + "]";
        return text + " }";
    }
    if (std::holds_alternative<ImagePattern>(some[0].second.pattern->kind)) return lost = true, some[0].first;
    const std::vector<ColorStop>& stops = some[0].second.pattern->colors;
    return pattern_text(*some[0].second.pattern, "texture_map", "texture", [&](const ColorStop& stop) {
        std::vector<std::pair<std::string, Pigment>> parts;
        for (const auto& [name, share] : some) {
            const ColorStop& own = share.pattern->colors[std::size_t(&stop - stops.data())];
            parts.emplace_back(name, own.pattern ? Pigment(*own.pattern) : Pigment(own.color));
        }
        return mixed_text(parts, lost);
    });
}

/// Returns the texture of a material with POV-Ray's finish. Before it, those that it mixes are declared.
std::string finished_texture(const Material& m, const std::string& indent, PovMaterial& pov) {
    const std::vector<Material> stacks = stacks_of(m);
    if (stacks.size() == 1) return layers_of(m, indent);
    std::vector<std::pair<std::string, Pigment>> outside, inside;
    for (std::size_t i = 0; i < stacks.size(); ++i) {
        const Material& own = stacks[i];
        const std::string name = pov.name + "_" + std::to_string(1 + i);
        pov.declaration += "#declare " + name + " = " + layers_of(own, "") + "\n";
        const auto add = [&](auto& side, double factor) {
            if (factor > 0) side.emplace_back(name, own.share);
            pov.lost_shares |= factor > 0 && factor < 1;
        };
        add(outside, own.outside), add(inside, own.inside);
    }
    const auto text = [&](const auto& side) {
        return side.empty() ? "pigment { rgb 0 }" : mixed_text(side, pov.lost_shares);
    };
    const std::string all = "texture { " + text(outside) + " }";
    return m.has_sides() ? all + "\n" + indent + "interior_texture { " + text(inside) + " }" : all;
}

PovMaterial describe(const Material& m, const std::string& name, const Circumstances& scene, bool scaled) {
    PovMaterial pov{.name = name};
    pov.patterned = m.patterned();
    pov.transparent = m.transmits();
    if (m.shadow == 0) pov.hides.push_back("no_shadow");
    if (m.both_sides > 0) pov.hides.push_back("double_illuminate");
    if (m.seen == 0) pov.hides.push_back("no_image");
    if (m.mirrored == 0) pov.hides.push_back("no_reflection");
    if (!m.plain()) {
        pov.ior = text_of(m.ior);
        pov.transparent |= m.ior != 1 || m.has_sides();  // both are said in a `material`
        pov.grouped = m.group > 0 || m.common == 0;
        if (m.fade_distance > 0)
            pov.ior += " fade_distance " + text_of(m.fade_distance) + (scaled ? " * Unit" : "") + " fade_power " +
                       text_of(m.fade_power) + " fade_color rgb " + text_of(m.fade_color);
        const std::string texture = finished_texture(m, pov.transparent ? "  " : "", pov);
        pov.declaration += "#declare " + name + " = ";
        if (pov.transparent)
            pov.declaration += "material {\n  " + texture + "\n  interior { ior " + pov.ior + " }\n}\n";
        else
            pov.declaration += texture + "\n";
        return pov;
    }
    if (!pov.transparent) {
        pov.declaration = "#declare " + name + " = " + part_texture(m, "", "") + "\n";
        return pov;
    }
    // Total reflection has the share Kr + Kt here, and 1 in POV-Ray unless the old keyword `refraction` changes it.
    if (scene.bends && std::fabs(m.reflection + m.refraction - 1) > 1e-9) pov.weight = weight_of(m);
    pov.layered = needs_layers(m, pov.weight);
    pov.own_shadow = scene.lights && (!pov.weight.empty() || m.rgb != Pigment(Color(1)));
    pov.near_one = m.ior == 1 && scene.depth_shows;
    // POV-Ray keeps the ior in single precision; this is the next number after 1.
    pov.ior = pov.near_one ? "1.00000012" : text_of(m.ior);
    pov.declaration = "#declare " + name + " = material {\n  " + part_texture(m, pov.weight, "  ") +
                      "\n  interior { ior " + pov.ior + " }\n}\n";
    if (pov.own_shadow) pov.declaration += "#declare " + name + "_Shadow = " + shadow_texture(m, "") + "\n";
    return pov;
}

}  // namespace

std::string part_texture(const Material& m, const std::string& weight, const std::string& indent) {
    if (!m.plain()) return layers_of(stacks_of(m)[0], indent);
    if (m.refraction > 0) return seen_through(m, weight, indent);
    return texture(pigment_text(m.rgb), finish(m, "", weight), indent, m.bump);
}
std::string shadow_texture(const Material& m, const std::string& indent) {
    return texture(pigment_text(m.rgb, " filter " + text_of(m.refraction)), {"ambient 0", "diffuse 0"}, indent);
}

std::vector<PovMaterial> pov_materials(const Scene& scene, int depth, bool scaled) {
    const Circumstances all = circumstances_of(scene, depth);
    const std::vector<std::string> names = material_names(scene.materials);
    std::vector<PovMaterial> result;
    for (std::size_t i = 0; i < names.size(); ++i)
        result.push_back(describe(scene.materials[i], names[i], all, scaled));
    return result;
}

}  // namespace strahl
