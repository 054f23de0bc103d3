// How fine a picture may be while everything moves, so that the rate of pictures holds.
#pragma once
#include <array>

namespace strahl {

/// Learns what a pixel costs and chooses the level (see progressive.h) that can be traced in the time there is. It
/// goes coarser at once, and finer only after a while and with room to spare, so that it does not flap.
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
    double budget = 0;
    std::array<double, 3> costs{};  // seconds per pixel, the last three
    int observed = 0;
    int calm = 0;  // observations in a row that left room for the next finer level
};

}  // namespace strahl
