// Strahl's engine as the other programs are measured: bench_strahl SCENE PICTURE WIDTH HEIGHT THREADS PRECISION [BITS]
//
// Prints seconds, rays and peak memory before the picture is written; the picture "-" is not written. Nothing is left
// out of it (error 0), or what is less than half a step of so many bits. `strahl render` itself loads the picture
// library while it traces, which small pictures feel.
#include <cstdlib>
#include <cstring>
#include <iostream>

#include "files/read_file.h"
#include "image/picture.h"
#include "num/thread_pool.h"
#include "tests/bench/measure.h"
#include "text/parse.h"
#include "trace/tracer.h"

namespace {

using namespace strahl;

template <class T>
void run(char** argv, Precision precision, int bits) {
    Scene scene = parse_scene(read_text(argv[1]), argv[1]);
    View view{.camera = scene.camera, .width = std::atoi(argv[3]), .height = std::atoi(argv[4])};
    view.depth = scene.settings.max_trace_level;
    std::vector<T> picture(3 * std::size_t(view.width) * view.height);
    const double gamma = scene.settings.assumed_gamma;
    if (bits > 0) view.error = half_step({bits, gamma});
    ThreadPool pool(std::atoi(argv[5]));
    const Lattice whole{.columns = view.width, .rows = view.height};
    const auto keep = [&](const Tile& tile) { place(tile, whole, picture); };

    const double start = bench::seconds();
    Tracer tracer(std::move(scene), precision);
    tracer.trace({view, pool, keep}, Lattice{.columns = 1, .rows = 1});  // the first ray waits for the hierarchy
    const double built = bench::seconds();
    const Counts counts = tracer.trace({view, pool, keep}, whole);
    bench::print_figures(built - start, bench::seconds() - built, counts.total());
    if (std::strcmp(argv[2], "-") != 0)
        write_picture({view.width, view.height, 3, {picture.begin(), picture.end()}}, argv[2], {16, gamma});
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 7 && argc != 8)
        throw std::invalid_argument("bench_strahl SCENE PICTURE WIDTH HEIGHT THREADS float|double [BITS]");
    const int bits = argc == 8 ? std::atoi(argv[7]) : 0;
    if (std::strcmp(argv[6], "float") == 0)
        run<float>(argv, Precision::float32, bits);
    else
        run<double>(argv, Precision::float64, bits);
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
