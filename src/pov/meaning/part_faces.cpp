#include "pov/meaning/part_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "num/vec_math.h"

namespace strahl::pov {
namespace {

/// Calls add(middle, u, v) for the parallelograms middle + a u + b v, a and b from -1 to 1, that hold the flat faces of
/// a simple body in its own space. `reach` is how far planes go.
template <class Add>
void each_part_face(const Shape& shape, double reach, const Add& add) {
    const auto add_cap = [&](const DVec3& centre, const DVec3& axis, double radius) {
        const DVec3 u = cross_product(std::fabs(axis.x) < .5 * length(axis) ? DVec3(1, 0, 0) : DVec3(0, 1, 0), axis);
        if (radius > 0) add(centre, radius * normalize(u), radius * normalize(cross_product(axis, u)));
    };
    const auto add_triangle = [&](const DVec3& a, const DVec3& b, const DVec3& c) {
        add(.5 * (b + c), .5 * (b - a), .5 * (c - a));
    };
    if (const auto* const box = std::get_if<Cuboid>(&shape)) {
        const DVec3 middle = .5 * (box->corner + box->opposite), half = .5 * (box->opposite - box->corner);
        for (int i = 0; i < 3; ++i)
            for (const double side : {-1., 1.}) {
                DVec3 edges[3]{};
                for (int k = 0; k < 3; ++k) edges[k][k] = half[k];
                add(middle + side * edges[i], edges[(i + 1) % 3], edges[(i + 2) % 3]);
            }
    } else if (const auto* const plane = std::get_if<Plane>(&shape)) {
        const DVec3 n = normalize(plane->normal());
        add_cap(dot_product(n, plane->a) * n, n, reach);
    } else if (const auto* const cylinder = std::get_if<Cylinder>(&shape)) {
        for (const DVec3& end : {cylinder->base, cylinder->cap})
            add_cap(end, cylinder->cap - cylinder->base, cylinder->radius);
    } else if (const auto* const cone = std::get_if<Cone>(&shape)) {
        add_cap(cone->base, cone->cap - cone->base, cone->base_radius);
        add_cap(cone->cap, cone->cap - cone->base, cone->cap_radius);
    } else if (const auto* const disc = std::get_if<Disc>(&shape)) {
        add_cap(disc->centre, disc->normal, disc->radius);
    } else if (const auto* const triangle = std::get_if<Triangle>(&shape)) {
        add_triangle(triangle->a, triangle->b, triangle->c);
    } else if (const auto* const mesh = std::get_if<Mesh>(&shape)) {
        constexpr std::size_t most = 100;  // of triangles; larger meshes are hardly flat
        if (mesh->data->triangles.size() > most) return;
        for (const MeshData::Corners& corners : mesh->data->triangles) {
            const auto corner = [&](int i) { return mesh->data->points[static_cast<std::size_t>(corners[i])]; };
            add_triangle(corner(0), corner(1), corner(2));
        }
    } else if (const auto* const prism = std::get_if<Prism>(&shape)) {
        const Box box = prism->bounds();
        const DVec3 half = .5 * box.size(), up(0, 0, half.z);
        for (const double z : {box.low.z, box.high.z})
            add(DVec3(box.centre().x, box.centre().y, z), DVec3(half.x, 0, 0), DVec3(0, half.y, 0));
        const auto add_wall = [&](const Contour::Point& a, const Contour::Point& b) {
            const DVec3 from(a[0], a[1], box.centre().z), to(b[0], b[1], box.centre().z);
            if (a != b) add(.5 * (from + to), .5 * (to - from), up);
        };
        for (const Contour& contour : prism->data->contours) {
            Contour::Point at = contour.start;
            for (const Contour::Stroke& stroke : contour.strokes) {
                if (stroke.straight()) add_wall(at, stroke.end);
                at = stroke.end;
            }
            add_wall(at, contour.start);
        }
    }
}

/// Returns points on the curved surface of a sphere, a cylinder or a cone in its own space.
std::vector<PointOnFace> own_points(const Shape& shape) {
    std::vector<PointOnFace> points;
    const auto add_rings = [&](const DVec3& base, const DVec3& way, double base_radius, double cap_radius) {
        const DVec3 axis = normalize(way);
        const DVec3 u = normalize(cross_product(std::fabs(axis.x) < .5 ? DVec3(1, 0, 0) : DVec3(0, 1, 0), axis));
        const DVec3 v = cross_product(axis, u);
        const double rise = (base_radius - cap_radius) / length(way);
        for (const double t : {.02, .35, .65, .98})
            for (int i = 0; i < 12; ++i) {
                const double turn = (i + t) * std::numbers::pi / 6;
                const DVec3 out = std::cos(turn) * u + std::sin(turn) * v;
                points.push_back({base + t * way + (base_radius + t * (cap_radius - base_radius)) * out,
                                  normalize(out + rise * axis)});
            }
    };
    if (const auto* const sphere = std::get_if<Sphere>(&shape)) {
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z)
                    if (const DVec3 way(x, y, z); way != DVec3(0))
                        points.push_back({sphere->centre + sphere->radius * normalize(way), normalize(way)});
    } else if (const auto* const cylinder = std::get_if<Cylinder>(&shape)) {
        add_rings(cylinder->base, cylinder->cap - cylinder->base, cylinder->radius, cylinder->radius);
    } else if (const auto* const cone = std::get_if<Cone>(&shape)) {
        add_rings(cone->base, cone->cap - cone->base, cone->base_radius, cone->cap_radius);
    }
    return points;
}

/// Returns the part of a convex polygon on one side of a plane through a point.
std::vector<DVec3> clipped(const std::vector<DVec3>& polygon, const DVec3& from, const DVec3& inwards) {
    std::vector<DVec3> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const DVec3 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
        const double a = dot_product(inwards, p - from), b = dot_product(inwards, q - from);
        if (a >= 0) kept.push_back(p);
        if ((a >= 0) != (b >= 0)) kept.push_back(p + a / (a - b) * (q - p));
    }
    return kept;
}

