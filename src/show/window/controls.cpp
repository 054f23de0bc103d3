// Collects input for the camera.
#include "show/window/controls.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace strahl {
namespace {

constexpr double still = 0.1;  // seconds without mouse movement after which a drag has ended
constexpr double fast = 4;     // factor of the speed while Shift is down
constexpr double turn = 1.5;   // radians per second, with a stick at its end
int number(Push key) { return static_cast<int>(key); }

}  // namespace

void Controls::press(Push key) { held[number(key)] = {true, true}; }

void Controls::release(Push key) { held[number(key)].down = false; }

void Controls::drag(double by_right, double by_upwards, bool around, double now) {
    right += by_right, upwards += by_upwards, dragged = now, turns_around = around;
}

void Controls::pan(const glm::dvec2& way, double now) { panned += way, dragged = now; }

void Controls::tilt(const DVec3& push, double by_right, double by_upwards) {
    // Sticks do not return to their middle exactly. Squares make small turns finer.
    const auto beyond = [](double v) {
        const double away = std::clamp((std::abs(v) - 0.15) / 0.85, 0., 1.);
        return std::copysign(away * away, v);
    };
    tilted = {{beyond(push.x), beyond(push.y), beyond(push.z)}, turn * beyond(by_right), turn * beyond(by_upwards)};
}

bool Controls::active(double now) const {
    const bool waiting = right != 0 || upwards != 0 || panned != glm::dvec2(0);
    return waiting || !(tilted == CameraInput{}) || (dragged >= 0 && now - dragged < still) ||
           std::ranges::any_of(held, [](const KeyState& h) { return h.down || h.fresh; });
}

CameraInput Controls::take(double seconds) {
    const auto pushes = [&](Push key) { return held[number(key)].down || held[number(key)].fresh ? 1. : 0.; };
    const auto push = [&](Push there, Push back) { return pushes(there) - pushes(back); };
    CameraInput input{{push(Push::right, Push::left), push(Push::up, Push::down), push(Push::forward, Push::back)},
                      std::exchange(right, 0) + seconds * tilted.right,
                      std::exchange(upwards, 0) + seconds * tilted.upwards,
                      std::exchange(turns_around, false),
                      std::exchange(panned, glm::dvec2(0))};
    input.push += tilted.push;
    input.push *= seconds * (faster ? fast : 1);
    for (KeyState& h : held) h.fresh = false;
    return input;
}

std::optional<glm::dvec2> Pointer::move(double x, double y) {
    at = {x, y};
    const glm::dvec2 way = *at - last;
    dragging |= std::hypot(way.x, way.y) >= 4;
    if (!held || !dragging) return std::nullopt;
    last = *at;
    return way;
}

}  // namespace strahl
