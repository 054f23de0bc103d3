// A tile of a picture that a lens or a shutter makes: each pixel is the average over its square, and over the lens, the
// time, or both.
//
// Cells cannot say where such a picture is smooth: each of its rays has up to five coordinates, two in the pixel, two
// on the lens, and the time. Each pixel therefore has a scrambled net of its own (num/scrambled_net.h). Its eighths are
// nets as well, and how far their means differ says how wrong the mean of all may be. As long as that is too much, the
// net is doubled.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "scene/camera.h"
#include "trace/cells/pixel_sampling.h"

namespace strahl {

/// A place in the picture, in pixels that have their middles at whole numbers, and one on the lens, see lens_place().
struct LensRay {
    double x, y, across, below;
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

    /// `error` is the RMS error aimed at; `moments` is the number of moments of a shutter, or 0.
    void begin(int x, int y, int columns, int rows, double error, const Camera& camera, int moments);
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
    using Sums = std::array<LensLight, eighths>;
    struct LensPixel {
        Sums sums{};  // of the eighths of the net
        std::uint32_t taken = 0;
        /// The variance that the mean of eight independent nets would have: of light, averaged over red, green and
        /// blue, or of alpha, if that is larger.
        double variance = 0;
    };
    /// Points `first` to `last` of the net of `last` points with this seed, in a pixel; their light is added to `sums`.
    struct NetPart {
        int pixel;
        std::uint32_t seed, first, last;
        Sums* sums;
    };
    std::uint32_t seed_of(int pixel) const;
    class Rays;
    /// Traces these parts, many rays at once.
    void trace_nets(std::span<const NetPart> parts, const TraceLensRays& trace, bool check) const;
    void settle();

    int left = 0, top = 0, columns = 0, rows = 0, moments = 0;
    double aim = 0;  // the RMS error
    Camera camera;
    bool lens = false;
    std::vector<LensPixel> pixels;
    std::vector<int> open;  // numbers of the pixels that need more
    std::vector<double> means;
};

}  // namespace strahl
