// The window: passes events to the session, its views to the tracing thread, and pictures to the screen.
#pragma once
#include <array>
#include <chrono>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "show/session/session.h"
#include "show/session/view_options.h"
#include "show/window/controls.h"
#include "show/window/overlay.h"
#include "show/window/screen.h"
#include "show/window/sound.h"
#include "show/window/timeline.h"
#include "show/work/reload.h"
#include "show/work/rocket.h"
#include "show/work/stability_check.h"
#include "show/work/stills.h"
#include "show/work/trace_thread.h"
#include "show/work/viewer_log.h"

namespace strahl {

/// Of a scene's file.
std::string window_title(const std::string& path);

class Viewer {
  public:
    using Clock = std::chrono::steady_clock;
    /// `first` is the scene and `text` its text; `began` is when the user started the program.
    /// `rocket` is the connection to an editor of tracks, if there is one.
    Viewer(const ViewOptions& options, const Loaded& first, std::string text, Clock::time_point began,
           const std::atomic<bool>* interrupted, std::unique_ptr<Rocket> rocket);
    ~Viewer();
    /// Runs until the user quits or the program is interrupted. Returns the exit status.
    int run();

  private:
    // Input, see viewer_input.cpp
    void connect();
    void on_key(int key, int scancode, int action, int modifiers);
    void on_button(bool pressed);
    void on_cursor(double x, double y);
    void perform(Command command);
    void perform_here(Action action);
    void read_gamepad();
    bool on_timeline() const;
    void apply(const TimelineInput& input);
    void write_path();
    void quit();

    // Other threads
    void start_scene();
    void add_still();
    void handle_reload();
    void handle_stills();
    void handle_stability();
    void handle_written();

    // The editor of tracks, see viewer_rocket.cpp
    void start_driven();
    void ask_tracks();
    void take_tracks();
    void handle_rocket();

    // Sound, see viewer_sound.cpp
    void load_sound();
    void follow_sound();
    void picture_shown(double seconds);
    std::string sound_report();

    void toggle_stability();

    // The loop. All times are seconds since `start`.
    double now() const;
    bool in_motion() const;
    double next_draw() const;
    void wait();
    void move();
    void order();
    void draw();
    void log_finished();
    void handle_interrupt();
    void hide_pointer();
    void flight_ended(const Answer& answer);
    void report_benchmark() const;

    // Output
    Overlay overlay();
    std::vector<std::pair<std::string, std::string>> info() const;
    void show(const std::string& text, double seconds);
    void note(const std::string& text);
    /// Notes that are logged in any case.
    void announce(const std::string& text);
    void tell(const Answer& answer);

    const ViewOptions options;
    const Clock::time_point start;
    const std::atomic<bool>* const interrupted;
    std::string path;  // of the scene
    Session session;
    Controls controls;
    Screen screen;
    TraceThread tracing;
    Stills stills;
    StabilityCheck stability;
    Reload reload;
    std::unique_ptr<Rocket> rocket;
    std::unique_ptr<Sound> sound;

    bool quitting = false, closed = false, failed = false, signalled = false;
    bool help = false, with_info = false, quiet = false, fill = false;
    bool with_timeline = false;
    Timeline timeline;
    double write_until = -1;  // when the question ends whether a changed file is to be written anyway
    bool waiting = false;  // for the first scene without an error
    bool started = false;  // the flight of `strahl play`
    Stability marks;      // of the picture on the screen
    bool marked = false;  // marks are shown or being computed
    std::string fault;
    static constexpr double forever = std::numeric_limits<double>::infinity();
    double fault_until = 0;  // forever for the watched scene
    struct Note {
        std::string text;
        double until;
    };
    std::deque<Note> notes;

    bool pushing = false;  // the character that follows belongs to a key that moves the camera
    Pointer pointer;
    double pointer_moved = 0;
    bool pointer_hidden = false;
    std::array<bool, 15> buttons{};  // of the gamepad, which are down
    double still_told = 0;

    std::string sound_file;
    bool sound_told = false;  // why there is none
    struct SoundClock {
        double now, flight;  // when sound and picture were compared the last time
    };
    std::optional<SoundClock> sound_clock;  // while they run together
    double picture_delay = 0;               // from the order of a picture until it is on the screen, in seconds
    std::array<double, 16> ordered{};       // moments of the flight of the last pictures, by number
    std::vector<double> sound_log;          // how far each picture was before the sound

    Order wanted;
    Refinement state;
    std::uint64_t told = 0;  // the last picture logged as finished
    int draws_due = 0;
    double next_move = 0, last_move = 0;  // of the camera
    double last_draw = -1, draw_seconds = 0;
    bool moving = false;
    MotionLog motion;
    std::optional<double> change_heard;  // when an editor changed what is not on the screen yet
};

}  // namespace strahl
