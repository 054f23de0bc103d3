// Chooses the origin and the unit of a world's coordinates.
#include <algorithm>
#include <cmath>

#include "num/vec_math.h"
#include "scene/overlap.h"
#include "trace/world/build_world.h"

namespace strahl {
namespace {

/// Returns how far bodies and lights reach from a point.
double reach_from(const DVec3& point, const Scene& scene) {
    double most = 0;
    for (const Primitive& primitive : scene.primitives) most = std::max(most, reach_from(point, primitive));
    for (const Light& light : scene.lights)
        for (int c = 0; c < 3 && !light.direction; ++c) most = std::max(most, std::fabs(light.position[c] - point[c]));
    return most;
}

}  // namespace

Extent extent_of(const Scene& scene) {
    constexpr std::size_t enough = 4096;
    const std::size_t stride = 1 + scene.primitives.size() / enough;
    std::vector<double> along[3], sizes;
    for (std::size_t i = 0; i < scene.primitives.size(); i += stride) {
        const Box box = world_bounds(scene.primitives[i]);
        if (!box.finite()) continue;
        const DVec3 centre = box.centre(), size = box.size();
        for (int c = 0; c < 3; ++c) along[c].push_back(centre[c]);
        sizes.push_back(std::max({size.x, size.y, size.z}));
    }
    if (sizes.empty()) return {scene.camera.look_at, length(scene.camera.position - scene.camera.look_at)};
    const auto quantile = [](std::vector<double>& values, int quarters) {
        const auto nth = values.begin() + (values.size() - 1) * quarters / 4;
        std::nth_element(values.begin(), nth, values.end());
        return *nth;
    };
    Extent extent;
    double spread = 0;
    for (int c = 0; c < 3; ++c) {
        extent.centre[c] = quantile(along[c], 2);
        spread = std::max(spread, quantile(along[c], 3) - quantile(along[c], 1));
    }
    // Boxes of bodies below the last bit of where they are have no size. What is smaller than this share of the way to
    // the scene's camera cannot be seen from there, and with such a unit that way would leave the range of float.
    constexpr double least_share = 0x1p-40;
    const Camera& camera = scene.camera;
    const double way = std::max(length(camera.position - extent.centre), length(camera.position - camera.look_at));
    extent.size = std::max(2 * (spread + quantile(sizes, 2)), least_share * way);
    // Squares of coordinates must stay finite in float. In files coordinates end at 1e9: few scenes need a look.
    constexpr double most_units = 0x1p60, enough_for_files = 0x1p-28;
    if (extent.size < enough_for_files)
        extent.size = std::max(extent.size, reach_from(extent.centre, scene) / most_units);
    return extent;
}

Placement placement(const Extent& extent, const DVec3& camera) {
    const int exponent = std::ilogb(extent.size);
    const auto snap = [](const DVec3& p, double cell) {
        return DVec3(std::round(p.x / cell), std::round(p.y / cell), std::round(p.z / cell)) * cell;
    };
    const DVec3 home = snap(extent.centre, std::ldexp(1., exponent));
    return {home + snap(camera - home, std::ldexp(1., exponent + 3)), std::ldexp(1., -exponent)};
}

}  // namespace strahl
