// More than one ray in a pixel: grids, and cells that follow what the picture needs.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "num/thread_pool.h"
#include "tests/referee/random_scene.h"
#include "tests/unit/sanitized.h"
#include "tests/unit/scenes.h"
#include "tests/unit/trace/cut_out.h"
#include "trace/cells/cell_picture.h"
#include "trace/cells/checked_pixels.h"
#include "trace/tracer.h"

namespace strahl::sampling {

View view_of(const Scene& scene, int width, int height) {
    return {.camera = scene.camera, .width = width, .height = height, .depth = 6, .error = 1. / 510};
}

std::vector<double> traced(Tracer& tracer, const View& view, const Sampling& sampling, const Lattice& part,
                           int threads = 2) {
    ThreadPool pool(threads);
    return values_of(tracer, view, part, pool, sampling);
}
std::vector<double> whole(const Scene& scene, const View& view, const Sampling& sampling,
                          Precision precision = Precision::float64, Simd simd = Simd::automatic) {
    Tracer tracer(scene, precision, simd);
    return traced(tracer, view, sampling, {.columns = view.width, .rows = view.height});
}

/// In steps of 1/510, of values as a file shows them.
double rms(const std::vector<double>& a, const std::vector<double>& b) {
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double off = std::clamp(a[i], 0., 1.) - std::clamp(b[i], 0., 1.);
        squares += off * off;
    }
    return 510 * std::sqrt(squares / double(a.size()));
}

TEST_CASE("a grid is the average of shifted pictures") {
    const Scene scene = random_scene(3);
    View view = view_of(scene, 37, 23);
    view.error = 0;
    const std::vector<double> one = whole(scene, view, {.grid = 1});
    CHECK(one == whole(scene, view, {.grid = 1, .centre = false}));
    for (const bool centre : {false, true}) {
        std::vector<double> sum = centre ? one : std::vector<double>(one.size());
        for (const double y : {-1. / 3, 0., 1. / 3})
            for (const double x : {-1. / 3, 0., 1. / 3}) {
                View shifted = view;
                shifted.shift_x = x, shifted.shift_y = y;
                const std::vector<double> more = whole(scene, shifted, {.grid = 1});
                for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += more[i];
            }
        for (double& value : sum) value /= centre ? 10 : 9;
        CHECK(rms(sum, whole(scene, view, {.grid = 3, .centre = centre})) < 1e-6);
    }
}

TEST_CASE("averages come out as exact as they aim") {
    if (sanitized()) return;  // only figures count here and below: the other cases run the same code
    for (const std::string name : {"article", "die", "flythrough"}) {
        CAPTURE(name);
        const Scene scene = read_scene(name);
        const View view = view_of(scene, 96, 72);
        const std::vector<double> exact = whole(scene, view, {.grid = 12}, Precision::float32);
        const double stairs = rms(whole(scene, view, {.grid = 1}), exact);
        const double usual = rms(whole(scene, view, {}), exact), fine = rms(whole(scene, view, {.error = 2e-4}), exact);
        CHECK(usual < stairs / 5);
        CHECK(usual < 2);  // where much is smaller than a pixel, up to twice as much as is aimed at
        CHECK(fine < usual / 1.5);
    }
}

/// Returns the estimate of a refined picture's error over the true one. About `checked` pixels are checked for each
/// sample that pixels take on average.
double estimate_over_error(const Scene& scene, const View& view, double aim, const std::vector<double>& exact,
                           int checked) {
    const Lattice all{.columns = view.width, .rows = view.height};
    ThreadPool pool(2);
    Tracer tracer(scene, Precision::float64);
    CellPicture cells(scene, view, all, aim);
    cells.check(checked);
    std::vector<double> rgb(exact.size());
    tracer.trace({view, pool, [&](const Tile& tile) { place(tile, all, rgb); }}, CellPass{cells, 0});
    double squares = 0;
    for (std::size_t i = 0; i < rgb.size(); ++i) squares += (rgb[i] - exact[i]) * (rgb[i] - exact[i]);
    return cells.sampled().error() / std::sqrt(squares / double(rgb.size()));
}

TEST_CASE("the error that is estimated is the true one, within a factor of two") {
    if (sanitized()) return;
    for (const auto& [name, depth] : {std::pair<std::string, int>{"article", 20},
                                      {"flythrough", 20},
                                      {"die", 6},
                                      {"crosscheck/balls_of_mirror", 6},
                                      {"kinds/torus", 6}}) {
        CAPTURE(name);
        const Scene scene = read_scene(name);
        View view = view_of(scene, 120, 90);
        view.depth = depth;
        const std::vector<double> exact = whole(scene, view, {.grid = 12}, Precision::float32);
        for (const double aim : {4. / 510, .5 / 510}) {
            CAPTURE(aim);
            // Half of the error of a small picture may be in one pixel, as in that of the die, which few checks miss.
            const double ratio = estimate_over_error(scene, view, aim, exact, 400);
            MESSAGE("estimate over error: ", ratio);
            CHECK(ratio > .5);
            CHECK(ratio < 2);
        }
    }
}

