// Adapts the resolution of pictures in motion so that the frame rate holds.
#pragma once
#include <array>
#include <cstddef>

namespace strahl {

/// The last five costs of something. A single unusual one changes nothing.
class RecentCosts {
  public:
    void add(double cost);
    bool any() const { return count > 0; }
    double median() const;

  private:
    std::array<double, 5> costs{};
    std::size_t count = 0;
};

/// Returns the seconds that a picture of this level may take, given the `budget` at full rate.
double allowed_seconds(int level, double budget);

/// For pictures whose traced pixels have equal distances: learns the cost of a pixel and chooses the resolution level
/// (see progressive.h) that fits into the time available. The level falls when most of the last pictures took too long.
/// It rises only after a while, one level at a time and with headroom, so that it does not oscillate. A single slow
/// picture changes nothing. Below 1/16 of the pixels little can be recognised: if those do not fit, the rate falls
/// first, to a quarter.
class Resolution {
  public:
    /// Reports that `pixels` were traced in `seconds`.
    void observe(double pixels, double seconds);

    /// Returns the level for the next picture, at most `finest`. `budget` is the time for it in seconds. Levels of more
    /// than 1/9 of the pixels may take only this share of it.
    int choose(int width, int height, double budget, int finest, double share = 1);

  private:
    double seconds_for(int level) const;

    int level = 2;  // every 8th pixel, until anything is known
    int width = 0, height = 0;
    RecentCosts costs;  // seconds per pixel of the last pictures
    int since = 0;      // observations since the level changed
};

}  // namespace strahl
