// The log of the window on standard output, and figures of its motion.
#pragma once
#include <string>
#include <vector>

#include "show/work/benchmark.h"

namespace strahl {

/// Lines begin with "// ", so that they may be pasted into a scene together with the text printed between them.
void log_line(const std::string& text);

/// Figures of a motion from start to end. Times are in seconds.
class MotionLog {
  public:
    void begin(double now);
    void picture(const ShownPicture& picture) { shown.push_back(picture); }
    void drawn(double seconds);
    /// The mean time to draw a picture, in seconds.
    double draw_seconds() const { return draws ? drawing / draws : 0; }
    const std::vector<ShownPicture>& pictures() const { return shown; }
    /// Pictures per second over the last second.
    double rate(double now) const;
    /// "120 pictures in 2.0 s (60.0/s; the first after 9 ms), 1/2 of the pixels, 1.7 ms to draw each"
    std::string report(double now) const;

  private:
    double start = 0, drawing = 0;
    int draws = 0;
    std::vector<ShownPicture> shown;
};

}  // namespace strahl
