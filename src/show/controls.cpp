// Input from keys and mouse.
#include "show/controls.h"

#include <algorithm>
#include <utility>

namespace strahl {
namespace {

constexpr double tap = 0.2;    // longest tap, in seconds
constexpr double still = 0.1;  // seconds without mouse movement after which a drag is at rest
constexpr double fast = 4;     // factor of speed with Shift
int number(Push key) { return static_cast<int>(key); }

}  // namespace

void Controls::press(Push key, double now) { held[number(key)] = {true, true, now}; }

bool Controls::release(Push key, double now) {
    Held& h = held[number(key)];
    const bool tapped = key == Push::back && h.down && !pushes(key, now);
    h.down = false;
    if (tapped) h.fresh = false;
    return tapped;
}

void Controls::drag(double by_right, double by_upwards, double now) {
    right += by_right, upwards += by_upwards, dragged = now;
}

bool Controls::others_down() const {
    for (int i = 0; i < static_cast<int>(held.size()); ++i)
        if (i != number(Push::back) && held[i].down) return true;
    return false;
}

bool Controls::pushes(Push key, double now) const {
    const Held& h = held[number(key)];
    if (key != Push::back) return h.down || h.fresh;
    return h.down && (now - h.since > tap || others_down());
}

bool Controls::active(double now) const {
    return (dragged >= 0 && now - dragged < still) ||
           std::ranges::any_of(held, [](const Held& h) { return h.down || h.fresh; });
}

CameraInput Controls::take(double seconds, double now) {
    const auto push = [&](Push there, Push back) {
        return (pushes(there, now) ? 1. : 0.) - (pushes(back, now) ? 1. : 0.);
    };
    CameraInput input{{push(Push::right, Push::left), push(Push::up, Push::down), push(Push::forward, Push::back)},
                      std::exchange(right, 0),
                      std::exchange(upwards, 0)};
    input.push *= seconds * (faster ? fast : 1);
    for (Held& h : held) h.fresh = false;
    return input;
}

}  // namespace strahl
