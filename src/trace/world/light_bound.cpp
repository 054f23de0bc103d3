#include "trace/world/light_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "scene/leaves.h"
#include "trace/world/world.h"

namespace strahl {
namespace {

double largest(const Color& c) { return std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}); }

/// Returns the most that powers of cosines can be, see signed_power; in the cone of a spot these are not below `least`.
double most_power(double exponent, double least = 0) {
    return exponent < 0 ? std::min(std::pow(std::max(least, 0.), exponent), 1e9) : 1;
}
/// Returns by how much a light is brighter off its axis than on it.
double off_axis(const Light& light) {
    if (!light.spot) return most_power(light.tightness);
    return most_power(light.spot->tightness, std::cos(light.spot->falloff * std::numbers::pi / 180));
}

/// Returns how often a line crosses a shape at most.
double most_crossings(const Shape& shape) {
    return std::visit(
        []<class Kind>(const Kind& kind) -> double {
            if constexpr (requires { kind.data->triangles; })
                return static_cast<double>(kind.data->triangles.size());
            else if constexpr (std::is_same_v<Kind, Blob>)
                return 8. * static_cast<double>(kind.data->pieces.size());  // 4 between each two of their ends
            else if constexpr (std::is_same_v<Kind, SphereSweep>)
                return 6. * static_cast<double>(kind.data->pieces.size());  // in and out, up to three times each
            else if constexpr (std::is_same_v<Kind, JuliaFractal>)
                return 2 * kind.precision * kind.radius();  // one for each step through the ball around it
            else if constexpr (lists_crossings<Kind>)
                return (std::is_same_v<Kind, Lathe> ? 6. : 2.) * kind.face_count();
            else
                return std::max(2, Kind::max_crossings);
        },
        shape);
}

/// Returns the largest factor that a metal of this colour, or a darker one, gives light: 1 + s m (c - 1), where s is
/// between 0 and 1.
double most_tint(double metallic, const Color& color) {
    return std::max({1., std::abs(1 - metallic), std::abs(1 + metallic * (largest(color) - 1))});
}

/// Returns by how much the colours of a layer multiply light that comes through it, at most.
double passes(const Material& m) { return m.rgb.filter * largest(m.rgb.color) + m.rgb.transmit + m.refraction; }

/// Returns the sum of what its layers have each, of which upper ones let no more through than they do.
template <class Of>
double sum_of_layers(const Material& m, const Of& of) {
    double sum = of(m);
    for (const Material& coat : m.coats) sum = sum * std::max(1., passes(coat)) + of(coat);
    return sum * m.most_share();
}

/// Returns the most of facing + (1 - facing) x, see Material; 1 - the cosine is up to 2 where normals are bent.
double most_facing(const Material& m, bool bends) {
    if (m.facing == 1 || m.fresnel > 0) return 1;
    const double most = m.falloff < 0 ? most_power(m.falloff) : bends ? std::pow(2, m.falloff) : 1;
    return m.facing + (1 - m.facing) * std::min(most, 1e9);
}

/// Returns the share that a surface sends on at most: reflected, or refracted, or reflected totally.
double sent_on(const Material& m) {
    const double reflected = sum_of_layers(m, [&](const Material& layer) {
        return layer.reflection * largest(layer.mirror) * most_tint(layer.gilding, layer.rgb.color) * (1 + layer.irid) *
               most_facing(layer, m.bends());
    });
    double through = m.clarity * std::max(m.refraction, largest(m.passed(Color(m.refraction))));
    const bool clear = m.transmits() && m.rgb.clear();
    if (clear) through = std::max(m.clarity, through);
    const double total = m.transmits() ? clear ? m.clarity : m.reflection + m.refraction : 0;
    return std::max(reflected + through, total);
}

/// Returns by how much the bodies on its way can multiply a light at most: glass of a colour above 1 brightens it.
double gain(const Scene& scene) {
    const auto filter = [](const Material& m) { return largest(m.passed(m.refraction * m.rgb.color)); };
    double product = 1;
    if (std::any_of(scene.materials.begin(), scene.materials.end(), [&](const auto& m) { return filter(m) > 1; }))
        for (const Primitive& primitive : scene.primitives)
            for_each_leaf(primitive, [&](const Primitive& leaf, const glm::dmat4&) {
                const double factor = filter(scene.materials[leaf.material]);
                if (factor > 1) product *= std::pow(factor, most_crossings(leaf.shape));
            });
    return std::min(product, std::numeric_limits<double>::max());  // infinity times nothing would be no number
}

/// Returns the most of a light's colour: lights may be brighter near them and off their axes.
Color most_of(const Light& light) {
    Color color = light.color * (light.fades() ? 2. : 1.) * off_axis(light);
    for (int c = 0; c < 3; ++c) color[c] = std::abs(color[c]);
    return color;
}

