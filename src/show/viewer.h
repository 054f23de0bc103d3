// The window: passes the user's commands to the session, its views to the tracing thread, and pictures to the screen.
#pragma once
#include <atomic>
#include <memory>
#include <string>

#include "show/session/session.h"
#include "show/session/view_options.h"
#include "show/window/input.h"
#include "show/window/overlay.h"
#include "show/window/panels.h"
#include "show/window/scene_sound.h"
#include "show/window/screen.h"
#include "show/work/notes.h"
#include "show/work/pace.h"
#include "show/work/reload.h"
#include "show/work/rocket.h"
#include "show/work/still_requests.h"
#include "show/work/track_editor.h"
#include "show/work/watched_scene.h"
#include "show/work/window_picture.h"

namespace strahl {

class Viewer {
  public:
    /// `first` is the scene and `text` its text; `began` is when the user started the program. `rocket` is the
    /// connection to an editor of tracks, or null.
    Viewer(const ViewOptions& options, const Loaded& first, std::string text, Pace::Clock::time_point began,
           std::unique_ptr<Rocket> rocket);
    /// Runs until the user quits, or until `interrupted` becomes true, which asks for the same. Returns the exit
    /// status.
    int run(const std::atomic<bool>& interrupted);

  private:
    void perform(Command command);
    void apply(const TimelineInput& input);

    // The loop
    bool in_motion() const { return session.under_way() || input.active(); }
    void move();
    void draw();
    double next_draw() const;
    void wait();
    void take_scene();

    // Flights
    void start_scene();
    void start_playing();
    void flight_ended(const Answer& answer);

    Overlay overlay() const;
    void report_benchmark() const;
    void end() const;

    const ViewOptions options;
    Pace pace;
    Notes notes;
    Session session;
    Screen screen;
    Panels panels;
    Input input;
    WindowPicture picture;
    StillRequests stills;
    WatchedScene file;
    TrackEditor tracks;
    SceneSound sound;
    bool started = false;  // the flight of `strahl play`
    bool closed = false;
};

}  // namespace strahl
