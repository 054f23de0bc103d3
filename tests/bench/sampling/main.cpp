// Measures the error and cost of anti-aliased pictures, against averages over pixels. See tests/bench/sampling.md.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "files/output_file.h"
#include "files/read_file.h"
#include "image/picture.h"
#include "image/pixels.h"
#include "num/thread_pool.h"
#include "tests/bench/measure.h"
#include "text/parse.h"
#include "trace/cells/cell_picture.h"
#include "trace/tracer.h"

namespace strahl {
namespace {

struct Result {
    std::vector<double> rgb;
    Counts rays;
    double seconds = 0, estimate = 0;
};

/// A picture and what it costs. `trace` is given where its tiles go.
Result render(Tracer& tracer, const View& view, ThreadPool& pool, const std::function<Counts(const Sink&)>& trace) {
    const Lattice whole{.columns = view.width, .rows = view.height};
    Result result;
    result.rgb.resize(std::size_t(3) * view.width * view.height);
    tracer.prepare(view, pool);
    const double start = bench::seconds();
    result.rays = trace([&](const Tile& tile) { place(tile, whole, result.rgb); });
    result.seconds = bench::seconds() - start;
    return result;
}

/// With a grid of rays in every pixel.
Result grid_picture(Tracer& tracer, const View& view, int grid, ThreadPool& pool) {
    const Lattice whole{.columns = view.width, .rows = view.height};
    return render(tracer, view, pool, [&](const Sink& sink) {
        return tracer.trace({view, pool, sink}, SampledRegion{whole, {.grid = grid}});
    });
}

/// An adaptive picture, and the RMS error that it is thought to have.
Result refine(Tracer& tracer, const View& view, double error, ThreadPool& pool) {
    std::optional<CellPicture> picture;
    Result result = render(tracer, view, pool, [&](const Sink& sink) {
        picture.emplace(tracer.scene(), view, Lattice{.columns = view.width, .rows = view.height}, error);
        return tracer.trace({view, pool, sink}, CellPass{*picture, 0});
    });
    result.estimate = picture->sampled().error();
    return result;
}

/// The reference, from a file of this scene's text and size if there is one.
std::vector<double> reference(Tracer& tracer, const View& view, int grid, const std::string& path, ThreadPool& pool) {
    std::vector<double> rgb(std::size_t(3) * view.width * view.height);
    const auto bytes = static_cast<std::streamsize>(rgb.size() * sizeof(double));
    if (std::ifstream file(path, std::ios::binary); file.read(reinterpret_cast<char*>(rgb.data()), bytes)) return rgb;
    rgb = grid_picture(tracer, view, grid, pool).rgb;
    std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(rgb.data()), bytes);
    return rgb;
}

/// Values are clamped to what a file shows, so that a brightness of 3 does not outweigh everything else.
void print(const std::string& name, const Result& result, const std::vector<double>& exact, double pixels) {
    double squares = 0;
    std::vector<double> worst;  // by pixel
    for (std::size_t i = 0; i < exact.size(); i += 3) {
        double most = 0;
        for (std::size_t c = i; c < i + 3; ++c) {
            const double off = std::clamp(result.rgb[c], 0., 1.) - std::clamp(exact[c], 0., 1.);
            squares += off * off;
            most = std::max(most, std::abs(off));
        }
        worst.push_back(most);
    }
    std::ranges::sort(worst);
    const auto percentile = [&](double share) { return worst[std::size_t(share * double(worst.size() - 1))] * 255; };
    std::printf("%-14s %7.2f %8.1f %8.3f %8.3f %8.2f %8.1f %9.4f %9.3f\n", name.c_str(),
                double(result.rays.camera) / pixels, double(result.rays.total()) / pixels,
                510 * std::sqrt(squares / double(exact.size())), percentile(.99), percentile(.999), worst.back() * 255,
                result.seconds, 510 * result.estimate);
}

int compare(int argc, char** argv) {
    const std::string path = argv[1];
    const int width = argc > 2 ? std::atoi(argv[2]) : 320, grid = argc > 3 ? std::atoi(argv[3]) : 32;
    const double time = argc > 4 ? std::atof(argv[4]) : -1;
    const bool in_float = std::getenv("STRAHL_FLOAT");
    const std::string text = read_text(path);
    Scene scene = parse_scene(text, path, {}, read_pixels);
    View view{.camera = scene.camera, .width = width, .height = width * 3 / 4};
    if (time >= 0 && scene.flythrough) view.camera = camera_at(*scene.flythrough, scene.camera, time);
    view.depth = scene.settings.max_trace_level;
    view.error = 1. / 510;
    const double pixels = double(view.width) * view.height;
    ThreadPool pool(0);
    Tracer tracer(scene, in_float ? Precision::float32 : Precision::float64);
    const char* const folder = std::getenv("TMPDIR");
    const std::string kept = std::string(folder ? folder : "/tmp") + "/strahl-" +
                             std::filesystem::path(path).stem().string() + "-" +
                             std::to_string(std::hash<std::string>()(text)) + "-" + std::to_string(width) + "-" +
                             std::to_string(grid) + "-" + std::to_string(time) + ".raw";
    const std::vector<double> exact = reference(tracer, view, grid, kept, pool);
    if (argc > 5) {  // other programs' pictures
        for (int i = 5; i < argc; ++i) {
            const Picture picture = read_picture(argv[i]);
            Result result;
            result.rgb = picture.values;
            result.rays.camera = static_cast<std::uint64_t>(pixels);
            print(std::filesystem::path(argv[i]).stem().string(), result, exact, pixels);
        }
        return 0;
    }
    std::printf("%s, %dx%d, reference %dx%d\n", path.c_str(), view.width, view.height, grid, grid);
    std::printf("%-14s %7s %8s %8s %8s %8s %8s %9s %9s\n", "", "samples", "rays", "RMS*510", "99%*255", "99.9%", "most",
                "seconds", "estimate");
    for (const int n : {1, 2, 4, 8})
        print(std::to_string(n) + "x" + std::to_string(n), grid_picture(tracer, view, n, pool), exact, pixels);
    for (const double error : {8., 4., 2., 1., .5, .25}) {
        char name[32];
        std::snprintf(name, sizeof name, "error %g/510", error);
        print(name, refine(tracer, view, error / 510, pool), exact, pixels);
    }
    return 0;
}

}  // namespace
}  // namespace strahl

int main(int argc, char** argv) {
    if (argc < 2) return std::puts("usage: strahl_sampling SCENE [WIDTH [GRID [TIME [PICTURE...]]]]"), 2;
    return strahl::compare(argc, argv);
}
