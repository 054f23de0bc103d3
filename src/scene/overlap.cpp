#include "scene/overlap.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace strahl {
namespace {

/// A transparent body: what of it is known exactly, and a box around it.
struct Body {
    Box box;
    std::optional<Ball> ball;        // if it is one
    std::optional<HalfSpace> space;  // likewise
    double distance = 0;             // of the half-space normal . x < distance
};

Body body_of(const Primitive& primitive) {
    Body body{.box = world_bounds(primitive)};
    body.space = half_space(primitive);
    if (body.space) body.distance = dot_product(body.space->normal, body.space->point);
    const glm::dmat4 m = matrix(primitive.transformations);
    const double factor = similarity(primitive.transformations);
    std::visit(
        [&](const auto& shape) {
            if constexpr (requires { shape.ball(m, factor); })
                if (factor > 0) body.ball = shape.ball(m, factor);
        },
        primitive.shape);
    return body;
}

bool may_overlap(const Body& a, const Body& b) {
    if (b.space && !a.space) return may_overlap(b, a);
    if (a.space && b.space) return !(dot_product(a.space->normal, b.space->normal) == -1 && a.distance <= -b.distance);
    if (a.space) {
        const DVec3& normal = a.space->normal;
        if (b.ball) return dot_product(normal, b.ball->centre) - a.distance < b.ball->radius;
        DVec3 deepest;  // the corner furthest into the half-space
        for (int c = 0; c < 3; ++c) deepest[c] = normal[c] > 0 ? b.box.low[c] : b.box.high[c];
        return dot_product(normal, deepest) < a.distance;
    }
    for (int c = 0; c < 3; ++c)
        if (a.box.high[c] <= b.box.low[c] || b.box.high[c] <= a.box.low[c]) return false;
    if (!a.ball || !b.ball) return true;
    const DVec3 d = a.ball->centre - b.ball->centre;
    return std::sqrt(dot_product(d, d)) < a.ball->radius + b.ball->radius;
}

}  // namespace

Box world_bounds(const Primitive& primitive) {
    return std::visit(
        [&](const auto& shape) {
            const Box own = shape.bounds();
            if (primitive.transformations.empty() || !own.finite()) return own;
            const glm::dmat4 m = matrix(primitive.transformations);
            if constexpr (requires { shape.bounds(m); })
                return shape.bounds(m);
            else
                return transformed(own, m);
        },
        primitive.shape);
}

std::optional<HalfSpace> half_space(const Primitive& primitive) {
    return std::visit(
        [&]<class Kind>(const Kind& shape) -> std::optional<HalfSpace> {
            if constexpr (!Kind::bounded)
                return shape.half_space(matrix(primitive.transformations));
            else
                return {};
        },
        primitive.shape);
}

bool transparent_bodies_overlap(const Scene& scene) {
    std::vector<Body> planes, bodies;
    for (const Primitive& primitive : scene.primitives)
        if (scene.materials[primitive.material].refraction > 0) {
            const Body body = body_of(primitive);
            for (const Body& plane : planes)
                if (may_overlap(plane, body)) return true;
            (body.space ? planes : bodies).push_back(body);
        }
    for (const Body& plane : planes)
        for (const Body& body : bodies)
            if (may_overlap(plane, body)) return true;
    // Sweep along x: only bodies whose boxes overlap there are compared.
    std::sort(bodies.begin(), bodies.end(), [](const Body& a, const Body& b) { return a.box.low.x < b.box.low.x; });
    std::vector<const Body*> open;
    for (const Body& body : bodies) {
        std::erase_if(open, [&](const Body* other) { return other->box.high.x <= body.box.low.x; });
        for (const Body* other : open)
            if (may_overlap(*other, body)) return true;
        open.push_back(&body);
    }
    return false;
}

}  // namespace strahl
