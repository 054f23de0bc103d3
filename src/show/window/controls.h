// Collects input from keys, mouse and gamepad until the camera takes it.
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <utility>

#include "show/keys/commands.h"
#include "show/session/camera_control.h"

namespace strahl {

class Controls {
  public:
    void press(Push key);
    void release(Push key);
    /// `around`: around what the camera looks at, in any style.
    void drag(double right, double upwards, bool around, double now);
    /// Moves the picture by these shares of its width, to the right and down.
    void pan(const glm::dvec2& way, double now);
    /// Takes the position of a gamepad's sticks, -1 to 1 in each direction: they push like keys, and turn to the right
    /// and upwards. Near their middle they count as at rest.
    void tilt(const DVec3& push, double right, double upwards);
    bool faster = false;

    /// Will there be more input soon?
    bool active(double now) const;
    /// The input since the last call, `seconds` ago. Pushes are in seconds.
    CameraInput take(double seconds);

  private:
    struct KeyState {
        bool down = false, fresh = false;  // fresh: pressed since the last take, even if released since
    };

    std::array<KeyState, 6> held;
    double right = 0, upwards = 0, dragged = -1;
    bool turns_around = false;  // the drag does
    glm::dvec2 panned{0};
    CameraInput tilted;  // per second
};

/// Distinguishes drags from clicks. All in pixels of the window.
class Pointer {
  public:
    enum Dragging { look, turn, pan };
    /// Begins a drag where the pointer moved last. When events have waited it may be elsewhere by now, at `now`, which
    /// counts only if it has not moved in this window.
    void press(const glm::dvec2& now, Dragging what = look) {
        held = true, dragging = false, kind = what, last = at.value_or(now);
    }
    /// Returns what is dragged: with the left button the view, else also what is seen.
    Dragging drag() const { return kind; }
    /// Is the middle button down in place of the left one?
    bool middle_held() const { return held && kind != look; }
    /// Returns where it moved last, if it has moved in this window.
    const std::optional<glm::dvec2>& place() const { return at; }
    /// Returns whether that was a click.
    bool release() { return std::exchange(held, false) && !dragging; }
    /// Ends a drag because the window becomes another one under the pointer.
    void leave() { held = false, at.reset(); }
    /// Returns how far the pointer was dragged by moving here. Less than 4 pixels is a click and not a drag.
    std::optional<glm::dvec2> move(double x, double y);

  private:
    bool held = false, dragging = false;
    Dragging kind = look;
    std::optional<glm::dvec2> at;
    glm::dvec2 last{0};  // up to where the drag was reported
};

}  // namespace strahl
