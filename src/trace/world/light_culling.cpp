#include "trace/world/light_culling.h"

#include <cmath>

#include "num/vec_math.h"

namespace strahl {
namespace {

/// Returns how far in front of a plane a point is.
double height(const BoundingVolume& plane, const DVec3& point) {
    return dot_product(plane.normal, point) - plane.distance;
}

/// Returns whether the whole ball is on the light's side of the plane (side 1) or on the other (side -1).
bool beside(const BoundingVolume& plane, const Ball& ball, const LightPlace& light, double margin, int side) {
    const double own = height(plane, ball.centre);
    const double lights = light.parallel ? dot_product(plane.normal, light.point) : height(plane, light.point);
    constexpr double least_slope = 1e-6;
    if (!(std::abs(lights) > (light.parallel ? least_slope : margin))) return false;
    return side * (lights > 0 ? own : -own) > ball.radius + margin;
}

/// Returns whether a ball certainly does not reach between the light and another ball.
bool apart(const Ball& other, const Ball& lit, const LightPlace& light, double margin) {
    if (light.parallel) {
        const DVec3 way = other.centre - lit.centre;
        const double reach = other.radius + lit.radius + 2 * margin, along = dot_product(way, light.point);
        return along < -reach || length(way - along * light.point) > reach + 1e-6 * length(way);
    }
    const DVec3 to_other = other.centre - light.point, to_lit = lit.centre - light.point;
    const double d = length(to_other), e = length(to_lit), r = other.radius + margin, s = lit.radius + margin;
    if (d - r > e + s) return true;
    if (!(d > r && e > s)) return false;
    const double between = std::acos(std::clamp(dot_product(to_other, to_lit) / (d * e), -1., 1.));
    return between > std::asin(r / d) + std::asin(s / e) + 1e-6;
}

struct Breadth {
    double low, high;
    double size() const { return high - low; }
};
/// Returns where a body lies along a unit vector. Of an unbounded one both are infinite.
Breadth breadth_of(const BoundingVolume& body, const DVec3& axis) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (!body.bounded()) return {-infinity, infinity};
    double reach = 0;  // half the box's extent along the axis
    for (int c = 0; c < 3; ++c) reach += std::abs(axis[c]) * body.box.size()[c] / 2;
    const double box = dot_product(axis, body.box.centre()), ball = dot_product(axis, body.ball.centre);
    return {std::max(box - reach, ball - body.ball.radius), std::min(box + reach, ball + body.ball.radius)};
}

/// Returns whether the plane certainly does not cross the body.
bool clear_of(const BoundingVolume& plane, const BoundingVolume& body, double margin) {
    const Breadth along = breadth_of(body, plane.normal);
    return along.low - plane.distance > margin || along.high - plane.distance < -margin;
}
bool clear_of_each_other(const BoundingVolume& a, const BoundingVolume& b, double margin) {
    for (int c = 0; c < 3; ++c)
        if (a.box.low[c] - b.box.high[c] > margin || b.box.low[c] - a.box.high[c] > margin) return true;
    return length(a.ball.centre - b.ball.centre) > a.ball.radius + b.ball.radius + margin;
}

}  // namespace

template <class T>
LightCone<T> cone_of(const BoundingVolume& body, const LightPlace& light, double margin) {
    if (light.parallel) return {};
    const DVec3 way = body.ball.centre - light.point;
    const double away = length(way), radius = body.ball.radius + margin;
    if (body.plane || !(radius < .99 * away) || !std::isfinite(away)) return {};
    constexpr double rounding = 32 * culling_unit<T>;
    const double cosine = std::sqrt(1 - radius / away * (radius / away)) - rounding;
    const DVec3 axis = way / away;
    return {{static_cast<T>(axis.x), static_cast<T>(axis.y), static_cast<T>(axis.z)},
            static_cast<T>(cosine),
            static_cast<T>((away - radius) * (1 - rounding))};
}
template LightCone<float> cone_of(const BoundingVolume&, const LightPlace&, double);
template LightCone<double> cone_of(const BoundingVolume&, const LightPlace&, double);
template LightCone<long double> cone_of(const BoundingVolume&, const LightPlace&, double);

LightAxes axes_across(const std::vector<BoundingVolume>& bodies, const DVec3& towards) {
    LightAxes best;
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        DVec3 u = -towards[axis] * towards;
        u[axis] += 1;
        if (length(u) < .01) continue;  // the light shines along it
        u /= length(u);
        const LightAxes axes{u, cross_product(towards, u), towards};
        double area = 0;
        for (const BoundingVolume& body : bodies)
            if (body.bounded()) area += breadth_of(body, axes.u).size() * breadth_of(body, axes.v).size();
        if (area < least) least = area, best = axes;
    }
    return best;
}

template <class T>
ParallelShadows<T> shadows_of(const std::vector<BoundingVolume>& bodies, const LightAxes& axes, double margin) {
    ParallelShadows<T> shadows;
    for (auto* low : {&shadows.left, &shadows.bottom}) low->fill(-std::numeric_limits<T>::infinity());
    for (auto* high : {&shadows.right, &shadows.top, &shadows.end}) high->fill(std::numeric_limits<T>::infinity());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Breadth u = breadth_of(bodies[i], axes.u), v = breadth_of(bodies[i], axes.v);
        shadows.left[i] = static_cast<T>(u.low - margin), shadows.right[i] = static_cast<T>(u.high + margin);
        shadows.bottom[i] = static_cast<T>(v.low - margin), shadows.top[i] = static_cast<T>(v.high + margin);
        shadows.end[i] = static_cast<T>(breadth_of(bodies[i], axes.towards).high + margin);
    }
    return shadows;
}
template ParallelShadows<float> shadows_of(const std::vector<BoundingVolume>&, const LightAxes&, double);
template ParallelShadows<double> shadows_of(const std::vector<BoundingVolume>&, const LightAxes&, double);
template ParallelShadows<long double> shadows_of(const std::vector<BoundingVolume>&, const LightAxes&, double);

BodySet occluders_of(const std::vector<BoundingVolume>& bodies, std::size_t body, const LightPlace& light,
                     double margin) {
    const BoundingVolume& lit = bodies[body];
    const auto may_occlude = [&](std::size_t i) {
        const BoundingVolume& other = bodies[i];
        if (i == body) return !lit.plane;
        if (other.plane) return lit.plane || !beside(other, lit.ball, light, margin, 1);
        return lit.plane ? !beside(lit, other.ball, light, margin, -1) : !apart(other.ball, lit.ball, light, margin);
    };
    BodySet set = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (may_occlude(i)) set |= BodySet(1) << i;
    return set;
}

bool isolated(const std::vector<BoundingVolume>& bodies, std::size_t body, double margin) {
    if (!bodies[body].bounded()) return false;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (i != body && !(bodies[i].plane ? clear_of(bodies[i], bodies[body], margin)
                                           : clear_of_each_other(bodies[i], bodies[body], margin)))
            return false;
    return true;
}

}  // namespace strahl
