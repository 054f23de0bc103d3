// Adapts the resolution in motion so that the frame rate holds.
#pragma once
#include <array>

namespace strahl {

/// Returns the seconds that a picture of this level may take, given the `budget` at full rate.
double allowed_seconds(int level, double budget);

/// Learns the cost of a pixel and chooses the resolution level (see progressive.h) that fits into the time available.
/// The level falls when most of the last pictures took too long. It rises only after a while, one level at a time and
/// with headroom, so that it does not oscillate. A single slow picture changes nothing. Below 1/16 of the pixels little
/// can be recognised: if those do not fit, the rate falls first, to a quarter.
class Resolution {
  public:
    /// Reports that `pixels` were traced in `seconds`.
    void observe(double pixels, double seconds);

    /// Returns the level for the next picture, at most `finest`. `budget` is the time for it in seconds.
    int choose(int width, int height, double budget, int finest);

  private:
    double seconds_for(int level) const;

    int level = 2;  // every 8th pixel, until anything is known
    int width = 0, height = 0;
    std::array<double, 5> costs{};  // seconds per pixel of the last pictures
    int observed = 0;
    int since = 0;  // observations since the level changed
};

}  // namespace strahl
