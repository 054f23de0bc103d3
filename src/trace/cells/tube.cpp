#include "trace/cells/tube.h"

#include <algorithm>
#include <cmath>

#include "num/vec_math.h"
#include "scene/box_tree.h"

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

/// Returns a ball around capsules.
Capsule ball_around(std::span<const Capsule> capsules) {
    Box box;
    for (const Capsule& capsule : capsules) box.add(capsule.from), box.add(capsule.to);
    const DVec3 centre = box.centre();
    double radius = 0;
    for (const Capsule& capsule : capsules)
        for (const DVec3& end : {capsule.from, capsule.to})
            radius = std::max(radius, quick_length(end - centre) + capsule.radius);
    return {centre, centre, radius * (1 + 1e-12)};
}

}  // namespace

double radius_at(const Tube& tube, const Capsule& capsule) {
    const DVec3 since = capsule.from - tube.from, way = capsule.to - capsule.from;
    const double start = dot_product(since, tube.direction);
    // Balls of the capsule's radius reach into the tube where their centres are no further from the way than `reach`.
    const double slant = std::sqrt(1 + tube.growth * tube.growth);
    const double reach = tube.radius + tube.growth * start + capsule.radius * slant;
    const auto radius = [&](double s) {
        s += tube.growth < 0 ? -capsule.radius : capsule.radius;
        return tube.radius + tube.growth * std::clamp(s, 0., tube.length);
    };
    if (capsule.from == capsule.to) {
        const bool between = start >= -capsule.radius && start <= tube.length + capsule.radius;
        const bool near = reach >= 0 && dot_product(since, since) - start * start <= reach * reach;
        return between && near ? radius(start) : -1;
    }
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

CapsuleTree::CapsuleTree(const Scene& scene) {
    std::vector<Capsule> all;
    for (const Primitive& primitive : scene.primitives) {
        const std::vector<Capsule> own = capsules_of(primitive);
        all.insert(all.end(), own.begin(), own.end());
    }
    if (all.empty()) return;
    nodes.reserve(2 * all.size() - 1);
    add(all);
}

/// Adds a node for them, and below it one for each half.
void CapsuleTree::add(std::span<Capsule> capsules) {
    const std::size_t own = nodes.size();
    const bool leaf = capsules.size() == 1;
    const double least = std::ranges::min(capsules, {}, &Capsule::radius).radius;
    nodes.push_back({leaf ? capsules[0] : ball_around(capsules), least, 0, leaf});
    if (!leaf) {
        halve(capsules, [](const Capsule& capsule) { return capsule.from + capsule.to; });
        const std::size_t half = capsules.size() / 2;
        add(capsules.first(half)), add(capsules.subspan(half));
    }
    nodes[own].next = static_cast<std::int32_t>(nodes.size());
}

bool CapsuleTree::meets(const Tube& tube, double least, std::span<const DVec3> own) const {
    for (std::size_t i = 0; i < nodes.size();) {
        const CapsuleNode& node = nodes[i];
        const double radius = radius_at(tube, node.around);
        if (!(radius >= node.least)) {
            i = std::size_t(node.next);
            continue;
        }
        ++i;
        if (!node.leaf) continue;
        const Capsule& body = node.around;
        const double width = 2 * body.radius, across = std::min(2 * radius, quick_length(body.to - body.from)) + width;
        if (width * across < least * tube.area * radius * radius) continue;
        const auto inside = [&](const DVec3& p) { return distance_to(body, p) < body.radius * (1 + 1e-3); };
        if (own.empty() || !std::ranges::all_of(own, inside)) return true;
    }
    return false;
}

}  // namespace strahl
