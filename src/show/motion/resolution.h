// Adapts pictures in motion so that the frame rate holds: their tolerance, or their resolution.
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

/// Learns how long pictures take, and chooses the tolerance (see filled_lattice.h) with which one takes the time that
/// is available. For that it assumes that the time is inversely proportional to the tolerance: where it falls less, the
/// tolerance approaches the right one from one side. Beyond `coarse` little can be recognised: if that does not fit,
/// the rate falls first, to a quarter.
class Tolerance {
  public:
    /// In steps of 1/255 times pixels. With the finest everything is traced that could be seen.
    static constexpr double finest = 24, coarse = 800, coarsest = 255 * 8, first = 400;

    /// Reports that a picture of so many pixels took so many seconds with this tolerance.
    void observe(double tolerance, double pixels, double seconds) { costs.add(tolerance * seconds / pixels); }
    /// Returns the tolerance for a picture of so many pixels.
    double choose(double pixels, double budget) const;
    /// Returns the seconds that a picture with this tolerance may take, given the `budget` at full rate.
    static double allowed_seconds(double tolerance, double budget) {
        return tolerance >= coarse ? 4 * budget : budget;
    }

  private:
    RecentCosts costs;
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

    /// Returns the level for the next picture, at most `finest`. `budget` is the time for it in seconds.
    int choose(int width, int height, double budget, int finest);

  private:
    double seconds_for(int level) const;

    int level = 2;  // every 8th pixel, until anything is known
    int width = 0, height = 0;
    RecentCosts costs;  // seconds per pixel of the last pictures
    int since = 0;  // observations since the level changed
};

}  // namespace strahl
