// Measures the error and cost of anti-aliased pictures, against averages over pixels. See tests/bench/sampling.md.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <random>
#include <span>
#include <sstream>
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
        picture->check();
        return tracer.trace({view, pool, sink}, CellPass{*picture, 0});
    });
    result.estimate = picture->sampled().error();
    return result;
}

/// How the picture looks without noise, in two halves with rays of their own: the expected product of a picture's
/// differences from both is the square of its error, however noisy they are.
struct Reference {
    std::vector<double> halves[2];

    double difference(const std::vector<double>& rgb, std::size_t i) const {
        return rgb[i] - .5 * (halves[0][i] + halves[1][i]);
    }
};

/// A half of the reference, from a file of this scene's text and size if there is one: grid x grid rays a pixel, each
/// anywhere in its own part of the pixel. On a regular grid edges along its rows would be off by up to half a row in
/// every pixel.
std::vector<double> half_of_reference(Tracer& tracer, const View& view, int grid, unsigned seed,
                                      const std::string& path, ThreadPool& pool) {
    std::vector<double> rgb(std::size_t(3) * view.width * view.height);
    const auto bytes = static_cast<std::streamsize>(rgb.size() * sizeof(double));
    if (std::ifstream file(path, std::ios::binary); file.read(reinterpret_cast<char*>(rgb.data()), bytes)) return rgb;
    std::fill(rgb.begin(), rgb.end(), 0.);
    std::mt19937 random(seed);
    const auto within = [&](int part) { return (part + random() * 0x1p-32) / grid - .5; };
    for (int i = 0; i < grid * grid; ++i) {
        View shifted = view;
        shifted.shift_x = within(i % grid), shifted.shift_y = within(i / grid);
        const std::vector<double> one = grid_picture(tracer, shifted, 1, pool).rgb;
        for (std::size_t k = 0; k < rgb.size(); ++k) rgb[k] += one[k] / (double(grid) * grid);
    }
    std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(rgb.data()), bytes);
    return rgb;
}
Reference reference(Tracer& tracer, const View& view, int grid, const std::string& path, ThreadPool& pool) {
    const auto half = [&](unsigned i) {
        return half_of_reference(tracer, view, grid, i, path + std::to_string(i) + ".raw", pool);
    };
    return {{half(1), half(2)}};
}

/// Values are clamped to what a file shows, so that a brightness of 3 does not outweigh everything else.
void print(const std::string& name, const Result& result, const Reference& exact, double pixels) {
    double squares = 0;
    std::vector<double> worst;  // by pixel
    for (std::size_t i = 0; i < result.rgb.size(); i += 3) {
        double most = 0;
        for (std::size_t c = i; c < i + 3; ++c) {
            const auto off = [&](int half) {
                return std::clamp(result.rgb[c], 0., 1.) - std::clamp(exact.halves[half][c], 0., 1.);
            };
            squares += off(0) * off(1);
            most = std::max(most, std::abs(off(0) + off(1)) / 2);
        }
        worst.push_back(most);
    }
    std::ranges::sort(worst);
    const auto percentile = [&](double share) { return worst[std::size_t(share * double(worst.size() - 1))] * 255; };
    std::printf("%-14s %7.2f %8.1f %8.3f %8.3f %8.2f %8.1f %9.4f %9.3f\n", name.c_str(),
                double(result.rays.camera) / pixels, double(result.rays.total()) / pixels,
                510 * std::sqrt(std::max(squares, 0.) / double(result.rgb.size())), percentile(.99), percentile(.999),
                worst.back() * 255, result.seconds, 510 * result.estimate);
}

/// A scene at a moment and a size, and the file that keeps its reference picture, with a grid of rays in every pixel.
struct Measured {
    std::string path;
    int width, grid;
    double time = -1;
    std::string text = read_text(path);
    Scene scene = parse_scene(text, path, {}, read_pixels);

    View view() const {
        View view{.camera = scene.camera, .width = width, .height = width * 3 / 4};
        if (time >= 0 && scene.flythrough) view.camera = camera_at(*scene.flythrough, scene.camera, time);
        view.depth = scene.settings.max_trace_level, view.error = 1. / 510, view.time = std::max(time, 0.);
        return view;
    }
    std::string kept() const {
        const char* const folder = std::getenv("TMPDIR");
        std::ostringstream name;
        name << (folder ? folder : "/tmp") << "/strahl-" << std::filesystem::path(path).stem().string() << '-'
             << std::hash<std::string>()(text) << '-' << width << '-' << grid << '-' << time << "-half-";
        return name.str();
    }
};

