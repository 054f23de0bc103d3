// The camera: position, direction, angle of view, and its path.
#pragma once
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "num/vec.h"

namespace strahl {

/// How a camera maps space to its picture, in POV-Ray's words. From `fisheye` on the picture's sides are angles.
enum class Projection {
    perspective,
    orthographic,
    panoramic,
    fisheye,
    ultra_wide_angle,
    spherical,
    cylinder,
    cylinder2,
    cylinder3,
    cylinder4
};
inline constexpr std::array<std::string_view, 10> projection_words{
    "perspective", "orthographic", "panoramic", "fisheye",   "ultra_wide_angle",
    "spherical",   "cylinder",     "cylinder2", "cylinder3", "cylinder4"};
constexpr std::string_view word_of(Projection projection) {
    return projection_words[static_cast<std::size_t>(projection)];
}
/// Returns whether the picture's sides are angles, which may exceed 180 degrees.
constexpr bool angular(Projection projection) { return projection >= Projection::fisheye; }
/// Returns whether rays start at different points.
constexpr bool starts_apart(Projection projection) {
    return projection == Projection::orthographic || projection >= Projection::cylinder3;
}

/// How a picture shows what the left and the right eye see. The left eye has the left or the upper half.
enum class Stereo { none, side_by_side, top_bottom };
inline constexpr std::array<std::string_view, 3> stereo_words{"", "side_by_side", "top_bottom"};

/// The world is right-handed; +x of camera space is to the right of the picture, +y down it (row 0 is the top row).
struct Camera {
    DVec3 position{0};
    DVec3 look_at{0};
    DVec3 up{0, 0, -1};  // the direction that points *down* the picture; `sky` in scenes is its negative
    double fov = 25;     // degrees between the viewing axis and the left or right edge: below 90 or, if angular, to 360
    std::optional<double> aspectratio;  // picture width / height; without it the picture's own
    Projection projection = Projection::perspective;
    double aperture = 0;              // the radius of the lens; 0 for a pinhole, to which everything is sharp
    std::optional<double> focus{};    // the distance of the plane that is sharp, along the viewing direction,
    std::optional<DVec3> focus_on{};  // or a point of it; without either it goes through look_at
    std::optional<double> blades{};   // corners of a lens that is a regular polygon; without them it is round
    double shutter = 0;               // time for which it is open, half of it before its time; 0: a moment
    bool shutter_in_frames = false;   // that is a share of the time from frame to frame, and not in seconds
    Stereo stereo = Stereo::none;
    double eye_distance = 0;              // of both eyes, in stereo; the position is between them
    std::optional<double> convergence{};  // distance of what both see at the same place; none if they look in parallel
    bool operator==(const Camera&) const = default;
};
/// A moment of a scene, in seconds, as its camera sees it.
struct Shot {
    Camera camera;
    double time = 0;
    bool operator==(const Shot&) const = default;
};
/// Returns for how many seconds the shutter is open, in a film of so many frames a second.
constexpr double shutter_seconds(const Camera& camera, double fps) {
    return camera.shutter_in_frames ? camera.shutter / fps : camera.shutter;
}
/// Returns whether the picture is one eye's in perspective.
constexpr bool in_perspective(const Camera& camera) {
    return camera.projection == Projection::perspective && camera.stereo == Stereo::none;
}
/// Returns which eye sees a picture point: the left one, -1, or the right one, 1; or 0 if there is one eye.
template <class R>
constexpr int eye_at(const Camera& camera, R x, R y) {
    if (camera.stereo == Stereo::none) return 0;
    return (camera.stereo == Stereo::side_by_side ? x : y) < 0 ? -1 : 1;
}
/// Returns whether the rays of a pixel start all over a lens.
constexpr bool has_lens(const Camera& camera) { return camera.aperture > 0; }
/// Returns the distance from the camera of the plane that is sharp. Where a flight has left focus_on behind or beside
/// the camera, it is a thousandth of the distance to that point, or 1e-9.
double focal_distance(const Camera& camera);
/// Returns the place on the lens, relative to its radius, of a point of the unit square: x to the right of the picture,
/// y down it. Equal areas become equal ones (discs: P. Shirley and K. Chiu, "A Low Distortion Map Between Disk and
/// Square", 1997).
std::array<double, 2> lens_place(const Camera& camera, double s, double t);

/// The orthonormal axes of a camera: `right` and `down` the picture, `forward` into it; and half the picture's width
/// and height: at distance 1; of an orthographic camera as at the distance of look_at; or in radians. In stereo the
/// picture is that of one eye.
struct CameraFrame {
    DVec3 right, down, forward;
    double tan_x, tan_y;
};
/// `aspect` is used where the camera has no aspectratio of its own. Requires position != look_at and up not parallel
/// to the viewing direction (see `degenerate`).
CameraFrame frame_of(const Camera& camera, double aspect);

/// A camera ray: its start, relative to the camera's position, and its direction, of any length.
template <class R>
struct CameraRay {
    Vec3<R> start, way;
    bool seen = true;  // false beyond the circle of a fisheye, where the picture is black
};
/// Returns the ray through the picture point (x, y) in [-1, 1]^2, left to right, top to bottom, as POV-Ray's cameras
/// have it (render/tracepixel.cpp of 3.7): with picture axes of length 1, a fisheye's circle touches top and bottom.
template <class R>
CameraRay<R> camera_ray(Projection projection, const CameraFrame& frame, R x, R y) {
    const Vec3<R> none(0), right(frame.right), down(frame.down), forward(frame.forward);
    const R u = x * R(frame.tan_x), v = y * R(frame.tan_y), quarter = std::numbers::pi_v<R> / 2;
    const auto way = [&](R across, R below, R ahead) { return across * right + below * down + ahead * forward; };
    switch (projection) {
        case Projection::orthographic:
            return {u * right + v * down, forward};
        case Projection::panoramic:
            return {none, way(2 * R(frame.tan_x) * std::sin(quarter * x), 2 * R(frame.tan_y) * std::tan(quarter * y),
                              std::cos(quarter * x))};
        case Projection::fisheye: {
            const R angle = std::hypot(u, v), share = angle > 0 ? std::sin(angle) / angle : 1;
            return {none, way(share * u, share * v, std::cos(angle)), angle <= R(frame.tan_y)};
        }
        case Projection::ultra_wide_angle:
            return {none, way(std::sin(u), std::sin(v), std::cos(u) * std::cos(v))};
        case Projection::spherical:
            return {none, way(std::sin(u) * std::cos(v), std::sin(v), std::cos(u) * std::cos(v))};
        case Projection::cylinder:
            return {none, way(std::sin(u), v, std::cos(u))};
        case Projection::cylinder2:
            return {none, way(u, std::sin(v), std::cos(v))};
        case Projection::cylinder3:
            return {v * down, way(std::sin(u), 0, std::cos(u))};
        case Projection::cylinder4:
            return {u * right, way(0, std::sin(v), std::cos(v))};
        default:
            return {none, way(u, v, 1)};
    }
}

/// Returns the ray of a camera through a picture point that one of its eyes sees, see eye_at. Eyes look in the same
/// direction from points side by side; in pictures of all around they turn with the column (S. Peleg, M. Ben-Ezra and
/// Y. Pritch, "Omnistereo: Panoramic Stereo Imaging", 2001).
template <class R>
CameraRay<R> camera_ray(const Camera& camera, const CameraFrame& frame, R x, R y, int eye) {
    if (eye == 0) return camera_ray(camera.projection, frame, x, y);
    const bool beside = camera.stereo == Stereo::side_by_side;
    const R own_x = beside ? 2 * x - R(eye) : x, own_y = beside ? y : 2 * y - R(eye);
    CameraRay<R> ray = camera_ray(camera.projection, frame, own_x, own_y);
    const R half = R(eye) * R(camera.eye_distance) / 2;
    const bool turns = camera.projection == Projection::spherical || camera.projection == Projection::cylinder;
    const R longitude = turns ? own_x * R(frame.tan_x) : 0;
    ray.start = half * (std::cos(longitude) * Vec3<R>(frame.right) - std::sin(longitude) * Vec3<R>(frame.forward));
    if (camera.convergence) ray.way = ray.way - half / R(*camera.convergence) * Vec3<R>(frame.right);
    return ray;
}

/// Why the camera is degenerate ("position equals look_at", "up is parallel to ..."), or nullptr if it is not.
const char* degenerate(const Camera& camera);

/// A key of a flythrough: a time in seconds and the camera then. Values that are not given are those of the scene's
/// camera.
struct Keyframe {
    double time = 0;
    DVec3 position{0};
    DVec3 look_at{0};
    std::optional<double> fov;
    std::optional<DVec3> up;
    double ease = 0;  // by what share the movement is slower here, see eased()
    bool operator==(const Keyframe&) const = default;
};

/// The camera at a key; `scene_camera` supplies what the key does not give.
Camera camera_of(const Keyframe& key, const Camera& scene_camera);

/// A path through keys on a centripetal Catmull-Rom spline; times increase strictly.
struct Flythrough {
    double duration = 0;  // seconds, at least the last key's time
    bool loop = false;    // the path is a closed curve that returns to its first key after `duration`
    std::vector<Keyframe> keys;
    bool operator==(const Flythrough&) const = default;
};

/// The camera at `time` seconds: before the first key that of the first key, after the last key that of the last. A
/// path that loops repeats every `duration`, also before its first key. At the time of a key it is exactly the key's
/// camera. Between keys position and look_at follow smooth curves, fov and up stay between the values of the two keys,
/// and where the result would be degenerate it takes its axes from a moment before or after.
Camera camera_at(const Flythrough& path, const Camera& scene_camera, double time);

/// Returns the camera without its aspectratio, for a picture of `aspect` = width / height: it shows all that the camera
/// shows, in the right proportions, and more above and below or to both sides, up to 89 degrees from the middle, or 360
/// if its sides are angles.
Camera filled_view(const Camera& camera, double aspect);

}  // namespace strahl
