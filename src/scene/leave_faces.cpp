#include "scene/leave_faces.h"

#include <algorithm>
#include <type_traits>

#include "num/vec_math.h"
#include "scene/kinds/composite.h"
#include "scene/overlap.h"
#include "scene/ray_hits.h"

namespace strahl {
namespace {

bool is_flat(const Shape& shape) {
    return std::visit(
        []<class Kind>(const Kind&) {
            return is_composite<Kind> || std::is_same_v<Kind, Cuboid> || std::is_same_v<Kind, Plane> ||
                   std::is_same_v<Kind, Disc> || std::is_same_v<Kind, Cylinder>;
        },
        shape);
}

}  // namespace

DVec3 off_faces(const Scene& scene, const Camera& camera, double reach, double rounding) {
    DVec3 eye = camera.position;
    const DVec3 way = .01 * (camera.look_at - eye);
    const double away = length(way);
    if (!(away > 0)) return eye;
    const DVec3 towards = way / away;
    const double far = length(eye) + away;  // what a hair is measured by, whatever the unit of length
    for (const Primitive& body : scene.primitives) {
        if (!is_flat(body.shape)) continue;
        const Box box = world_bounds(body);
        bool holds = true;
        for (int i = 0; i < 3; ++i) holds &= eye[i] >= box.low[i] - reach && eye[i] <= box.high[i] + reach;
        if (!holds) continue;
        const auto hits = ray_hits(body, {eye - reach * towards, towards, {}}, 0, 2 * reach);
        if (hits.empty()) continue;
        const DVec3 normal = hits[0].normal * (dot_product(hits[0].normal, towards) < 0 ? -1. : 1.);
        const double behind = (hits[0].t - reach) * dot_product(normal, towards);
        const double size = box.finite() ? length(box.high - box.low) : 0;
        eye = eye + (std::max(behind, 0.) + 1e-7 * far + rounding * (far + size)) * normal;
    }
    return eye;
}

}  // namespace strahl
