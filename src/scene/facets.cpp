#include "scene/facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "num/vec_math.h"

namespace strahl {
namespace {

constexpr int fewest_sides = 16, most_sides = 256;  // of a circle
constexpr int disc_sides = 64;                      // they take 99.8 % of a disc's area
/// Meshes of more triangles have no facets: to make them would take longer than a picture.
constexpr std::size_t most_triangles = 10000;

/// Two directions across another one; all three of length 1 and at right angles.
std::array<DVec3, 2> axes_across(const DVec3& axis) {
    const DVec3 other = std::abs(axis.x) < .6 ? DVec3(1, 0, 0) : DVec3(0, 1, 0);
    const DVec3 x = normalize(cross_product(axis, other));
    return {x, cross_product(axis, x)};
}

/// Points of a circle around the origin, in units of its radius.
std::vector<DVec3> circle(const DVec3& axis, int sides) {
    const auto [x, y] = axes_across(axis);
    std::vector<DVec3> points;
    for (int i = 0; i < sides; ++i) {
        const double turn = 2 * std::numbers::pi * i / sides;
        points.push_back(std::cos(turn) * x + std::sin(turn) * y);
    }
    return points;
}

/// Strips between two circles, whose corners are centre + radius * point: an outer one and one inside or beside it.
void add_strips(const std::vector<DVec3>& points, const DVec3& centre, double radius, const DVec3& other_centre,
                double other_radius, double least, std::vector<Facet>& facets) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const DVec3 &from = points[i], &to = points[(i + 1) % points.size()];
        Facet facet{{centre + radius * from, centre + radius * to, other_centre + other_radius * to}, least};
        if (other_radius > 0) facet.corners.push_back(other_centre + other_radius * from);
        facets.push_back(facet);
    }
}
void add_circle(const std::vector<DVec3>& points, const DVec3& centre, double radius, double least,
                std::vector<Facet>& facets) {
    Facet facet{{}, least};
    for (const DVec3& point : points) facet.corners.push_back(centre + radius * point);
    if (radius > 0) facets.push_back(facet);
}

std::vector<Facet> own_facets(const Disc& disc) {
    // The arc of a ring is no further from its chord than an eighth of the ring's width.
    const double width = (disc.radius - disc.hole) / disc.radius;
    const double wanted = std::numbers::pi / std::acos(1 - std::min(width / 8, 1.));
    const int sides = wanted < most_sides ? std::max(static_cast<int>(std::ceil(wanted)), fewest_sides) : most_sides;
    const std::vector<DVec3> points = circle(normalize(disc.normal), disc.hole > 0 ? sides : disc_sides);
    std::vector<Facet> facets;
    if (disc.hole > 0)
        add_strips(points, disc.centre, disc.radius, disc.centre, disc.hole, 0, facets);
    else
        add_circle(points, disc.centre, disc.radius, 0, facets);
    // Polygons of wider rings do not have the rings' area.
    for (Facet& facet : facets) facet.whole = disc.hole == 0 || width < .1;
    return facets;
}

/// Returns facets of a cylinder or a cone: none if it is longer than thick, where a capsule tells whether it is thin.
std::vector<Facet> flat_facets(const DVec3& base, double base_radius, const DVec3& cap, double cap_radius) {
    const double height = length(cap - base);
    std::vector<Facet> facets;
    if (!(height < 2 * std::max(base_radius, cap_radius))) return facets;
    const std::vector<DVec3> points = circle(normalize(cap - base), disc_sides);
    const double least = height / 4;  // a cone is at least half as thick somewhere
    add_circle(points, base, base_radius, least, facets);
    add_circle(points, cap, cap_radius, least, facets);
    if (base_radius > 0)
        add_strips(points, base, base_radius, cap, cap_radius, least, facets);
    else
        add_strips(points, cap, cap_radius, base, base_radius, least, facets);
    return facets;
}
std::vector<Facet> own_facets(const Cylinder& body) {
    return flat_facets(body.base, body.radius, body.cap, body.radius);
}
std::vector<Facet> own_facets(const Cone& body) {
    return flat_facets(body.base, body.base_radius, body.cap, body.cap_radius);
}

