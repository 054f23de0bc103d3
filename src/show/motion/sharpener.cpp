#include "show/motion/sharpener.h"

#include <algorithm>
#include <cstddef>

#include "num/thread_pool.h"

namespace strahl {
namespace {

constexpr int least_contrast = 12;             // in steps of 1/255; what differs less is smooth
constexpr double first_rays = 4096;            // rays of a picture when nothing is known yet
constexpr float aside_x = .3f, aside_y = .2f;  // of two rays from the middle of a pixel, to opposite sides
constexpr int block = 8;                       // pixels whose rays are neighbours in packs
constexpr double worth = .05;                  // share of the rays for which it pays to look for edges of single pixels

/// Extends ranges of colours, from `low` to `high`, by these colours. Compilers make SIMD code of this loop and the
/// next one, as their arrays do not overlap.
void extend(const std::uint32_t* __restrict colors, int count, std::uint32_t* __restrict low,
            std::uint32_t* __restrict high) {
    const auto* const from = reinterpret_cast<const std::uint8_t*>(colors);
    auto *const least = reinterpret_cast<std::uint8_t*>(low), *const greatest = reinterpret_cast<std::uint8_t*>(high);
    for (int i = 0; i < 4 * count; ++i) {
        least[i] = least[i] < from[i] ? least[i] : from[i];
        greatest[i] = greatest[i] > from[i] ? greatest[i] : from[i];
    }
}

/// Finds in which channel ranges of colours are largest, and how large they are there.
void measure(const std::uint32_t* __restrict low, const std::uint32_t* __restrict high, int count,
             std::uint8_t* __restrict out) {
    for (int i = 0; i < count; ++i) {
        const std::uint32_t blue = (high[i] & 255) - (low[i] & 255);
        const std::uint32_t green = (high[i] >> 8 & 255) - (low[i] >> 8 & 255);
        const std::uint32_t red = (high[i] >> 16 & 255) - (low[i] >> 16 & 255);
        out[i] = static_cast<std::uint8_t>(std::max(std::max(blue, green), red));
    }
}

/// Calls `use` with the number of each contrast from `first` to `last` that is at least so large. Most are not: eight
/// are compared at a time.
template <class Use>
void each_at_least(const std::vector<std::uint8_t>& contrast, int least, std::size_t first, std::size_t last,
                   const Use& use) {
    for (std::size_t i = first; i < last; i += block) {
        const std::size_t end = std::min(i + block, last);
        bool any = i + block > last;
        if (!any)
            for (int k = 0; k < block; ++k) any |= contrast[i + k] >= least;
        for (std::size_t k = i; any && k < end; ++k)
            if (contrast[k] >= least) use(k);
    }
}

/// Computes 3/4 of each pixel of a row and 1/16 of its four neighbours; the first and the last stay as they are.
void smooth(const std::uint32_t* above, const std::uint32_t* row, const std::uint32_t* below, int width,
            std::uint32_t* __restrict out) {
    const auto bytes = [](const std::uint32_t* pixels) { return reinterpret_cast<const std::uint8_t*>(pixels); };
    const std::uint8_t *const up = bytes(above), *const at = bytes(row), *const down = bytes(below);
    auto* const to = reinterpret_cast<std::uint8_t*>(out);
    for (int i = 4; i < 4 * (width - 1); ++i) {
        const auto around = static_cast<std::uint16_t>(up[i] + down[i] + at[i - 4] + at[i + 4]);
        to[i] = static_cast<std::uint8_t>(static_cast<std::uint16_t>(12 * at[i] + around + 8) >> 4);
    }
    out[0] = row[0], out[width - 1] = row[width - 1];
}

}  // namespace

/// Smooths edges, which one ray in the middle of each pixel makes steps of: the RMS of pictures with one ray in each
/// pixel falls to .79 in demo.rt, .74 in flythrough.rt and .95 in mirror_ball.rt.
void Sharpener::smooth_edges(ScreenImage& image, ThreadPool& pool) {
    smoothed.resize(image.width, image.height);
    const auto row = [&](int y) {
        return &image.pixels[std::size_t(std::clamp(y, 0, image.height - 1)) * image.width];
    };
    share_out(pool, image.height, 16, [&](int first, int last) {
        for (int y = first; y < last; ++y)
            smooth(row(y - 1), row(y), row(y + 1), image.width, &smoothed.pixels[std::size_t(y) * image.width]);
    });
    std::swap(image.pixels, smoothed.pixels);
}

/// Finds for each pixel by how much those at these offsets from it differ. Beyond the border are no pixels.
void Sharpener::compare(const ScreenImage& image, std::span<const Offset> offsets, ThreadPool& pool) {
    const int width = image.width, height = image.height;
    contrast.resize(image.pixels.size());
    share_out(pool, height, 16, [&](int first, int last) {
        std::vector<std::uint32_t> least(width), greatest(width);
        for (int y = first; y < last; ++y) {
            std::ranges::fill(least, ~0u), std::ranges::fill(greatest, 0u);
            for (const auto& [aside, down] : offsets) {
                if (y + down < 0 || y + down >= height) continue;
                const int begin = std::max(0, -aside), end = width - std::max(0, aside);
                extend(&image.pixels[std::size_t(y + down) * width + begin + aside], end - begin, &least[begin],
                       &greatest[begin]);
            }
            measure(least.data(), greatest.data(), width, &contrast[std::size_t(y) * width]);
        }
    });
}

/// Calls `place` for the pixels of an image that have the most contrast, but for no more than `most`, and gathers the
/// points that it adds.
void Sharpener::choose(const ScreenImage& image, double most, const Place& place, ThreadPool& pool) {
    std::array<int, 256> pixels{};
    each_at_least(contrast, least_contrast, 0, contrast.size(), [&](std::size_t i) { ++pixels[contrast[i]]; });
    int least = 256;
    for (double sum = 0; least > least_contrast && (sum += pixels[least - 1]) <= most;) --least;
    rows.resize((image.height + block - 1) / block);
    share_out(pool, static_cast<int>(rows.size()), 1, [&](int first, int last) {
        for (int row = first; row < last; ++row) {
            rows[row].clear();
            const int bottom = std::min((row + 1) * block, image.height);
            for (int left = 0; left < image.width; left += block)
                for (int y = row * block; y < bottom; ++y) {
                    const std::size_t begin = std::size_t(y) * image.width;
                    each_at_least(contrast, least, begin + left, begin + std::min(left + block, image.width),
                                  [&](std::size_t i) { place(int(i - begin), y, rows[row]); });
                }
        }
    });
    points.clear();
    for (const std::vector<PicturePoint>& row : rows) points.insert(points.end(), row.begin(), row.end());
}

Counts Sharpener::trace(Tracer& tracer, const Job& job) {
    rgb.resize(3 * points.size());
    return tracer.trace(job, PointList{points, rgb.data(), 1});
}

Counts Sharpener::sharpen(Tracer& tracer, const Job& job, const TransferTable& table, const ScreenImage& traced,
                          Steps steps, double seconds, const std::function<double()>& clock, ScreenImage& whole) {
    const double start = clock();
    const auto all = static_cast<double>(whole.pixels.size());
    if (choices.any()) seconds -= choices.median() * all;
    if (seconds <= 0) return {};
    const double fitting = costs.any() ? seconds / costs.median() : first_rays;
    double tracing = 0, count = 0;
    Counts rays;
    const auto pixel = [&](const PicturePoint& point) -> std::uint32_t& {
        return whole
            .pixels[static_cast<std::size_t>(point.y + .5f) * whole.width + static_cast<std::size_t>(point.x + .5f)];
    };
    const auto trace_all = [&](int rays_of_pixel, const auto& color) {
        const double before = clock();
        rays += trace(tracer, job);
        if (job.stopped()) return;
        const auto pixels = static_cast<int>(points.size()) / rays_of_pixel;
        share_out(job.pool, pixels, 4096, [&](int first, int last) {
            for (int i = first * rays_of_pixel; i < last * rays_of_pixel; i += rays_of_pixel) color(i);
        });
        tracing += clock() - before, count += static_cast<double>(points.size());
    };

    const auto note_costs = [&] {
        choices.add((clock() - start - tracing) / all);
        if (count > 0) costs.add(tracing / count);
    };

    if (const int others = steps.area() - 1; others > 0) {
        compare(traced, square, job.pool);
        const auto between = [&](int x, int y, std::vector<PicturePoint>& to) {
            for (int i = 1; i <= others; ++i) {
                const int column = x * steps.x + i % steps.x, row = y * steps.y + i / steps.x;
                if (column < whole.width && row < whole.height)
                    to.push_back({static_cast<float>(column), static_cast<float>(row)});
            }
        };
        choose(traced, fitting / others, between, job.pool);
        trace_all(1, [&](int i) {
            const double value[]{rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]};
            pixel(points[i]) = table.pixel(value);
        });
        if (job.stopped()) return rays;
    }
    smooth_edges(whole, job.pool);
    const double left = fitting - count;
    if (left < worth * fitting) return note_costs(), rays;
    compare(whole, cross, job.pool);
    const auto aside = [](int x, int y, std::vector<PicturePoint>& to) {
        const auto column = static_cast<float>(x), row = static_cast<float>(y);
        to.push_back({column - aside_x, row - aside_y}), to.push_back({column + aside_x, row + aside_y});
    };
    choose(whole, left / 2, aside, job.pool);
    trace_all(2, [&](int i) {
        std::uint32_t& color = pixel(points[i]);
        double mean[3];
        for (int c = 0; c < 3; ++c)
            mean[c] = (table.light(color >> 8 * (2 - c) & 255) + rgb[3 * i + c] + rgb[3 * i + 3 + c]) / 3;
        color = table.pixel(mean);
    });
    if (!job.stopped()) note_costs();
    return rays;
}

}  // namespace strahl
