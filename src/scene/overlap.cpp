#include "scene/overlap.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <glm/matrix.hpp>
#include <vector>

namespace strahl {
namespace {

/// A transparent body: what of it is known exactly, and a box around it.
struct Body {
    Box box;
    const Sphere* sphere = nullptr;  // with `centre` and `radius` if it stayed one
    DVec3 centre{0};
    double radius = 0;
    bool plane = false;  // the half-space normal . x < distance
    DVec3 normal{0};
    double distance = 0;
};

double dot_product(const DVec3& a, const DVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Body body_of(const Primitive& primitive) {
    Body body{.box = world_bounds(primitive)};
    const glm::dmat4 m = matrix(primitive.transformations);
    const double s = similarity(primitive.transformations);
    if (const auto* sphere = std::get_if<Sphere>(&primitive.shape); sphere && s > 0) {
        body.sphere = sphere;
        body.centre = DVec3(m * glm::dvec4(sphere->centre, 1));
        body.radius = sphere->radius * s;
    } else if (const auto* plane = std::get_if<Plane>(&primitive.shape)) {
        body.plane = true;
        const DVec3 n = glm::transpose(glm::inverse(glm::dmat3(m))) * plane->normal();
        body.normal = n / std::sqrt(dot_product(n, n));
        body.distance = dot_product(body.normal, DVec3(m * glm::dvec4(plane->a, 1)));
    }
    return body;
}

bool may_overlap(const Body& a, const Body& b) {
    if (b.plane && !a.plane) return may_overlap(b, a);
    if (a.plane && b.plane) return !(dot_product(a.normal, b.normal) == -1 && a.distance <= -b.distance);
    if (a.plane) {
        if (b.sphere) return dot_product(a.normal, b.centre) - a.distance < b.radius;
        DVec3 deepest;  // the corner furthest into the half-space
        for (int c = 0; c < 3; ++c) deepest[c] = a.normal[c] > 0 ? b.box.low[c] : b.box.high[c];
        return dot_product(a.normal, deepest) < a.distance;
    }
    for (int c = 0; c < 3; ++c)
        if (a.box.high[c] <= b.box.low[c] || b.box.high[c] <= a.box.low[c]) return false;
    if (!a.sphere || !b.sphere) return true;
    const DVec3 d = a.centre - b.centre;
    return std::sqrt(dot_product(d, d)) < a.radius + b.radius;
}

}  // namespace

Box world_bounds(const Primitive& primitive) {
    const Box local = std::visit([](const auto& shape) { return shape.bounds(); }, primitive.shape);
    if (primitive.transformations.empty() || !local.finite()) return local;
    const glm::dmat4 m = matrix(primitive.transformations);
    Box box;
    if (const auto* sphere = std::get_if<Sphere>(&primitive.shape)) {  // exact: the rows' lengths
        const DVec3 centre = DVec3(m * glm::dvec4(sphere->centre, 1));
        DVec3 reach;
        for (int c = 0; c < 3; ++c) reach[c] = sphere->radius * std::hypot(m[0][c], m[1][c], m[2][c]);
        return {centre - reach, centre + reach};
    }
    for (int corner = 0; corner < 8; ++corner) {
        const DVec3 p{corner & 1 ? local.high.x : local.low.x, corner & 2 ? local.high.y : local.low.y,
                      corner & 4 ? local.high.z : local.low.z};
        box.add(DVec3(m * glm::dvec4(p, 1)));
    }
    return box;
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

}  // namespace

bool transparent_bodies_overlap(const Scene& scene) {
    std::vector<Body> planes, bodies;
    for (const Primitive& primitive : scene.primitives)
        if (scene.materials[primitive.material].refraction > 0) {
            const Body body = body_of(primitive);
            for (const Body& plane : planes)
                if (may_overlap(plane, body)) return true;
            (body.plane ? planes : bodies).push_back(body);
        }
    for (const Body& plane : planes)
        for (const Body& body : bodies)
            if (may_overlap(plane, body)) return true;
    return OverlapTree(bodies).any();
}

}  // namespace strahl
