// Keys held and mouse dragged, until the camera takes them.
#pragma once
#include <array>

#include "show/camera_control.h"
#include "show/keys.h"

namespace strahl {

class Controls {
  public:
    void press(Push key, double now);
    /// True if the key back was only tapped, which does not push: it has another meaning then.
    bool release(Push key, double now);
    void drag(double right, double upwards, double now);
    bool faster = false;

    /// Should the camera be asked to move again soon?
    bool active(double now) const;
    /// What has come together; `seconds` is the time since the last call. Pushes are in seconds.
    Hands take(double seconds, double now);

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
