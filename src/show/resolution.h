// How fine a picture may be while everything moves, so that the rate of pictures holds.
#pragma once
#include <array>

namespace strahl {

/// Learns what a pixel costs and chooses the level (see progressive.h) that can be traced in the time there is. It
/// goes coarser when most of the last pictures took too long, and finer only after a while, with room to spare and
/// level by level, so that it does not flap. A single hiccup of the machine changes nothing.
class Resolution {
  public:
    /// Something was traced: so many pixels in so many seconds.
    void observe(double pixels, double seconds);

    /// The level for the next picture, at most `finest`. `budget` is the time for it in seconds.
    int choose(int width, int height, double budget, int finest);

  private:
    double seconds_for(int level) const;

    int level = 2;  // of every 8th pixel, until anything is known
    int width = 0, height = 0;
    std::array<double, 5> costs{};  // seconds per pixel, the last ones
    int observed = 0;
    int since = 0;  // observations since the level changed
};

}  // namespace strahl
