// Measures how good pictures in motion are at a fixed budget of processor time: tests/bench/motion_quality.md.
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "files/read_file.h"
#include "image/picture.h"
#include "image/pixels.h"
#include "image/transfer.h"
#include "num/thread_pool.h"
#include "show/motion/quality.h"
#include "show/motion/quick_pictures.h"
#include "show/motion/screen_image.h"
#include "show/session/session.h"
#include "text/parse.h"
#include "trace/tracer.h"

namespace strahl {
namespace {

struct Flown {
    std::string scene, folder, picture;
    bool one = false;    // one ray in each pixel, whatever it takes
    bool means = false;  // and patterns averaged over the pixels
    bool even = false;   // equal distances between traced pixels, and nothing else
    int width = 480, height = 270, frames = 60, shown = 30;
    double start = 0, fps = 60, speed = 1;
    double budget = 2 * .8 / 60;  // seconds of processor time: .8 of a 60th of a second on two threads
};

/// Processor time of this process.
double processor_seconds() {
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// Keeps finished pictures in files: they take far longer than all that is measured.
ScreenImage finished(const Flown& options, int frame, Tracer& tracer, const View& view, ThreadPool& pool,
                     const TransferTable& table) {
    char name[300];
    std::snprintf(name, sizeof name, "%s/%s-%dx%d-%g.bgra", options.folder.c_str(),
                  std::filesystem::path(options.scene).stem().c_str(), view.width, view.height,
                  options.start + options.speed * frame / options.fps);
    ScreenImage image;
    image.resize(view.width, view.height);
    const auto bytes = static_cast<std::streamsize>(4 * image.pixels.size());
    if (std::ifstream file(name, std::ios::binary); file.read(reinterpret_cast<char*>(image.pixels.data()), bytes))
        return image;
    image = traced_picture(tracer, view, pool, table, {});
    std::ofstream(name, std::ios::binary).write(reinterpret_cast<const char*>(image.pixels.data()), bytes);
    return image;
}

void write(const ScreenImage& image, const std::string& path) {
    Picture picture{image.width, image.height, 3, {}};
    for (const std::uint32_t pixel : image.pixels)
        for (int c = 0; c < 3; ++c) picture.values.push_back(double(pixel >> 8 * (2 - c) & 255) / 255);
    write_picture(picture, path, {});
}

int run(const Flown& options) {
    std::filesystem::create_directories(options.folder);
    const auto scene =
        std::make_shared<const Scene>(parse_scene(read_text(options.scene), options.scene, {}, read_pixels));
    const TransferTable table(scene->settings.assumed_gamma);
    Session session(scene);
    session.perform({Action::play}, -options.start);
    ThreadPool pool(1);
    Tracer tracer(*scene, Precision::float32);
    const QuickPictures::Wish wish{.budget = options.budget,
                                   .sharpened_until = options.even ? 0 : options.budget,
                                   .averages = !options.even,
                                   .contrast = 6. / 255 / steepest(scene->settings.assumed_gamma)};  // as in the window
    const auto encode = [&](const double* rgb) { return table.pixel(rgb); };
    QuickPictures quick;
    QualityLog log;
    std::map<int, int> levels;
    double seconds = 0;
    for (int frame = -40; frame < options.frames; ++frame) {  // the first ones find the level that fits
        session.follow(options.speed * frame / options.fps);
        const View view = session.view(options.width, options.height);
        tracer.prepare(view, pool);
        ScreenImage image;
        const double start = processor_seconds();
        if (options.one) {
            if (options.means) {
                image.resize(view.width, view.height);
                const Lattice all = pixels_of(finest_level, view.width, view.height);
                tracer.trace({view, pool, {}}, FilledLattice{all, 0, encode, image.pixels.data(), 1});
            } else if (frame >= 0) {
                image = traced_picture(tracer, view, pool, table, {.grid = 1});
            }
        } else {
            const int level = quick.choose(options.width, options.height, wish);
            quick.trace(
                tracer, {view, pool, {}}, table, wish, level, [&] { return processor_seconds() - start; }, true, image);
            if (frame >= 0) ++levels[level];
        }
        if (frame < 0) continue;
        seconds += processor_seconds() - start;
        ScreenImage exact = finished(options, frame, tracer, view, pool, table);
        if (!options.picture.empty() && frame == options.shown) {
            write(image, options.picture + ".png");
            write(exact, options.picture + "-finished.png");
        }
        log.add(std::move(image), std::move(exact), frame > 0);
    }
    const Quality quality = log.quality();
    std::printf("| %s, %dx%d | %s | %.1f | %.1f | %.2f | %.0f | %.4f | %.2f %% | %.2f |",
                std::filesystem::path(options.scene).stem().c_str(), options.width, options.height,
                options.means  ? "one ray a pixel, means"
                : options.one  ? "one ray a pixel"
                : options.even ? "even"
                               : "sharpened",
                1000 * options.budget, 1000 * seconds / options.frames, quality.rms, quality.p99, quality.ssim,
                100 * quality.visible, quality.flicker);
    for (auto at = levels.rbegin(); at != levels.rend(); ++at)
        std::printf(" 1/%d: %d", steps_of(at->first).area(), at->second);
    std::puts(" |");
    return 0;
}

}  // namespace
}  // namespace strahl

int main(int argc, char** argv) {
    strahl::Flown options;
    const char* const temporary = std::getenv("TMPDIR");
    options.folder = std::string(temporary ? temporary : "/tmp") + "/strahl-motion";
    for (int i = 1; i < argc; ++i) {
        const std::string text = argv[i];
        const std::size_t equals = text.find('=');
        const std::string name = text.substr(0, equals), value = equals == text.npos ? "" : text.substr(equals + 1);
        const double number = std::atof(value.c_str());
        if (equals == text.npos)
            options.scene = text;
        else if (name == "size")
            std::sscanf(value.c_str(), "%dx%d", &options.width, &options.height);
        else if (text == "one=yes")
            options.one = true;
        else if (text == "means=yes")
            options.one = options.means = true;
        else if (text == "even=yes")
            options.even = true;
        else if (name == "budget")
            options.budget = number / 1000;
        else if (name == "frames")
            options.frames = int(number);
        else if (name == "start")
            options.start = number;
        else if (name == "speed")
            options.speed = number;
        else if (name == "shown")
            options.shown = int(number);
        else if (name == "picture")
            options.picture = value;
        else
            options.scene.clear();
    }
    if (options.scene.empty())
        return std::puts(
                   "usage: bench_motion_quality SCENE [size=480x270] [budget=26.7] [frames=60] [start=0] "
                   "[one=yes] [means=yes] [even=yes]\n                            [speed=1] [picture=NAME [shown=30]]\n"
                   "The budget is in ms of processor time. One row: RMS in 1/255, 99 %, SSIM, share of the pixels off\n"
                   "by more than 8/255, flicker; and how many pictures had which share of the pixels traced."),
               2;
    return strahl::run(options);
}
