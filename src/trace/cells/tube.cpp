#include "trace/cells/tube.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "num/box_tree.h"
#include "num/vec_math.h"
#include "scene/capsules.h"

namespace strahl {
namespace {

/// A part of the way along a capsule, from 0 to 1.
struct Stretch {
    double low = 0, high = 1;
    /// Keeps only t with a + b t >= 0.
    void clip(double a, double b) {
        if (b > 0)
            low = std::max(low, -a / b);
        else if (b < 0)
            high = std::min(high, -a / b);
        else if (a < 0)
            high = -1;
    }
};

double distance_to(const Capsule& capsule, const DVec3& p) {
    const DVec3 way = capsule.to - capsule.from, since = p - capsule.from;
    const double squared = dot_product(way, way);
    const double t = squared > 0 ? std::clamp(dot_product(since, way) / squared, 0., 1.) : 0.;
    return quick_length(since - t * way);
}

/// Returns a ball around points, each with a radius of its own.
template <class Each>
Capsule ball_around(const Each& each) {
    Box box;
    each([&](const DVec3& point, double) { box.add(point); });
    const DVec3 centre = box.centre();
    double radius = 0;
    each([&](const DVec3& point, double own) { radius = std::max(radius, quick_length(point - centre) + own); });
    return {centre, centre, radius * (1 + 1e-12)};
}

/// A convex polygon that is cut along planes, in the coordinates of a bundle: w u, w v and w.
class CutPolygon {
  public:
    static constexpr std::size_t most = 272;  // a circle's sides, and one more for each cut

    void add(const DVec3& corner) {
        if (count < most) corners[count++] = corner;
    }
    /// Keeps only points with plane . p + constant >= 0.
    void cut(const DVec3& plane, double constant) {
        CutPolygon rest;
        for (std::size_t k = 0; k < count; ++k) {
            const DVec3 &from = corners[k], &to = corners[k + 1 < count ? k + 1 : 0];
            const double a = dot_product(plane, from) + constant, b = dot_product(plane, to) + constant;
            if (a >= 0) rest.add(from);
            if ((a >= 0) != (b >= 0)) rest.add(from + a / (a - b) * (to - from));
        }
        count = rest.count;
        std::copy_n(rest.corners.begin(), count, corners.begin());
    }
    std::span<DVec3> points() { return std::span(corners).first(count); }

  private:
    std::array<DVec3, most> corners;
    std::size_t count = 0;
};

DVec3 longest_side(const std::vector<DVec3>& polygon) {
    DVec3 longest(0);
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const DVec3 side = polygon[(k + 1) % polygon.size()] - polygon[k];
        if (dot_product(side, side) > dot_product(longest, longest)) longest = side;
    }
    return longest;
}

/// Calls add(polygon, pieces) for the pieces of a facet. A ball around all of a long one would be met by most tubes, so
/// it is cut across into pieces about as long as wide, but no shorter than `shortest`.
template <class Add>
void add_pieces(const Facet& facet, double shortest, const Add& add) {
    const std::vector<DVec3>& corners = facet.corners;
    const DVec3 along = quick_unit(longest_side(corners));
    double low = 0, high = 0, width = 0;  // as seen from the first corner, along and across
    for (const DVec3& corner : corners) {
        const DVec3 since = corner - corners[0];
        const double at = dot_product(since, along);
        low = std::min(low, at), high = std::max(high, at);
        width = std::max(width, quick_length(since - at * along));
    }
    const double wanted = std::ceil((high - low) / std::max(width, shortest));
    const int pieces = wanted > 1 ? static_cast<int>(std::min(wanted, 1e3)) : 1;
    for (int i = 0; i < pieces; ++i) {
        CutPolygon piece;
        for (const DVec3& corner : corners) piece.add(corner - corners[0]);
        const auto end = [&](int n) { return low + (high - low) * n / pieces; };
        if (i > 0) piece.cut(along, -end(i));
        if (i + 1 < pieces) piece.cut(-along, end(i + 1));
        for (DVec3& corner : piece.points()) corner += corners[0];
        if (!piece.points().empty()) add(piece.points(), pieces);
    }
}

}  // namespace

glm::dmat3 RayBundle::coordinates() const { return glm::inverse(glm::dmat3(across, down, corner)); }

