#include "povref/materials.h"

#include <algorithm>
#include <cmath>

#include "povref/layout.h"
#include "povref/material_names.h"
#include "povref/numbers.h"

namespace strahl {
namespace {

/// What of a scene decides how its materials must be written.
struct Circumstances {
    bool bends = false;        // some ior is not 1: there may be total reflection
    bool lights = false;       // there may be shadows
    bool depth_shows = false;  // the last generation's rays still carry light that a 16-bit picture shows
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

/// A transparent body's share of light that goes on, Kr + Kt. POV-Ray keeps it in single precision; so may the text.
std::string weight(const Material& m) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, static_cast<float>(m.reflection + m.refraction)).ptr};
}

/// The terms of a finish. POV-Ray dims ambient and diffuse light by a pigment's opacity, which is divided out
/// (`opacity` is a text, "" for 1).
std::vector<std::string> finish(const Material& m, const std::string& opacity, bool keyword) {
    const auto lit = [&](double k) { return text_of(k) + (k == 0 || opacity.empty() ? "" : "/" + opacity); };
    std::vector<std::string> terms{"ambient " + lit(m.ambient), "diffuse " + lit(m.diffuse)};
    if (m.specular > 0) terms.push_back("phong " + text_of(m.specular) + " phong_size " + text_of(m.pow));
    if (m.reflection > 0) terms.push_back("reflection { rgb " + text_of(m.reflection) + " }");
    if (keyword) terms.push_back("refraction " + weight(m));
    return terms;
}

std::string texture(const std::string& pigment, const std::vector<std::string>& finish, const std::string& indent) {
    return "texture {\n" + indent + "  pigment { " + pigment + " }\n" + indent +
           block("  finish {", finish, indent + "  ") + indent + "}";
}

/// The texture of a transparent body as the eye sees it.
std::string seen_through(const Material& m, bool keyword) {
    // The keyword dims what is transmitted and what is totally reflected; the pigment what is transmitted only.
    const double opacity = 1 - (keyword ? m.refraction / (m.reflection + m.refraction) : m.refraction);
    const std::string transmit = !keyword            ? text_of(m.refraction)
                                 : m.reflection == 0 ? "1"
                                                     : text_of(m.refraction) + "/" + weight(m);
    if (opacity >= 0.05 || (m.ambient == 0 && m.diffuse == 0))
        return texture("rgb " + text_of(m.rgb) + " transmit " + transmit, finish(m, "(1 - " + transmit + ")", keyword),
                       "  ");
    // Nothing of an opacity of 0 can be lit: a clear layer below lets half through, one above is half opaque.
    return texture("rgb 0 transmit 2*" + transmit, {"ambient 0", "diffuse 0"}, "  ") + "\n  " +
           texture("rgb " + text_of(m.rgb) + " transmit 0.5", finish(m, "0.5", keyword), "  ");
}

PovMaterial describe(const Material& m, const std::string& name, const Circumstances& scene) {
    PovMaterial pov{.name = name};
    pov.transparent = m.refraction > 0;
    if (!pov.transparent) {
        pov.declaration =
            "#declare " + name + " = " + texture("rgb " + text_of(m.rgb), finish(m, "", false), "") + "\n";
        return pov;
    }
    // Total reflection carries Kr + Kt here and 1 in POV-Ray, where the old keyword `refraction` can change it.
    pov.keyword = scene.bends && std::fabs(m.reflection + m.refraction - 1) > 1e-9;
    pov.own_shadow = scene.lights && (pov.keyword || m.rgb != Color(1));
    pov.near_one = m.ior == 1 && scene.depth_shows;
    // POV-Ray keeps an ior in single precision; this is the number after 1.
    const std::string ior = pov.near_one ? "1.00000012" : text_of(m.ior);
    pov.declaration = "#declare " + name + " = material {\n  " + seen_through(m, pov.keyword) + "\n  interior { ior " +
                      ior + " }\n}\n";
    if (pov.own_shadow)
        pov.declaration +=
            "#declare " + name + "_Shadow = " +
            texture("rgb " + text_of(m.rgb) + " filter " + text_of(m.refraction), {"ambient 0", "diffuse 0"}, "") +
            "\n";
    return pov;
}

}  // namespace

std::vector<PovMaterial> pov_materials(const Scene& scene, int depth) {
    const Circumstances all = circumstances_of(scene, depth);
    const std::vector<std::string> names = material_names(scene.materials);
    std::vector<PovMaterial> result;
    for (std::size_t i = 0; i < names.size(); ++i) result.push_back(describe(scene.materials[i], names[i], all));
    return result;
}

}  // namespace strahl
