// Flights: a clock that can be paused, and an orbit for scenes without a path.
#pragma once
#include "scene/camera.h"

namespace strahl {

/// Converts real seconds to seconds of flight.
class FlightClock {
  public:
    bool running() const { return runs; }
    double at(double now) const { return runs ? passed + speed * (now - since) : passed; }
    void run(double now) { passed = at(now), since = now, runs = true; }
    void hold(double now) { passed = at(now), runs = false; }
    void set(double seconds, double now) { passed = seconds, since = now; }
    /// Seconds of flight per real second; 1 at the start.
    double rate() const { return speed; }
    void set_rate(double rate, double now) { set(at(now), now), speed = rate; }

  private:
    double passed = 0, since = 0, speed = 1;
    bool runs = false;
};

/// Returns a slow orbit that begins at the camera's position and goes around the scene camera's look_at.
Flythrough orbit_path(const Camera& camera, const Camera& scene_camera);

}  // namespace strahl
