#include "povref/unit.h"

#include <algorithm>
#include <cmath>

#include "scene/overlap.h"

namespace strahl {
namespace {

double length(const DVec3& v) { return std::hypot(v.x, v.y, v.z); }

/// The distance from `eye` of the farthest point of a body that must be within reach: of a plane, its nearest.
double reach(const Primitive& primitive, const DVec3& eye) {
    if (const auto* plane = std::get_if<Plane>(&primitive.shape)) {
        const DVec3 a(matrix(primitive.transformations) * glm::dvec4(plane->a, 1));
        return length(a - eye);
    }
    const Box box = world_bounds(primitive);
    return length({std::max(eye.x - box.low.x, box.high.x - eye.x), std::max(eye.y - box.low.y, box.high.y - eye.y),
                   std::max(eye.z - box.low.z, box.high.z - eye.z)});
}

}  // namespace

Unit unit_for(const Scene& scene, const std::vector<Camera>& cameras) {
    double farthest = 0, smallest = std::numeric_limits<double>::infinity();
    for (const Camera& camera : cameras) {
        for (const Primitive& primitive : scene.primitives)
            farthest = std::max(farthest, reach(primitive, camera.position));
        for (const Light& light : scene.lights) farthest = std::max(farthest, length(light.position - camera.position));
    }
    for (const Primitive& primitive : scene.primitives) {
        const DVec3 size = world_bounds(primitive).size();
        smallest = std::min({smallest, size.x, size.y, size.z});
    }
    if (farthest == 0) return {};
    const double least = std::ceil(std::log10(std::max(1e3 / farthest, 10 / smallest)));
    const double most = std::floor(std::log10(1e6 / farthest));
    const double power = least > most ? most : std::clamp(0., least, most);
    const double unit = std::pow(10., power);
    Unit result{unit, ""};
    if (smallest * unit < 1)
        result.fault =
            "bodies differ so much in size that POV-Ray, which counts nothing nearer than 1e-3 as a shadow caster, may "
            "lose shadows and inner faces of the smallest";
    return result;
}

}  // namespace strahl