RayBundle::Met RayBundle::met(std::span<const DVec3> polygon, const glm::dmat3& to_own,
                              std::vector<glm::dvec2>* outline) const {
    CutPolygon part;
    // With w as the unit of u and v the bundle's sides are planes.
    const double unit = parallel ? 0 : 1, one = parallel ? 1 : 0;
    unsigned some = 0, all = ~0u;  // a bit for each plane that corners are beyond
    for (const DVec3& point : polygon) {
        const DVec3 own = to_own * (point - from);
        const double side = unit * own.z + one;
        const unsigned beyond = unsigned(own.z < nearest) | unsigned(own.z > furthest) << 1 | unsigned(own.x < 0) << 2 |
                                unsigned(own.x > side) << 3 | unsigned(own.y < 0) << 4 | unsigned(own.y > side) << 5;
        some |= beyond, all &= beyond;
        part.add(own);
    }
    if (all != 0) return {};
    if (some & 1) part.cut({0, 0, 1}, -nearest);
    if (some & 2) part.cut({0, 0, -1}, furthest);
    if (some & 4) part.cut({1, 0, 0}, 0);
    if (some & 8) part.cut({-1, 0, unit}, one);
    if (some & 16) part.cut({0, 1, 0}, 0);
    if (some & 32) part.cut({0, -1, unit}, one);
    const std::span<DVec3> points = part.points();
    Met result;
    if (points.size() < 3) return result;
    constexpr double edge = 1e-9;
    for (DVec3& point : points) {
        if (!parallel) point *= 1 / point.z;
        const bool left = point.x<edge, right = point.x> 1 - edge, top = point.y<edge, bottom = point.y> 1 - edge;
        if (top && left) result.corners |= 1;
        if (top && right) result.corners |= 2;
        if (bottom && right) result.corners |= 4;
        if (bottom && left) result.corners |= 8;
    }
    for (std::size_t k = 0; k < points.size(); ++k) {
        const DVec3 &from = points[k], &to = points[k + 1 < points.size() ? k + 1 : 0];
        const double low_x = std::min(from.x, to.x), high_x = std::max(from.x, to.x);
        const double low_y = std::min(from.y, to.y), high_y = std::max(from.y, to.y);
        result.sides += !(high_x < edge || low_x > 1 - edge || high_y < edge || low_y > 1 - edge);
    }
    double sum = 0;
    for (std::size_t k = 2; k < points.size(); ++k) {
        const DVec3 a = points[k - 1] - points[0], b = points[k] - points[0];
        sum += a.x * b.y - a.y * b.x;
    }
    result.share = std::abs(sum) / 2;
    if (outline) outline->assign(points.begin(), points.end());
    return result;
}

namespace {

/// Tells which boxes a bundle misses, by their corners in its coordinates.
class BoxesBeside {
  public:
    BoxesBeside(const RayBundle& bundle, const glm::dmat3& to_own) : bundle(bundle), to_own(to_own) {
        for (int i = 0; i < 3; ++i) sizes[i] = glm::abs(to_own[i]);
    }
    /// Returns false for infinite boxes.
    bool has(const Box& box) const {
        constexpr double rounding = 1e-9;
        const DVec3 middle = to_own * (box.centre() - bundle.from), half = sizes * (.5 * box.size());
        const double off = rounding * (std::abs(middle.x) + std::abs(middle.y));
        const DVec3 low = middle - half, high = middle + half;
        const double side = bundle.parallel ? 1 : high.z;  // u and v are multiplied by w
        return high.z < bundle.nearest || low.z > bundle.furthest || high.x < -off || low.x > side + off ||
               high.y < -off || low.y > side + off;
    }