Precision precision() { return std::getenv("STRAHL_FLOAT") ? Precision::float32 : Precision::float64; }

int compare(const Measured& own, std::span<char*> pictures) {
    const View view = own.view();
    const double pixels = double(view.width) * view.height;
    ThreadPool pool(0);
    Tracer tracer(own.scene, precision());
    const Reference exact = reference(tracer, view, own.grid, own.kept(), pool);
    if (!pictures.empty()) {  // other programs' pictures
        for (const char* const path : pictures) {
            Result result;
            result.rgb = read_picture(path).values;
            result.rays.camera = static_cast<std::uint64_t>(pixels);
            print(std::filesystem::path(path).stem().string(), result, exact, pixels);
        }
        return 0;
    }
    std::printf("%s, %dx%d, reference %dx%d\n", own.path.c_str(), view.width, view.height, own.grid, own.grid);
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

/// Prints a row of the table of worlds: values are not clamped here. Light is the sum over pixels of the mean of the
/// channels: how much the picture has too much or too little of it. Without a reference only the estimate is printed.
void print_row(const Measured& own) {
    const View view = own.view();
    ThreadPool pool(0);
    Tracer tracer(own.scene, precision());
    const Result result = refine(tracer, view, 1. / 510, pool);
    const double pixels = double(view.width) * view.height;
    std::printf("| %s | %.2f | %.1f |", std::filesystem::path(own.path).stem().string().c_str(),
                double(result.rays.camera) / pixels, double(result.rays.total()) / pixels);
    if (own.grid == 0) {
        std::printf(" %.2f |\n", 510 * result.estimate);
        return;
    }
    const Reference exact = reference(tracer, view, own.grid, own.kept(), pool);
    double squares = 0, worst = 0, light = 0;
    for (std::size_t i = 0; i < result.rgb.size(); ++i) {
        const double off = exact.difference(result.rgb, i);
        squares += (result.rgb[i] - exact.halves[0][i]) * (result.rgb[i] - exact.halves[1][i]);
        light += off / 3, worst = std::max(worst, std::abs(off));
    }
    const double rms = std::sqrt(std::max(squares, 0.) / double(result.rgb.size()));
    std::printf(" %.2f | %.2f | %.2f | %.3f | %+.1f |\n", 510 * result.estimate, 510 * rms, result.estimate / rms,
                worst, light);
    std::fflush(stdout);
}

int table(int width, int grid, std::span<char*> scenes) {
    std::puts(grid == 0 ? "| world | samples a pixel | all rays | estimate, 1/510 |\n|---|--:|--:|--:|"
                        : "| world | samples a pixel | all rays | estimate, 1/510 | RMS | over RMS | worst | light |\n"
                          "|---|--:|--:|--:|--:|--:|--:|--:|");
    for (const std::string scene : scenes) {
        const std::size_t at = scene.rfind('@');
        const double time = at == std::string::npos ? -1 : std::atof(scene.c_str() + at + 1);
        print_row({scene.substr(0, at), width, grid, time});
    }
    return 0;
}

}  // namespace
}  // namespace strahl

int main(int argc, char** argv) try {
    using namespace strahl;
    const std::span all(argv, static_cast<std::size_t>(argc));
    const auto number = [&](int i, int otherwise) { return argc > i ? std::atoi(argv[i]) : otherwise; };
    if (argc > 4 && std::string(argv[1]) == "--table") return table(number(2, 0), number(3, 0), all.subspan(4));
    if (argc > 1 && argv[1][0] != '-') {
        const Measured own{argv[1], number(2, 320), number(3, 32), argc > 4 ? std::atof(argv[4]) : -1};
        return compare(own, all.subspan(std::min(argc, 5)));
    }
    return std::puts(
               "usage: bench_sampling SCENE [WIDTH [GRID [TIME [PICTURE...]]]]\n"
               "       bench_sampling --table WIDTH GRID SCENE[@TIME]...\n"
               "GRID 0: no reference, so that errors are only estimated"),
           2;
} catch (const strahl::FileError& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 3;
}
