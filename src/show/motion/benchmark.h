// Figures of a motion, for the log, and of a whole flight, by which `strahl play --benchmark` compares machines.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "show/motion/quality.h"
#include "show/session/view_options.h"

namespace strahl {

/// A picture that was on the screen.
struct ShownPicture {
    double time = 0;  // when, in seconds
    int level = 0;    // see progressive.h; averages count as all pixels
    double pixels = 0;
};
/// Describes a picture of `width` x `height` pixels. The first one of a flight may be the last one of the rest before.
ShownPicture shown_picture(double time, int level, int width, int height);

/// Collects figures of a motion. Times are in seconds.
class MotionLog {
  public:
    void begin(double now);
    void picture(const ShownPicture& picture);
    void drawn(double seconds);
    /// The mean time to draw the window.
    double draw_seconds() const { return draws ? drawing / draws : 0; }
    const std::vector<ShownPicture>& pictures() const { return shown; }
    /// Are all pictures kept, and not just the last ones? A flight may go on for hours.
    bool keeps_all = false;
    /// Pictures per second over the last second.
    double rate(double now) const;
    /// "120 pictures in 2.0 s (60.0/s; the first after 9 ms), 1/2 of the pixels, 1.7 ms to draw each"
    std::string report(double now) const;

  private:
    double start = 0, drawing = 0;
    int draws = 0;
    std::size_t count = 0;  // number of pictures
    double first = 0;       // when the first one was shown
    std::vector<ShownPicture> shown;
};

struct Benchmark {
    int pictures = 0;
    double seconds = 0;                     // from the first picture to the last
    double median = 0, p99 = 0, worst = 0;  // times from one picture to the next, in seconds
    std::map<int, double> levels;           // share of the pictures by level
    double pixels_per_second = 0;           // traced or filled
    std::optional<Quality> quality{};       // quality of some pictures (see flown_pictures.h)
};
Benchmark benchmark_of(const std::vector<ShownPicture>& shown);

/// The conditions of a measurement.
struct BenchmarkSetting {
    std::string scene, precision, simd;
    int width = 0, height = 0;  // of the picture, which may be smaller than the window
    PictureSize window;
    std::optional<PictureSize> wanted{};  // the window's, if one was given
    int depth = 0, threads = 0;
    double fps = 0, draw_seconds = 0;  // pictures per second requested; time to draw one
};
/// Returns a few lines for people, or the same as JSON.
std::string report_of(const Benchmark& benchmark, const BenchmarkSetting& setting);
std::string json_of(const Benchmark& benchmark, const BenchmarkSetting& setting);

}  // namespace strahl