  private:
    const RayBundle& bundle;
    const glm::dmat3 to_own;
    glm::dmat3 sizes;
};

double slant_of(const Tube& tube) { return std::sqrt(1 + tube.growth * tube.growth); }

/// Returns how far from the way the centres of balls may be, so far along it, that reach into the tube.
double reach_at(const Tube& tube, double slant, double along, double radius) {
    return tube.radius + tube.growth * along + radius * slant;
}
/// Returns a bound on the radius of the tube where it is met by balls with centres so far along the way.
double bound_at(const Tube& tube, double along, double radius) {
    along += tube.growth < 0 ? -radius : radius;
    return tube.radius + tube.growth * std::clamp(along, 0., tube.length);
}

/// Returns radius_at() of a ball. It is asked for most often, and so gets the slant of the tube.
double radius_at_ball(const Tube& tube, double slant, const DVec3& centre, double radius) {
    const DVec3 since = centre - tube.from;
    const double start = dot_product(since, tube.direction), reach = reach_at(tube, slant, start, radius);
    const bool near = reach >= 0 && dot_product(since, since) - start * start <= reach * reach;
    return near && start >= -radius && start <= tube.length + radius ? bound_at(tube, start, radius) : -1;
}

}  // namespace

double radius_at(const Tube& tube, const Capsule& capsule) {
    const double slant = slant_of(tube);
    if (capsule.from == capsule.to) return radius_at_ball(tube, slant, capsule.from, capsule.radius);
    const DVec3 since = capsule.from - tube.from, way = capsule.to - capsule.from;
    const double start = dot_product(since, tube.direction);
    // Balls of the capsule's radius reach into the tube where their centres are no further from the way than `reach`.
    const double reach = reach_at(tube, slant, start, capsule.radius);
    const auto radius = [&](double along) { return bound_at(tube, along, capsule.radius); };
    const double ahead = dot_product(way, tube.direction), more = tube.growth * ahead;
    Stretch part;
    part.clip(start + capsule.radius, ahead);
    part.clip(tube.length + capsule.radius - start, -ahead);
    part.clip(reach, more);
    if (!(part.low <= part.high)) return -1;
    // |p + t q| <= reach + more t: a part of the way, for tubes have no hollows.
    const DVec3 p = since - start * tube.direction, q = way - ahead * tube.direction;
    const double a = dot_product(q, q) - more * more, b = dot_product(p, q) - reach * more;
    const double c = dot_product(p, p) - reach * reach;
    if (a > 0) {
        const double squared = b * b - a * c;
        if (!(squared >= 0)) return -1;
        const double root = std::sqrt(squared);
        part.low = std::max(part.low, (-b - root) / a), part.high = std::min(part.high, (-b + root) / a);
        if (!(part.low <= part.high)) return -1;
    } else {
        const auto outside = [&](double t) { return (a * t + 2 * b) * t + c > 0; };
        if (outside(part.low) && outside(part.high)) return -1;
    }
    return std::max(radius(start + part.low * ahead), radius(start + part.high * ahead));
}

CapsuleTree::CapsuleTree(const Scene& scene, bool with_facets) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Box everywhere{DVec3(-infinity), DVec3(infinity)};
    std::vector<TreeLeaf> all;
    Box box;
    double lengths = 0;                // of all facets together
    std::vector<std::int32_t> bodies;  // of the facets
    for (const Primitive& primitive : scene.primitives) {
        const auto body = static_cast<std::int32_t>(whole.size());
        for (const Capsule& capsule : capsules_of(primitive))
            all.push_back({capsule, everywhere, capsule.radius, body, -1});
        whole.push_back(false);
        if (!with_facets) continue;
        for (Facet& facet : facets_of(primitive)) {
            whole.back() = facet.whole;
            for (const DVec3& corner : facet.corners) box.add(corner);
            lengths += length(longest_side(facet.corners));
            facets.push_back(std::move(facet));
            bodies.push_back(body);
        }
    }
    // Finer pieces did not help in a CAD model of 2,710 triangles.
    constexpr double finest = 1. / 128, most_pieces = 1e5;
    const double shortest = std::max(finest * length(box.size()), lengths / most_pieces);
    for (std::size_t i = 0; i < facets.size(); ++i)
        add_pieces(facets[i], shortest, [&](std::span<const DVec3> piece, int pieces) {
            const Capsule ball = ball_around([&](const auto& add) {
                for (const DVec3& corner : piece) add(corner, 0);
            });
            Box own;
            for (const DVec3& corner : piece) own.add(corner);
            all.push_back({ball, own, facets[i].least, bodies[i], static_cast<std::int32_t>(i), pieces > 1});
        });
    if (all.empty()) return;
    nodes.reserve(2 * all.size() - 1);
    add(all);
}

