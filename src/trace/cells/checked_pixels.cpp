#include "trace/cells/checked_pixels.h"

#include <cmath>
#include <random>
#include <vector>

namespace strahl {
namespace {

constexpr int across = 8;  // parts of a pixel in a row, with two rays each

struct CheckedPixel {
    int number;
    double chance;  // the expected number of times that it is chosen
};

/// Chooses pixels in their order, at equal steps of the sum of their chances from a random place on: they are spread
/// over the tile.
std::vector<CheckedPixel> chosen(std::span<const std::uint32_t> samples, double share, double first) {
    std::vector<CheckedPixel> pixels;
    double sum = first;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double chance = share * (.25 + samples[i]);
        for (sum += chance; sum >= 1; --sum) pixels.push_back({static_cast<int>(i), chance});
    }
    return pixels;
}

}  // namespace

MeasuredError measured_error(const FinishedTile& tile, double share, std::uint32_t seed, const TraceSquares& trace) {
    std::mt19937 random(seed);
    const auto below = [&](double end) { return end * static_cast<double>(random()) * 0x1p-32; };
    const std::vector<CheckedPixel> pixels = chosen(tile.samples, share, below(1));
    constexpr int rays = 2 * across * across;
    std::vector<Point> points;
    points.reserve(pixels.size() * rays);
    for (const CheckedPixel& pixel : pixels)
        for (int i = 0; i < rays; ++i) {
            const auto within = [&](int part) {
                return static_cast<std::int32_t>((part + below(1)) / across * Point::unit);
            };
            const int part = i / 2;
            points.push_back({pixel.number % tile.columns * Point::unit + within(part % across),
                              pixel.number / tile.columns * Point::unit + within(part / across)});
        }
    std::vector<CellSample> seen(points.size());
    if (!points.empty()) trace(points, 1. / across, seen.data());
    MeasuredError error{.checked = pixels.size()};
    const CellSample* sample = seen.data();
    for (const auto& [number, chance] : pixels) {
        // Two means of independent rays: the expected product of their differences is the square of the true one.
        double off[2][3], product = 0;
        for (auto& half : off)
            for (int c = 0; c < 3; ++c) half[c] = -tile.rgb[std::size_t(3) * number + c];
        for (int i = 0; i < rays; ++i, ++sample)
            for (int c = 0; c < 3; ++c) off[i % 2][c] += sample->rgb[c] / (across * across);
        for (int c = 0; c < 3; ++c) product += off[0][c] * off[1][c] / 3;
        error.squares += product / chance, error.variance += product / chance * (product / chance);
    }
    return error;
}

}  // namespace strahl
