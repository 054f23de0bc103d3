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

/// Returns the share that a surface sends on at most: reflected, or refracted, or reflected totally.
double sent_on(const Material& m) {
    double reflected = m.reflection * largest(m.mirror) * std::max(1., m.gilding * largest(m.rgb.color));
    for (const Material& coat : m.coats)
        reflected += coat.reflection * largest(coat.mirror) * std::max(1., coat.gilding * largest(coat.rgb.color));
    const double through = m.clarity * std::max(m.refraction, largest(m.passed(Color(m.refraction))));
    return reflected * m.most_share() + (m.transmits() && m.rgb.clear() ? std::max(m.clarity, through) : through);
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

/// Most light that a surface of this material sends back by itself.
double own_light(const Scene& scene, const Material& m, double gain) {
    Color sum = scene.settings.ambient_light * m.rgb.color * m.ambient * m.glow;
    const double tint = std::max(1., m.metallic * largest(m.rgb.color));
    const double diffuse = std::max(m.diffuse, m.behind) * most_power(m.brilliance);
    const double shine = m.specular * most_power(m.pow) + m.blinn * most_power(m.roughness);
    for (const Light& light : scene.lights)
        for (int c = 0; c < 3; ++c)
            sum[c] += gain * (light.fades() ? 2 : 1) * std::abs(light.color[c]) * off_axis(light) *
                      (diffuse * m.rgb.color[c] + shine * tint);
    double all = largest(sum);
    for (const Material& coat : m.coats) all += own_light(scene, coat, gain);
    return all * m.most_share() * (1 + m.irid);
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
    // filters multiplies all that is seen through it.
    const Fog fog = scene.fog.value_or(Fog());
    const double tint = std::max(1., 1 - fog.filter + fog.filter * largest(fog.color));
    double sky = largest(scene.background.color);
    for (const Pigment& coat : scene.background_coats)
        sky = largest(coat.color) + std::max(1., coat.filter * largest(coat.color) + coat.transmit) * sky;
    const double background = std::max(tint * sky, scene.fog ? largest(fog.color) : 0);
    std::vector<double> own, sent;
    const double most_gain = gain(scene);
    for (const Material& m : scene.materials) own.push_back(own_light(scene, m, most_gain)), sent.push_back(sent_on(m));
    Bound bound{{0}, background, most_gain};
    for (int generation = 0; generation < depth; ++generation) {
        double most = background;
        for (std::size_t i = 0; i < own.size(); ++i)
            most = std::max(most, tint * (own[i] + sent[i] * bound.brightest.back()));
        bound.brightest.push_back(most);
    }
    // A geometric series.
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
    for (const Light& light : scene.lights) lights += largest(light.color) * off_axis(light);
    const double most_gain = gain(scene);
    std::vector<double> light;
    for (const Material& m : scene.materials)
        light.push_back(faint_share * most_gain * lights * m.diffuse * largest(m.rgb.color));
    return light;
}

}  // namespace strahl
