#include "pov/meaning/shared_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "num/vec_math.h"
#include "scene/leaves.h"
#include "scene/overlap.h"
#include "scene/ray_hits.h"

namespace strahl::pov {
namespace {

constexpr double step_aside = 1e-7;   // relative to coordinates: a step to one side of a face
constexpr double same_place = 1e-10;  // relative to coordinates: faces that are no further apart are in one place

/// A flat face of a part: a convex polygon that holds it.
struct PartFace {
    std::size_t part;
    DVec3 normal;  // of length 1; its first coordinate that is not 0 is positive
    double at;     // normal . p of its points
    bool there;    // is it a surface, not only the end of an open body's inside?
    std::vector<DVec3> corners;
    Box box;

    bool may_meet(const PartFace& other) const {
        bool all = length(normal - other.normal) < same_place;
        for (int c = 0; c < 3; ++c) all &= box.low[c] <= other.box.high[c] && other.box.low[c] <= box.high[c];
        return all;
    }
};
/// A place on a surface of a part, with a normal of length 1.
struct PointOnPart {
    DVec3 p, normal;
};

/// Calls add(middle, u, v) for the parallelograms middle + a u + b v, a and b from -1 to 1, that hold the flat faces of
/// a simple body in its own space. `reach` is how far planes go.
template <class Add>
void each_part_face(const Shape& shape, double reach, const Add& add) {
    const auto add_cap = [&](const DVec3& centre, const DVec3& axis, double radius) {
        const DVec3 u = cross_product(std::fabs(axis.x) < .5 * length(axis) ? DVec3(1, 0, 0) : DVec3(0, 1, 0), axis);
        if (radius > 0) add(centre, radius * normalize(u), radius * normalize(cross_product(axis, u)));
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
std::vector<PointOnPart> points_on(const Shape& shape) {
    std::vector<PointOnPart> points;
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

/// Returns the part of a convex polygon that another one in its plane covers.
std::vector<DVec3> common_part(std::vector<DVec3> polygon, const PartFace& other) {
    DVec3 middle(0);
    for (const DVec3& corner : other.corners) middle = middle + 1. / double(other.corners.size()) * corner;
    for (std::size_t i = 0; i < other.corners.size(); ++i) {
        const DVec3& from = other.corners[i];
        DVec3 inwards = cross_product(other.normal, other.corners[(i + 1) % other.corners.size()] - from);
        if (dot_product(inwards, middle - from) < 0) inwards = -inwards;
        std::vector<DVec3> kept;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const DVec3 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
            const double a = dot_product(inwards, p - from), b = dot_product(inwards, q - from);
            if (a > 0) kept.push_back(p);
            if ((a > 0) != (b > 0)) kept.push_back(p + a / (a - b) * (q - p));
        }
        polygon = std::move(kept);
    }
    return polygon;
}

/// One composite: its parts, in its own space.
class SharedFaces {
  public:
    SharedFaces(const Primitive& own, const glm::dmat4& to_world, const Primitive& whole, const Scene& scene)
        : scene(scene),
          whole(whole),
          to_world(to_world),
          eye(transform_point(glm::inverse(to_world), scene.camera.position)),
          clear(shows_inside(own)) {
        each_part(own, [&](const Primitive& part) { parts.push_back(&part); });
        const auto look = [&]<class Kind>(const Kind& kind) {
            if constexpr (is_composite<Kind>) operation = Kind::operation, keeps = kind.keeps;
        };
        std::visit(look, own.shape);
        const Box around = world_bounds(whole);
        reach = around.finite() ? length(around.size()) + length(around.centre()) : 1e4;
    }

    bool found() {
        if (keeps) return false;
        struct PlacedLeaf {
            std::size_t part;
            const Primitive* body;
            glm::dmat4 matrix;
        };
        std::vector<PartFace> faces;
        std::vector<PlacedLeaf> leaves;
        for (std::size_t i = 0; i < parts.size(); ++i)
            for_each_leaf(*parts[i], [&](const Primitive& leaf, const glm::dmat4& matrix) {
                leaves.push_back({i, &leaf, matrix});
                each_part_face(leaf.shape, reach, [&](const DVec3& middle, const DVec3& u, const DVec3& v) {
                    add(faces, {i, DVec3(0), 0, !is_nothing(leaf), {}, {}}, matrix, middle, u, v);
                });
            });
        std::ranges::sort(faces, {}, &PartFace::at);
        for (std::size_t a = 0; a < faces.size(); ++a)
            for (std::size_t b = a + 1; b < faces.size() && faces[b].at - faces[a].at <= off(faces[a].at); ++b)
                if (faces[a].part != faces[b].part && (faces[a].there || faces[b].there) &&
                    faces[a].may_meet(faces[b]) && decides_on(faces[a], faces[b]))
                    return true;
        std::ranges::stable_sort(leaves, {}, [](const PlacedLeaf& leaf) { return leaf.matrix[3].x; });
        for (std::size_t a = 0; a < leaves.size(); ++a)
            for (std::size_t b = a + 1; b < leaves.size() && leaves[b].matrix[3].x == leaves[a].matrix[3].x; ++b) {
                const PlacedLeaf &one = leaves[a], &other = leaves[b];
                if (one.part == other.part || one.matrix != other.matrix || one.body->shape != other.body->shape)
                    continue;
                const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(one.matrix)));
                for (const PointOnPart& own : points_on(one.body->shape))
                    if (decides(one.part, other.part, transform_point(one.matrix, own.p), normalize(turn * own.normal)))
                        return true;
            }
        return false;
    }

  private:
    const Material& material(const Primitive& leaf) const {
        return scene.materials[static_cast<std::size_t>(leaf.material)];
    }
    /// Is it the surface of an open body's inside, which is not there?
    bool is_nothing(const Primitive& leaf) const {
        const Material& own = material(leaf);
        return own.rgb.transmit == 1 && own.diffuse == 0 && own.specular == 0 && own.reflection == 0;
    }
    bool shows_inside(const Primitive& own) const {
        bool any = false;
        for_each_leaf(own, [&](const Primitive& leaf, const glm::dmat4&) {
            any |= material(leaf).transmits() && !is_nothing(leaf);
        });
        return any;
    }

    static double off(double at) { return same_place * (1 + std::fabs(at)); }

    static void add(std::vector<PartFace>& faces, PartFace face, const glm::dmat4& m, const DVec3& middle,
                    const DVec3& u, const DVec3& v) {
        face.normal = cross_product(glm::dmat3(m) * u, glm::dmat3(m) * v);
        if (!(length(face.normal) > 0)) return;
        face.normal = normalize(face.normal);
        const DVec3& n = face.normal;
        if (n.x < -same_place || (n.x < same_place && (n.y < -same_place || (n.y < same_place && n.z < 0))))
            face.normal = -n;
        face.at = dot_product(face.normal, transform_point(m, middle));
        for (const auto& [a, b] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
            face.corners.push_back(transform_point(m, middle + double(a) * u + double(b) * v));
        for (const DVec3& corner : face.corners) face.box.add(corner);
        const DVec3 hairs(off(length(face.box.low) + length(face.box.high)));
        face.box.low = face.box.low - hairs, face.box.high = face.box.high + hairs;
        faces.push_back(std::move(face));
    }

    bool decides_on(const PartFace& one, const PartFace& other) {
        const std::vector<DVec3> polygon = common_part(one.corners, other);
        if (polygon.size() < 3) return false;
        DVec3 middle(0);
        for (const DVec3& corner : polygon) middle = middle + 1. / double(polygon.size()) * corner;
        for (const DVec3& corner : polygon)
            for (const double share : {.05, .4, .9})
                if (decides(one.part, other.part, middle + share * (corner - middle), one.normal)) return true;
        return false;
    }

    /// Is a surface of the whole at a point, which surfaces of two parts have in common, only if POV-Ray rounds it to
    /// one side of them?
    bool decides(std::size_t one, std::size_t other, const DVec3& p, const DVec3& normal) {
        if ((tests -= static_cast<int>(parts.size())) < 0) return true;
        const DVec3 step = step_aside * (1 + length(p)) * normal;
        const DVec3 below = p - step, above = p + step;
        const auto in = [&](std::size_t part, const DVec3& q) { return contains(*parts[part], q); };
        const bool one_below = in(one, below), other_below = in(other, below);
        if (one_below == in(one, above) || other_below == in(other, above)) return false;
        const auto whole_at = [&](const DVec3& q) { return contains(whole, transform_point(to_world, q)); };
        if (operation == Operation::unite && one_below != other_below)  // they touch
            return clear && shows(one, other, below) && shows(one, other, above) && whole_at(below) &&
                   whole_at(above) && is_seen(p);
        if (shows(one, other, below) == shows(one, other, above)) return false;
        const bool inside_below = whole_at(below), faces_eye = dot_product(normal, eye - p) > 0;
        return inside_below != whole_at(above) && (clear || faces_eye == inside_below) && is_seen(p);
    }
    /// Is no opaque body before a point?
    bool is_seen(const DVec3& p) const {
        if (scene.camera.projection != Projection::perspective) return true;
        const DVec3 way = transform_point(to_world, p) - scene.camera.position;
        const double away = length(way);
        for (const BodyHit& own : bodies_along(scene, {scene.camera.position, 1 / away * way, -1})) {
            if (own.hit.t > (1 - 1e-6) * away) return true;
            if (!transparent(scene, scene.primitives[static_cast<std::size_t>(own.body)])) return false;
        }
        return true;
    }
    /// Does POV-Ray show one of the surfaces of two parts at a point that both have, if it rounds the point to q?
    bool shows(std::size_t one, std::size_t other, const DVec3& q) const {
        bool shown[2]{true, true};
        for (std::size_t k = 0; k < parts.size() && (shown[0] || shown[1]); ++k) {
            const bool in = contains(*parts[k], q);
            const bool counts =
                operation == Operation::intersect || (operation == Operation::subtract && k == 0) ? in : !in;
            shown[0] &= counts || k == one, shown[1] &= counts || k == other;
        }
        return shown[0] || shown[1];
    }

    const Scene& scene;
    const Primitive& whole;
    const glm::dmat4 to_world;
    const DVec3 eye;
    const bool clear;
    int tests = 1'000'000;  // of parts that are left; without one nothing is known
    std::vector<const Primitive*> parts;
    Operation operation = Operation::unite;
    bool keeps = false;
    double reach;
};

bool decides_in(const Primitive& own, const glm::dmat4& outer, const Primitive& whole, const Scene& scene) {
    bool any = false, composite = false;
    const glm::dmat4 to_world = outer * matrix(own.transformations);
    each_part(own,
              [&](const Primitive& part) { composite = true, any = any || decides_in(part, to_world, whole, scene); });
    return any || (composite && SharedFaces(own, to_world, whole, scene).found());
}

}  // namespace

bool rounding_decides(const Scene& scene, const Primitive& whole) {
    return decides_in(whole, glm::dmat4(1), whole, scene);
}

std::vector<std::size_t> clear_bodies_on_planes(const Scene& scene) {
    std::vector<std::size_t> found;
    std::vector<const Primitive*> planes;
    for (const Primitive& body : scene.primitives)
        if (std::holds_alternative<Plane>(body.shape)) planes.push_back(&body);
    if (planes.size() > 100) return found;
    for (std::size_t i = 0; i < scene.primitives.size() && !planes.empty(); ++i) {
        const Primitive& own = scene.primitives[i];
        if (std::holds_alternative<Cuboid>(own.shape) || !transparent(scene, own)) continue;
        const auto touches = [&](const Primitive* plane) {
            if (plane == &own) return false;
            const auto parts = std::make_shared<const std::vector<Primitive>>(std::vector{own, *plane});
            const Primitive both{Union{parts}, own.material, {}};
            return SharedFaces(both, glm::dmat4(1), both, scene).found();
        };
        if (std::ranges::any_of(planes, touches)) found.push_back(i);
    }
    return found;
}

}  // namespace strahl::pov
