#include "povref/convert/scale.h"

#include <algorithm>
#include <cmath>

#include "num/vec_math.h"
#include "scene/leaves.h"
#include "scene/overlap.h"

namespace strahl {
namespace {

double reach(const Box& box, const DVec3& eye) {
    return length({std::max(eye.x - box.low.x, box.high.x - eye.x), std::max(eye.y - box.low.y, box.high.y - eye.y),
                   std::max(eye.z - box.low.z, box.high.z - eye.z)});
}

/// Returns the distance from `eye` of the farthest point of a body, or of one point of a half-space.
double reach(const Primitive& primitive, const DVec3& eye) {
    if (const Box box = world_bounds(primitive); box.finite()) return reach(box, eye);
    double farthest = 0;
    for_each_leaf(primitive, [&](const Primitive& leaf, const glm::dmat4& whole) {
        const auto look = [&]<class Kind>(const Kind& kind) {
            if constexpr (Kind::bounded)
                farthest = std::max(farthest, reach(transformed(kind.bounds(), whole), eye));
            else
                farthest = std::max(farthest, length(kind.half_space(whole).point - eye));
        };
        std::visit(look, leaf.shape);
    });
    return farthest;
}

/// Returns the smallest of ... 1, 2, 5, 10, 20, 50 ... that is not below v.
double round_up(double v) {
    const double power = std::pow(10., std::floor(std::log10(v)));
    for (const double digit : {1., 2., 5.})
        if (digit * power >= v) return digit * power;
    return 10 * power;
}

bool has_horizon(const Scene& scene) {
    return std::any_of(scene.primitives.begin(), scene.primitives.end(),
                       [](const Primitive& primitive) { return !world_bounds(primitive).finite(); });
}

}  // namespace

void SceneSizes::add(const Scene& scene, const std::vector<Camera>& cameras) {
    for (const Camera& camera : cameras) {
        for (const Primitive& primitive : scene.primitives)
            farthest = std::max(farthest, reach(primitive, camera.position));
        for (const Light& light : scene.lights)
            if (!light.direction) farthest = std::max(farthest, length(light.position - camera.position));
    }
    for (const Primitive& primitive : scene.primitives) {
        // A flat body has no size across.
        const DVec3 size = world_bounds(primitive).size();
        const double flat = 1e-9 * std::max({size.x, size.y, size.z});
        for (int i = 0; i < 3; ++i)
            if (size[i] > flat) smallest = std::min(smallest, size[i]);
    }
    horizon |= has_horizon(scene);
}

PovScale scale_for(const SceneSizes& sizes) {
    const auto [farthest, smallest, horizon] = sizes;
    if (farthest == 0) return {};
    const double least = std::max((horizon ? 150 : 3e4) / farthest, 1 / smallest), most = 1e6 / farthest;
    const bool good = least <= 1 && farthest <= (horizon ? 1e4 : 1e6);
    const double factor = good ? 1 : std::min(round_up(least), round_up(most));
    PovScale result{factor, ""};
    if (smallest * factor < 0.1)
        result.fault =
            "bodies differ so much in size that POV-Ray, which counts nothing nearer than 1e-3 as a shadow caster, may "
            "lose shadows and inner faces of the smallest";
    return result;
}

}  // namespace strahl
