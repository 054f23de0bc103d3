#include "scene/ray_hits.h"

#include <algorithm>
#include <cmath>

#include "num/vec_math.h"
#include "scene/leaves.h"
#include "scene/overlap.h"

namespace strahl {
namespace {

/// Adds where a ray crosses the surface of a simple body.
void add_crossings(std::vector<RayHit>& all, const Primitive& leaf, int number, const glm::dmat4& to_world,
                   const Ray<double>& ray, double from) {
    const auto look = [&](const auto& kernel) {
        const auto add = [&](double t, double face) {
            if constexpr (requires { kernel.at(ray, t, face); })
                if (t > from && std::isfinite(t))
                    all.push_back({t, kernel.at(ray, t, face).normal, number, static_cast<int>(face)});
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

/// Does the ray, from its start on, meet the box?
bool meets(const Box& box, const Ray<double>& ray) {
    double near = 0, far = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        if (ray.direction[i] == 0) {
            if (!(box.low[i] <= ray.origin[i] && ray.origin[i] <= box.high[i])) return false;
            continue;
        }
        const double a = (box.low[i] - ray.origin[i]) / ray.direction[i];
        const double b = (box.high[i] - ray.origin[i]) / ray.direction[i];
        near = std::max(near, std::min(a, b)), far = std::min(far, std::max(a, b));
    }
    return near <= far * (1 + 1e-9) + 1e-9;
}

}  // namespace

std::vector<RayHit> ray_hits(const Primitive& body, const Ray<double>& ray, double from, double to) {
    std::vector<RayHit> all, hits;
    bool simple = true;
    int leaves = 0;
    for_each_leaf(body, [&](const Primitive& leaf, const glm::dmat4& m) {
        simple &= &leaf == &body;
        add_crossings(all, leaf, leaves++, m, ray, from);
    });
    std::ranges::sort(all, {}, &RayHit::t);
    const auto is_inside = [&](double t) { return contains(body, ray.origin + t * ray.direction); };
    for (std::size_t i = 0; i < all.size() && all[i].t < to; ++i) {
        RayHit hit = all[i];
        const double before = i > 0 ? all[i - 1].t : 0, behind = i + 1 < all.size() ? all[i + 1].t : 2 * hit.t + 1;
        if (!simple) {
            const bool leads_in = is_inside((hit.t + behind) / 2);
            if (is_inside((before + hit.t) / 2) == leads_in) continue;
            if (leads_in == (dot_product(hit.normal, ray.direction) > 0)) hit.normal = -hit.normal;
        }
        hits.push_back(hit);
    }
    return hits;
}

std::vector<BodyHit> bodies_along(const Scene& scene, const Ray<double>& ray) {
    std::vector<BodyHit> found;
    for (int body = 0; body < std::ssize(scene.primitives); ++body) {
        const Primitive& own = scene.primitives[body];
        if (!meets(world_bounds(own), ray)) continue;
        if (const std::vector<RayHit> hits = ray_hits(own, ray, 0); !hits.empty()) found.push_back({body, hits[0]});
    }
    std::ranges::stable_sort(found, {}, [](const BodyHit& at) { return at.hit.t; });
    return found;
}

}  // namespace strahl
