// Progressive refinement: passes, the resolution in motion, and the pixels of the screen.
#include "show/session/progressive.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "num/thread_pool.h"
#include "show/motion/resolution.h"
#include "show/motion/screen_image.h"

using namespace strahl;

namespace {

const int sizes[][2] = {{64, 48}, {1, 1}, {7, 3}, {16, 16}, {17, 33}, {1, 40}, {40, 1}, {37, 29}};

}  // namespace

TEST_CASE("the passes after a level are finer than it, and the last one finishes") {
    for (int level = 0; level < averaged_level; ++level) {
        const auto left = passes_after(level);
        REQUIRE(!left.empty());
        CHECK(left.front().level > level);
        CHECK(left.back().level == averaged_level);
        CHECK(left.back().finest == 0);
        for (std::size_t i = 1; i < left.size(); ++i) {
            CHECK(left[i].level > left[i - 1].level);
            CHECK(left[i].finest < left[i - 1].finest);
        }
    }
    CHECK(passes_after(averaged_level).empty());
}

TEST_CASE("every level has more pixels than the one before, at most twice as many, from every 16th to all") {
    CHECK(steps_of(0) == Steps{16, 16});
    CHECK(steps_of(2) == Steps{8, 8});
    CHECK(steps_of(sixteenth_level).area() == 16);
    CHECK(steps_of(finest_level) == Steps{1, 1});
    for (int level = 1; level <= finest_level; ++level) {
        const double more = count(pixels_of(level, 96, 48)) / count(pixels_of(level - 1, 96, 48));
        CHECK(more > 1.3);
        CHECK(more <= 2);
    }
}

TEST_CASE("steps are as long in one direction as a picture is smooth in it, for about as many traced pixels") {
    CHECK(steps_of(ninth_level, 2) == Steps{4, 2});
    CHECK(steps_of(ninth_level, .5) == Steps{2, 4});
    CHECK(steps_of(sixteenth_level, 4) == Steps{8, 2});
    for (int level = 0; level <= finest_level; ++level)
        for (const double aspect : {.1, .3, .6, .9, 1.1, 1.6, 3.7, 10.}) {
            CAPTURE(level);
            CAPTURE(aspect);
            const Steps steps = steps_of(level, aspect), turned = steps_of(level, 1 / aspect);
            CHECK(steps == Steps{turned.y, turned.x});
            CHECK(steps.area() <= level_areas[level]);
            CHECK(steps.area() >= level_areas[level] * 8 / 9.);
            CHECK(std::max(steps.x, steps.y) <= 16);
            CHECK((steps.x >= steps.y) == (aspect > 1 || steps.x == steps.y));
        }
}

TEST_CASE("an expanded level is exact at its pixels and between its neighbours elsewhere") {
    ThreadPool pool(2);
    for (const auto& [width, height] : sizes)
        for (int level = 0; level < finest_level; ++level) {
            const Steps steps = steps_of(level, width > height ? 3 : .4);
            const Lattice lattice = pixels_of(steps, width, height);
            ScreenImage coarse, whole;
            coarse.resize(lattice.columns, lattice.rows), whole.resize(width, height);
            for (int i = 0; i < lattice.columns * lattice.rows; ++i) {
                const unsigned red = i * 37 % 256, green = i * 101 % 256, blue = i * 53 % 256;
                coarse.pixels[i] = red | green << 8 | blue << 16 | 0xff000000u;
            }
            expand(coarse, steps, whole, pool);
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    const int i = x / steps.x, j = y / steps.y;
                    const int i1 = std::min(i + 1, coarse.width - 1), j1 = std::min(j + 1, coarse.height - 1);
                    const std::uint32_t color = whole.pixels[y * width + x];
                    CHECK((color >> 24) == 0xff);
                    if (x % steps.x == 0 && y % steps.y == 0) CHECK(color == coarse.pixels[j * coarse.width + i]);
                    for (const int shift : {0, 8, 16}) {
                        const auto channel = [&](std::uint32_t pixel) {
                            return static_cast<double>(pixel >> shift & 255);
                        };
                        const auto at = [&](int c, int r) { return channel(coarse.pixels[r * coarse.width + c]); };
                        const double u = x % steps.x / double(steps.x), v = y % steps.y / double(steps.y);
                        const double exact =
                            (1 - v) * ((1 - u) * at(i, j) + u * at(i1, j)) + v * ((1 - u) * at(i, j1) + u * at(i1, j1));
                        CHECK(std::abs(channel(color) - exact) < 1.8);  // rounded twice, and a third is 85/256
                    }
                }
        }
}

