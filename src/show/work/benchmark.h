// Figures of a flight that `strahl play --benchmark` reports, so that machines and versions can be compared.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace strahl {

/// A picture that was shown.
struct ShownPicture {
    double time = 0;  // when, in seconds
    int level = 0;    // see progressive.h; averages count as all pixels
    double pixels = 0;
};
/// Of `width` x `height` pixels. The first picture of a flight may be the last one of the rest before it.
ShownPicture shown_picture(double time, int level, int width, int height);

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

struct Benchmark {
    int pictures = 0;
    double seconds = 0;                     // from the first picture to the last
    double median = 0, p99 = 0, worst = 0;  // times from one picture to the next, in seconds
    std::map<int, double> levels;           // the shares of pictures at each level
    double pixels_per_second = 0;           // that were traced
};
Benchmark benchmark_of(const std::vector<ShownPicture>& shown);

/// What was measured.
struct BenchmarkSetting {
    std::string scene, precision, simd;
    int width = 0, height = 0, depth = 0, threads = 0;
    double fps = 0, draw_seconds = 0;  // pictures per second that were asked for; to draw one
};
/// A few lines.
std::string report_of(const Benchmark& benchmark, const BenchmarkSetting& setting);
std::string json_of(const Benchmark& benchmark, const BenchmarkSetting& setting);

}  // namespace strahl