TEST_CASE("the error that is estimated of worlds at random is half to three times the true one") {
    if (sanitized()) return;
    for (std::uint64_t seed = 900; seed < 906; ++seed) {
        CAPTURE(seed);
        const Scene scene = random_scene(seed, {.lights = seed % 2 == 0, .patterns = true, .bumps = seed % 3 == 0});
        const View view = view_of(scene, 64, 48);
        const double ratio =
            estimate_over_error(scene, view, 1. / 510, whole(scene, view, {.grid = 12}, Precision::float32), 96);
        MESSAGE("estimate over error: ", ratio);
        CHECK(ratio > .5);
        CHECK(ratio < 3);
    }
}

TEST_CASE("the squares of errors measured at some pixels are expected to be those of all") {
    // A half-plane, whose edge is known exactly, in a tile with errors of our own.
    constexpr int columns = 24, rows = 10;
    const auto edge_at = [](double y) { return 9.3 + .37 * y; };
    std::vector<double> rgb;
    std::vector<std::uint32_t> samples;
    double squares = 0;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            double share = 0;
            for (int i = 0; i < 1000; ++i) share += std::clamp(edge_at(y + (i + .5) / 1000) - x, 0., 1.) / 1000;
            const bool edge = share > 0 && share < 1;
            for (int c = 0; c < 3; ++c) {
                const double off = (edge ? .02 : .002) * (c - .7) * ((x * 7 + y * 5) % 4 - 1.5);
                rgb.push_back(share + off), squares += off * off / 3;
            }
            samples.push_back(edge ? 20 : (x + y) % 2);
        }
    const TraceSquares trace = [&](std::span<const Point> points, double, CellSample* seen) {
        for (const Point& p : points) {
            const double value = double(p.x) / Point::unit < edge_at(double(p.y) / Point::unit);
            *seen = {}, std::fill_n((seen++)->rgb, 3, value);
        }
    };
    MeasuredError sum;
    double spread = 0;
    constexpr int times = 400;
    for (std::uint32_t seed = 1; seed <= times; ++seed) {
        const MeasuredError one = measured_error({columns, rgb, samples}, .02, seed, trace);
        sum += one, spread += (one.squares - squares) * (one.squares - squares);
    }
    CHECK(double(sum.checked) / times ==
          doctest::Approx(.02 * (std::accumulate(samples.begin(), samples.end(), 0.) + .25 * columns * rows))
              .epsilon(.01));
    CHECK(sum.squares / times == doctest::Approx(squares).epsilon(.06));
    CHECK(sum.variance > spread);  // errors that a few pixels share are counted for each of them
    CHECK(sum.variance < 4 * spread);
}

TEST_CASE("checks and bricks are known by themselves, not by their colours alone") {
    // Without the filters the errors of both pictures are 3.7.
    for (const std::string pattern : {"checker { <.9, .9, .9>, <.1, .1, .1>  rotate <0, 0, 25> }",
                                      "brick { <.9, .9, .9>, <.1, .1, .1>  scale .2  rotate <0, 0, 25> }"}) {
        CAPTURE(pattern);
        const Scene scene = parse_scene(
            "camera { position <0, -10, 5>  look_at <0, 0, .5>  up <0, 0, -1>  fov 18 }\n"
            "light { position <-7, -9, 12>  color <.9, .9, .9> }\n"
            "disc { <0, 0, 0>, <0, 0, 1>, 6  material { rgb " +
                pattern +
                " } }\n"
                "sphere { <0, 0, 1>, 1  material { reflection .6 } }",
            "checks");
        const View view = view_of(scene, 160, 120);
        const double error = rms(whole(scene, view, Sampling{}), whole(scene, view, {.grid = 12}));
        CAPTURE(error);
        CHECK(error < 2);
    }
}

TEST_CASE("patterns are averaged at the edges of pictures, too, where rays of panoramas turn round") {
    const Scene scene = parse_scene(
        "camera { position <0, 0, 1>  look_at <0, 5, 1>  sky <0, 0, 1>  angle 90  panoramic }\n"
        "light { position <-7, -9, 12>  color <.9, .9, .9> }\n"
        "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>\n"
        "        material { rgb checker { <.9, .9, .9>, <.1, .1, .1>  scale .07  rotate <0, 0, 25> } } }",
        "panorama");
    const View view = view_of(scene, 64, 48);
    const std::vector<double> ours = whole(scene, view, Sampling{}), exact = whole(scene, view, {.grid = 16});
    CHECK(rms(ours, exact) < 3);
    CHECK(rms(cut_out(ours, 64, {0, 47, 64, 1}), cut_out(exact, 64, {0, 47, 64, 1})) < 6);
}

