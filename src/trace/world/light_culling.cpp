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

/// Returns whether the plane certainly does not cross the body.
bool clear_of(const BoundingVolume& plane, const BoundingVolume& body, double margin) {
    double reach = 0;  // of the box, along the normal
    for (int c = 0; c < 3; ++c) reach += std::abs(plane.normal[c]) * body.box.size()[c] / 2;
    return std::abs(height(plane, body.ball.centre)) > body.ball.radius + margin ||
           std::abs(height(plane, body.box.centre())) > reach + margin;
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
    if (bodies[body].plane) return false;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (i != body && !(bodies[i].plane ? clear_of(bodies[i], bodies[body], margin)
                                           : clear_of_each_other(bodies[i], bodies[body], margin)))
            return false;
    return true;
}

}  // namespace strahl
