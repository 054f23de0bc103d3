// A tile of a picture that a lens or a shutter makes: each pixel is the average over its square, and over the lens, the
// time, or both.
//
// Cells cannot say where such a picture is smooth: each of its rays has up to five coordinates, two in the pixel, two
// on the lens, and the time. Each pixel therefore has a scrambled net of its own (num/scrambled_net.h). Its eighths are
// nets as well, and how far their means differ says how wrong the mean of all may be. As long as that is too much, the
// net is doubled.
//
// Rays that meet the ball around a small bright body (bright_spots.h) are averaged apart: a net of rays that are aimed
// at the ball gives their mean, and the pixel's net leaves them out.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "scene/camera.h"
#include "trace/cells/bright_spots.h"
#include "trace/cells/pixel_sampling.h"

namespace strahl {

/// A place in the picture, in pixels that have their middles at whole numbers, and one on the lens, see lens_place().
/// `weight` is that of the ray's light in its pixel, where another ray has 1.
struct LensRay {
    double x, y, across, below, weight = 1;
};
/// Holds what a ray brings: red, green, blue, and how opaque it is where alpha is asked for, else 0.
using LensLight = std::array<double, 4>;
/// Traces rays at a moment of the view, by its number, and writes the light that each brings. Rays of a check are not
/// counted. Number `moments` is the time of the view itself.
using TraceLensRays = std::function<void(int moment, std::span<const LensRay>, std::span<LensLight> light, bool check)>;

/// A tile of columns x rows pixels at (x, y) in the view; one after the other in the same memory. What a pixel does
/// depends on the square of 8x8 pixels around it alone, of those that lie side by side from the view's corner on.
class LensPixels {
  public:
    static constexpr int eighths = 8;

    /// `error` is the RMS error aimed at; `moments` is the number of moments of a shutter, or 0. `spots`, if any, are
    /// those of all moments, and have to stay.
    void begin(int x, int y, int columns, int rows, double error, const Camera& camera, int moments,
               const BrightSpots* spots = nullptr);
    /// Gives squares of 8x8 pixels in which nothing changes while the shutter is open the values and the numbers of
    /// samples of a picture of the view's time, and takes no rays there. Finds that out by two rays for each pixel at
    /// moments, and two of the same at the view's time.
    void keep_still(std::span<const double> values, std::span<const std::uint32_t> counts, const TraceLensRays& trace);
    /// Doubles the samples of pixels that are not good enough: once or, with `all`, until none is left.
    void refine(bool all, const TraceLensRays& trace);
    bool finished() const { return open.empty(); }
    /// Takes this many rays in each open pixel, or doubles those that were taken before.
    void take(std::uint32_t rays, const TraceLensRays& trace);

    /// Returns the pixels' values and the number of their rays, row by row.
    std::span<const double> values() const { return means; }
    std::vector<std::uint32_t> counts() const;

    /// Measures the error of the finished tile: each pixel is chosen with this chance, and traced by twice as many rays
    /// as it had, twice. The mean of the product of both differences is the mean square of the error.
    MeasuredError measured(double chance, const TraceLensRays& trace) const;

  private:
    /// Sums of the light of a net's rays, by eighths of it, and of their weights.
    struct NetSums {
        std::array<LensLight, eighths> light{};
        std::array<double, eighths> weights{};
        /// Makes two eighths one of a net that is twice as large.
        void make_room();
        LensLight mean() const;
        /// Returns the mean of an eighth, or of all if that has no rays.
        LensLight mean(int eighth) const;
    };
    /// A spot that a pixel may see from moment `first` until before `last`.
    struct Target {
        int spot, first, last;
        double share = 0;  // of the pixel's rays: those which meet its ball, and none of the targets before it
    };
    /// The sums of a pixel's own net, and of those of its targets.
    struct PixelSums {
        NetSums own;
        std::vector<NetSums> targets;
    };
    struct LensPixel {
        PixelSums sums;
        std::vector<Target> targets;
        std::uint32_t taken = 0;
        /// The variance that the mean of eight independent nets would have: of light, averaged over red, green and
        /// blue, or of alpha, if that is larger.
        double variance = 0;
    };
    /// Points `first` to `last` of the nets of `last` points with this seed, in a pixel; their light is added to
    /// `sums`.
    struct NetPart {
        int pixel;
        std::uint32_t seed, first, last;
        PixelSums* sums;
    };
    struct AimedRay {
        LensRay ray;
        int moment;
    };
    void find_targets();
    /// Returns the share of a target. With another seed it is wrong by something else.
    double share_of(int pixel, std::size_t target, std::uint32_t seed) const;
    /// Returns whether a ray of a pixel meets one of its first targets.
    bool meets(const LensPixel& pixel, std::size_t targets, const LensRay& ray, int moment) const;
    /// Returns the ray to a target of a pixel that belongs to a point of the unit cube. Its weight is 0 if it misses.
    AimedRay aimed(int pixel, std::size_t target, const std::array<double, 5>& point) const;
    /// Returns what a pixel's sums come to, in all or in an eighth of them.
    template <class... Eighth>
    LensLight light_of(const LensPixel& pixel, const PixelSums& sums, Eighth... eighth) const;
    std::uint32_t seed_of(int pixel) const;
    class Rays;
    /// Traces these parts, many rays at once.
    void trace_nets(std::span<const NetPart> parts, const TraceLensRays& trace, bool check) const;
    void settle();

    int left = 0, top = 0, columns = 0, rows = 0, moments = 0;
    const BrightSpots* bright = nullptr;
    double aim = 0;  // the RMS error
    Camera camera;
    bool lens = false;
    std::vector<LensPixel> pixels;
    std::vector<int> open;  // numbers of the pixels that need more
    std::vector<double> means;
};

}  // namespace strahl