TEST_CASE("averages depend neither on threads, crops, lanes nor passes") {
    for (const Scene& scene : {read_scene("article"), random_scene(17, {.camera_inside = true})}) {
        const View view = view_of(scene, 75, 61);
        Tracer tracer(scene, Precision::float64);
        const Lattice all{.columns = view.width, .rows = view.height};
        const std::vector<double> picture = traced(tracer, view, {}, all);
        CHECK(picture == traced(tracer, view, {}, all, 3));
        CHECK(picture == whole(scene, view, {}, Precision::float64, Simd::scalar));
        for (const Lattice crop :
             {Lattice{33, 17, 20, 30}, Lattice{0, 0, 1, 1}, Lattice{74, 60, 1, 1}, Lattice{7, 0, 40, 9}}) {
            CHECK(traced(tracer, view, {}, crop) == cut_out(picture, view.width, crop));
        }
        ThreadPool pool(2);
        CellPicture cells(scene, view, all, Sampling{}.error);
        std::vector<double> rgb(picture.size());
        double before = 1e9;
        for (const int finest : {8, 4, 2, 1, 0}) {
            CHECK(!cells.finished());
            tracer.trace({view, pool, [&](const Tile& tile) { place(tile, all, rgb); }}, CellPass{cells, finest});
            CHECK(rms(rgb, picture) < before);  // each pass is nearer to the last
            before = rms(rgb, picture);
        }
        CHECK(cells.finished());
        CHECK(rgb == picture);
        CHECK(cells.sampled().count() == 75 * 61);
        CHECK(cells.sampled().most() > cells.sampled().median());
    }
}

TEST_CASE("rays are where the picture changes") {
    Scene scene = read_scene("crosscheck/no_light");
    scene.primitives.clear();
    const View view = view_of(scene, 64, 64);
    ThreadPool pool(1);
    Tracer tracer(scene, Precision::float64);
    const Lattice all{.columns = 64, .rows = 64};
    CellPicture empty(scene, view, all, Sampling{}.error, 8);
    const Counts rays = tracer.trace({view, pool, [](const Tile&) {}}, CellPass{empty, 0});
    CHECK(rays.camera == 81 + 64);  // a tile of 64 cells with corners and a middle
    CHECK(empty.sampled().error() == 0);
}

TEST_CASE("a chord halves a cell") {
    // Straight edges at random: areas are exact.
    for (int i = 0; i < 1000; ++i) {
        const double a = .001 + .998 * (i % 31) / 31., b = .001 + .998 * (i % 37) / 37.;
        const std::array<int, 2> opposite{0, 2}, beside{0, 1}, across{1, 3};
        CHECK(parts_of(opposite, {a, b}).first_area == doctest::Approx(((1 - a) + b) / 2));
        CHECK(parts_of(beside, {a, b}).first_area == doctest::Approx((1 - a) * b / 2));
        CHECK(parts_of(across, {a, b}).first_area == doctest::Approx(((1 - a) + b) / 2));
        const ChordParts parts = parts_of(beside, {a, b});  // the first part has the corner (1, 0)
        CHECK((1 - parts.middle_x) * parts.normal_x - parts.middle_y * parts.normal_y < 0);
    }
    CHECK(!changing_sides({1, 1, 1, 1}));
    CHECK(!changing_sides({1, 2, 1, 2}));
    CHECK(!changing_sides({1, 2, 3, 1}));
    CHECK(changing_sides({1, 2, 2, 1}) == std::array<int, 2>{0, 2});
    CHECK(changing_sides({1, 1, 2, 1}) == std::array<int, 2>{1, 2});
}

TEST_CASE("what is counted of samples") {
    Sampled a, b;
    a.pixels[1] = 3, a.pixels[7] = 2, a.measured = {9, 5, 4};
    CHECK(a.count() == 5);
    CHECK(a.median() == 1);
    CHECK(a.most() == 7);
    CHECK(a.error() == 1);
    a.measured.variance = 100;
    CHECK(a.error() == std::sqrt(2.));
    a.measured.squares = -3;
    CHECK(a.error() == std::sqrt(2.));
    b.pixels[4096] = 20;
    a += b;
    CHECK(a.median() == 4096);
    CHECK(a.count() == 25);
    CHECK(Sampled().error() == 0);
}

}  // namespace strahl::sampling
