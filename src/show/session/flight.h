// Flights: along a path, by a clock that can be paused, and an orbit for scenes without a path.
#pragma once
#include <optional>

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

/// The flight: its path, if one is flown, and its clock, which keeps the moment when a flight has ended. Without keys
/// the path leaves the camera free, and only bodies move.
class Flight {
  public:
    bool once = false;    // end a path that loops after one round
    bool driven = false;  // does an editor of tracks set the time? Then flights do not end

    bool flying() const { return flown.has_value(); }
    bool paused() const { return flown && !clock.running(); }
    bool under_way() const { return flown && clock.running(); }
    /// Does the flight go around the scene, because that has no path?
    bool circling() const { return flown && around; }
    /// Is this a flight of the scene's own, at its own speed?
    bool at_own_speed() const { return flown && !around && clock.rate() == 1; }
    const std::optional<Flythrough>& path() const { return flown; }
    /// The moment of the flight, or where the last one ended, in seconds.
    double time(double now) const;
    /// Has the flight reached the end of its path?
    bool over(double now) const;

    /// Begins at the moment where the last flight ended, or at 0 if that is the end of this path.
    void begin(Flythrough path, double now);
    /// Begins an orbit around the scene.
    void circle(Flythrough orbit, double now);
    /// Pauses at this moment of a path. Without a path the flight ends, and the moment is kept.
    void go_to(double seconds, std::optional<Flythrough> path, double now);
    /// Goes on along a path that has changed, unless the flight is an orbit or over.
    void change(std::optional<Flythrough> path);
    void stop(double now);
    /// Ends the flight and goes back to 0.
    void reset() { flown.reset(), clock = {}; }

    void run(double now) { clock.run(now); }
    void hold(double now) { clock.hold(now); }
    void set(double seconds, double now) { clock.set(seconds, now); }
    /// Moves the flight forward by so many seconds.
    void shift(double seconds, double now) { clock.set(clock.at(now) + seconds, now); }
    /// Seconds of the flight per second.
    double rate() const { return clock.rate(); }
    void set_rate(double rate, double now) { clock.set_rate(rate, now); }

  private:
    std::optional<Flythrough> flown;
    bool around = false;  // `flown` is an orbit
    FlightClock clock;
};

/// Returns a slow orbit that begins at the camera's position and goes around the scene camera's look_at.
Flythrough orbit_path(const Camera& camera, const Camera& scene_camera);

}  // namespace strahl
