// What the person at the window has made of the scene: camera, flight, depth. Knows nothing of windows or threads.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "scene/scene.h"
#include "show/camera_control.h"
#include "show/flight.h"
#include "show/keys.h"
#include "show/progressive.h"

namespace strahl {

/// What to tell: a short note in the window and a line for the log, and text for standard output to be pasted.
struct Answer {
    std::string note, print;
};

class Session {
  public:
    /// `depth` is used instead of the scene's. All times named `now` are seconds of one steady clock.
    explicit Session(std::shared_ptr<const Scene> scene, std::optional<int> depth = {});

    /// The file changed, or (`opened`) it is another one. The camera stays unless the file's camera is another one.
    void replace(std::shared_ptr<const Scene> scene, bool opened);

    /// Commands for the window alone (quit, still, full screen, help, info) do nothing here.
    Answer perform(Command command, double now);

    /// To a moment of the scene's flythrough, if it has one; the flight is paused there.
    bool go_to(double seconds, double now);

    /// Hands on the camera end a flight. `push` in units of seconds at the present speed.
    void steer(const Hands& hands, double now);
    void change_speed(double factor) { speed *= factor; }
    /// Follows the flight to this moment. Says so if it ended.
    std::optional<Answer> follow(double now);

    bool flying() const { return path.has_value(); }
    bool paused() const { return flying() && !clock.running(); }
    bool under_way() const { return flying() && clock.running(); }
    double flight_time(double now) const { return clock.at(now); }
    const std::optional<Flythrough>& flight_path() const { return path; }

    std::shared_ptr<const Scene> scene;
    Camera camera;
    bool orbiting = false;
    double speed = 1;           // units of the scene per second
    int finest = finest_level;  // while moving
    int depth() const { return own_depth.value_or(scene->settings.max_trace_level); }

  private:
    Answer play(double now);
    Answer pause(double now);
    Answer record();
    Answer recall(int number);
    void stop(double now);

    std::optional<int> own_depth;
    std::optional<Flythrough> path;  // on which the camera flies now
    FlightClock clock;               // on the scene's path also while nobody flies it
    Flythrough recorded;
    std::array<std::optional<Camera>, 9> cameras;
};

/// "1/4 of the pixels", for a level.
std::string resolution_text(int level);

}  // namespace strahl
