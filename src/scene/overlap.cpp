#include "scene/overlap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/matrix.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "num/box_tree.h"
#include "scene/leaves.h"

namespace strahl {
namespace {

/// A transparent body: a box around it, and its shape if that is one of two simple ones.
struct TransparentBody {
    Box box;
    std::optional<Ball> ball;        // if it is one
    std::optional<HalfSpace> space;  // if it is one
    double distance = 0;             // of the half-space normal . x < distance
};

TransparentBody body_of(const Primitive& primitive) {
    TransparentBody body;
    body.box = world_bounds(primitive);
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

bool apart(const Box& a, const Box& b) {
    for (int c = 0; c < 3; ++c)
        if (a.high[c] <= b.low[c] || b.high[c] <= a.low[c]) return true;
    return false;
}

bool may_overlap(const TransparentBody& a, const TransparentBody& b) {
    if (b.space && !a.space) return may_overlap(b, a);
    if (a.space && b.space) return !(dot_product(a.space->normal, b.space->normal) == -1 && a.distance <= -b.distance);
    if (a.space) {
        const DVec3& normal = a.space->normal;
        if (b.ball) return dot_product(normal, b.ball->centre) - a.distance < b.ball->radius;
        DVec3 deepest;  // the corner furthest into the half-space
        for (int c = 0; c < 3; ++c) deepest[c] = normal[c] > 0 ? b.box.low[c] : b.box.high[c];
        return dot_product(normal, deepest) < a.distance;
    }
    if (apart(a.box, b.box)) return false;
    if (!a.ball || !b.ball) return true;
    const DVec3 d = a.ball->centre - b.ball->centre;
    return std::sqrt(dot_product(d, d)) < a.ball->radius + b.ball->radius;
}

}  // namespace

Box world_bounds(const Primitive& primitive) { return transformed_bounds(primitive, glm::dmat4(1)); }

Box transformed_bounds(const Primitive& primitive, const glm::dmat4& to_world) {
    return transformed_bounds(primitive.shape, to_world * matrix(primitive.transformations));
}
Box transformed_bounds(const Shape& any, const glm::dmat4& m) {
    return std::visit(
        [&](const auto& shape) {
            if constexpr (requires { shape.bounds(m); })  // of a composite it may be infinite on some sides alone
                if (m != glm::dmat4(1)) return shape.bounds(m);
            const Box own = shape.bounds();
            return m != glm::dmat4(1) && own.finite() ? transformed(own, m) : own;
        },
        any);
}

double reach_from(const DVec3& point, const Primitive& primitive) {
    double most = 0;
    const auto look = [&](const Box& box) {
        if (!box.finite()) return;
        for (int c = 0; c < 3; ++c)
            most = std::max({most, std::abs(box.low[c] - point[c]), std::abs(box.high[c] - point[c])});
    };
    look(world_bounds(primitive));
    for_each_leaf(primitive, [&](const Primitive& leaf, const glm::dmat4& to_world) {
        look(transformed_bounds(leaf.shape, to_world));
    });
    return most;
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

bool contains(const Primitive& primitive, const DVec3& p) {
    const DVec3 local = transform_point(glm::inverse(matrix(primitive.transformations)), p);
    return std::visit([&](const auto& shape) { return shape.contains(local); }, primitive.shape);
}

namespace {

/// Looks for a pair of bodies that may overlap.
struct OverlapSearch {
    const std::vector<TransparentBody>& bodies;
    const BoxTree& tree;
    bool found = false;

    bool skips(const BoxTree::Subtree& a, const BoxTree::Subtree& b) const {
        return found || apart(tree.box(a), tree.box(b));
    }
    void meet(std::size_t a, std::size_t b) { found |= may_overlap(bodies[a], bodies[b]); }
    void leave(const BoxTree::Subtree&) const {}
};

/// Returns whether the shape has an inside. A ray that goes through a surface without one is in its medium until it
/// goes through once more.
bool closed(const Shape& shape) {
    return std::visit([]<class Kind>(const Kind&) { return Kind::closed; }, shape);
}

}  // namespace

bool transparent_bodies_overlap(const Scene& scene) {
    std::vector<TransparentBody> planes, bodies;
    for (const Primitive& primitive : scene.primitives)
        if (transparent(scene, primitive)) {
            if (!closed(primitive.shape)) return true;
            const TransparentBody body = body_of(primitive);
            for (const TransparentBody& plane : planes)
                if (may_overlap(plane, body)) return true;
            (body.space ? planes : bodies).push_back(body);
        }
    for (const TransparentBody& plane : planes)
        for (const TransparentBody& body : bodies)
            if (may_overlap(plane, body)) return true;
    std::vector<Box> boxes;
    for (const TransparentBody& body : bodies) boxes.push_back(body.box);
    const BoxTree tree(std::move(boxes));
    OverlapSearch search{bodies, tree};
    tree.visit_pairs(search);
    return search.found;
}

}  // namespace strahl