/// Most light of all lights that a surface of this material sends back, and if `glows` of its own.
double own_light(const Scene& scene, const Material& m, double gain, bool glows) {
    return sum_of_layers(m, [&](const Material& layer) {
        const Pigment& rgb = layer.rgb;
        Color sum = glows ? scene.settings.ambient_light * rgb.color * layer.ambient * layer.glow : Color(0);
        const double diffuse = std::max(layer.diffuse, layer.behind) * most_power(layer.brilliance);
        const double shine = (layer.specular * most_power(layer.pow) + layer.blinn * most_power(layer.roughness)) *
                             most_tint(layer.metallic, rgb.color);
        for (const Light& light : scene.lights)
            sum += gain * (1 + layer.irid) * most_of(light) * (diffuse * rgb.color + Color(shine));
        // Where more comes through than there is, POV-Ray scatters less than nothing.
        return largest(sum) * std::max(1., rgb.filter + rgb.transmit - 1);
    });
}

/// Returns the scene with bounds that hold for its pictures as values of an assumed_gamma above 1: the root of a pixel
/// is larger than the pixel, but not above 1 unless the pixel is.
std::optional<Scene> with_raised_pictures(const Scene& scene) {
    if (scene.settings.assumed_gamma <= 1) return std::nullopt;
    Scene raised = scene;
    const auto raise = [](Pigment& own) {
        if (own.pattern && std::holds_alternative<ImagePattern>(own.pattern->kind))
            own.color = max(own.color, Color(1));
    };
    raise(raised.background);
    for (Pigment& coat : raised.background_coats) raise(coat);
    for (Material& material : raised.materials) {
        raise(material.rgb);
        for (Material& coat : material.coats) raise(coat.rgb);
    }
    return raised;
}

}  // namespace

Bound bound_for(const Scene& given, int depth) {
    const std::optional<Scene> raised = with_raised_pictures(given);
    const Scene& scene = raised ? *raised : given;
    // B(n) = max(background, own + (Kr + Kt) B(n - 1)) over all materials, from the last generation upwards; a fog that
    // filters multiplies all that is seen through it. Rays that surfaces are not there for bring B(n - 1), which is
    // less.
    const Fog fog = scene.fog.value_or(Fog());
    const double tint = std::max(1., 1 - fog.filter + fog.filter * largest(fog.color));
    double sky = largest(scene.background.color);
    for (const Pigment& coat : scene.background_coats)
        sky = largest(coat.color) + std::max(1., coat.filter * largest(coat.color) + coat.transmit) * sky;
    const double background = std::max(tint * sky, scene.fog ? largest(fog.color) : 0);
    std::vector<double> own, sent;
    const double most_gain = gain(scene);
    for (const Material& m : scene.materials)
        own.push_back(own_light(scene, m, most_gain, true)), sent.push_back(sent_on(m));
    constexpr int deepest = 256;  // generations, if rays go straight on through clear surfaces and hidden bodies
    const auto is_clear = [](const Material& m) {
        return m.seen == 0 || m.mirrored == 0 || (m.transmits() && m.rgb.clear());
    };
    const int generations = std::ranges::any_of(scene.materials, is_clear) ? deepest : depth;
    Bound bound{depth, {0}, background, most_gain};
    for (int generation = 0; generation < generations; ++generation) {
        double most = background;
        for (std::size_t i = 0; i < own.size(); ++i)
            most = std::max(most, tint * (own[i] + sent[i] * bound.brightest.back()));
        bound.brightest.push_back(most);
    }
    // The bound for any number of generations is a geometric series.
    for (std::size_t i = 0; i < own.size(); ++i) {
        const double lost = 1 - tint * sent[i];
        const double series = lost > 0 ? tint * own[i] / lost : std::numeric_limits<double>::infinity();
        bound.limit = std::max(bound.limit, series);
    }
    return bound;
}

std::vector<double> scattered_light(const Scene& given) {
    const std::optional<Scene> raised = with_raised_pictures(given);
    const Scene& scene = raised ? *raised : given;
    double lights = 0;
    for (const Light& light : scene.lights) lights += largest(most_of(light));
    const double most_gain = gain(scene);
    std::vector<double> light;
    for (const Material& m : scene.materials)
        light.push_back(m.plain() ? faint_share * most_gain * lights * m.diffuse * largest(m.rgb.color)
                                  : own_light(scene, m, most_gain, false));
    return light;
}

std::vector<double> own_glow(const Scene& scene) {
    std::vector<double> light;
    for (const Material& m : scene.materials) light.push_back(own_light(scene, m, 0, true));
    return light;
}

}  // namespace strahl
