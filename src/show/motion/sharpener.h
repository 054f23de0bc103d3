// Spends the time that a picture in motion has left on rays where it changes most.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "image/transfer_table.h"
#include "show/motion/resolution.h"
#include "show/motion/screen_image.h"
#include "trace/tracer.h"

namespace strahl {

/// Sharpens pictures whose traced pixels have equal distances. Most of what these are off is in few places: at edges of
/// bodies, shadows and patterns, where colours of neighbours differ. First all pixels are traced between traced ones
/// that differ most, and edges are smoothed. If there is time left, pixels that differ most from their neighbours get
/// the mean with two more rays. How many is learnt from the times of the last pictures.
class Sharpener {
  public:
    /// The share of a picture's time after which the rest serves sharpening better than more traced pixels would.
    static constexpr double first_share = .5;

    /// Sharpens `whole`, in which the pixels between those of `traced`, which has these steps, are interpolated.
    /// `traced` is not used if all pixels are traced. Takes about so many of the seconds that `clock` returns.
    Counts sharpen(Tracer& tracer, const Job& job, const TransferTable& table, const ScreenImage& traced, Steps steps,
                   double seconds, const std::function<double()>& clock, ScreenImage& whole);

  private:
    struct Offset {
        int x, y;
    };
    static constexpr std::array<Offset, 4> square{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};
    static constexpr std::array<Offset, 5> cross{{{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    using Place = std::function<void(int x, int y, std::vector<PicturePoint>& points)>;

    void compare(const ScreenImage& image, std::span<const Offset> offsets, ThreadPool& pool);
    void choose(const ScreenImage& image, double most, const Place& place, ThreadPool& pool);
    Counts trace(Tracer& tracer, const Job& job);
    void smooth_edges(ScreenImage& image, ThreadPool& pool);

    RecentCosts costs, choices;          // seconds for a ray, and for the choice of rays for each pixel of a picture
    std::vector<std::uint8_t> contrast;  // of each pixel of a picture, see compare()
    ScreenImage smoothed;
    std::vector<std::vector<PicturePoint>> rows;
    std::vector<PicturePoint> points;
    std::vector<float> rgb;  // of the points
};

}  // namespace strahl