TEST_CASE("tiles are stored where their pixels belong") {
    const TransferTable table(false);
    const std::vector<float> rgb{0, .5f, 1, 2, -1, .25f};
    ScreenImage image;
    image.resize(4, 3);
    const Lattice part{.x = 2, .y = 1, .columns = 2, .rows = 1};
    store(part, encoded({part, std::span<const float>(rgb)}, table).data(), image);
    CHECK(image.pixels[1 * 4 + 2] == (128u << 8 | 255u | 0xff000000u));  // blue is in the lowest bits
    CHECK(image.pixels[1 * 4 + 3] == (255u << 16 | 64u | 0xff000000u));
    CHECK(image.pixels[1 * 4 + 1] == 0);
}

namespace {

/// Several pictures of a scene whose pixels have this cost.
std::vector<int> run(Resolution& resolution, int pictures, double seconds_per_pixel, double budget,
                     int finest = finest_level, double share = 1) {
    std::vector<int> levels;
    for (int i = 0; i < pictures; ++i) {
        const int level = resolution.choose(640, 480, budget, finest, share);
        const double pixels = count(pixels_of(level, 640, 480));
        resolution.observe(pixels, pixels * seconds_per_pixel);
        levels.push_back(level);
    }
    return levels;
}

}  // namespace

TEST_CASE("the resolution settles at the budget and stays there") {
    Resolution resolution;
    const double all = 640 * 480, budget = 0.010;
    CHECK(run(resolution, 100, 0.5 * budget / all, budget).back() == finest_level);
    // Now four times slower: coarser within a few pictures, and then stable.
    const std::vector<int> levels = run(resolution, 100, 2 * budget / all, budget);
    CHECK(levels[4] < finest_level);
    for (int i = 5; i < 100; ++i) CHECK(levels[i] == levels[4]);
    CHECK(2 * budget / all * count(pixels_of(levels[4], 640, 480)) <= budget);
    // Becomes finer only with time to spare: a level that would take 0.9 of the budget is not tried ...
    CHECK(run(resolution, 100, 0.9 * budget / all, budget).back() == finest_level - 1);
    // ... but such a level is kept if it is in use.
    run(resolution, 100, 0.5 * budget / all, budget);
    CHECK(run(resolution, 100, 0.9 * budget / all, budget).back() == finest_level);
    CHECK(run(resolution, 100, 1e-3, budget).back() == 0);
    CHECK(run(resolution, 100, 1e-12, budget, 3).back() == 3);
}

TEST_CASE("below 1/16 of the pixels the rate falls first") {
    Resolution resolution;
    const double budget = 0.010, sixteenth = count(pixels_of(sixteenth_level, 640, 480));
    CHECK(run(resolution, 100, 2 * budget / sixteenth, budget).back() == sixteenth_level);
    CHECK(run(resolution, 100, 3.9 * budget / sixteenth, budget).back() == sixteenth_level);
    CHECK(run(resolution, 100, 5.5 * budget / sixteenth, budget).back() == sixteenth_level - 1);
    CHECK(run(resolution, 100, 0.4 * budget / sixteenth, budget).back() == sixteenth_level + 2);
}

TEST_CASE("levels of more than 1/9 of the pixels leave a share of the time") {
    Resolution resolution;
    const double budget = 0.010, ninth = count(pixels_of(ninth_level, 640, 480));
    CHECK(run(resolution, 100, .4 * budget / ninth, budget, finest_level, .5).back() == ninth_level);
    CHECK(run(resolution, 100, .8 * budget / ninth, budget, finest_level, .5).back() == ninth_level);
    CHECK(run(resolution, 100, .18 * budget / ninth, budget, finest_level, .5).back() == ninth_level + 2);
}

TEST_CASE("one or two slow pictures change nothing") {
    Resolution resolution;
    const double cost = 0.5 * 0.010 / (640 * 480);
    run(resolution, 100, cost, 0.010);
    for (int i = 0; i < 2; ++i) resolution.observe(640 * 480, 0.5);
    CHECK(run(resolution, 1, cost, 0.010).back() == finest_level);
}
