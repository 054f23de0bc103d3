// Works out the speed of more threads: bench_threads SCENE WIDTH HEIGHT [ROUNDS [PRECISION]]
//
// Measures one and two threads in turn, and with one how long each tile takes. From that it works out larger numbers:
// the tiles, in their order, go to whichever thread is free; of what comes before them the serial part is what two
// threads do not halve. Memory that processors share is not in it. Prints a row of threads.md's table.
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <queue>
#include <string>
#include <vector>

#include "num/thread_pool.h"
#include "tests/bench/measure.h"
#include "text/parse.h"
#include "trace/tracer.h"

namespace {

using namespace strahl;

using bench::median;

/// Seconds of one picture: before its tiles (hierarchy and light buffers), and for them.
struct Times {
    std::vector<double> before, tiles;
};

void measure(const Scene& scene, const View& view, Precision precision, ThreadPool& pool, Times& times) {
    const Lattice all{.columns = view.width, .rows = view.height};
    Tracer tracer(scene, precision);
    const double start = bench::seconds();
    tracer.prepare(view, pool);
    tracer.trace({view, pool, [](const Tile&) {}}, all);
    const double first = bench::seconds();
    tracer.trace({view, pool, [](const Tile&) {}}, all);
    const double second = bench::seconds() - first;
    times.tiles.push_back(second), times.before.push_back(std::max(0., first - start - second));
}

/// Returns the processor time of the calling thread, which other programs do not lengthen.
double processor_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Seconds of each tile, in order.
std::vector<double> tiles(const Scene& scene, const View& view, Precision precision, ThreadPool& alone) {
    Tracer tracer(scene, precision);
    const Lattice all{.columns = view.width, .rows = view.height};
    tracer.trace({view, alone, [](const Tile&) {}}, all);
    std::vector<double> seconds;
    double last = processor_seconds();
    const auto note = [&](const Tile&) {
        const double now = processor_seconds();
        seconds.push_back(now - last), last = now;
    };
    tracer.trace({view, alone, note}, all);
    return seconds;
}

/// When the last of `threads` threads is done with the tiles.
double end_of(const std::vector<double>& tiles, int threads) {
    std::priority_queue<double, std::vector<double>, std::greater<>> free_at;
    for (int i = 0; i < threads; ++i) free_at.push(0);
    double end = 0;
    for (const double seconds : tiles) {
        const double done = free_at.top() + seconds;
        free_at.pop(), free_at.push(done), end = std::max(end, done);
    }
    return end;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) return std::fputs("usage: bench_threads SCENE WIDTH HEIGHT [ROUNDS [PRECISION]]\n", stderr), 2;
    const Precision precision = argc > 5 && std::string(argv[5]) == "double" ? Precision::float64 : Precision::float32;
    std::ifstream file(argv[1]);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    const double start = bench::seconds();
    const Scene scene = parse_scene(text, argv[1]);
    const double parsed = bench::seconds() - start;
    const View view{.camera = scene.camera, .width = std::atoi(argv[2]), .height = std::atoi(argv[3])};
    ThreadPool one(1), two(2);
    Times with_one, with_two;
    for (int round = argc > 4 ? std::atoi(argv[4]) : 7; round > 0; --round)
        measure(scene, view, precision, one, with_one), measure(scene, view, precision, two, with_two);

    const double before[]{median(with_one.before), median(with_two.before)};
    const double serial = std::clamp(2 * before[1] - before[0], 0., before[0]), shared = before[0] - serial;
    const std::vector<double> each = tiles(scene, view, precision, one);
    double sum = 0;
    for (const double seconds : each) sum += seconds;
    std::printf("parsing %.4f, before the tiles %.4f and %.4f, tiles %.3f and %.3f, the longest of %zu %.2g s\n",
                parsed, before[0], before[1], median(with_one.tiles), median(with_two.tiles), each.size(),
                *std::ranges::max_element(each));
    const double alone = parsed + before[0] + median(with_one.tiles);
    std::printf("| %.2f | %.2f |", median(with_one.tiles) / median(with_two.tiles),
                alone / (parsed + before[1] + median(with_two.tiles)));
    for (const int threads : {2, 4, 16, 64})
        std::printf(" %.1f, %.1f |", sum / end_of(each, threads),
                    (parsed + before[0] + sum) / (parsed + serial + shared / threads + end_of(each, threads)));
    std::puts("");
}
