#include "povref/convert/pigments.h"

#include <algorithm>
#include <array>

#include "num/decimal.h"
#include "num/vec_math.h"
#include "povref/convert/images.h"
#include "povref/convert/layout.h"
#include "povref/convert/sentences.h"
#include "text/reading/opacity.h"

namespace strahl {
namespace {

std::string octaves_text(const Octaves& octaves) {
    std::string sum;
    double strength = 1, fineness = 1;
    for (int i = 0; i < octaves.octaves; ++i) {
        const std::string factor = fineness == 1 ? "" : text_of(fineness) + "*";
        sum += (sum.empty() ? "" : " + ") + (strength == 1 ? "" : text_of(strength) + "*") + "Noise(" + factor + "x, " +
               factor + "y, " + factor + "z)";
        strength *= octaves.omega, fineness *= octaves.lambda;
    }
    return sum;
}
template <class Kind>
std::string moved(const std::string& coordinate, const Kind& kind) {
    if (kind.turbulence == 0) return coordinate;
    return coordinate + " + " + text_of(kind.turbulence) + "*(" + octaves_text(kind) + ")";
}

std::string solid_text(const SolidPattern& own) {
    if (const Opacity* const opacity = opacity_of(own))
        return "pigment_pattern { " + image_text(opacity->picture(), "", true) + " }";
    constexpr std::array<const char*, 5> waves{"ramp", "triangle", "sine", "scallop", "cubic"};
    const SolidPattern usual;
    std::string text(solid_names[static_cast<std::size_t>(own.solid)]);
    if (own.solid == Solid::uniform) text = "function { 0 }";
    if (own.solid == Solid::spiral1 || own.solid == Solid::spiral2) text += " " + text_of(own.arms);
    if (own.solid == Solid::gradient) text += " " + text_of(own.axis);
    text += std::string(" ") + waves[static_cast<std::size_t>(std::clamp(own.wave, 0., 4.))] + "_wave";
    if (own.turbulence != DVec3(0)) text += " turbulence " + text_of(own.turbulence);
    if (own.octaves != usual.octaves) text += " octaves " + text_of(own.octaves);
    if (own.omega != usual.omega) text += " omega " + text_of(own.omega);
    if (own.lambda != usual.lambda) text += " lambda " + text_of(own.lambda);
    if (own.frequency != usual.frequency) text += " frequency " + text_of(own.frequency);
    if (own.phase != usual.phase) text += " phase " + text_of(own.phase);
    return text + " noise_generator " + text_of(own.generator);
}

/// Writes the value of a pattern as a function. Empty where POV-Ray has the pattern without visible tolerances; its own
/// gradient is off by 1e-5 at -1.
struct ValueText {
    std::string operator()(const Checker&) const { return ""; }
    std::string operator()(const Brick&) const { return ""; }
    std::string operator()(const ImagePattern&) const { return ""; }
    std::string operator()(const SolidPattern& own) const { return solid_text(own); }
    std::string operator()(const Gradient& gradient) const {
        const DVec3 axis = normalize(gradient.axis);
        return "Fraction(" + text_of(axis.x) + "*x + " + text_of(axis.y) + "*y + " + text_of(axis.z) + "*z + 1e-10)";
    }
    std::string operator()(const Noise& noise) const { return "min(max(0.5 + " + octaves_text(noise) + ", 0), 1)"; }
    std::string operator()(const Marble& marble) const { return "Wave(" + moved("x", marble) + ")"; }
    std::string operator()(const Wood& wood) const { return "Wave(" + moved("sqrt(x*x + y*y)", wood) + ")"; }
};

}  // namespace

std::string pattern_text(const Pattern& pattern, const std::string& map, const std::string& item,
                         const std::function<std::string(const ColorStop&)>& own) {
    const auto& [kind, colors, transformations, by_uv] = pattern;
    std::string text;
    if (const std::string value = std::visit(ValueText{}, kind); !value.empty()) {
        text = (std::holds_alternative<SolidPattern>(kind) ? value : "function { " + value + " }") + " " + map + " {";
        const Opacity* const opacity = opacity_of(pattern);
        for (const ColorStop& stop : colors)
            text += " [" + text_of(opacity && opacity->limit > 0 ? opacity->limit : stop.at) + " " + own(stop) + "]";
        text += " }";
    } else {
        const Brick* const brick = std::get_if<Brick>(&kind);
        const auto part = [&](const ColorStop& stop) {
            return item.empty() ? own(stop) : item + " { " + own(stop) + " }";
        };
        text = std::string(brick ? "brick " : "checker ") + part(colors[0]) + ", " + part(colors[1]);
        if (brick) text += " brick_size " + text_of(brick->size) + " mortar " + text_of(brick->mortar);
    }
    for (const Transformation& step : transformations) text += " " + step_text(step);
    return (by_uv ? "uv_mapping " : "") + text;
}

std::string pigment_text(const Pigment& pigment, const std::string& more) {
    const auto color = [&](const Color& c, double filter = 0, double transmit = 0) {
        return "rgb " + text_of(c) + (filter > 0 ? " filter " + text_of(filter) : "") +
               (transmit > 0 ? " transmit " + text_of(transmit) : "") + more;
    };
    if (!pigment.pattern) return color(pigment.color, pigment.filter, pigment.transmit);
    const Pattern& pattern = *pigment.pattern;
    if (const auto* const image = std::get_if<ImagePattern>(&pattern.kind)) {
        std::string text = image_text(*image, more);
        for (const Transformation& step : pattern.transformations) text += " " + step_text(step);
        return (pattern.by_uv ? "uv_mapping " : "") + text;
    }
    const auto own = [&](const ColorStop& stop) {
        return stop.pattern ? pigment_text(Pigment(*stop.pattern), more)
                            : color(stop.color, stop.filter, stop.transmit);
    };
    return pattern.nests() ? pattern_text(pattern, "pigment_map", "pigment", own)
                           : pattern_text(pattern, "color_map", "", own);
}

std::string normal_text(const Bump& bump) {
    if (!bump.pattern) return "";
    // POV-Ray's size of 1 is 0.1 / accuracy times the sum over the corners that scene/pattern.h describes.
    constexpr double size_of_height = 3 / (4 * .1);
    const ImagePattern* const image = std::get_if<ImagePattern>(&bump.pattern->kind);
    const SolidPattern* const solid = std::get_if<SolidPattern>(&bump.pattern->kind);
    // Behind the words of a solid pattern its amount needs a word as well.
    std::string text = std::string(bump.pattern->by_uv ? "normal { uv_mapping " : "normal { ") +
                       (image   ? "pigment_pattern { " + image_text(*image, "", true) + " } "
                        : solid ? solid_text(*solid) + " bump_size "
                                : "function { " + std::visit(ValueText{}, bump.pattern->kind) + " } ") +
                       text_of(solid ? bump.height : size_of_height * bump.height) + " accuracy " +
                       text_of(bump.step());
    for (const Transformation& step : bump.pattern->transformations) text += " " + step_text(step);
    return text + " }";
}

std::string function_section(const Scene& scene) {
    const auto any = [&](const auto& test) {
        bool found = false;
        const auto look = [&](const Pattern& own) {
            each_nested(own, [&](const Pattern& p) { found |= std::visit(test, p.kind); });
        };
        if (scene.background.pattern) look(*scene.background.pattern);
        for (const Pigment& coat : scene.background_coats)
            if (coat.pattern) look(*coat.pattern);
        for (const Material& material : scene.materials)
            material.each_pattern([&](const Pattern& own) {
                if (&own != material.normal.pattern.get()) look(own);  // POV-Ray has no such images
            });
        return found;
    };
    const bool images = any([]<class Kind>(const Kind& kind) {
        if constexpr (std::is_same_v<Kind, SolidPattern>)
            return opacity_of(kind) != nullptr;
        else
            return std::is_same_v<Kind, ImagePattern>;
    });
    const bool maps = any([]<class Kind>(const Kind&) { return has_map<Kind> && !std::is_same_v<Kind, SolidPattern>; });
    if (!images && !maps) return "";
    std::string text = heading("Patterns") + (images ? image_macro(scene.settings.assumed_gamma) : "");
    if (!maps) return text;
    text +=
        "#declare Fraction = function(a) { a - floor(a) };\n"
        "#declare Wave = function(a) { 1 - abs(2*Fraction(a) - 1) };\n";
    if (!any([](const auto& kind) {
            return requires { kind.octaves; }
            &&!requires { kind.solid; };
        }))
        return text;
    text += comment(
        "Gradient noise over cells of whole coordinates, their corners hashed by a permutation polynomial. POV-Ray's "
        "own noise is a table of random numbers.");
    return text +
           "#declare Mod289 = function(a) { a - 289*floor((a + 0.5)/289) };\n"
           "#declare Permuted = function(a) { Mod289((34*a + 1)*a) };\n"
           "#declare Seventh = function(a) { floor((a + 0.5)/7) };\n"
           "#declare Slope = function(a, b, c, x, y, z) { ((a - 7*b - 3)*x + (b - 7*c - 3)*y)/3 + (c - 2.5)/2.5*z };\n"
           "#declare Corner = function(a, x, y, z) { Slope(a, Seventh(a), Seventh(Seventh(a)), x, y, z) };\n"
           "#declare Fade = function(a) { a*a*a*(a*(a*6 - 15) + 10) };\n"
           "#declare Mix = function(a, b, s) { a + s*(b - a) };\n"
           "#declare Along_Z = function(a, x, y, z, k, s) {\n"
           "  Mix(Corner(Permuted(a + k), x, y, z), Corner(Permuted(a + k + 1), x, y, z - 1), s) };\n"
           "#declare Along_Y = function(a, x, y, z, j, k, r, s) {\n"
           "  Mix(Along_Z(Permuted(a + j), x, y, z, k, s), Along_Z(Permuted(a + j + 1), x, y - 1, z, k, s), r) };\n"
           "#declare In_Cell = function(x, y, z, i, j, k, r, s) {\n"
           "  Mix(Along_Y(Permuted(i), x, y, z, j, k, r, s), Along_Y(Permuted(i + 1), x - 1, y, z, j, k, r, s),\n"
           "      Fade(x))/2 };\n"
           "#declare Noise = function(x, y, z) {\n"
           "  In_Cell(Fraction(x), Fraction(y), Fraction(z), Mod289(floor(x)), Mod289(floor(y)), Mod289(floor(z)),\n"
           "          Fade(Fraction(y)), Fade(Fraction(z))) };\n";
}

}  // namespace strahl
