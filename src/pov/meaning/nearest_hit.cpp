#include "pov/meaning/nearest_hit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "num/ray.h"
#include "num/vec_math.h"
#include "scene/leaves.h"
#include "scene/overlap.h"

namespace strahl::pov {
namespace {

struct SurfaceCrossing {
    double t;
    DVec3 normal;
};

/// Adds where a ray crosses the surface of a simple body.
void add_crossings(std::vector<SurfaceCrossing>& all, const Primitive& leaf, const glm::dmat4& to_world,
                   const Ray<double>& ray) {
    const auto look = [&](const auto& kernel) {
        const auto add = [&](double t, double face) {
            if constexpr (requires { kernel.at(ray, t, face); })
                if (t > 1e-4 && t < 1e7) all.push_back({t, kernel.at(ray, t, face).normal});
        };
        if constexpr (requires { kernel.crossings(ray, -1.); }) {
            const auto found = kernel.crossings(ray, -1.);
            if (!any(found.hit)) return;
            for (const double t : found.t) add(t, 0);
        } else if constexpr (requires { kernel.span(ray, -1.); }) {
            const auto span = kernel.span(ray, -1.);
            if (!any(span.hit)) return;
            add(span.near, span.near_face), add(span.far, span.far_face);
        }
    };
    std::visit(
        [&](const auto& kind) {
            kind.template emit<double>(WorldTransform{to_world, 0, DVec3(0), 1}, look);
        },
        leaf.shape);
}

}  // namespace

bool nearest_hit(const std::vector<Primitive>& bodies, const DVec3& from, const DVec3& direction, DVec3& hit,
                 DVec3& normal) {
    const double size = length(direction);
    if (!(size > 0)) return false;
    const Ray<double> ray{from, direction / size, {}};
    double nearest = std::numeric_limits<double>::infinity();
    std::vector<SurfaceCrossing> all;
    for (const Primitive& body : bodies) {
        all.clear();
        bool simple = true;
        for_each_leaf(body, [&](const Primitive& leaf, const glm::dmat4& m) {
            simple &= &leaf == &body;
            add_crossings(all, leaf, m, ray);
        });
        std::ranges::sort(all, {}, &SurfaceCrossing::t);
        // A composite has a surface where one of its parts has one and only one side of it is inside.
        const auto is_inside = [&](double t) { return contains(body, from + t * ray.direction); };
        for (std::size_t i = 0; i < all.size(); ++i) {
            const double t = all[i].t;
            if (t >= nearest) break;
            const double before = i > 0 ? all[i - 1].t : 0, behind = i + 1 < all.size() ? all[i + 1].t : 2 * t + 1;
            if (!simple && is_inside((before + t) / 2) == is_inside((t + behind) / 2)) continue;
            nearest = t, normal = all[i].normal;
            if (!simple && is_inside((t + behind) / 2) == (dot_product(normal, ray.direction) > 0)) normal = -normal;
        }
    }
    if (!std::isfinite(nearest)) return false;
    hit = from + nearest * ray.direction;
    return true;
}

}  // namespace strahl::pov
