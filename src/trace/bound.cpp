#include "trace/bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace strahl {
namespace {

double largest(const Color& c) { return std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}); }

/// Most by which the bodies on its way can multiply a light: glass of a colour above 1 brightens it.
double gain(const Scene& scene) {
    const auto filter = [](const Material& m) { return m.refraction * largest(m.rgb); };
    double product = 1;
    if (std::any_of(scene.materials.begin(), scene.materials.end(), [&](const auto& m) { return filter(m) > 1; }))
        for (const Primitive& primitive : scene.primitives) {
            const double factor = filter(scene.materials[primitive.material]);
            if (factor > 1) product *= factor * factor;  // entered and left
        }
    return product;
}

/// Most light that a surface of this material sends back by itself.
double own_light(const Scene& scene, const Material& m, double gain) {
    Color sum = scene.settings.ambient_light * m.rgb * m.ambient;
    for (const Light& light : scene.lights)
        for (int c = 0; c < 3; ++c) sum[c] += gain * std::abs(light.color[c]) * (m.diffuse * m.rgb[c] + m.specular);
    return largest(sum);
}

/// Most that all generations past `depth` can add: a geometric series.
double truncated(const Scene& scene, double gain, int depth) {
    double keeps = 0, endless = largest(scene.background);
    for (const Material& m : scene.materials) keeps = std::max(keeps, m.reflection + m.refraction);
    if (keeps == 0) return 0;
    if (keeps >= 1) return std::numeric_limits<double>::infinity();
    for (const Material& m : scene.materials)
        endless = std::max(endless, own_light(scene, m, gain) / (1 - m.reflection - m.refraction));
    return std::pow(keeps, depth) * endless;
}

}  // namespace

double path_factor(double coefficient, double other) {
    return std::sqrt(coefficient) * (std::sqrt(coefficient) + std::sqrt(other));
}

Bound bound_for(const Scene& scene, int depth, double error) {
    // B(n) = max(background, own + (Kr + Kt) B(n - 1)) over all materials, from the last generation upwards.
    const double background = largest(scene.background);
    double brightest = 0;
    std::vector<double> own;
    const double most_gain = gain(scene);
    for (const Material& m : scene.materials) own.push_back(own_light(scene, m, most_gain));
    for (int generation = 0; generation < depth; ++generation) {
        double most = background;
        for (std::size_t i = 0; i < own.size(); ++i) {
            const Material& m = scene.materials[i];
            most = std::max(most, own[i] + (m.reflection + m.refraction) * brightest);
        }
        brightest = most;
    }
    Bound bound{.brightest = brightest};
    bound.cutoff = brightest > 0 ? .75 * error / brightest : 0;
    if (!scene.lights.empty())
        bound.faint = .25 * error / (depth * most_gain * static_cast<double>(scene.lights.size()));
    bound.truncated = truncated(scene, most_gain, depth);
    return bound;
}

int depth_for(const Scene& scene, double error) {
    const double most_gain = gain(scene);
    int depth = 1;
    while (depth < 256 && truncated(scene, most_gain, depth) > error) ++depth;
    return depth;
}

}  // namespace strahl
