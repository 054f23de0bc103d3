// The window: passes events to the session, its views to the tracing thread, and pictures to the screen.
#pragma once
#include <chrono>
#include <deque>
#include <memory>
#include <string>

#include "show/command_view.h"
#include "show/controls.h"
#include "show/overlay.h"
#include "show/reload.h"
#include "show/screen.h"
#include "show/session.h"
#include "show/stability_check.h"
#include "show/stills.h"
#include "show/trace_thread.h"
#include "show/viewer_log.h"

namespace strahl {

class Viewer {
  public:
    using Clock = std::chrono::steady_clock;
    /// `text` is the text of the scene; `began` is when the user started the program.
    Viewer(const ViewOptions& options, std::shared_ptr<const Scene> scene, std::string text, Clock::time_point began);
    ~Viewer();
    /// Runs until the user quits.
    void run();

  private:
    // Input, see viewer_input.cpp
    void connect();
    void on_key(int key, int scancode, int action, int modifiers);
    void on_cursor(double x, double y);
    void perform(Command command);
    void quit();

    // Other threads
    void add_still();
    void handle_reload();
    void handle_stills();
    void handle_stability();
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

    // Output
    Overlay overlay();
    std::vector<std::pair<std::string, std::string>> info() const;
    void note(const std::string& text);
    void tell(const Answer& answer);

    const ViewOptions options;
    const Clock::time_point start;
    std::string path;  // of the scene
    Session session;
    Controls controls;
    Screen screen;
    TraceThread tracing;
    Stills stills;
    StabilityCheck stability;
    Reload reload;

    bool quitting = false, closed = false;
    bool help = false, with_info = false;
    std::vector<Mark> marks;  // of the picture on the screen
    bool marked = false;      // marks are shown or being computed
    std::string fault;
    double fault_until = 0;  // infinite for the watched scene
    struct Note {
        std::string text;
        double until;
    };
    std::deque<Note> notes;

    bool pushing = false;  // the character that follows belongs to a key that moves the camera
    bool dragging = false;
    double cursor_x = 0, cursor_y = 0;
    double still_told = 0;

    Order wanted;
    Refinement state;
    std::uint64_t told = 0;  // the last picture logged as finished
    int draws_due = 0;
    double next_move = 0, last_move = 0;  // of the camera
    double last_draw = -1;
    bool moving = false;
    MotionLog motion;
};

}  // namespace strahl
