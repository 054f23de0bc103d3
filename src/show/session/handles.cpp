#include "show/session/handles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "num/vec_math.h"
#include "show/session/body_editor.h"

namespace strahl {
namespace {

constexpr double least_factor = .01;  // by which a single drag scales

/// Returns the distance of a point from a line through these points.
double distance_from(const std::vector<glm::dvec2>& line, const glm::dvec2& point) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const glm::dvec2 way = line[i + 1] - line[i], to = point - line[i];
        const double size = way.x * way.x + way.y * way.y;
        const double share = size > 0 ? std::clamp((to.x * way.x + to.y * way.y) / size, 0., 1.) : 0;
        nearest = std::min(nearest, std::hypot(to.x - share * way.x, to.y - share * way.y));
    }
    return nearest;
}

/// Is the point within a closed line?
bool within_area(const std::vector<glm::dvec2>& edge, const glm::dvec2& point) {
    bool inside = false;
    for (std::size_t i = 0; i + 1 < edge.size(); ++i) {
        const glm::dvec2 &a = edge[i], &b = edge[i + 1];
        if ((a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

double in_steps(double value, double step) { return std::round(value / step) * step; }

}  // namespace

double round_length(double length) {
    const double power = std::pow(10., std::floor(std::log10(length)));
    return length >= 5 * power ? 5 * power : length >= 2 * power ? 2 * power : power;
}
int decimals_of(double pixel) { return std::clamp(static_cast<int>(std::ceil(-std::log10(pixel))), -9, 12); }

std::optional<glm::dvec2> place_in(const View& view, const DVec3& point) {
    const CameraFrame frame = frame_of(view.camera, double(view.width) / view.height);
    const DVec3 way = point - view.camera.position;
    const bool parallel = view.camera.projection == Projection::orthographic;
    if (!parallel && !in_perspective(view.camera)) return std::nullopt;
    const double along = dot_product(way, frame.forward), depth = parallel ? 1 : along;
    if (!(along > 1e-9 * length(way))) return std::nullopt;
    return glm::dvec2((dot_product(way, frame.right) / (depth * frame.tan_x) + 1) * view.width / 2,
                      (dot_product(way, frame.down) / (depth * frame.tan_y) + 1) * view.height / 2);
}

std::vector<DVec3> cone_circle(const DVec3& light, const Spot& spot, double angle) {
    const DVec3 axis = normalize(spot.look_at - light);
    const DVec3 aside = std::abs(axis.z) < .9 ? DVec3(0, 0, 1) : DVec3(1, 0, 0);
    const DVec3 u = normalize(cross_product(axis, aside)), v = cross_product(axis, u);
    const double radius = length(spot.look_at - light) * std::tan(std::min(angle, 80.) * std::numbers::pi / 180);
    std::vector<DVec3> points;
    for (int i = 0; i <= 32; ++i) {
        const double along = 2 * std::numbers::pi * i / 32;
        points.push_back(spot.look_at + radius * (std::cos(along) * u + std::sin(along) * v));
    }
    return points;
}

Handles::Handles(HandleMode mode, const DVec3& centre, const std::array<DVec3, 3>& axes, double pixels,
                 const View& view, bool only_even)
    : mode(mode), centre(centre), axes(axes), view(view) {
    const CameraFrame frame = frame_of(view.camera, double(view.width) / view.height);
    right = frame.right, down = frame.down, forward = frame.forward;
    if (!place_in(view, centre)) return;
    pixel = 2 * frame.tan_x / view.width;
    if (view.camera.projection == Projection::perspective) pixel *= dot_product(centre - view.camera.position, forward);
    reach = pixels * pixel;
    constexpr int pieces = 48;
    const DVec3 sight = sight_of_centre();
    const auto circle = [&](Handle handle, const DVec3& u, const DVec3& v, double radius, bool front) {
        std::vector<DVec3> points;
        for (int i = 0; i <= pieces; ++i) {
            const double angle = 2 * std::numbers::pi * i / pieces;
            const DVec3 out = std::cos(angle) * u + std::sin(angle) * v;
            // The half behind the centre is left out.
            if (!front || dot_product(out, sight) <= .05) {
                points.push_back(centre + radius * out);
            } else if (!points.empty()) {
                add_line(handle, points), points.clear();
            }
        }
        if (points.size() > 1) add_line(handle, points);
    };
    for (const Handle handle : {Handle::x, Handle::y, Handle::z}) {
        if (only_even && mode == HandleMode::scale) break;
        const DVec3 along = axis(handle);
        if (mode == HandleMode::turn) {
            const auto i = static_cast<std::size_t>(handle);
            circle(handle, axes[(i + 1) % 3], axes[(i + 2) % 3], reach, true);
            continue;
        }
        add_line(handle, {centre + .18 * reach * along, centre + reach * along});
        if (mode == HandleMode::scale) {
            add_square(handle, centre + reach * along, .07 * reach);
            continue;
        }
        const DVec3 side = cross_product(along, forward);
        if (length(side) < .05) continue;  // it points to the eye
        const DVec3 wide = .06 * reach * normalize(side), back = centre + .84 * reach * along;
        add_line(handle, {centre + reach * along, back + wide, back - wide, centre + reach * along}, true);
    }
    if (mode == HandleMode::turn)
        circle(Handle::all, right, down, 1.15 * reach, false);
    else
        add_square(Handle::all, centre, .1 * reach);
}

Handles::Handles(const DVec3& light, const Spot& spot, const View& view)
    : mode(HandleMode::scale), cone(true), centre(spot.look_at), view(view) {
    add_line(Handle::y, cone_circle(light, spot, spot.radius));
    add_line(Handle::all, cone_circle(light, spot, spot.falloff));
}

void Handles::add_line(Handle handle, const std::vector<DVec3>& points, bool filled) {
    HandleLine line{handle, {}, filled};
    for (const DVec3& point : points)
        if (const auto place = place_in(view, point)) line.points.push_back(*place);
    if (line.points.size() == points.size()) drawn.push_back(std::move(line));
}

void Handles::add_square(Handle handle, const DVec3& at, double side) {
    const DVec3 u = side * right, v = side * down;
    add_line(handle, {at + u + v, at + u - v, at - u - v, at - u + v, at + u + v}, true);
}

std::optional<Handle> Handles::at(const glm::dvec2& point, double within) const {
    std::optional<Handle> nearest;
    for (const HandleLine& line : drawn) {
        const double distance = line.filled && within_area(line.points, point) ? 0 : distance_from(line.points, point);
        if (distance <= within) within = distance, nearest = line.handle;
    }
    return nearest;
}

/// Returns the direction in which the centre is seen.
DVec3 Handles::sight_of_centre() const {
    return view.camera.projection == Projection::orthographic ? forward : normalize(centre - view.camera.position);
}

/// Returns the place along an axis, from the centre, that is nearest to what is seen at a point.
double Handles::along_axis(Handle handle, const glm::dvec2& point) const {
    const Ray<double> ray = ray_at(view, point.x, point.y);
    const DVec3 along = axis(handle), sight = ray.direction, from = centre - ray.origin;
    const double same = dot_product(along, sight), square = std::max(1 - same * same, 1e-4);
    return (same * dot_product(from, sight) - dot_product(from, along)) / square;
}

/// Returns the point of the plane through the centre, across the view, that is seen there.
DVec3 Handles::in_plane(const glm::dvec2& point) const {
    const Ray<double> ray = ray_at(view, point.x, point.y);
    return ray.origin + dot_product(centre - ray.origin, forward) / dot_product(ray.direction, forward) * ray.direction;
}

/// Returns the angle by which a drag along a circle turns it.
double Handles::turn_degrees(Handle handle, const glm::dvec2& from, const glm::dvec2& to) const {
    const double degree = 180 / std::numbers::pi;
    if (handle == Handle::all) {  // seen from the tip of an axis that points to the eye
        const glm::dvec2 middle = place_in(view, centre).value_or(from), a = from - middle, b = to - middle;
        return degree * std::atan2(a.y * b.x - a.x * b.y, a.x * b.x + a.y * b.y);
    }
    // The way along the tangent where the drag began: right also where the circle is seen from its side.
    const DVec3 along = axis(handle);
    const std::vector<HandleLine>& all = drawn;
    double nearest = std::numeric_limits<double>::infinity();
    glm::dvec2 tangent(1, 0);
    const auto i = static_cast<std::size_t>(handle);
    const DVec3 sight = sight_of_centre();
    for (int step = 0; step < 180 && !all.empty(); ++step) {
        const double angle = step * 2 / degree;
        const DVec3 out = std::cos(angle) * axes[(i + 1) % 3] + std::sin(angle) * axes[(i + 2) % 3];
        if (dot_product(out, sight) > .05) continue;
        const auto here = place_in(view, centre + reach * out);
        const auto there = place_in(view, centre + reach * (out + .01 * cross_product(along, out)));
        if (!here || !there) continue;
        const double distance = std::hypot(here->x - from.x, here->y - from.y);
        if (distance < nearest) nearest = distance, tangent = 100. * (*there - *here);
    }
    const double pixels = reach / pixel, size = std::max(std::hypot(tangent.x, tangent.y), .3 * pixels);
    return degree * ((to.x - from.x) * tangent.x + (to.y - from.y) * tangent.y) / (size * size);
}

Placing Handles::drag(Handle handle, const glm::dvec2& from, const glm::dvec2& to, bool steps) const {
    if (mode == HandleMode::turn) {
        const double degrees = turn_degrees(handle, from, to);
        return TurnBy{handle == Handle::all ? DVec3(0) - forward : axis(handle),
                      steps ? in_steps(degrees, 15) : degrees, centre};
    }
    if (cone) {
        const glm::dvec2 middle = place_in(view, centre).value_or(from), a = from - middle, b = to - middle;
        const double factor = std::hypot(b.x, b.y) / std::max(std::hypot(a.x, a.y), 1.);
        return ScaleBy{DVec3(std::max(steps ? in_steps(factor, .1) : factor, least_factor)), centre};
    }
    const double step = round_length(20 * pixel);
    if (mode == HandleMode::move && handle == Handle::all) {
        DVec3 by = in_plane(to) - in_plane(from);
        for (int i = 0; i < 3 && steps; ++i) by[i] = in_steps(centre[i] + by[i], step) - centre[i];
        return MoveBy{by};
    }
    const double way = handle == Handle::all ? ((to.x - from.x) - (to.y - from.y)) * pixel
                                             : along_axis(handle, to) - along_axis(handle, from);
    if (mode == HandleMode::move) {
        const double at = dot_product(centre, axis(handle));
        return MoveBy{(steps ? in_steps(at + way, step) - at : way) * axis(handle)};
    }
    double factor = 1 + way / reach;
    if (steps) factor = in_steps(factor, .1);
    factor = std::max(factor, steps ? .1 : least_factor);
    ScaleBy scale{DVec3(1), centre};
    for (int i = 0; i < 3; ++i)
        if (handle == Handle::all || i == static_cast<int>(handle)) scale.factors[i] = factor;
    return scale;
}

Ray<double> Handles::ray(const glm::dvec2& point) const { return ray_at(view, point.x, point.y); }

int Handles::decimals() const { return decimals_of(pixel); }

}  // namespace strahl
