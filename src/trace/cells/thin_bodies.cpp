#include "trace/cells/thin_bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "num/vec_math.h"
#include "trace/cells/cells.h"
#include "trace/kernel/kernel.h"

namespace strahl {
namespace {

/// Reflections are only looked for if reflected rays part at most so many times as fast as the camera's own. In mirrors
/// more curved everything is small, and not worth two to three times the rays.
constexpr double most_widening = 2;

/// Shadows and reflections are only looked for if no corner is so many times as far away as another: cells that reach
/// to the horizon are not parallelograms of the surface.
constexpr double most_receding = 2;

/// Limits distances for shadows in mirrors more closely, since they alone tell whether all corners show one surface.
constexpr double most_slanted = 1.05;

/// Cells of less than so many pixels are not divided for what facets that some of their corners meet may leave.
constexpr double finest_doubt = 1. / 8;
/// Facets at the very eye or light do not count.
constexpr double nearest_depth = 1e-9;
/// Facets nearer to a surface than so many times the distance between corners count as parts of it.
constexpr double own_depth = 1e-3;

/// In pictures that are not flat, directions part at most so many times as fast as in the middle.
constexpr double most_bent = std::numbers::pi / 2;

double square(const DVec3& v) { return dot_product(v, v); }
DVec3 middle_of(const FourPoints& corners) { return .25 * (corners[0] + corners[1] + corners[2] + corners[3]); }
/// Returns the area of the square between the corners as seen along a direction.
double area(const FourPoints& corners, const DVec3& direction) {
    return std::abs(dot_product(cross_product(corners[2] - corners[0], corners[3] - corners[1]), direction)) / 2;
}

double radius_of(const FourPoints& points) {
    const DVec3 middle = middle_of(points);
    double squared = 0;
    for (const DVec3& point : points) squared = std::max(squared, square(point - middle));
    return std::sqrt(squared);
}
/// Returns the largest tangent of the angles between the directions and the axis.
double growth_of(const FourPoints& directions, const DVec3& axis) {
    double squared = 0;
    for (const DVec3& direction : directions) {
        const double ahead = dot_product(direction, axis);
        if (!(ahead > 0)) return std::numeric_limits<double>::infinity();
        squared = std::max(squared, square(direction - ahead * axis) / (ahead * ahead));
    }
    return std::sqrt(squared);
}

}  // namespace

ThinBodies::ThinBodies(const Scene& scene, const View& view, std::shared_ptr<const CapsuleTree> known)
    : own(known ? std::move(known) : std::make_shared<const CapsuleTree>(scene)),
      bodies(*own),
      lights(points_of(scene.lights)),
      camera(view.camera),
      frame(frame_of(view.camera, static_cast<double>(view.width) / view.height)),
      width(view.width),
      height(view.height),
      shift_x(view.shift_x),
      shift_y(view.shift_y),
      eye(view.camera.position) {
    const EyeHalves halves = halves_of(view);
    right = (2 * frame.tan_x / (view.width - halves.column)) * frame.right;
    down = (2 * frame.tan_y / (view.height - halves.row)) * frame.down;
    diagonal = quick_length(right + down);
    if (!bodies.empty()) {
        const Capsule& all = bodies.around();
        end = std::max(length(all.from - eye), length(all.to - eye)) + all.radius;
    }
    if (camera.stereo != Stereo::none) end += camera.eye_distance / 2;
    if (starts_apart(camera.projection)) end += std::hypot(frame.tan_x, frame.tan_y);
    first = frame.forward + (view.shift_x - view.width / 2.) * right + (view.shift_y - view.height / 2.) * down;
}

ThinBodies::Sights ThinBodies::sights_at(const std::array<CellCorner, 4>& corners) const {
    Sights sights;
    const int which = eye_at(camera, (corners[0].x + corners[2].x + 2 * shift_x) / width - 1,
                             (corners[0].y + corners[2].y + 2 * shift_y) / height - 1);
    for (int k = 0; k < 4; ++k) {
        const auto& [x, y, sample] = corners[k];
        sights.starts[k] = eye, sights.ways[k] = first + x * right + y * down;
        if (!in_perspective(camera)) {
            const auto ray =
                camera_ray(camera, frame, 2 * (x + shift_x) / width - 1, 2 * (y + shift_y) / height - 1, which);
            sights.starts[k] = eye + ray.start, sights.ways[k] = ray.way;
        }
        sights.units[k] = quick_unit(sights.ways[k]);
    }
    return sights;
}

bool ThinBodies::hides_in(const std::array<CellCorner, 4>& corners, double least, std::optional<FlatPart>* part) const {
    if (bodies.empty()) return false;
    double least_distance = std::numeric_limits<double>::infinity(), most_distance = 0, furthest = 0, nearest = end;
    double brightest = 0, reflection = 0, further = 0, reach = 0;
    double least_way = least_distance, most_way = 0;  // by the mirror
    std::uint32_t lit = 0;
    bool one_surface = true, same = true;
    for (const CellCorner& corner : corners) {
        const CellSample& sample = *corner.sample;
        least_distance = std::min(least_distance, double(sample.distance));
        most_distance = std::max(most_distance, double(sample.distance));
        const double distance = std::min(double(sample.distance), end);
        furthest = std::max(furthest, distance), nearest = std::min(nearest, distance);
        for (const double value : sample.rgb) brightest = std::max(brightest, value);
        reflection = std::max(reflection, double(sample.reflection));
        further = std::max(further, double(sample.further));
        const double way = double(sample.distance) + double(sample.further);
        least_way = std::min(least_way, way), most_way = std::max(most_way, way);
        reach = std::max(reach, 1 + double(sample.further) / double(sample.distance));
        lit |= sample.lit;
        one_surface = one_surface && sample.surface == corners[0].sample->surface;
        same = same && sample.signature == corners[0].sample->signature;
    }
    one_surface = one_surface && corners[0].sample->surface >= 0 && most_distance < most_receding * least_distance;
    // How far apart the corners are, at most. Where all bodies are larger, neither they nor their shadows are thin.
    const double half = std::max(corners[2].x - corners[0].x, corners[2].y - corners[0].y) * diagonal / 2;
    const bool parallel = camera.projection == Projection::orthographic;
    const double own_radius = parallel ? half : 0;
    const double own_growth = parallel ? 0 : camera.projection == Projection::perspective ? half : most_bent * half;
    const double across = 2 * (own_radius + own_growth * (furthest + 2 * bodies.least()));
    const bool wide = !(across + furthest - nearest < .99 * bodies.least());
    FourPoints places, reflected;
    bool mirrors = one_surface && reflection > least && further > 0;
    if (mirrors) {
        for (int k = 0; k < 4; ++k) {
            const float* const direction = corners[k].sample->reflected;
            reflected[k] = DVec3(direction[0], direction[1], direction[2]);
        }
        const double widening = parallel ? own_radius / furthest : own_growth;
        mirrors = growth_of(reflected, quick_unit(middle_of(reflected))) < most_widening * widening;
    }
    if (!wide && !mirrors) return false;
    const Sights sights = sights_at(corners);
    const bool small = corners[2].x - corners[0].x < finest_doubt;
    const FacetsSeen seen = small ? FacetsSeen::any : same ? FacetsSeen::same : FacetsSeen::split;
    const bool in_sight = wide && hides_camera(corners, sights, furthest, seen, least, part);
    if (in_sight && (!part || !*part)) return true;
    // Drops the part: with something else hidden, the cell is more than that part and the rest.
    const auto besides = [&] {
        if (part) part->reset();
        return true;
    };
    if (!one_surface) {
        // Shadows beside a part are not looked for here, but in smaller cells, whose corners are all beside it.
        const bool large = corners[2].x - corners[0].x > finest_doubt;
        for (unsigned k = 0; k < 4 && in_sight && large; ++k)
            if (!((*part)->corners >> k & 1) && corners[k].sample->lit != 0) return besides();
        return in_sight;
    }
    if (lit == 0 && !mirrors) return in_sight;
    for (int k = 0; k < 4; ++k) places[k] = sights.starts[k] + double(corners[k].sample->distance) * sights.units[k];
    const double radius = radius_of(places);
    const double most_dark = least / brightest;  // all that a shadow can take
    if (wide && hides_shadow(places, radius, lit, seen, most_dark)) return besides();
    if (!mirrors) return in_sight;
    if (hides_reflection(places, radius, reflected, further, reach, seen, least / reflection)) return besides();
    // Shadows on what the mirror shows; in cells of less than finest_doubt they would take twice the samples.
    if (small || !(most_way < most_slanted * least_way)) return in_sight;
    for (int k = 0; k < 4; ++k) places[k] += double(corners[k].sample->further) * quick_unit(reflected[k]);
    return hides_shadow(places, radius_of(places), ~0u, seen, most_dark) ? besides() : in_sight;
}

bool ThinBodies::hides_camera(const std::array<CellCorner, 4>& corners, const Sights& sights, double furthest,
                              FacetsSeen seen, double least, std::optional<FlatPart>* part) const {
    const auto& [starts, ways, units] = sights;
    const bool parallel = camera.projection == Projection::orthographic;
    double depth = 0;  // in units of the ways: along `forward` in perspective
    for (int k = 0; k < 4; ++k)
        depth = std::max(depth, std::min(double(corners[k].sample->distance), end) / quick_length(ways[k]));
    const DVec3 axis = quick_unit(middle_of(units));
    const double radius = radius_of(starts), growth = parallel ? 0 : growth_of(units, axis);
    const Tube tube{.from = middle_of(starts),
                    .direction = axis,
                    .length = furthest,
                    .radius = radius,
                    .growth = growth,
                    .area = parallel ? area(starts, axis) / (radius * radius) : area(units, axis) / (growth * growth)};
    const FourPoints& sides = parallel ? starts : ways;
    const RayBundle bundle{.from = starts[0],
                           .corner = ways[0],
                           .across = sides[1] - sides[0],
                           .down = sides[3] - sides[0],
                           .parallel = parallel,
                           .nearest = nearest_depth,
                           .furthest = depth * (1 + own_depth)};
    if (!bodies.meets(tube, bundle, least, seen)) return false;
    if (part) *part = bodies.flat_part(tube, bundle);
    return true;
}

bool ThinBodies::hides_shadow(const FourPoints& points, double radius, std::uint32_t lit, FacetsSeen seen,
                              double least) const {
    if (radius < bodies.least()) return false;
    const DVec3 middle = middle_of(points);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (!(lit >> std::min<std::size_t>(i, most_lit) & 1)) continue;
        const Light& light = lights[i];
        const DVec3 way =
            light.direction ? -2 * end / quick_length(*light.direction) * *light.direction : light.position - middle;
        const double far = quick_length(way);
        const Tube tube{.from = middle,
                        .direction = way / far,
                        .length = far,
                        .radius = radius,
                        .growth = light.direction ? 0 : -radius / far,
                        .area = area(points, way / far) / (radius * radius)};
        const RayBundle bundle{.from = light.direction ? points[0] : light.position,
                               .corner = light.direction ? way / far : points[0] - light.position,
                               .across = points[1] - points[0],
                               .down = points[3] - points[0],
                               .parallel = light.direction.has_value(),
                               .nearest = light.direction ? own_depth * radius : nearest_depth,
                               .furthest = light.direction ? far : 1 - own_depth * radius / far};
        if (bodies.meets(tube, bundle, least, seen, points)) return true;
    }
    return false;
}