/// Adds a node for them, and below it one for each half.
void CapsuleTree::add(std::span<TreeLeaf> leaves) {
    const std::size_t own = nodes.size();
    const bool single = leaves.size() == 1;
    const Capsule around = single ? leaves[0].around : ball_around([&](const auto& add) {
        for (const TreeLeaf& leaf : leaves)
            add(leaf.around.from, leaf.around.radius), add(leaf.around.to, leaf.around.radius);
    });
    const double least = std::ranges::min(leaves, {}, &TreeLeaf::least).least;
    Box box;
    for (const TreeLeaf& leaf : leaves) box.add(leaf.box);
    nodes.push_back(
        {around, box, least, 0, single, single && leaves[0].is_piece, leaves[0].body, single ? leaves[0].facet : -1});
    if (!single) {
        const std::size_t half = leaves.size() / 2;
        halve(leaves, half, [](const TreeLeaf& leaf) { return leaf.around.from + leaf.around.to; });
        add(leaves.first(half)), add(leaves.subspan(half));
    }
    nodes[own].next = static_cast<std::int32_t>(nodes.size());
}

/// Calls visit(leaf, radius) for the leaves that reach into the tube and are thinner than it is there, with a bound on
/// its radius, until one returns true; returns whether one did. Leaves out facets that the bundle does not meet, whose
/// coordinates are `to_own`, and visits those of several pieces once.
template <class Visit>
bool CapsuleTree::any_thin(const Tube& tube, const RayBundle& bundle, const glm::dmat3& to_own,
                           const Visit& visit) const {
    const double slant = slant_of(tube);
    const BoxesBeside beside(bundle, to_own);
    std::vector<std::int32_t> visited;
    for (std::size_t i = 0; i < nodes.size();) {
        const CapsuleNode& node = nodes[i];
        const double radius = node.is_leaf && node.facet < 0
                                  ? radius_at(tube, node.around)
                                  : radius_at_ball(tube, slant, node.around.from, node.around.radius);
        if (!(radius >= 0 && radius >= node.least) || (!facets.empty() && beside.has(node.facets))) {
            i = std::size_t(node.next);
            continue;
        }
        ++i;
        if (!node.is_leaf) continue;
        if (node.is_piece) {
            if (std::ranges::find(visited, node.facet) != visited.end()) continue;
            visited.push_back(node.facet);
        }
        if (visit(node, radius)) return true;
    }
    return false;
}

bool CapsuleTree::meets(const Tube& tube, const RayBundle& bundle, double least, FacetsSeen seen,
                        std::span<const DVec3> own) const {
    const glm::dmat3 to_own = facets.empty() ? glm::dmat3(1) : bundle.coordinates();
    constexpr unsigned all = 15;
    double largest[all + 1] = {};  // largest share of the facets that a set of corners meets
    const bool found = any_thin(tube, bundle, to_own, [&](const CapsuleNode& node, double radius) {
        if (node.facet >= 0) {
            const auto [share, corners, sides] = bundle.met(facets[node.facet].corners, to_own);
            if (corners == 0) return share >= least;
            if (corners == all) return false;
            if (seen == FacetsSeen::split && sides > 1 && std::min(share, 1 - share) >= least) return true;
            largest[corners] = std::max(largest[corners], share);
            return false;
        }
        const Capsule& body = node.around;
        const double width = 2 * body.radius, across = std::min(2 * radius, quick_length(body.to - body.from)) + width;
        if (width * across < least * tube.area * radius * radius) return false;
        const auto inside = [&](const DVec3& p) { return distance_to(body, p) < body.radius * (1 + 1e-3); };
        return own.empty() || !std::ranges::all_of(own, inside);
    });
    if (found) return true;
    for (unsigned corners = 1; corners < all; ++corners) {
        const double share = largest[corners], other = largest[all - corners];
        const bool whole = other > 0 && share + other > 1 - least;
        if (seen == FacetsSeen::same && std::min(share, 1 - share) >= least && !whole) return true;
        if (seen == FacetsSeen::split && share > 0 && other > 0 && !whole) return true;
    }
    return false;
}

