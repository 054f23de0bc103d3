// Flights: a clock that can be paused, an orbit for scenes without a path, and recorded paths.
#pragma once
#include "scene/camera.h"

namespace strahl {

/// Seconds of flight as a function of real seconds.
class FlightClock {
  public:
    bool running() const { return runs; }
    double at(double now) const { return runs ? passed + (now - since) : passed; }
    void run(double now) { passed = at(now), since = now, runs = true; }
    void hold(double now) { passed = at(now), runs = false; }
    void set(double seconds, double now) { passed = seconds, since = now; }

  private:
    double passed = 0, since = 0;
    bool runs = false;
};

/// A slow orbit from where the camera is around what the scene's camera looks at.
Flythrough orbit_path(const Camera& camera, const Camera& scene_camera);

/// `path` with the camera added as a key, `seconds` after the last one. The key omits values that equal those of the
/// scene's camera. A path that returns to its first key loops.
Flythrough with_key(Flythrough path, const Camera& camera, const Camera& scene_camera, double seconds);

}  // namespace strahl
