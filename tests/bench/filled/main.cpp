// Compares lattices filled by cells with plain ones, in cost and error: tests/bench/sampling.md, "In flight".
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "files/read_file.h"
#include "image/pixels.h"
#include "image/transfer.h"
#include "num/thread_pool.h"
#include "show/motion/screen_image.h"
#include "show/session/flight.h"
#include "show/session/progressive.h"
#include "tests/bench/measure.h"
#include "text/parse.h"
#include "trace/tracer.h"

namespace strahl {
namespace {

struct Run {
    std::vector<std::uint32_t> colors;
    Counts rays;
    double seconds = 0;  // of the processor
};

/// Traces a lattice; plainly if `contrast` is 0.
Run run(Tracer& tracer, const View& view, ThreadPool& pool, const Lattice& lattice, double contrast) {
    Run result{.colors = std::vector<std::uint32_t>(std::size_t(lattice.columns) * lattice.rows)};
    const TransferTable table(tracer.scene().settings.assumed_gamma);
    const auto keep = [&](const Tile& tile) {
        const std::vector<std::uint32_t> colors = encoded(tile, table);
        for (int i = 0; i < tile.lattice.columns * tile.lattice.rows; ++i) {
            const int x = (tile.lattice.x - lattice.x) / lattice.step_x + i % tile.lattice.columns;
            const int y = (tile.lattice.y - lattice.y) / lattice.step_y + i / tile.lattice.columns;
            result.colors[std::size_t(y) * lattice.columns + x] = colors[i];
        }
    };
    const auto encode = [&](const double* rgb) { return table.pixel(rgb); };
    const FilledLattice filled{lattice, contrast, encode, result.colors.data()};
    const std::clock_t start = std::clock();
    result.rays = contrast > 0 ? tracer.trace({view, pool, {}}, filled) : tracer.trace({view, pool, keep}, lattice);
    result.seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    return result;
}

using bench::median;

/// Pixels whose worst channel, as the screen shows it, is off by more than this many steps.
double share_off(const Run& a, const Run& b, int steps) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.colors.size(); ++i) {
        int most = 0;
        for (int shift = 0; shift < 24; shift += 8)
            most = std::max(most, std::abs(int(a.colors[i] >> shift & 255) - int(b.colors[i] >> shift & 255)));
        count += most > steps;
    }
    return double(count) / double(a.colors.size());
}

/// A scene with a moment of its flight, as the window asks for it.
struct Shot {
    Scene scene;
    View view;
    double contrast;
};
Shot shot(const std::string& path, int width, int height) {
    Shot shot{parse_scene(read_text(path), path, {}, read_pixels), {}, 0};
    const double slope = steepest(shot.scene.settings.assumed_gamma);
    shot.view = {.camera = shot.scene.camera, .width = width, .height = height};
    shot.view.depth = shot.scene.settings.max_trace_level, shot.view.error = .5 / 255 / slope;
    shot.contrast = 3. / 255 / slope;
    if (!shot.scene.flythrough) shot.scene.flythrough = orbit_path(shot.scene.camera, shot.scene.camera);
    return shot;
}
void go_to(Shot& shot, double time) {
    shot.view.time = time;
    shot.view.camera = camera_at(*shot.scene.flythrough, shot.scene.camera, time);
}