std::vector<Facet> own_facets(const Cuboid& box) {
    const Box around = box.bounds();
    const DVec3 size = around.size();
    std::vector<Facet> facets;
    for (int axis = 0; axis < 3; ++axis)
        for (const bool upper : {false, true}) {
            Facet facet{{}, std::min({size.x, size.y, size.z}) / 2};
            for (const auto& [right, up] : {std::pair(false, false), {true, false}, {true, true}, {false, true}}) {
                DVec3 corner;
                corner[axis] = upper ? around.high[axis] : around.low[axis];
                corner[(axis + 1) % 3] = right ? around.high[(axis + 1) % 3] : around.low[(axis + 1) % 3];
                corner[(axis + 2) % 3] = up ? around.high[(axis + 2) % 3] : around.low[(axis + 2) % 3];
                facet.corners.push_back(corner);
            }
            facets.push_back(facet);
        }
    return facets;
}

std::vector<Facet> own_facets(const Triangle& triangle) { return {{{triangle.a, triangle.b, triangle.c}, 0}}; }
std::vector<Facet> own_facets(const SmoothTriangle& triangle) { return {{{triangle.a, triangle.b, triangle.c}, 0}}; }
std::vector<Facet> own_facets(const Mesh& mesh) {
    std::vector<Facet> facets;
    const MeshData& data = *mesh.data;
    if (data.triangles.size() > most_triangles) return facets;
    for (const auto& [a, b, c] : data.triangles)
        facets.push_back({{data.points[a], data.points[b], data.points[c]}, 0});
    return facets;
}

/// Returns facets of a prism: its walls, curved ones in strips, and no caps.
std::vector<Facet> own_facets(const Prism& prism) {
    std::vector<Facet> facets;
    const ContourData& data = *prism.data;
    if (data.pieces.size() > most_triangles) return facets;
    for (const ContourPiece<double>& piece : data.pieces) {
        const bool straight = piece.ex == 0 && piece.ey == 0 && piece.dx == 0 && piece.dy == 0;
        const int strips = straight ? 1 : 4;
        const auto at = [&](int i, double z) {
            const double t = double(i) / strips;
            const double x = piece.ax + t * (2 * piece.hx + t * (piece.ex + t * piece.dx));
            const double y = piece.ay + t * (2 * piece.hy + t * (piece.ey + t * piece.dy));
            return DVec3(data.centre[0] + data.unit * x, data.centre[1] + data.unit * y, z);
        };
        for (int i = 0; i < strips; ++i)
            facets.push_back(
                {{at(i, prism.base), at(i + 1, prism.base), at(i + 1, prism.top), at(i, prism.top)}, 0, false});
    }
    return facets;
}

}  // namespace

std::vector<Facet> facets_of(const Primitive& primitive, const glm::dmat4& outer) {
    const glm::dmat4 to_world = outer * matrix(primitive.transformations);
    const auto visit = [&]<class Kind>(const Kind& kind) {
        std::vector<Facet> found;
        if constexpr (is_composite<Kind>) {
            for (const Primitive& part : *kind.parts) {
                const std::vector<Facet> own = facets_of(part, to_world);
                found.insert(found.end(), own.begin(), own.end());
                if (Kind::operation != Operation::unite) break;
            }
            // Cutting may leave a piece of any size.
            for (Facet& facet : found)
                if (Kind::operation != Operation::unite) facet.least = 0, facet.whole = false;
        } else if constexpr (requires { own_facets(kind); }) {
            found = own_facets(kind);
            // A bound from below on how much the matrix lengthens vectors.
            const glm::dmat4 back = glm::inverse(to_world);
            double most = 0;
            for (int i = 0; i < 3; ++i) most += dot_product(DVec3(back[i]), DVec3(back[i]));
            for (Facet& facet : found) {
                for (DVec3& corner : facet.corners) corner = transform_point(to_world, corner);
                facet.least /= std::sqrt(most);
            }
        }
        return found;
    };
    return std::visit(visit, primitive.shape);
}

}  // namespace strahl
