#include "scene/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "num/vec_math.h"
#include "scene/motion/curve.h"
#include "scene/tangent.h"

namespace strahl {
namespace {

bool finite(const DVec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Directions are interpolated as unit vectors; one that is the same at both keys stays exactly the same.
template <class Value>
DVec3 direction_at(const Window<Keyframe>& w, Value value) {
    const DVec3 p = value(*w.key[1]);
    if (value(*w.key[2]) == p) return p;
    DVec3 result;
    for (int i = 0; i < 3; ++i) result[i] = number_at(w, [&](const Keyframe& key) { return normalize(value(key))[i]; });
    return result;
}

/// The camera at a time; degenerate where the curves of position and look_at meet.
Camera raw_camera_at(const Flythrough& path, const Camera& scene_camera, double time) {
    if (path.keys.empty()) return scene_camera;
    const auto [key, w] = moment_among(path.keys, path.loop ? path.duration : 0, time);
    if (key) return camera_of(*key, scene_camera);
    Camera camera = scene_camera;
    camera.position = point_at(w, &Keyframe::position);
    camera.look_at = point_at(w, &Keyframe::look_at);
    camera.fov = number_at(w, [&](const Keyframe& k) { return k.fov.value_or(scene_camera.fov); });
    camera.up = direction_at(w, [&](const Keyframe& k) { return k.up.value_or(scene_camera.up); });
    return camera;
}

}  // namespace

Camera camera_of(const Keyframe& key, const Camera& scene_camera) {
    Camera camera = scene_camera;
    camera.position = key.position, camera.look_at = key.look_at;
    camera.up = key.up.value_or(scene_camera.up), camera.fov = key.fov.value_or(scene_camera.fov);
    return camera;
}

double focal_distance(const Camera& camera) {
    const DVec3 view = camera.look_at - camera.position;
    if (camera.focus_on) {
        const DVec3 way = *camera.focus_on - camera.position;
        return std::max({dot_product(normalize(view), way), 1e-3 * length(way), 1e-9});
    }
    return camera.focus.value_or(length(view));
}

std::array<double, 2> lens_place(const Camera& camera, double s, double t) {
    constexpr double pi = std::numbers::pi;
    if (camera.blades) {  // chooses a place in a triangle of the fan around the middle, the first corner on top
        const double corners = std::round(*camera.blades);  // between keys of a track it is no whole number
        const double place = s * corners, side = std::floor(place), share = place - side, out = std::sqrt(t);
        const auto corner = [&](double number) {
            const double angle = 2 * pi * number / corners;
            return std::array{std::sin(angle), -std::cos(angle)};
        };
        const auto a = corner(side), b = corner(side + 1);
        return {out * (a[0] + share * (b[0] - a[0])), out * (a[1] + share * (b[1] - a[1]))};
    }
    const double x = 2 * s - 1, y = 2 * t - 1;
    if (x == 0 && y == 0) return {0, 0};
    const bool wide = std::abs(x) > std::abs(y);
    const double radius = wide ? x : y, angle = wide ? pi / 4 * (y / x) : pi / 2 - pi / 4 * (x / y);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

const char* degenerate(const Camera& camera) {
    const DVec3 view = camera.look_at - camera.position;
    if (view == DVec3(0)) return "position and look_at are the same point";
    if (camera.up == DVec3(0)) return "up is the zero vector";
    if (!finite(view) || !finite(camera.up)) return "a coordinate is not finite";
    // Rounding turns the axes by 1e-16 / sine: at 1e-12 the picture's roll would still be right to 0.01 degrees.
    if (length(cross_product(normalize(camera.up), normalize(view))) < 1e-12)
        return "up is parallel to the direction from position to look_at";
    return nullptr;
}

CameraFrame frame_of(const Camera& camera, double aspect) {
    const DVec3 forward = normalize(camera.look_at - camera.position);
    // If `up` is almost parallel to the view, rounding tilts the cross product; the tilt is removed.
    const DVec3 across = normalize(cross_product(normalize(camera.up), forward));
    const DVec3 right = normalize(across - dot_product(across, forward) * forward);
    const DVec3 down = cross_product(forward, right);
    double half = angular(camera.projection) ? camera.fov * std::numbers::pi / 180 : tangent(camera.fov);
    if (camera.projection == Projection::orthographic) half *= length(camera.look_at - camera.position);
    const double eyes = camera.stereo == Stereo::side_by_side ? .5 : camera.stereo == Stereo::top_bottom ? 2 : 1;
    const double ratio = eyes * camera.aspectratio.value_or(aspect);
    if (camera.projection == Projection::cylinder2 || camera.projection == Projection::cylinder4)
        return {right, down, forward, half * ratio, half};  // the angle is that of the picture's height
    return {right, down, forward, half, half / ratio};
}

Camera camera_at(const Flythrough& path, const Camera& scene_camera, double time) {
    Camera camera = raw_camera_at(path, scene_camera, time);
    if (!degenerate(camera)) return camera;
    // The path passes through its own look_at, or looks along `up`, at this moment: use the axes of a moment nearby.
    for (double step = path.duration * 1e-6; step < path.duration; step *= 4)
        for (const double near : {time - step, time + step}) {
            const Camera other = raw_camera_at(path, scene_camera, near);
            if (degenerate(other)) continue;
            const CameraFrame frame = frame_of(other, 1);
            if (camera.position == camera.look_at)
                camera.look_at = camera.position + length(other.look_at - other.position) * frame.forward;
            camera.up = frame.down;
            if (!degenerate(camera)) return camera;
        }
    return camera;
}

Camera filled_view(const Camera& camera, double aspect) {
    if (!camera.aspectratio) return camera;
    Camera wider = camera;
    wider.aspectratio.reset();
    constexpr double degree = std::numbers::pi / 180, widest = 89;
    const double factor = std::max(1., aspect / *camera.aspectratio);
    if (factor > 1 && angular(camera.projection))
        wider.fov = std::min(360., camera.fov * factor);
    else if (factor > 1)
        wider.fov = std::max(camera.fov, std::min(widest, std::atan(std::tan(camera.fov * degree) * factor) / degree));
    return wider;
}

}  // namespace strahl