/// Lattices of steps 1, 2, .. up to `coarsest` at one moment.
void compare(Shot& shot, double time, int runs, int coarsest) {
    if (time >= 0) go_to(shot, time);
    const View& view = shot.view;
    ThreadPool pool(2);
    Tracer tracer(shot.scene, Precision::float32);
    tracer.prepare(view, pool);
    std::printf("%-6s %7s %7s %7s %9s %8s %9s %9s\n", "step", "camera", "rays", "time", "plain, s", "> 1/255",
                "> 4/255", "> 16/255");
    for (int step = 1; step <= coarsest; step *= 2) {
        const Lattice lattice{0, 0, (view.width + step - 1) / step, (view.height + step - 1) / step, step, step};
        std::vector<double> plain_seconds, ratios;
        Run plain, filled;
        for (int i = 0; i < runs; ++i) {
            plain = run(tracer, view, pool, lattice, 0);
            filled = run(tracer, view, pool, lattice, shot.contrast);
            plain_seconds.push_back(plain.seconds), ratios.push_back(filled.seconds / plain.seconds);
        }
        const auto off = [&](int steps) { return 100 * share_off(plain, filled, steps); };
        const auto share = [](std::uint64_t a, std::uint64_t b) { return double(a) / double(b); };
        std::printf("%-6d %7.3f %7.3f %7.3f %9.4f %7.3f%% %8.4f%% %8.4f%%\n", step,
                    share(filled.rays.camera, plain.rays.camera), share(filled.rays.total(), plain.rays.total()),
                    median(ratios), median(plain_seconds), off(1), off(4), off(16));
    }
}

/// The finest resolution levels that fit into 0.8 of a 60th of a second, along the flight.
void fly(Shot& shot, int moments) {
    constexpr int threads = 2, runs = 3;
    constexpr double budget = threads * .8 / 60;  // processor time
    ThreadPool pool(threads);
    Tracer tracer(shot.scene, Precision::float32);
    std::array<int, finest_level + 2> plain_levels{}, filled_levels{};  // the last one: not even the coarsest fits
    const auto finest_that_fits = [&](const auto& trace) {
        int level = finest_level;
        for (; level >= 0; --level) {
            const Lattice lattice = pixels_of(level, shot.view.width, shot.view.height);
            std::vector<double> seconds;
            for (int i = 0; i < runs; ++i) {
                const std::clock_t start = std::clock();
                trace(lattice);
                seconds.push_back(double(std::clock() - start) / CLOCKS_PER_SEC);
            }
            if (median(seconds) <= budget) break;
        }
        return level;
    };
    for (int i = 0; i < moments; ++i) {
        go_to(shot, shot.scene.flythrough->duration * (i + .5) / moments);
        tracer.prepare(shot.view, pool);
        const Job job{shot.view, pool, [](const Tile&) {}};
        const auto plain = [&](const Lattice& l) { tracer.trace(job, l); };
        std::vector<std::uint32_t> colors(std::size_t(shot.view.width) * shot.view.height);
        const TransferTable table(shot.scene.settings.assumed_gamma);
        const auto encode = [&](const double* rgb) { return table.pixel(rgb); };
        const auto filled = [&](const Lattice& l) {
            tracer.trace(job, FilledLattice{l, shot.contrast, encode, colors.data()});
        };
        ++plain_levels.at(std::size_t(finest_that_fits(plain) + 1)),
            ++filled_levels.at(std::size_t(finest_that_fits(filled) + 1));
    }
    for (int level = finest_level; level >= -1; --level)
        if (const auto at = std::size_t(level + 1); plain_levels[at] + filled_levels[at] > 0)
            std::printf("1/%-4d of the pixels: plain %5.1f %%, filled %5.1f %% of the moments\n",
                        steps_of(level).area(), 100. * plain_levels[at] / moments, 100. * filled_levels[at] / moments);
}

}  // namespace
}  // namespace strahl

int main(int argc, char** argv) {
    if (argc < 2)
        return std::puts(
                   "usage: bench_filled SCENE [WIDTH HEIGHT [TIME [RUNS [COARSEST]]]]\n"
                   "       bench_filled SCENE WIDTH HEIGHT flight [MOMENTS]"),
               2;
    const auto number = [&](int i, double otherwise) { return argc > i ? std::atof(argv[i]) : otherwise; };
    strahl::Shot shot = strahl::shot(argv[1], int(number(2, 1920)), int(number(3, 1080)));
    if (argc > 4 && std::string(argv[4]) == "flight")
        strahl::fly(shot, int(number(5, 40)));
    else
        strahl::compare(shot, number(4, -1), int(number(5, 15)), int(number(6, 1)));
}
