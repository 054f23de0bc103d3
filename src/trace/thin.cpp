#include "trace/thin.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "num/vec_math.h"
#include "trace/cells.h"
#include "trace/kernel.h"

namespace strahl {
namespace {

using Quad = std::array<DVec3, 4>;

double square(const DVec3& v) { return dot_product(v, v); }
DVec3 unit(const DVec3& v) { return (1 / std::sqrt(square(v))) * v; }
DVec3 middle_of(const Quad& corners) { return .25 * (corners[0] + corners[1] + corners[2] + corners[3]); }
/// As seen along a direction.
double area(const Quad& corners, const DVec3& direction) {
    return std::abs(dot_product(cross_product(corners[2] - corners[0], corners[3] - corners[1]), direction)) / 2;
}

}  // namespace

Thin::Thin(const Scene& scene, const View& view) : bodies(scene), lights(scene.lights), eye(view.camera.position) {
    const CameraFrame frame = frame_of(view.camera, static_cast<double>(view.width) / view.height);
    right = (2 * frame.tan_x / view.width) * frame.right, down = (2 * frame.tan_y / view.height) * frame.down;
    diagonal = std::sqrt(square(right + down));
    if (bodies.least() < std::numeric_limits<double>::infinity())
        end = length(bodies.around().from - eye) + bodies.around().radius;
    first = frame.forward + (view.shift_x - view.width / 2.) * right + (view.shift_y - view.height / 2.) * down;
}

bool Thin::hides_in(const std::array<Corner, 4>& corners, double least) const {
    double furthest = 0, nearest = end, brightest = 0;
    std::uint32_t lit = 0;
    for (const Corner& corner : corners) {
        const double distance = std::min(double(corner.sample->distance), end);
        furthest = std::max(furthest, distance), nearest = std::min(nearest, distance);
        for (const double value : corner.sample->rgb) brightest = std::max(brightest, value);
        lit |= corner.sample->lit;
    }
    // How far apart the corners are, at most. Where all bodies are larger, that is the end of it.
    const double across = (corners[2].x - corners[0].x) * diagonal * (furthest + 2 * bodies.least());
    if (across + furthest - nearest < .99 * bodies.least()) return false;
    Quad places;
    for (int k = 0; k < 4; ++k) places[k] = unit(first + corners[k].x * right + corners[k].y * down);
    if (bodies.meets(from_eye(places, furthest), least)) return true;
    const auto elsewhere = [&](const Corner& corner) { return corner.sample->surface != corners[0].sample->surface; };
    if (lit == 0 || std::ranges::any_of(corners, elsewhere)) return false;
    for (int k = 0; k < 4; ++k) places[k] = eye + double(corners[k].sample->distance) * places[k];
    return hides_shadow(places, lit, least / brightest);  // all that a shadow can take
}

Tube Thin::from_eye(const Quad& directions, double furthest) const {
    const DVec3 axis = unit(middle_of(directions));
    double growth = 0;  // squared
    for (const DVec3& direction : directions) {
        const double ahead = dot_product(direction, axis);
        growth = std::max(growth, square(direction - ahead * axis) / (ahead * ahead));
    }
    return {.from = eye, .direction = axis, .length = furthest, .radius = 0, .growth = std::sqrt(growth),
            .area = area(directions, axis) / growth};
}

bool Thin::hides_shadow(const Quad& points, std::uint32_t lit, double least) const {
    const DVec3 middle = middle_of(points);
    double squared = 0;
    for (const DVec3& point : points) squared = std::max(squared, square(point - middle));
    const double radius = std::sqrt(squared);
    if (radius < bodies.least()) return false;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (!(lit >> std::min<std::size_t>(i, most_lit) & 1)) continue;
        const DVec3 way = lights[i].position - middle;
        const double far = std::sqrt(square(way));
        const Tube tube{.from = middle, .direction = way / far, .length = far, .radius = radius, .growth = -radius / far,
                        .area = area(points, way / far) / squared};
        if (bodies.meets(tube, least, points)) return true;
    }
    return false;
}

}  // namespace strahl
