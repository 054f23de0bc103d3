#include "scene/overlap.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <glm/matrix.hpp>
#include <optional>
#include <vector>

#include "scene/leaves.h"

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
    Body body;
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

Box world_bounds(const Primitive& primitive) { return transformed_bounds(primitive, glm::dmat4(1)); }

Box transformed_bounds(const Primitive& primitive, const glm::dmat4& to_world) {
    return transformed_bounds(primitive.shape, to_world * matrix(primitive.transformations));
}
Box transformed_bounds(const Shape& any, const glm::dmat4& m) {
    return std::visit(
        [&](const auto& shape) {
            const Box own = shape.bounds();
            if (m == glm::dmat4(1)) return own;
            if constexpr (requires { shape.bounds(m); })
                return shape.bounds(m);  // of a composite it may be infinite on some sides alone
            else
                return own.finite() ? transformed(own, m) : own;
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

bool apart(const Box& a, const Box& b) {
    for (int c = 0; c < 3; ++c)
        if (a.high[c] <= b.low[c] || b.high[c] <= a.low[c]) return true;
    return false;
}

/// Bodies halved down to single ones, with a box around each half. Two halves are compared only where their boxes meet:
/// where few do, n bodies take time n log n however they lie, and where many do, a pair that overlaps is soon found.
class OverlapTree {
  public:
    explicit OverlapTree(std::vector<Body>& all) : bodies(all), boxes(4 * all.size() + 1) { build(root()); }
    bool any() const { return within(root()); }

  private:
    struct Node {
        std::size_t index, first, count;  // its box and its bodies
        Node lower() const { return {2 * index + 1, first, count / 2}; }
        Node upper() const { return {2 * index + 2, first + count / 2, count - count / 2}; }
    };
    Node root() const { return {0, 0, bodies.size()}; }

    void build(const Node& node) {
        Box& box = boxes[node.index];
        if (node.count == 1) box = bodies[node.first].box;
        if (node.count < 2) return;
        halve(node);
        build(node.lower());
        build(node.upper());
        box.add(boxes[node.lower().index]);
        box.add(boxes[node.upper().index]);
    }

    /// By the lower ends along the axis on which they are spread the furthest.
    void halve(const Node& node) {
        const auto begin = bodies.begin() + std::ptrdiff_t(node.first);
        const auto end = begin + std::ptrdiff_t(node.count);
        Box lows;
        for (auto body = begin; body != end; ++body) lows.add(body->box.low);
        const DVec3 spread = lows.size();
        const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
        std::nth_element(begin, begin + std::ptrdiff_t(node.count / 2), end, [axis](const Body& a, const Body& b) {
            return std::strong_order(a.box.low[axis], b.box.low[axis]) < 0;
        });
    }

    bool within(const Node& node) const {
        if (node.count < 2) return false;
        return within(node.lower()) || within(node.upper()) || between(node.lower(), node.upper());
    }
    bool between(const Node& a, const Node& b) const {
        if (apart(boxes[a.index], boxes[b.index])) return false;
        if (a.count == 1 && b.count == 1) return may_overlap(bodies[a.first], bodies[b.first]);
        if (a.count < b.count) return between(a, b.lower()) || between(a, b.upper());
        return between(a.lower(), b) || between(a.upper(), b);
    }

    std::vector<Body>& bodies;
    std::vector<Box> boxes;
};

/// A ray that goes through a surface without an inside is in its medium until it goes through once more.
bool closed(const Shape& shape) {
    return std::visit([]<class Kind>(const Kind&) { return Kind::closed; }, shape);
}

}  // namespace

bool transparent_bodies_overlap(const Scene& scene) {
    std::vector<Body> planes, bodies;
    for (const Primitive& primitive : scene.primitives)
        if (transparent(scene, primitive)) {
            if (!closed(primitive.shape)) return true;
            const Body body = body_of(primitive);
            for (const Body& plane : planes)
                if (may_overlap(plane, body)) return true;
            (body.space ? planes : bodies).push_back(body);
        }
    for (const Body& plane : planes)
        for (const Body& body : bodies)
            if (may_overlap(plane, body)) return true;
    return OverlapTree(bodies).any();
}

}  // namespace strahl
