// What cells add to the picture.
#include <algorithm>

#include "trace/cells/cells.h"

namespace strahl {
namespace {

/// The error of a cell over the difference between its samples, found by experiment on five worlds: what is estimated
/// is .7 to 1.9 times the error there (tests/bench/sampling.md).
constexpr double estimate = .17;
/// By how much the filter of images is off, over the difference of the middle from the corners, likewise.
constexpr double filter_off = .6;

}  // namespace

bool Cells::equal_signatures(const Cell& cell) const {
    const auto of = [&](int k) { return samples[cell.corners[k]].signature; };
    return of(0) == of(1) && of(1) == of(2) && of(2) == of(3);
}

bool Cells::shows_image(const Cell& cell) const {
    const CellSample& first = samples[cell.corners[0]];
    if (!first.filtered) return false;
    const auto same = [&](int k) { return samples[k].filtered && samples[k].signature == first.signature; };
    return std::ranges::all_of(cell.corners, same) && (cell.middle < 0 || same(cell.middle));
}

/// Calls use(value), where value(k, c) is channel c of corner k or, as k = 4, of the middle if it is known; of cells
/// that show an image as if this had one colour.
template <class Use>
auto Cells::with_values(const Cell& cell, const Use& use) const {
    if (!shows_image(cell))
        return use([&](int k, int c) { return samples[k < 4 ? cell.corners[k] : cell.middle].rgb[c]; });
    std::array<const CellSample*, 5> all{};
    std::ranges::copy(corners_of(cell), all.begin());
    if (cell.middle >= 0) all[4] = &samples[cell.middle];
    const auto values = without_image(std::span(all).first(cell.middle < 0 ? 4 : 5));
    return use([&](int k, int c) { return values[k][c]; });
}

/// The largest difference of a channel between two corners.
double Cells::spread(const Cell& cell) const {
    return with_values(cell, [](const auto& value) {
        double most = 0;
        for (int c = 0; c < 3; ++c) {
            double low = value(0, c), high = low;
            for (int k = 1; k < 4; ++k) low = std::min(low, value(k, c)), high = std::max(high, value(k, c));
            most = std::max(most, high - low);
        }
        return most;
    });
}

std::array<double, 3> Cells::mean(const Cell& cell) const {
    return with_values(cell, [&](const auto& value) {
        std::array<double, 3> color{};
        for (int c = 0; c < 3; ++c) {
            for (int k = 0; k < 4; ++k) color[c] += value(k, c);
            color[c] *= .25;
            // With the middle, of four triangles.
            if (cell.middle >= 0) color[c] = (2 * color[c] + value(4, c)) / 3;
        }
        return color;
    });
}

/// By how much a channel of the middle is off the mean of the corners, at most. Of an image the middle has seen the
/// mean, and its filter is thought to be off by a share of that.
double Cells::off_corners(const Cell& cell) const {
    const double whole = middle_off(corners_of(cell), samples[cell.middle]);
    if (!shows_image(cell)) return whole;
    return with_values(cell, [&](const auto& value) {
        double off = filter_off * whole;
        for (int c = 0; c < 3; ++c)
            off = std::max(off, std::abs(.25 * (value(0, c) + value(1, c) + value(2, c) + value(3, c)) - value(4, c)));
        return off;
    });
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
