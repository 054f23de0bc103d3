// What cells add to the picture.
#include <algorithm>

#include "trace/cells.h"

namespace strahl {
namespace {

constexpr std::int32_t unit = Point::unit;

/// The error of a cell over the difference between its samples, found by experiment on five worlds: what is estimated
/// is .7 to 1.9 times the error there (tests/bench/sampling.md).
constexpr double estimate = .17;

}  // namespace

bool Cells::equal_signatures(const Cell& cell) const {
    const auto of = [&](int k) { return samples[cell.corners[k]].signature; };
    return of(0) == of(1) && of(1) == of(2) && of(2) == of(3);
}

/// The largest difference of a channel between two corners.
double Cells::spread(const Cell& cell) const {
    double most = 0;
    for (int c = 0; c < 3; ++c) {
        double low = samples[cell.corners[0]].rgb[c], high = low;
        for (int k = 1; k < 4; ++k) {
            low = std::min(low, samples[cell.corners[k]].rgb[c]);
            high = std::max(high, samples[cell.corners[k]].rgb[c]);
        }
        most = std::max(most, high - low);
    }
    return most;
}

std::array<double, 3> Cells::mean(const Cell& cell) const {
    std::array<double, 3> color{};
    for (int c = 0; c < 3; ++c) {
        for (const int corner : cell.corners) color[c] += samples[corner].rgb[c];
        color[c] *= .25;
        // With the middle, of four triangles.
        if (cell.middle >= 0) color[c] = (2 * color[c] + samples[cell.middle].rgb[c]) / 3;
    }
    return color;
}

/// Adds a cell of a pixel or less to its pixel, with the difference between samples that were taken for equal.
void Cells::finish(const Cell& cell, const std::array<double, 3>& color, double difference) {
    const double area = double(cell.size) / unit * (double(cell.size) / unit);
    squares += difference * area * (difference * area);
    double* const sum = &sums[pixel_of(cell)];
    for (int c = 0; c < 3; ++c) sum[c] += area * color[c];
}

/// Interpolates in a cell of a pixel or more.
void Cells::fill(const Cell& cell) {
    const int n = cell.size / unit, left = cell.x / unit, top = cell.y / unit;
    const int end_x = std::min(n, columns - left), end_y = std::min(n, rows - top);
    const auto color = [&](int k) { return samples[cell.corners[k]].rgb; };
    for (int y = 0; y < end_y; ++y) {
        const double v = (y + .5) / n;
        double* to = sums.data() + 3 * (std::size_t(top + y) * columns + left);
        double from[3], step[3];
        for (int c = 0; c < 3; ++c) {
            from[c] = color(0)[c] + v * (color(3)[c] - color(0)[c]);
            step[c] = (color(1)[c] + v * (color(2)[c] - color(1)[c]) - from[c]) / n;
        }
        for (int x = 0; x < end_x; ++x)
            for (int c = 0; c < 3; ++c) *to++ = from[c] + (x + .5) * step[c];
    }
}

void Cells::add_to(Sampled& sampled) const {
    std::vector<std::uint32_t> counts(std::size_t(columns) * rows);
    for (const Point& p : points)
        if (p.x < columns * unit && p.y < rows * unit) ++counts[std::size_t(p.y / unit) * columns + p.x / unit];
    for (const std::uint32_t count : counts) ++sampled.pixels[std::min<std::size_t>(count, sampled.pixels.size() - 1)];
    sampled.squares += estimate * estimate * squares;
}

}  // namespace strahl
