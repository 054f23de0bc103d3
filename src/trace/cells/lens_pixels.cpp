#include "trace/cells/lens_pixels.h"

#include <algorithm>
#include <cmath>

#include "num/scrambled_net.h"
#include "trace/cells/cells.h"

namespace strahl {
namespace {

constexpr std::uint32_t first_rays = 32, most_rays = 16384;

/// Returns the largest standard deviation of eight independent nets that a pixel may have. One net of all their points
/// is better, by how much depends on the world; the factor was found by experiment (tests/bench/lens.md).
double allowed_deviation(double error) { return 2.2 * error; }

template <class Sums>
double variance_of(const Sums& sums, double taken) {
    double light = 0, alpha = 0;
    for (int c = 0; c < 4; ++c) {
        double mean = 0, squares = 0;
        for (const auto& sum : sums) mean += sum[c] / taken / LensPixels::eighths;
        for (const auto& sum : sums) squares += (sum[c] / taken - mean) * (sum[c] / taken - mean);
        const double variance = squares / (LensPixels::eighths * (LensPixels::eighths - 1));
        c < 3 ? light += variance / 3 : alpha = variance;
    }
    return std::max(light, alpha);
}

}  // namespace

void LensPixels::begin(int x, int y, int own_columns, int own_rows, double error, const Camera& own_camera,
                       int own_moments) {
    left = x, top = y, columns = own_columns, rows = own_rows, moments = own_moments;
    aim = error;
    camera = own_camera, lens = has_lens(camera);
    const auto count = static_cast<std::size_t>(columns) * rows;
    pixels.assign(count, {});
    means.assign(3 * count, 0);
    open.resize(count);
    for (std::size_t i = 0; i < count; ++i) open[i] = static_cast<int>(i);
}

std::uint32_t LensPixels::seed_of(int pixel) const {
    const int x = left + pixel % columns, y = top + pixel / columns;
    return ScrambledNet::mix(static_cast<std::uint32_t>(y) * 65536u + static_cast<std::uint32_t>(x));
}

/// Collects rays by their moments, and traces many at once.
class LensPixels::Rays {
  public:
    Rays(const LensPixels& pixels, const TraceLensRays& own_trace, bool own_check)
        : tile(pixels), trace(own_trace), check(own_check), buckets(pixels.moments + 1) {}
    /// Adds the light of the ray through this place to `sum` later.
    void add(double x, double y, double across, double below, int moment, double* sum) {
        buckets[moment].rays.push_back({x, y, across, below}), buckets[moment].to.push_back(sum), ++count;
    }
    /// To be called between pixels, so that sums do not depend on the tile.
    void flush_if_many() {
        if (count >= 128 * std::max<std::size_t>(32, tile.moments)) flush();
    }
    void flush() {
        for (int moment = 0; moment <= tile.moments; ++moment) {
            auto& [rays, to] = buckets[moment];
            if (rays.empty()) continue;
            light.assign(rays.size(), {});
            trace(moment, rays, light, check);
            for (std::size_t i = 0; i < rays.size(); ++i)
                for (int c = 0; c < 4; ++c) to[i][c] += light[i][c];
            rays.clear(), to.clear();
        }
        count = 0;
    }

