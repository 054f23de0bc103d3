#include "trace/bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strahl {
namespace {

double largest(const Color& c) { return std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}); }

/// Most light that a surface of this material sends back by itself.
double own_light(const Scene& scene, const Material& m) {
    Color sum = scene.settings.ambient_light * m.rgb * m.ambient;
    for (const Light& light : scene.lights)
        for (int c = 0; c < 3; ++c) sum[c] += std::abs(light.color[c]) * (m.diffuse * m.rgb[c] + m.specular);
    return largest(sum);
}

}  // namespace

Bound bound_for(const Scene& scene, int depth, double error) {
    // B(n) = max(background, own + (Kr + Kt) B(n - 1)) over all materials, from the last generation upwards.
    const double background = largest(scene.background);
    double brightest = 0, keeps = 0;
    for (const Material& m : scene.materials) keeps = std::max(keeps, m.reflection + m.refraction);
    const auto one_more = [&](double next) {
        double most = background;
        for (const Material& m : scene.materials)
            most = std::max(most, own_light(scene, m) + (m.reflection + m.refraction) * next);
        return most;
    };
    for (int generation = 0; generation < depth; ++generation) brightest = one_more(brightest);
    // Without end the same sum is a geometric series.
    double endless = std::numeric_limits<double>::infinity();
    if (keeps < 1) {
        endless = background;
        for (const Material& m : scene.materials)
            endless = std::max(endless, own_light(scene, m) / (1 - m.reflection - m.refraction));
    }
    Bound bound{.brightest = brightest};
    bound.cutoff = brightest > 0 ? error / brightest : 0;
    bound.dropped = bound.cutoff * brightest;
    bound.truncated = keeps == 0 ? 0 : std::pow(keeps, depth) * endless;
    return bound;
}

}  // namespace strahl
