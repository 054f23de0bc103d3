#include "pov/meaning/coincident.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <limits>

#include "pov/meaning/part_faces.h"
#include "scene/leaves.h"
#include "scene/overlap.h"

namespace strahl::pov {
namespace {

constexpr double hair = 1e-9;    // relative to coordinates
constexpr double sliver = 1e-6;  // so that floats have it as well

/// A flat face across an axis.
struct FlatFace {
    int axis = 0, side = 1;        // side: whether it faces up or down the axis
    double at = 0;                 // along the axis
    std::vector<DVec3*> points{};  // of the body, in its own space; one of their coordinates is the face's
    double scale = 1, offset = 0;  // at = scale * coordinate + offset
    Box box{};                     // around the body
    bool is_round = false;         // of a cylinder or a cone

    void move_to(double place) const {
        for (DVec3* const point : points) (*point)[axis] = (place - offset) / scale;
    }
    bool is_at(double place) const { return std::fabs(at - place) <= 1e-12 * (1 + std::fabs(at)); }
    void grow_by(double share) const { move_to(at + side * share * (1 + std::fabs(at))); }
    bool beside(const FlatFace& other) const {
        if (axis != other.axis || !is_at(other.at)) return false;
        for (int i = 0; i < 3; ++i)
            if (i != axis && !(box.low[i] < other.box.high[i] && other.box.low[i] < box.high[i])) return false;
        return true;
    }
};

/// Returns the axis that a plane lies across, or -1.
int axis_of(const Plane& plane) {
    for (int c = 0; c < 3; ++c)
        if (plane.a[c] == plane.b[c] && plane.b[c] == plane.c[c]) return c;
    return -1;
}

/// Returns the flat faces of a simple body that lie across axes; `outer` leads from around it to where they are.
std::vector<FlatFace> faces_of(Primitive& body, const glm::dmat4& outer) {
    auto* const box = std::get_if<Cuboid>(&body.shape);
    auto* const cylinder = std::get_if<Cylinder>(&body.shape);
    auto* const cone = std::get_if<Cone>(&body.shape);
    auto* const plane = std::get_if<Plane>(&body.shape);
    if (!box && !cylinder && !cone && !plane) return {};
    const glm::dmat4 m = outer * matrix(body.transformations);
    bool stays[3]{true, true, true};  // axes of the body that are axes of what is around it
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (i != j && m[i][j] != 0) stays[i] = stays[j] = false;
    constexpr double inf = std::numeric_limits<double>::infinity();
    std::vector<FlatFace> faces;
    const Box around = plane ? Box{DVec3(-inf), DVec3(inf)} : transformed_bounds(body.shape, m);
    const auto add = [&](std::vector<DVec3*> points, double inwards, int axis) {
        if (!stays[axis] || m[axis][axis] == 0) return;
        FlatFace own{.axis = axis, .points = std::move(points), .scale = m[axis][axis], .offset = m[3][axis]};
        own.at = own.scale * (*own.points[0])[axis] + own.offset;
        own.side = own.scale * inwards < 0 ? 1 : -1;
        own.box = around, own.is_round = cylinder || cone;
        faces.push_back(std::move(own));
    };
    const auto add_ends = [&](DVec3& base, DVec3& cap, bool has_base, bool has_cap) {
        const DVec3 way = cap - base;
        for (int i = 0; i < 3; ++i) {
            if (way[i] == 0 || length(way) != std::fabs(way[i])) continue;
            if (has_base) add({&base}, way[i], i);
            if (has_cap) add({&cap}, -way[i], i);
        }
    };
    if (box)
        for (int i = 0; i < 3; ++i) {
            const double way = box->opposite[i] - box->corner[i];
            add({&box->corner}, way, i), add({&box->opposite}, -way, i);
        }
    if (cylinder) add_ends(cylinder->base, cylinder->cap, true, true);
    if (cone) add_ends(cone->base, cone->cap, cone->base_radius > 0, cone->cap_radius > 0);
    if (const int axis = plane ? axis_of(*plane) : -1; axis >= 0)
        add({&plane->a, &plane->b, &plane->c}, -plane->normal()[axis], axis);
    return faces;
}

/// Calls visit(leaf, matrix) for the simple bodies of a body, which it may change, perhaps not for those that
/// differences take away; `matrix` leads out of its composites.
template <class Visit>
void change_leaves(Primitive& body, const glm::dmat4& outer, bool all, const Visit& visit) {
    const bool composite = std::visit([]<class Kind>(const Kind&) { return is_composite<Kind>; }, body.shape);
    if (!composite) return visit(body, outer);
    bool wanted = true;
    change_parts(body, [&](Primitive& part) {
        if (wanted) change_leaves(part, outer * matrix(body.transformations), all, visit);
        wanted = all || !std::holds_alternative<Difference>(body.shape);
    });
}

/// Grows boxes and planes of an intersection by a hair where they only touch parts before them: planes that slant where
/// they are those of others from their other side.
void join_touching(Intersection& whole) {
    std::vector<Primitive> parts = *whole.parts;
    std::vector<FlatFace> before;
    std::vector<HalfSpace> spaces;
    bool grows = false;
    for (Primitive& part : parts) {
        std::vector<FlatFace> own;
        change_leaves(part, glm::dmat4(1), false, [&](Primitive& leaf, const glm::dmat4& outer) {
            auto* const plane = std::get_if<Plane>(&leaf.shape);
            if (plane && axis_of(*plane) < 0) {
                const HalfSpace there = plane->half_space(outer * matrix(leaf.transformations));
                const double size = 1 + length(there.point);
                const bool touches = std::ranges::any_of(spaces, [&](const HalfSpace& other) {
                    return length(there.normal + other.normal) < hair &&
                           std::fabs(dot_product(there.normal, there.point - other.point)) < hair * size;
                });
                spaces.push_back(there);
                if (!touches) return;
                const DVec3 n = plane->normal();
                const double scale = length(transform_point(outer * matrix(leaf.transformations), n) -
                                            transform_point(outer * matrix(leaf.transformations), DVec3(0)));
                for (DVec3* const point : {&plane->a, &plane->b, &plane->c})
                    *point = *point + (sliver * size / scale) * n;
                grows = true;
                return;
            }
            for (FlatFace& face : faces_of(leaf, outer)) {
                if (face.is_round) continue;
                const bool touches = std::ranges::any_of(
                    before, [&](const FlatFace& other) { return face.beside(other) && face.side != other.side; });
                if (touches) face.grow_by(sliver), grows = true;
                own.push_back(std::move(face));
            }
        });
        std::ranges::move(own, std::back_inserter(before));
    }
    if (grows) whole.parts = std::make_shared<const std::vector<Primitive>>(std::move(parts));
}

/// Makes a cylinder or a cone wider by a hair.
void widen(Shape& shape) {
    if (auto* const cylinder = std::get_if<Cylinder>(&shape)) cylinder->radius *= 1 + hair;
    if (auto* const cone = std::get_if<Cone>(&shape)) cone->base_radius *= 1 + hair, cone->cap_radius *= 1 + hair;
}

}  // namespace

void keep_faces(Primitive& body) {
    if (auto* const shared = std::get_if<Intersection>(&body.shape)) join_touching(*shared);
    change_parts(body, [](Primitive& part) { keep_faces(part); });
    auto* const difference = std::get_if<Difference>(&body.shape);
    if (!difference) return;
    std::vector<Primitive> parts = *difference->parts;
    // An open cylinder or cone is an intersection with planes.
    const bool has_flat =
        std::holds_alternative<Intersection>(parts[0].shape) || !faces_of(parts[0], glm::dmat4(1)).empty();
    const auto curved_of = [](const Primitive& leaf, const glm::dmat4& outer) {
        std::vector<CurvedFace> curved;
        add_curved(curved, leaf.shape, outer * matrix(leaf.transformations), {});
        std::erase_if(curved, [](const CurvedFace& face) { return !face.round; });
        return curved;
    };
    std::vector<FlatFace> taken;
    std::vector<CurvedFace> taken_curved;
    for (std::size_t i = 1; i < parts.size(); ++i)
        change_leaves(parts[i], glm::dmat4(1), true, [&](Primitive& leaf, const glm::dmat4& outer) {
            std::ranges::move(curved_of(leaf, outer), std::back_inserter(taken_curved));
            if (std::holds_alternative<Plane>(leaf.shape) || !has_flat) return;
            std::ranges::move(faces_of(leaf, outer), std::back_inserter(taken));
        });
    bool grows = false;
    change_leaves(parts[0], glm::dmat4(1), true, [&](Primitive& leaf, const glm::dmat4& outer) {
        const auto shared = [&](const FlatFace& face) {
            return std::ranges::any_of(taken, [&](const FlatFace& other) {
                return face.beside(other) && face.side == other.side &&
                       (other.is_round || std::holds_alternative<Cuboid>(leaf.shape));
            });
        };
        for (const FlatFace& face : faces_of(leaf, outer))
            if (shared(face)) face.grow_by(hair), grows = true;
        for (const CurvedFace& face : curved_of(leaf, outer))
            if (std::ranges::any_of(taken_curved, [&](const CurvedFace& other) { return face.continues(other); }))
                widen(leaf.shape), grows = true;
    });
    if (grows) difference->parts = std::make_shared<const std::vector<Primitive>>(std::move(parts));
}

void settle_faces(Scene& scene) {
    const DVec3 eye = scene.camera.position;
    std::vector<std::pair<int, double>> planes;
    for (const Primitive& body : scene.primitives) {
        const auto* const plane = std::get_if<Plane>(&body.shape);
        const int axis = plane && body.transformations.empty() ? axis_of(*plane) : -1;
        if (axis >= 0) planes.emplace_back(axis, plane->a[axis]);
    }
    if (planes.empty() || planes.size() > 100) return;
    for (Primitive& body : scene.primitives) {
        if (std::holds_alternative<Plane>(body.shape)) continue;
        const bool clear = transparent(scene, body);
        const auto settle = [&](const FlatFace& own) {
            bool seen = (eye[own.axis] - own.at) * own.side > 0, within = true;
            for (int c = 0; c < 3; ++c) within &= eye[c] >= own.box.low[c] && eye[c] <= own.box.high[c];
            const double away = eye[own.axis] > own.at ? -1 : 1;
            if ((seen || within || clear) && std::ranges::any_of(planes, [&](const auto& plane) {
                    return plane.first == own.axis && own.is_at(plane.second);
                }))
                own.move_to(own.at + away * (clear ? sliver : hair) * (1 + std::fabs(own.at)));
        };
        if (clear)
            change_leaves(body, glm::dmat4(1), false, [&](Primitive& leaf, const glm::dmat4& outer) {
                std::ranges::for_each(faces_of(leaf, outer), settle);
            });
        else
            std::ranges::for_each(faces_of(body, glm::dmat4(1)), settle);
    }
}

}  // namespace strahl::pov
