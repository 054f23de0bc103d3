// The axes of a camera, and the camera along a flythrough.
#include "scene/camera.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "num/vec_math.h"
#include "scene/tangent.h"

namespace strahl {
namespace {

bool finite(const DVec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Interpolation between keyframes.
//
// `Window` holds the four keys around a moment, which lies between [1] and [2]; `h` is its share of the way. At the
// ends of an open path a neighbour is missing.
struct Window {
    std::array<const Keyframe*, 4> key;  // [0] and [3] may be nullptr
    std::array<double, 3> seconds;       // from each key to the next
    double h;
};

/// The slope of a curve at a key, times `interval`: from the differences to both neighbours and the seconds between,
/// the weighted harmonic mean of the secants, which never overshoots (F. N. Fritsch, J. Butland, "A Method for
/// Constructing Local Monotone Piecewise Cubic Interpolants", 1984). Written so that times neither overflow nor
/// underflow.
double slope_between(double left, double right, double seconds_left, double seconds_right, double interval) {
    if (!(left > 0 && right > 0) && !(left < 0 && right < 0)) return 0;
    const double unit = std::max(seconds_left, seconds_right), l = seconds_left / unit, r = seconds_right / unit;
    const double a = 2 * r + l, b = r + 2 * l;
    return (a + b) * (interval / unit) / (a * l / left + b * r / right);
}

/// The cubic from p to q with slopes m and n, both times the length of the interval; exact at both ends.
template <class V>
V hermite(const V& p, const V& q, const V& m, const V& n, double h) {
    const double g = 1 - h;
    return p * (g * g * (1 + 2 * h)) + q * (h * h * (3 - 2 * h)) + (m * g - n * h) * (g * h);
}

/// A quantity that changes by `here` between the two keys, and by `before` and `after` in the intervals beside (if
/// there are keys): how much it has changed so far, smoothly and monotonically.
double monotone(const Window& w, double before, double here, double after) {
    const double m = w.key[0] ? slope_between(before, here, w.seconds[0], w.seconds[1], w.seconds[1]) : here;
    const double n = w.key[3] ? slope_between(here, after, w.seconds[1], w.seconds[2], w.seconds[1]) : here;
    return std::clamp(hermite(0.0, here, m, n, w.h), std::min(0.0, here), std::max(0.0, here));
}

/// A number along the path, smooth and always between the values of the two keys.
template <class Value>
double number_at(const Window& w, Value value) {
    const double p = value(*w.key[1]), q = value(*w.key[2]);
    const double change = monotone(w, w.key[0] ? p - value(*w.key[0]) : 0, q - p, w.key[3] ? value(*w.key[3]) - q : 0);
    return std::clamp(p + change, std::min(p, q), std::max(p, q));
}

/// A point along the path. The curve is the centripetal Catmull-Rom spline, whose knots lie the square root of a chord
/// apart and which therefore has no loops or cusps between keys (C. Yuksel, S. Schaefer, J. Keyser, "Parameterization
/// and Applications of Catmull-Rom Curves", 2011). Time is mapped to the knots by a monotone cubic, so that
/// speed too is continuous at the keys, whatever their times.
DVec3 point_at(const Window& w, DVec3 Keyframe::*member) {
    const auto chord = [&](int i) { return w.key[i + 1]->*member - w.key[i]->*member; };
    const DVec3 here = chord(1);
    const double knots = std::sqrt(length(here));
    const DVec3 p = w.key[1]->*member, q = w.key[2]->*member;
    if (knots == 0) return p;

    // Without a neighbour the curve starts straight; beside a chord of length 0 its velocity is 0.
    DVec3 m = here, n = here;
    double before = 0, after = 0;
    const auto velocity = [](const DVec3& a, double ka, const DVec3& b, double kb) {
        return ka > 0 ? a / ka - (a + b) / (ka + kb) + b / kb : DVec3(0);
    };
    if (w.key[0]) {
        before = std::sqrt(length(chord(0)));
        m = velocity(chord(0), before, here, knots) * knots;
    }
    if (w.key[3]) {
        after = std::sqrt(length(chord(2)));
        n = velocity(chord(2), after, here, knots) * knots;
    }
    return hermite(p, q, m, n, monotone(w, before, knots, after) / knots);
}

/// Directions are interpolated as unit vectors; one that is the same at both keys stays exactly the same.
template <class Value>
DVec3 direction_at(const Window& w, Value value) {
    const DVec3 p = value(*w.key[1]);
    if (value(*w.key[2]) == p) return p;
    DVec3 result;
    for (int i = 0; i < 3; ++i) result[i] = number_at(w, [&](const Keyframe& key) { return normalize(value(key))[i]; });
    return result;
}

/// The camera at a moment; degenerate where the curves of position and look_at meet.
Camera raw_camera_at(const Flythrough& path, const Camera& scene_camera, double time) {
    const std::vector<Keyframe>& keys = path.keys;
    int count = static_cast<int>(keys.size());
    if (count == 0) return scene_camera;
    const bool closed = path.loop && path.duration > 0;
    if (closed) {
        time -= path.duration * std::floor(time / path.duration);
        if (time < keys.front().time) time += path.duration;
        // A last key at exactly the time at which the first one comes round again is that first key.
        if (count > 1 && keys.back().time >= keys.front().time + path.duration) --count;
    }
    if (count == 1 || !(time > keys.front().time)) return camera_of(keys.front(), scene_camera);
    const auto after = std::upper_bound(keys.begin(), keys.begin() + count, time,
                                        [](double t, const Keyframe& key) { return t < key.time; });
    const int i = static_cast<int>(after - keys.begin()) - 1;
    if (time == keys[i].time || (!closed && i == count - 1)) return camera_of(keys[i], scene_camera);

    // Key numbers continue past both ends: on a closed path they come round a duration later, on an open one there are
    // none.
    const auto key = [&](int k) -> const Keyframe* {
        return closed ? &keys[(k + count) % count] : k >= 0 && k < count ? &keys[k] : nullptr;
    };
    const auto moment = [&](int k) {
        return key(k)->time + (k < 0 ? -path.duration : k >= count ? path.duration : 0.0);
    };
    Window w{{key(i - 1), key(i), key(i + 1), key(i + 2)}, {0, moment(i + 1) - moment(i), 0}, 0};
    if (w.key[0]) w.seconds[0] = moment(i) - moment(i - 1);
    if (w.key[3]) w.seconds[2] = moment(i + 2) - moment(i + 1);
    w.h = (time - moment(i)) / w.seconds[1];

    Camera camera = scene_camera;
    camera.position = point_at(w, &Keyframe::position);
    camera.look_at = point_at(w, &Keyframe::look_at);
    camera.fov = number_at(w, [&](const Keyframe& k) { return k.fov.value_or(scene_camera.fov); });
    camera.up = direction_at(w, [&](const Keyframe& k) { return k.up.value_or(scene_camera.up); });
    return camera;
}

}  // namespace

Camera camera_of(const Keyframe& key, const Camera& scene_camera) {
    return {key.position, key.look_at, key.up.value_or(scene_camera.up), key.fov.value_or(scene_camera.fov),
            scene_camera.aspectratio};
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
    const double tan_x = tangent(camera.fov);
    return {right, down, forward, tan_x, tan_x / camera.aspectratio.value_or(aspect)};
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

}  // namespace strahl
