#include "show/work/pace.h"

#include <algorithm>
#include <utility>

namespace strahl {
namespace {

constexpr double rest_interval = 0.05;  // seconds between drawings while a resting picture is refined

}  // namespace

void Pace::redraw(int times) { draws_due = std::max(draws_due, times); }

double Pace::next_draw(bool update, bool soon) const {
    if (draws_due == 0 && !update) return forever;
    return drawn_at + (moves || soon || draws_due > 0 ? 0.9 * frame : rest_interval);
}

void Pace::drawn(double began) {
    const double seconds = now() - began;
    drawn_at = began;
    if (draws_due > 0) --draws_due;
    motion.drawn(seconds);
    draw_seconds += 0.2 * (seconds - draw_seconds);
}

std::optional<Pace::Due> Pace::move(bool in_motion, bool update) {
    const double moment = now();
    const bool begins = in_motion && !moves;
    if (begins) {
        moves = true;
        motion.begin(moment);
        next = moment, last = moment - frame;
    }
    if (!moves || moment < next - (update ? 0.5 * frame : 0)) return std::nullopt;
    next = std::max(next + frame, moment);
    // If the machine cannot keep up, the camera slows down instead of jumping; a flight follows the clock in any case.
    return Due{moment, std::min(moment - std::exchange(last, moment), 0.1), begins};
}

double Pace::budget() const {
    // There is more time to trace if drawing limits the rate.
    return 0.8 * std::clamp(draw_seconds, frame, 2 * frame);
}

}  // namespace strahl
