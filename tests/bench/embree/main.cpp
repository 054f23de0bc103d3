// A small Whitted tracer on Embree: bench_embree SCENE PICTURE WIDTH HEIGHT THREADS. Prints seconds, rays and memory.
//
// The picture "-" is not written. Float only, as Embree is. It has no list of bodies entered: overlapping glass comes
// out wrong.
#include <pmmintrin.h>

#include <atomic>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "files/read_file.h"
#include "image/picture.h"
#include "tests/bench/measure.h"
#include "text/parse.h"
#include "whitted.h"

namespace {

using namespace strahl;

void run(char** argv) {
    const int width = std::atoi(argv[3]), height = std::atoi(argv[4]), threads = std::atoi(argv[5]);
    const Scene scene = parse_scene(read_text(argv[1]), argv[1]);

    const double start = bench::seconds();
    const bench::World world(scene, threads);
    const double built = bench::seconds();
    std::vector<float> rgb(static_cast<std::size_t>(width) * height * 3);
    std::vector<bench::RayCounts> counts(threads);
    std::atomic<int> next = 0;
    const auto work = [&](int thread) {
        _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
        _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
        bench::Whitted tracer(world, scene.camera, width, height, scene.settings.max_trace_level);
        constexpr int tile = bench::Whitted::tile;
        const int columns = (width + tile - 1) / tile, tiles = columns * ((height + tile - 1) / tile);
        for (int i; (i = next++) < tiles;) tracer.trace_tile(i % columns * tile, i / columns * tile, rgb);
        counts[thread] = tracer.counts;
    };
    {
        std::vector<std::jthread> others;
        for (int i = 1; i < threads; ++i) others.emplace_back(work, i);
        work(0);
    }
    const double traced = bench::seconds();
    bench::RayCounts sum;
    for (const auto& c : counts) sum.camera += c.camera, sum.secondary += c.secondary, sum.shadow += c.shadow;
    bench::print_figures(built - start, traced - built, sum.camera + sum.secondary + sum.shadow);
    if (argv[2] != std::string("-"))
        write_picture({width, height, 3, {rgb.begin(), rgb.end()}}, argv[2], {16, scene.settings.assumed_gamma});
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 6) throw std::invalid_argument("bench_embree SCENE PICTURE WIDTH HEIGHT THREADS");
    run(argv);
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
