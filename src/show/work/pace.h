// Decides when the window moves the camera and when it draws.
#pragma once
#include <chrono>
#include <limits>
#include <optional>

#include "show/motion/benchmark.h"

namespace strahl {

/// All times are in seconds since the user started the program.
class Pace {
  public:
    using Clock = std::chrono::steady_clock;
    static constexpr double forever = std::numeric_limits<double>::infinity();

    /// `fps` is the number of pictures per second that motion aims at.
    Pace(Clock::time_point start, double fps) : start(start), frame(1 / fps) {}
    double now() const { return std::chrono::duration<double>(Clock::now() - start).count(); }
    /// The length of a frame at full rate.
    double frame_seconds() const { return frame; }

    /// Asks for the window to be drawn at least this often from now on: ImGui needs a second frame to lay out panels
    /// that have changed, and a third one to react to input.
    void redraw(int times = 2);
    /// The time of the next drawing; `forever` if there is nothing to draw. `update`: the picture has changed. `soon`:
    /// it should be shown without delay, because the change was awaited or is the last one.
    double next_draw(bool update, bool soon) const;
    /// To be called after drawing, which took from `began` until now.
    void drawn(double began);
    double last_draw() const { return drawn_at; }

    /// A movement of the camera that is due.
    struct Due {
        double now, passed;  // `passed`: since the last one, at most 0.1 s
        bool first;          // is it the first picture of a motion?
    };
    /// Returns the movement that is due now, if any. A motion begins when `in_motion` becomes true, and goes on until
    /// rest(). `update`: a picture is waiting to be drawn; the next one is ordered before, to be traced meanwhile.
    std::optional<Due> move(bool in_motion, bool update);
    void rest() { moves = false; }
    bool moving() const { return moves; }
    double next_move() const { return next; }
    /// The time that tracing a picture in motion may take.
    double budget() const;
    /// The figures of the motion under way, or of the last one.
    MotionLog motion;

  private:
    Clock::time_point start;
    double frame;
    bool moves = false;
    double next = 0, last = 0;  // of the camera's movements
    int draws_due = 0;
    double drawn_at = -1, draw_seconds = 0;  // draw_seconds is a sliding mean
};

}  // namespace strahl
