// Compares pictures by the measures of quality.h.
#include "show/motion/quality.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace strahl {
namespace {

/// 0 is blue.
int channel(std::uint32_t pixel, int c) { return static_cast<int>(pixel >> 8 * c & 255); }

/// Returns the brightness as in Rec. 601, from 0 to 255.
double luma(std::uint32_t pixel) {
    return .299 * channel(pixel, 2) + .587 * channel(pixel, 1) + .114 * channel(pixel, 0);
}

}  // namespace

double structural_similarity(const ScreenImage& a, const ScreenImage& b) {
    constexpr int side = 8, step = 4;
    constexpr double c1 = .01 * .01 * 255 * 255, c2 = .03 * .03 * 255 * 255;
    double sum = 0, blocks = 0;
    for (int top = 0; top + side <= a.height; top += step)
        for (int left = 0; left + side <= a.width; left += step) {
            double mean_a = 0, mean_b = 0, aa = 0, bb = 0, ab = 0;
            for (int y = top; y < top + side; ++y)
                for (int x = left; x < left + side; ++x) {
                    const std::size_t i = std::size_t(y) * a.width + x;
                    const double own = luma(a.pixels[i]), other = luma(b.pixels[i]);
                    mean_a += own, mean_b += other;
                    aa += own * own, bb += other * other, ab += own * other;
                }
            constexpr double pixels = side * side;
            mean_a /= pixels, mean_b /= pixels;
            const double variances = aa / pixels - mean_a * mean_a + bb / pixels - mean_b * mean_b;
            const double covariance = ab / pixels - mean_a * mean_b;
            sum += (2 * mean_a * mean_b + c1) * (2 * covariance + c2) /
                   ((mean_a * mean_a + mean_b * mean_b + c1) * (variances + c2));
            ++blocks;
        }
    return blocks > 0 ? sum / blocks : 1;
}

void QualityLog::add(ScreenImage shown, ScreenImage finished, bool next) {
    assert(shown.pixels.size() == finished.pixels.size());
    const bool pair = next && last_shown.pixels.size() == shown.pixels.size();
    for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
        int most = 0;
        for (int c = 0; c < 3; ++c) {
            const int off = channel(shown.pixels[i], c) - channel(finished.pixels[i], c);
            squares += off * off, most = std::max(most, std::abs(off));
            if (!pair) continue;
            const int before = channel(last_shown.pixels[i], c) - channel(last_finished.pixels[i], c);
            changes += (off - before) * (off - before);
        }
        ++worst[static_cast<std::size_t>(most)];
    }
    similarity += structural_similarity(shown, finished);
    const double added = 3 * static_cast<double>(shown.pixels.size());
    ++count, values += added, values_of_pairs += pair ? added : 0;
    last_shown = std::move(shown), last_finished = std::move(finished);
}

Quality QualityLog::quality() const {
    Quality quality;
    if (count == 0) return quality;
    quality.pictures = count, quality.rms = std::sqrt(squares / values), quality.ssim = similarity / count;
    if (values_of_pairs > 0) quality.flicker = std::sqrt(changes / values_of_pairs);
    const double pixels = values / 3;
    double seen = 0;
    for (std::size_t off = 0; off < worst.size(); ++off) {
        seen += static_cast<double>(worst[off]);
        if (seen < .99 * pixels) quality.p99 = static_cast<double>(off + 1);
        if (off > 8) quality.visible += static_cast<double>(worst[off]) / pixels;
    }
    return quality;
}

ScreenImage traced_picture(Tracer& tracer, const View& view, ThreadPool& pool, const TransferTable& table,
                           const Sampling& sampling, const std::atomic<bool>* stop) {
    ScreenImage image;
    image.resize(view.width, view.height);
    const auto keep = [&](const Tile& tile) { store(tile.lattice, encoded(tile, table).data(), image); };
    tracer.trace({view, pool, keep, stop}, SampledRegion{{.columns = view.width, .rows = view.height}, sampling});
    return image;
}

}  // namespace strahl
