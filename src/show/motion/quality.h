// Compares pictures as the window shows them in motion with the finished ones of the same moments.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>

#include "show/motion/screen_image.h"
#include "trace/tracer.h"

namespace strahl {

/// Differences in steps of 1/255, over all pixels.
struct Quality {
    int pictures = 0;    // compared
    double rms = 0;      // over all channels
    double p99 = 0;      // 99 % of the pixels are off by no more, in their worst channel
    double ssim = 0;     // structural similarity of the brightness, 1 if equal
    double visible = 0;  // share of the pixels that are off by more than 8
    double flicker = 0;  // RMS of the change since the picture before, less that of the finished ones
};

/// Collects the quality of the pictures of a flight.
class QualityLog {
  public:
    /// Adds a picture and the finished one of the same moment, both with all pixels. `next`: the last one was shown
    /// just before it.
    void add(ScreenImage shown, ScreenImage finished, bool next);
    Quality quality() const;

  private:
    int count = 0;
    double squares = 0, similarity = 0, changes = 0;
    double values = 0, values_of_pairs = 0;  // three for each pixel
    std::array<std::uint64_t, 256> worst{};  // pixels by the error of their worst channel
    ScreenImage last_shown, last_finished;
};

/// Returns the mean structural similarity of blocks of 8x8 pixels, every fourth in both directions (Z. Wang et al.,
/// "Image Quality Assessment: From Error Visibility to Structural Similarity", 2004). 1 for pictures smaller than that.
double structural_similarity(const ScreenImage& a, const ScreenImage& b);

/// Traces all pixels of a view. Those that were not reached when `stop` became true are 0.
ScreenImage traced_picture(Tracer& tracer, const View& view, ThreadPool& pool, const TransferTable& table,
                           const Sampling& sampling, const std::atomic<bool>* stop = nullptr);

}  // namespace strahl
