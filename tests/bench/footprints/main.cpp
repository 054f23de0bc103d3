// How near to the average over each pixel one ray comes whose picture is filtered by its footprint:
// bench_footprints [PICTURE [GRID]]
//
// A picture, 3 long and 2 wide, again and again on a plane to the horizon, 320x240. The reference are GRID x GRID rays
// in each pixel. Filters look up pictures of half the size each (L. Williams, "Pyramidal Parametrics", 1983) between
// two of them, one or several times along the longer side of the footprint.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <vector>

#include "image/pixels.h"
#include "num/vec_math.h"

namespace {

using namespace strahl;

struct Place {
    double u, v;
};
Place operator-(const Place& a, const Place& b) { return {a.u - b.u, a.v - b.v}; }

/// Where the ray through (x, y), in pixels, meets the plane: from 2 above it, 8 degrees down, 25 degrees to each side.
constexpr int width = 320, height = 240;
std::optional<Place> place_at(double x, double y) {
    constexpr double degree = std::numbers::pi / 180;
    const double tan = std::tan(25 * degree), right = (2 * x / width - 1) * tan, up = (1 - 2 * y / height) * tan * .75;
    const double ahead = std::cos(8 * degree) + up * std::sin(8 * degree);
    const double below = std::sin(8 * degree) - up * std::cos(8 * degree);
    if (below < 1e-9) return {};
    const double t = 2 / below, c = std::cos(25 * degree), s = std::sin(25 * degree);
    return Place{t * (right * c + ahead * s) / 3, t * (ahead * c - right * s) / 2};
}

class Levels {
  public:
    explicit Levels(Pixels&& first) : levels{std::move(first)} {
        while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(half(levels.back()));
    }
    /// Bilinear in each of two levels, linear between them.
    Color at(const Place& p, double level) const {
        const double own = std::clamp(level, 0., double(levels.size() - 1));
        const auto low = static_cast<std::size_t>(own), high = std::min(low + 1, levels.size() - 1);
        const Color a = bilinear(levels[low], p);
        return own == double(low) ? a : a + (own - double(low)) * (bilinear(levels[high], p) - a);
    }
    /// Of a way, in pixels of the first level.
    double length(const Place& way) const { return std::hypot(way.u * levels[0].width, way.v * levels[0].height); }

  private:
    static Color pixel(const Pixels& of, int x, int y) {
        const auto within = [](int i, int size) { return ((i % size) + size) % size; };
        const auto i = 3 * (std::size_t(within(y, of.height)) * unsigned(of.width) + unsigned(within(x, of.width)));
        return {of.values[i], of.values[i + 1], of.values[i + 2]};
    }
    static Pixels half(const Pixels& of) {
        Pixels result{std::max(1, of.width / 2), std::max(1, of.height / 2), of.linear, {}, of.largest};
        for (int y = 0; y < result.height; ++y)
            for (int x = 0; x < result.width; ++x) {
                const int right = of.width > 1, down = of.height > 1, left = (1 + right) * x, top = (1 + down) * y;
                const Color mean = .25 * (pixel(of, left, top) + pixel(of, left + right, top) +
                                          pixel(of, left, top + down) + pixel(of, left + right, top + down));
                for (int c = 0; c < 3; ++c) result.values.push_back(static_cast<float>(mean[c]));
            }
        return result;
    }
    static Color bilinear(const Pixels& of, const Place& p) {
        const double x = p.u * of.width - .5, y = (1 - p.v) * of.height - .5, a = x - std::floor(x),
                     b = y - std::floor(y);
        const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
        return (1 - b) * ((1 - a) * pixel(of, i, j) + a * pixel(of, i + 1, j)) +
               b * ((1 - a) * pixel(of, i, j + 1) + a * pixel(of, i + 1, j + 1));
    }
    std::vector<Pixels> levels;
};

/// Of a ray whose square has sides of `size` pixels: up to `most` lookups along the longer side of its parallelogram.
Color filtered(const Levels& levels, double x, double y, double size, int most) {
    const Place middle = *place_at(x, y);
    if (most == 0) return levels.at(middle, 0);
    const Place across = *place_at(x + size / 2, y) - *place_at(x - size / 2, y);
    const Place down = *place_at(x, y + size / 2) - place_at(x, y - size / 2).value_or(middle);
    const double a = levels.length(across), b = levels.length(down), longer = std::max(a, b), shorter = std::min(a, b);
    const Place& way = a > b ? across : down;
    const int lookups = std::clamp(static_cast<int>(std::ceil(longer / std::max(shorter, 1.))), 1, most);
    const double level = std::log2(std::max({most == 1 ? (a + b) / 2 : longer / lookups, shorter, 1.}));
    Color sum{0};
    for (int i = 0; i < lookups; ++i) {
        const double t = (i + .5) / lookups - .5;
        sum += levels.at({middle.u + t * way.u, middle.v + t * way.v}, level);
    }
    return sum / double(lookups);
}

/// The mean over a pixel's square of a grid of rays, each with its share of the square.
Color mean(const Levels& levels, int x, int y, int grid, int most) {
    Color sum{0};
    for (int j = 0; j < grid; ++j)
        for (int i = 0; i < grid; ++i)
            sum += filtered(levels, x + (i + .5) / grid, y + (j + .5) / grid, 1. / grid, most);
    return sum / double(grid * grid);
}

}  // namespace

int main(int argc, char** argv) {
    const Levels levels(read_pixels(argc > 1 ? argv[1] : "scenes/pictures/parquet.png"));
    const int grid = argc > 2 ? std::atoi(argv[2]) : 64;
    int top = 0;  // the first row of which every pixel lies below the horizon
    while (!place_at(0, top)) ++top;
    std::vector<Color> reference;
    for (int y = top; y < height; ++y)
        for (int x = 0; x < width; ++x) reference.push_back(mean(levels, x, y, grid, 0));
    for (const int most : {0, 1, 4, 16})
        for (const int rays : {1, 2, 4, 8}) {
            if (most > 0 && rays > 2) continue;
            double squares = 0;
            const Color* wanted = reference.data();
            for (int y = top; y < height; ++y)
                for (int x = 0; x < width; ++x, ++wanted) {
                    const Color off = mean(levels, x, y, rays, most) - *wanted;
                    squares += dot_product(off, off);
                }
            std::printf("up to %2d lookups, %2d rays: RMS %.2f/510\n", most, rays * rays,
                        510 * std::sqrt(squares / (3. * double(reference.size()))));
        }
}