bool ThinBodies::hides_reflection(const FourPoints& points, double radius, const FourPoints& directions,
                                  double furthest, double reach, FacetsSeen seen, double least) const {
    const DVec3 axis = quick_unit(middle_of(directions)), middle = middle_of(points);
    const double growth = growth_of(directions, axis), start = radius * (1 + growth);
    const double longest = std::min(furthest, end + quick_length(middle - eye));
    if (!(start + growth * longest >= .99 * bodies.least())) return false;
    const double near_area = area(points, axis) / (start * start);
    const double far_area = growth > 0 ? area(directions, axis) / (growth * growth) : near_area;
    const Tube tube{.from = middle,
                    .direction = axis,
                    .length = furthest,
                    .radius = start,
                    .growth = growth,
                    .area = std::min(near_area, far_area)};
    if (camera.projection == Projection::orthographic)
        return bodies.meets(tube,
                            {.from = points[0],
                             .corner = quick_unit(directions[0]),
                             .across = points[1] - points[0],
                             .down = points[3] - points[0],
                             .parallel = true,
                             .nearest = own_depth * radius,
                             .furthest = furthest * (1 + own_depth)},
                            least, seen, points);
    // Rays from a flat mirror come from the eye's image behind it.
    FourPoints ways;
    for (int k = 0; k < 4; ++k) ways[k] = quick_length(points[k] - eye) * quick_unit(directions[k]);
    const double distance = quick_length(ways[0]);
    const RayBundle bundle{.from = middle_of(points) - middle_of(ways),
                           .corner = ways[0],
                           .across = ways[1] - ways[0],
                           .down = ways[3] - ways[0],
                           .parallel = false,
                           .nearest = 1 + own_depth * radius / distance,
                           .furthest = reach * (1 + own_depth)};
    return bodies.meets(tube, bundle, least, seen, points);
}

}  // namespace strahl