bool is_round(const Shape& shape) {
    return std::holds_alternative<Cylinder>(shape) || std::holds_alternative<Cone>(shape);
}

/// Turns a direction so that its first coordinate that is not 0 is positive.
DVec3 upwards(const DVec3& n) {
    const bool down = n.x < -off(0) || (n.x < off(0) && (n.y < -off(0) || (n.y < off(0) && n.z < 0)));
    return down ? -n : n;
}

}  // namespace

bool PartFace::may_meet(const PartFace& other) const {
    bool all = length(normal - other.normal) < off(0) && std::fabs(at - other.at) <= off(at);
    for (int c = 0; c < 3; ++c) all &= box.low[c] <= other.box.high[c] && other.box.low[c] <= box.high[c];
    return all;
}

void add_flat(std::vector<PartFace>& faces, const Shape& shape, const glm::dmat4& m, BodyFace part, double reach) {
    part.round = is_round(shape);
    each_part_face(shape, reach, [&](const DVec3& middle, const DVec3& u, const DVec3& v) {
        PartFace face{part, cross_product(glm::dmat3(m) * u, glm::dmat3(m) * v), 0, {}, {}};
        if (!(length(face.normal) > 0)) return;
        face.normal = upwards(normalize(face.normal));
        face.at = dot_product(face.normal, transform_point(m, middle));
        for (const auto& [a, b] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
            face.corners.push_back(transform_point(m, middle + double(a) * u + double(b) * v));
        for (const DVec3& corner : face.corners) face.box.add(corner);
        const DVec3 hairs(off(length(face.box.low) + length(face.box.high)));
        face.box.low = face.box.low - hairs, face.box.high = face.box.high + hairs;
        faces.push_back(std::move(face));
    });
}

std::vector<DVec3> common_part(std::vector<DVec3> polygon, const PartFace& other) {
    DVec3 middle(0);
    for (const DVec3& corner : other.corners) middle = middle + 1. / double(other.corners.size()) * corner;
    for (std::size_t i = 0; i < other.corners.size(); ++i) {
        const DVec3& from = other.corners[i];
        const DVec3 inwards = cross_product(other.normal, other.corners[(i + 1) % other.corners.size()] - from);
        polygon = clipped(polygon, from, dot_product(inwards, middle - from) < 0 ? -inwards : inwards);
    }
    return polygon;
}

std::vector<DVec3> common_part(std::vector<DVec3> polygon, const Box& box) {
    for (int i = 0; i < 3; ++i) {
        DVec3 inwards(0);
        inwards[i] = 1;
        if (std::isfinite(box.low[i])) polygon = clipped(polygon, box.low, inwards);
        if (std::isfinite(box.high[i])) polygon = clipped(polygon, box.high, -inwards);
    }
    return polygon;
}

bool CurvedFace::continues(const CurvedFace& other) const {
    return kind == other.kind && length(centre - other.centre) <= off(length(centre)) &&
           std::fabs(size - other.size) <= off(size) && length(axis - other.axis) <= off(0);
}

void add_curved(std::vector<CurvedFace>& faces, const Shape& shape, const glm::dmat4& m, BodyFace part) {
    part.round = is_round(shape);
    const double scale = length(DVec3(m[0]));
    for (int i = 0; i < 3; ++i)
        if (std::fabs(length(DVec3(m[i])) - scale) > off(scale) ||
            std::fabs(dot_product(DVec3(m[i]), DVec3(m[(i + 1) % 3]))) > off(scale * scale))
            return;
    CurvedFace face{part, shape.index(), DVec3(0), DVec3(0), 0};
    if (const auto* const sphere = std::get_if<Sphere>(&shape)) {
        face.centre = transform_point(m, sphere->centre), face.size = scale * sphere->radius;
    } else if (const auto* const cylinder = std::get_if<Cylinder>(&shape)) {
        const DVec3 base = transform_point(m, cylinder->base);
        face.axis = upwards(normalize(glm::dmat3(m) * (cylinder->cap - cylinder->base)));
        face.centre = base - dot_product(base, face.axis) * face.axis, face.size = scale * cylinder->radius;
    } else if (const auto* const cone = std::get_if<Cone>(&shape)) {
        const DVec3 way = cone->cap - cone->base;
        const double gain = cone->cap_radius - cone->base_radius;
        if (gain == 0) return;
        face.centre = transform_point(m, cone->base - cone->base_radius / gain * way);
        face.axis = upwards(normalize(glm::dmat3(m) * way)), face.size = std::fabs(gain) / length(way);
    } else {
        return;
    }
    faces.push_back(face);
}

std::vector<PointOnFace> points_on(const Shape& shape, const glm::dmat4& m) {
    std::vector<PointOnFace> points = own_points(shape);
    for (PointOnFace& own : points)
        own.p = transform_point(m, own.p), own.normal = normalize(glm::dmat3(m) * own.normal);
    return points;
}

}  // namespace strahl::pov
