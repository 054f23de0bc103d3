#include "pov/meaning/coincident.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "scene/leaves.h"
#include "scene/overlap.h"

namespace strahl::pov {
namespace {

constexpr double hair = 1e-9;  // relative to coordinates

/// A flat face across an axis.
struct FlatFace {
    int axis = 0, side = 1;        // side: whether it faces up or down the axis
    double at = 0;                 // along the axis
    DVec3* point = nullptr;        // of the body, in its own space; one of its coordinates is the face's
    double scale = 1, offset = 0;  // from that coordinate to `at`
    Box box{};                     // around the body
    bool is_round = false;

    void move_to(double place) const { (*point)[axis] = (place - offset) / scale; }
    bool is_at(double place) const { return std::fabs(at - place) <= 1e-12 * (1 + std::fabs(at)); }
    bool beside(const FlatFace& other) const {
        if (axis != other.axis || !is_at(other.at)) return false;
        for (int i = 0; i < 3; ++i)
            if (i != axis && !(box.low[i] < other.box.high[i] && other.box.low[i] < box.high[i])) return false;
        return true;
    }
};

/// Returns the box around a body that stands along the axes where a matrix moves it.
Box bounds_in(const Primitive& body, const glm::dmat4& m) {
    const Box own = std::visit([](const auto& kind) { return kind.bounds(); }, body.shape);
    Box box;
    box.add(transform_point(m, own.low)), box.add(transform_point(m, own.high));
    return box;
}

/// Returns the flat faces of a simple body that stands along the axes; `outer` leads from around it to where they are.
std::vector<FlatFace> faces_of(Primitive& body, const glm::dmat4& outer) {
    if (!std::holds_alternative<Cuboid>(body.shape) && !std::holds_alternative<Cylinder>(body.shape)) return {};
    const glm::dmat4 m = outer * matrix(body.transformations);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if ((m[i][j] == 0) == (i == j)) return {};
    std::vector<FlatFace> faces;
    const Box around = bounds_in(body, m);
    const auto add = [&](DVec3& point, const DVec3& other, int axis) {
        FlatFace own{.axis = axis, .point = &point, .scale = m[axis][axis], .offset = m[3][axis]};
        own.at = own.scale * point[axis] + own.offset;
        own.side = own.at > own.scale * other[axis] + own.offset ? 1 : -1;
        own.box = around;
        faces.push_back(own);
    };
    if (auto* const box = std::get_if<Cuboid>(&body.shape)) {
        for (int i = 0; i < 3; ++i) add(box->corner, box->opposite, i), add(box->opposite, box->corner, i);
    } else if (auto* const cylinder = std::get_if<Cylinder>(&body.shape)) {
        const DVec3 way = cylinder->cap - cylinder->base;
        for (int i = 0; i < 3; ++i) {
            if (way[i] == 0 || length(way) != std::fabs(way[i])) continue;
            add(cylinder->base, cylinder->cap, i), add(cylinder->cap, cylinder->base, i);
        }
        for (FlatFace& own : faces) own.is_round = true;
    }
    return faces;
}

/// Calls visit(leaf, matrix) for the simple bodies of a body, which it may change; `matrix` leads out of its
/// composites.
template <class Visit>
void change_leaves(Primitive& body, const glm::dmat4& outer, const Visit& visit) {
    const bool composite = std::visit([]<class Kind>(const Kind&) { return is_composite<Kind>; }, body.shape);
    if (!composite) return visit(body, outer);
    change_parts(body, [&](Primitive& part) { change_leaves(part, outer * matrix(body.transformations), visit); });
}

}  // namespace

void keep_faces(Primitive& body) {
    change_parts(body, [](Primitive& part) { keep_faces(part); });
    auto* const difference = std::get_if<Difference>(&body.shape);
    if (!difference) return;
    std::vector<Primitive> parts = *difference->parts;
    const std::vector<FlatFace> own = faces_of(parts[0], glm::dmat4(1));
    std::vector<bool> grows(own.size());
    for (std::size_t i = 1; i < parts.size() && !own.empty(); ++i)
        change_leaves(parts[i], glm::dmat4(1), [&](Primitive& leaf, const glm::dmat4& outer) {
            for (const FlatFace& taken : faces_of(leaf, outer))
                for (std::size_t k = 0; k < own.size(); ++k)
                    if (own[k].beside(taken) && own[k].side == taken.side && (taken.is_round || !own[k].is_round))
                        grows[k] = true;
        });
    if (std::ranges::none_of(grows, [](bool any) { return any; })) return;
    for (std::size_t k = 0; k < own.size(); ++k)
        if (grows[k]) own[k].move_to(own[k].at + own[k].side * hair * (1 + std::fabs(own[k].at)));
    difference->parts = std::make_shared<const std::vector<Primitive>>(std::move(parts));
}

void settle_faces(Scene& scene) {
    const DVec3 eye = scene.camera.position;
    std::vector<std::pair<int, double>> planes;
    for (const Primitive& body : scene.primitives) {
        const auto* const plane = std::get_if<Plane>(&body.shape);
        for (int c = 0; plane && body.transformations.empty() && c < 3; ++c)
            if (plane->a[c] == plane->b[c] && plane->b[c] == plane->c[c]) planes.emplace_back(c, plane->a[c]);
    }
    if (planes.empty() || planes.size() > 100) return;
    for (Primitive& body : scene.primitives)
        for (const FlatFace& own : faces_of(body, glm::dmat4(1))) {
            bool seen = (eye[own.axis] - own.at) * own.side > 0, within = true;
            for (int c = 0; c < 3; ++c) within &= eye[c] >= own.box.low[c] && eye[c] <= own.box.high[c];
            const double away = eye[own.axis] > own.at ? -1 : 1;
            if ((seen || within) && std::ranges::any_of(planes, [&](const auto& plane) {
                    return plane.first == own.axis && own.is_at(plane.second);
                }))
                own.move_to(own.at + away * hair * (1 + std::fabs(own.at)));
        }
}

}  // namespace strahl::pov
