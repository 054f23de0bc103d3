// Collects input from keys and mouse until the camera takes it.
#pragma once
#include <array>

#include "show/camera_control.h"
#include "show/keys.h"

namespace strahl {

class Controls {
  public:
    void press(Push key, double now);
    /// True if the key `back` was only tapped. Then it does not move the camera but has its other meaning.
    bool release(Push key, double now);
    void drag(double right, double upwards, double now);
    bool faster = false;

    /// Will there be more input soon?
    bool active(double now) const;
    /// The input since the last call, `seconds` ago. Pushes are in seconds.
    CameraInput take(double seconds, double now);

  private:
    struct Held {
        bool down = false, fresh = false;  // fresh: pressed since the last take, even if released by now
        double since = 0;
    };
    bool pushes(Push key, double now) const;
    bool others_down() const;

    std::array<Held, 6> held;
    double right = 0, upwards = 0, dragged = -1;
};

}  // namespace strahl
