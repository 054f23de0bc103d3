#include "pov/meaning/extents.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <span>

#include "num/vec_math.h"
#include "scene/kinds/world_transform.h"
#include "scene/overlap.h"

namespace strahl::pov {
namespace {

/// Returns a box around the moved box; an endless one stays as it is.
Box moved(const Box& box, const glm::dmat4& m) { return box.finite() ? transformed(box, m) : box; }

/// Returns a box around the box around the box, a step each.
Box moved_by_steps(Box box, const Steps& steps) {
    for (const Step& step : steps) box = moved(box, matrix_of(std::span(&step, 1)));
    return box;
}

/// Returns the box of a solid of revolution: of a square around its axis from one end, `height` long, which POV-Ray
/// turns from the z axis by the shortest way.
Box around_axis(const DVec3& from, const DVec3& up, double radius, double height, double beyond, const glm::dmat4& m) {
    const DVec3 axis = std::fabs(up.z) < 1 - 1e-10 ? normalize(DVec3(-up.y, up.x, 0)) : DVec3(1, 0, 0);
    const glm::dmat4 turned =
        glm::rotate(glm::translate(glm::dmat4(1), from), std::acos(std::clamp(up.z, -1., 1.)), axis);
    return moved({{-radius, -radius, -beyond}, {radius, radius, height + beyond}}, m * turned);
}

/// Returns the box of a sphere: around its cube, from the first step on that makes an ellipsoid of it.
Box around_ball(const Sphere& sphere, std::span<const Step> steps) {
    DVec3 centre = sphere.centre;
    double radius = sphere.radius;
    std::size_t i = 0;
    for (; i < steps.size(); ++i) {
        const auto* const scale = std::get_if<Scale>(&steps[i]);
        if (std::holds_alternative<MatrixStep>(steps[i]) ||
            (scale && (scale->by.x != scale->by.y || scale->by.x != scale->by.z)))
            break;
        centre = transform_point(matrix_of(steps.subspan(i, 1)), centre);
        if (scale) radius *= std::fabs(scale->by.x);
    }
    return moved({centre - DVec3(radius), centre + DVec3(radius)}, matrix_of(steps.subspan(i)));
}

/// Returns the box around the points and control points of a letter.
Box around_letter(const Prism& letter) {
    const ContourData& data = *letter.data;
    constexpr double tolerance = 1e-6;
    Box box;
    for (const ContourPiece<double>& piece : data.pieces) {
        const auto add = [&](double x, double y) {
            const DVec3 at(data.centre[0] + data.unit * x, data.centre[1] + data.unit * y, 0);
            box.add(at + DVec3(0, 0, letter.base - tolerance)), box.add(at + DVec3(0, 0, letter.top + tolerance));
        };
        add(piece.ax, piece.ay), add(piece.cx, piece.cy);
        if (piece.ex != 0 || piece.ey != 0) add(piece.ax + piece.hx, piece.ay + piece.hy);
    }
    return box;
}

Box around_shape(const ObjectThing& object, bool letter) {
    const glm::dmat4 m = matrix_of(object.steps);
    const Shape& shape = *object.shape;
    const Box tight = transformed_bounds(shape, m), own = transformed_bounds(shape, glm::dmat4(1));
    if (object.surface || object.patch) return tight;
    const auto visit = [&]<class Kind>(const Kind& kind) {
        if constexpr (std::is_same_v<Kind, Sphere>) {
            return around_ball(kind, object.steps);
        } else if constexpr (std::is_same_v<Kind, Cylinder>) {
            return around_axis(kind.base, kind.axis(), kind.radius, length(kind.cap - kind.base), 0, m);
        } else if constexpr (std::is_same_v<Kind, Cone>) {
            return around_axis(kind.base, normalize(kind.cap - kind.base), std::max(kind.base_radius, kind.cap_radius),
                               length(kind.cap - kind.base), 0, m);
        } else if constexpr (std::is_same_v<Kind, Disc>) {
            return around_axis(kind.centre, normalize(kind.normal), kind.radius, 0, 1e-3, m);
        } else if constexpr (std::is_same_v<Kind, Superellipsoid>) {
            return moved({1.0001 * own.low, 1.0001 * own.high}, m);
        } else if constexpr (std::is_same_v<Kind, Mesh>) {
            if (object.word == word("height_field")) return moved(own, m);
            return object.word == word("mesh") || object.word == word("mesh2") ? moved_by_steps(own, object.steps)
                                                                               : tight;
        } else if constexpr (std::is_same_v<Kind, Prism>) {
            return moved(letter ? around_letter(kind) : own, m);
        } else if constexpr (!Kind::bounded || std::is_same_v<Kind, Triangle> || std::is_same_v<Kind, SmoothTriangle>) {
            return tight;
        } else {
            return moved(own, m);
        }
    };
    return std::visit(visit, shape);
}

Box around(const ObjectThing& object, bool letter) {
    if (object.kind == ObjectKind::shape && object.shape) return around_shape(object, letter);
    Box box;
    for (const auto& part : object.parts) {
        const Box own = around(*part, object.word == word("text"));
        if (object.kind != ObjectKind::intersect || &part == &object.parts[0])
            box.add(own);
        else if (!part->inverse)
            box = {glm::max(box.low, own.low), glm::min(box.high, own.high)};
        if (object.kind == ObjectKind::subtract) break;
    }
    return moved_by_steps(box, object.steps);
}

}  // namespace

Box extent_of(const ObjectThing& object) { return around(object, false); }

}  // namespace strahl::pov
