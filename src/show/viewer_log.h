// Lines on standard output that say what happens at the window, and figures of its motion.
#pragma once
#include <string>
#include <vector>

namespace strahl {

/// Lines begin with "// ", so that scene text printed between them can be pasted with them.
void log_line(const std::string& text);

/// What happened between the start of a motion and its end. Times in seconds.
class Motion {
  public:
    void begin(double now);
    void picture(double now, int level);
    void drawn(double seconds);
    /// Pictures per second, lately.
    double rate(double now) const;
    /// "120 pictures in 2.0 s (60.0/s; the first after 9 ms), 1/2 of the pixels, 1.7 ms to draw each"
    std::string report(double now) const;

  private:
    double start = 0, drawing = 0;
    int draws = 0;
    std::vector<double> times;
    std::vector<int> levels;
};

}  // namespace strahl