  private:
    struct Bucket {
        std::vector<LensRay> rays;
        std::vector<double*> to;  // of each ray
    };
    const LensPixels& tile;
    const TraceLensRays& trace;
    const bool check;
    std::vector<Bucket> buckets;  // by moment
    std::vector<LensLight> light;
    std::size_t count = 0;
};

void LensPixels::trace_nets(std::span<const NetPart> parts, const TraceLensRays& trace, bool check) const {
    Rays rays(*this, trace, check);
    for (const NetPart& part : parts) {
        const double x = left + part.pixel % columns - .5, y = top + part.pixel / columns - .5;
        const ScrambledNet net(part.seed);
        for (std::uint32_t i = part.first; i < part.last; ++i) {
            double* const sum = (*part.sums)[std::uint64_t(i) * eighths / part.last].data();
            if (!lens) {
                const auto [u, v, time] = net.point<3>(i);
                rays.add(x + u, y + v, 0, 0, static_cast<int>(time * moments), sum);
                continue;
            }
            const auto add = [&](double u, double v, double s, double t, double time) {
                const auto [across, below] = lens_place(camera, s, t);
                rays.add(x + u, y + v, across, below, static_cast<int>(time * moments), sum);
            };
            if (moments > 0) {
                const auto [u, v, s, t, time] = net.point<5>(i);
                add(u, v, s, t, time);
            } else {
                const auto [u, v, s, t] = net.point(i);
                add(u, v, s, t, 0);
            }
        }
        rays.flush_if_many();
    }
    rays.flush();
}

void LensPixels::keep_still(std::span<const double> values, std::span<const std::uint32_t> counts,
                            const TraceLensRays& trace) {
    constexpr std::uint32_t tests = 2 * coarsest_cell * coarsest_cell;
    const double unseen = aim / 4;
    struct StillSquare {
        int x, y, columns, rows;
        std::array<std::array<LensLight, 2>, tests> light{};  // at a moment, and at the view's time
    };
    std::vector<StillSquare> squares;
    for (int y = 0; y < rows; y += coarsest_cell)
        for (int x = 0; x < columns; x += coarsest_cell)
            squares.push_back({x, y, std::min(coarsest_cell, columns - x), std::min(coarsest_cell, rows - y)});
    Rays rays(*this, trace, false);
    for (StillSquare& square : squares) {
        const ScrambledNet net(ScrambledNet::mix(seed_of(square.y * columns + square.x) + 4));
        for (std::uint32_t i = 0; i < tests; ++i) {
            const auto [u, v, time] = net.point<3>(i);
            const double x = left + square.x + u * square.columns - .5, y = top + square.y + v * square.rows - .5;
            rays.add(x, y, 0, 0, static_cast<int>(time * moments), square.light[i][0].data());
            rays.add(x, y, 0, 0, moments, square.light[i][1].data());
        }
        rays.flush_if_many();
    }
    rays.flush();
    const auto changes = [&](const auto& pair) {
        for (int c = 0; c < 3; ++c)
            if (!(std::abs(pair[0][c] - pair[1][c]) <= unseen)) return true;
        return false;
    };
    open.clear();
    for (const StillSquare& square : squares) {
        const bool moving = std::ranges::any_of(square.light, changes);
        for (int y = square.y; y < square.y + square.rows; ++y)
            for (int x = square.x; x < square.x + square.columns; ++x) {
                const int number = y * columns + x;
                if (moving) {
                    open.push_back(number);
                    continue;
                }
                pixels[number].taken = counts[number];
                std::copy_n(&values[std::size_t(3) * number], 3, &means[std::size_t(3) * number]);
            }
    }
}

void LensPixels::take(std::uint32_t rays, const TraceLensRays& trace) {
    std::vector<NetPart> parts;
    for (const int number : open) {
        LensPixel& pixel = pixels[number];
        for (int k = 0; k < eighths && pixel.taken > 0; ++k)  // two become an eighth of the doubled net
            for (int c = 0; c < 4; ++c)
                pixel.sums[k][c] = 2 * k < eighths ? pixel.sums[2 * k][c] + pixel.sums[2 * k + 1][c] : 0;
        parts.push_back({number, seed_of(number), pixel.taken, std::max(rays, 2 * pixel.taken), &pixel.sums});
        pixel.taken = parts.back().last;
    }
    trace_nets(parts, trace, false);
    for (const int number : open) {
        LensPixel& pixel = pixels[number];
        pixel.variance = variance_of(pixel.sums, double(pixel.taken) / eighths);
        for (int c = 0; c < 3; ++c) {
            double sum = 0;
            for (const auto& eighth : pixel.sums) sum += eighth[c];
            means[std::size_t(3) * number + c] = sum / pixel.taken;
        }
    }
}

void LensPixels::refine(bool all, const TraceLensRays& trace) {
    do {
        take(first_rays, trace);
        settle();
    } while (all && !open.empty());
}

/// Finds the pixels that need more rays. Few rays may all have missed what a neighbour has found.
void LensPixels::settle() {
    const double limit = allowed_deviation(aim) * allowed_deviation(aim);
    open.clear();
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const int number = y * columns + x;
            if (pixels[number].taken >= most_rays) continue;
            const auto from = [](int at) { return std::max(at / coarsest_cell * coarsest_cell, at - 1); };
            const auto to = [](int at, int end) {
                return std::min({at / coarsest_cell * coarsest_cell + coarsest_cell, at + 2, end});
            };
            double sum = 0;
            int count = 0;
            for (int v = from(y); v < to(y, rows); ++v)
                for (int u = from(x); u < to(x, columns); ++u, ++count) sum += pixels[v * columns + u].variance;
            if (std::max(pixels[number].variance, sum / count) > limit) open.push_back(number);
        }
}

std::vector<std::uint32_t> LensPixels::counts() const {
    std::vector<std::uint32_t> all;
    for (const LensPixel& pixel : pixels) all.push_back(pixel.taken);
    return all;
}

MeasuredError LensPixels::measured(double chance, const TraceLensRays& trace) const {
    const auto checks = [&](int pixel) { return 2 * std::max(pixels[pixel].taken, first_rays); };
    std::vector<int> chosen;
    for (int i = 0; i < columns * rows; ++i)
        if (ScrambledNet::mix(seed_of(i) + 1) * 0x1p-32 < chance) chosen.push_back(i);
    std::vector<std::array<Sums, 2>> sums(chosen.size());
    std::vector<NetPart> parts;
    for (std::size_t k = 0; k < chosen.size(); ++k)
        for (std::uint32_t half = 0; half < 2; ++half)
            parts.push_back(
                {chosen[k], ScrambledNet::mix(seed_of(chosen[k]) + 2 + half), 0, checks(chosen[k]), &sums[k][half]});
    trace_nets(parts, trace, true);
    MeasuredError error{.checked = chosen.size()};
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        double product = 0;
        for (int c = 0; c < 3; ++c) {
            double off[2];
            for (int half = 0; half < 2; ++half) {
                off[half] = -means[std::size_t(3) * chosen[k] + c];
                for (const auto& sum : sums[k][half]) off[half] += sum[c] / checks(chosen[k]);
            }
            product += off[0] * off[1] / 3;
        }
        error.squares += product / chance, error.variance += product / chance * (product / chance);
    }
    return error;
}

}  // namespace strahl
