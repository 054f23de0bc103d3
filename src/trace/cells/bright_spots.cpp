#include "trace/cells/bright_spots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "num/vec_math.h"
#include "scene/leaves.h"
#include "scene/overlap.h"
#include "trace/world/light_bound.h"

namespace strahl {
namespace {

constexpr double white = 1;

/// Returns the radius of a ball around a body with this box.
double radius_in(const Shape& shape, const Box& box) {
    const DVec3 size = box.size();
    return (std::holds_alternative<Sphere>(shape) ? std::max({size.x, size.y, size.z}) : length(size)) / 2;
}

SeenBall seen(const View& view, const CameraFrame& frame, const DVec3& middle, double radius) {
    const DVec3 way = middle - view.camera.position;
    const double depth = dot_product(way, frame.forward), far = length(way);
    if (!(depth > radius)) return {};
    const double u = dot_product(way, frame.right) / depth, v = dot_product(way, frame.down) / depth;
    const double unit_x = view.width / (2 * frame.tan_x), unit_y = view.height / (2 * frame.tan_y);  // in pixels
    const double half = radius / depth * (far / depth) / std::sqrt(1 - radius * radius / (depth * depth));
    const double blur = view.camera.aperture * (1 / depth - 1 / focal_distance(view.camera));
    return {.x = (view.width - 1) / 2. + u * unit_x - view.shift_x,
            .y = (view.height - 1) / 2. + v * unit_y - view.shift_y,
            .half_x = half * unit_x,
            .half_y = half * unit_y,
            .blur_x = blur * unit_x,
            .blur_y = blur * unit_y};
}

}  // namespace

double SeenBall::share() const {
    constexpr double pixel = .5;
    return std::min(half_x / (std::abs(blur_x) + pixel), 1.) * std::min(half_y / (std::abs(blur_y) + pixel), 1.);
}

void BrightSpots::add(const Scene& scene, const View& view) {
    const std::size_t moment = added++;
    const std::vector<double> glow = own_glow(scene);
    if (!in_perspective(view.camera) || std::ranges::none_of(glow, [](double light) { return light > white; })) return;
    const CameraFrame frame = frame_of(view.camera, static_cast<double>(view.width) / view.height);
    int number = 0;
    std::size_t known = 0;  // spots of earlier leaves
    const auto look = [&](const Primitive& leaf, const glm::dmat4& to_world) {
        const double light = glow[static_cast<std::size_t>(leaf.material)];
        const int own = number++;
        if (!(light > white)) return;
        const Box box = transformed_bounds(leaf.shape, to_world);
        if (!box.finite()) return;
        while (known < leaves.size() && leaves[known] < own) ++known;
        if (known == leaves.size() || leaves[known] > own) {
            leaves.insert(leaves.begin() + std::ptrdiff_t(known), own);
            all.insert(all.begin() + std::ptrdiff_t(known), BrightSpot{0, std::vector<SeenBall>(moments)});
        }
        all[known].light = std::max(all[known].light, light);
        all[known].seen[moment] = seen(view, frame, box.centre(), radius_in(leaf.shape, box));
    };
    for (const Primitive& body : scene.primitives) for_each_leaf(body, look);
    if (added < moments || has_lens(view.camera)) return;
    std::erase_if(all, [](const BrightSpot& spot) {
        return std::ranges::all_of(spot.seen, [&](const SeenBall& ball) { return ball == spot.seen[0]; });
    });
}

}  // namespace strahl
