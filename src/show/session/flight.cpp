// Flies along paths, and makes an orbit for scenes that have none.
#include "show/session/flight.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "show/session/camera_control.h"

namespace strahl {

double Flight::time(double now) const {
    const double seconds = clock.at(now);
    const bool loops = flown && flown->loop && flown->duration > 0;
    return loops ? seconds - flown->duration * std::floor(seconds / flown->duration) : seconds;
}

bool Flight::over(double now) const {
    return under_way() && !driven && (!flown->loop || once) && clock.at(now) >= flown->duration;
}

void Flight::begin(Flythrough path, double now) {
    flown = std::move(path), around = false;
    const bool at_end = !flown->loop && !driven && clock.at(now) >= flown->duration;
    clock.set(at_end ? 0 : time(now), now), clock.run(now);
}

void Flight::circle(Flythrough orbit, double now) {
    flown = std::move(orbit), around = true;
    clock.set(0, now), clock.run(now);
}

void Flight::go_to(double seconds, std::optional<Flythrough> path, double now) {
    flown = std::move(path), around = false;
    clock.hold(now);
    if (!flown)
        seconds = std::max(seconds, 0.);
    else if (!flown->loop)
        seconds = std::clamp(seconds, 0., driven ? seconds : flown->duration);
    clock.set(seconds, now);
}

void Flight::change(std::optional<Flythrough> path) {
    if (flown && !around) flown = std::move(path);
}

void Flight::stop(double now) {
    clock.set(time(now), now), clock.hold(now);
    flown.reset();
}

Flythrough orbit_path(const Camera& camera, const Camera& scene_camera) {
    Camera start = scene_camera;
    start.position = camera.position;
    if (degenerate(start)) start = scene_camera;
    constexpr int keys = 48;  // the curve through them is a circle to a hundred-thousandth
    Flythrough path{.duration = 40, .loop = true, .keys = {}};
    for (int i = 0; i < keys; ++i) {
        const Camera there = orbit(start, {.right = 2 * std::numbers::pi * i / keys});
        path.keys.push_back({path.duration * i / keys, there.position, there.look_at, {}, {}});
    }
    return path;
}

}  // namespace strahl