namespace {

using Outline = std::vector<glm::dvec2>;

/// Returns the area of the union of convex polygons: between heights at which there is a corner or two sides cross, its
/// width is linear.
double area_of_union(std::span<const Outline> polygons) {
    std::vector<double> heights;
    const auto each_side = [](const Outline& polygon, const auto& visit) {
        for (std::size_t k = 0; k < polygon.size(); ++k) visit(polygon[k], polygon[(k + 1) % polygon.size()]);
    };
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        for (const glm::dvec2& corner : polygons[i]) heights.push_back(corner.y);
        for (std::size_t j = 0; j < i; ++j)
            each_side(polygons[i], [&](const glm::dvec2& from, const glm::dvec2& to) {
                each_side(polygons[j], [&](const glm::dvec2& other, const glm::dvec2& end) {
                    const glm::dvec2 way = to - from, other_way = end - other, between = other - from;
                    const double crossed = way.x * other_way.y - way.y * other_way.x;
                    const double t = (between.x * other_way.y - between.y * other_way.x) / crossed;
                    if (t > 0 && t < 1) heights.push_back(from.y + t * way.y);
                });
            });
    }
    std::ranges::sort(heights);
    double area = 0;
    std::vector<std::pair<double, double>> stretches;
    for (std::size_t k = 1; k < heights.size(); ++k) {
        const double height = heights[k] - heights[k - 1], y = heights[k - 1] + height / 2;
        if (!(height > 0)) continue;
        stretches.clear();
        for (const Outline& polygon : polygons) {
            std::pair<double, double> own{HUGE_VAL, -HUGE_VAL};
            each_side(polygon, [&](const glm::dvec2& from, const glm::dvec2& to) {
                if ((from.y < y) == (to.y < y)) return;
                const double x = from.x + (y - from.y) / (to.y - from.y) * (to.x - from.x);
                own = {std::min(own.first, x), std::max(own.second, x)};
            });
            if (own.first < own.second) stretches.push_back(own);
        }
        std::ranges::sort(stretches);
        double end = -HUGE_VAL;
        for (const auto& [low, high] : stretches) {
            if (high > end) area += height * (high - std::max(low, end));
            end = std::max(end, high);
        }
    }
    return area;
}

}  // namespace

std::optional<FlatPart> CapsuleTree::flat_part(const Tube& tube, const RayBundle& bundle) const {
    if (facets.empty()) return std::nullopt;
    const glm::dmat3 to_own = bundle.coordinates();
    std::int32_t body = -1;
    FlatPart part;
    double largest = 0;
    std::vector<std::array<glm::dvec2, 2>> ends;  // corners of the polygons, and their middles
    std::vector<Outline> polygons;
    Outline outline;
    const bool others = any_thin(tube, bundle, to_own, [&](const CapsuleNode& node, double) {
        if (!whole[node.body]) return true;
        if (node.facet < 0) return false;
        const auto [share, corners, sides] = bundle.met(facets[node.facet].corners, to_own, &outline);
        if (share == 0) return false;
        constexpr std::size_t most_polygons = 12, most_ends = 96;  // dense meshes are divided
        if ((body >= 0 && node.body != body) || polygons.size() == most_polygons || ends.size() > most_ends)
            return true;
        body = node.body;
        part.corners |= corners;
        polygons.push_back(outline);
        glm::dvec2 middle(0);
        for (const glm::dvec2& point : outline) middle += 1. / static_cast<double>(outline.size()) * point;
        for (const glm::dvec2& point : outline) ends.push_back({point, middle});
        if (share > largest) largest = share, part.places[0] = middle;
        return false;
    });
    if (others || body < 0) return std::nullopt;
    part.share = polygons.size() == 1 ? largest : area_of_union(polygons);
    glm::dvec2 from = part.places[0];
    for (const int k : {1, 2}) {
        // Squares are compared, since the last bit of std::hypot differs between systems.
        const auto squared = [&](const auto& end) { return glm::dot(end[0] - from, end[0] - from); };
        const auto& [end, middle] = *std::ranges::max_element(ends, {}, squared);
        constexpr double inside = .6;  // of the way to the corner: arcs of rings bend by up to .125 of their width
        part.places[k] = middle + inside * (end - middle), from = end;
    }
    return part;
}

}  // namespace strahl
