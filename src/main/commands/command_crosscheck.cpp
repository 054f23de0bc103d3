#include "main/commands/command_crosscheck.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "files/output_file.h"
#include "files/streams.h"
#include "files/utf8.h"
#include "image/compare.h"
#include "image/transfer.h"
#include "main/commands/scene_file.h"
#include "num/thread_pool.h"
#include "povref/compare/run_povray.h"
#include "povref/compare/verdict.h"
#include "scene/moving_scene.h"

namespace strahl {
namespace {

namespace fs = std::filesystem;

/// Strahl's picture, and the time for tracing it.
struct OurRun {
    Frame frame;
    double seconds;
};
OurRun trace(Tracer& tracer, const View& view, int threads, const std::atomic<bool>* stop) {
    ThreadPool pool(threads);
    OurRun run{{view.width, view.height, {}}, 0};
    const auto start = std::chrono::steady_clock::now();
    run.frame.rgb = values_of(tracer, view, {.columns = view.width, .rows = view.height}, pool, {.grid = 1}, stop);
    if (stop && *stop) throw Stopped{};
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return run;
}

/// Rounds the values to 16 bits, as a screen would show them.
Picture for_screen(Picture picture, double gamma) {
    for (double& v : picture.values) v = quantise(v, gamma, 65535) / 65535.;
    return picture;
}

void write_sheet(const std::string& path, const Frame& ours, const Picture& theirs, double gamma) {
    const Picture mine{ours.width, ours.height, 3, ours.rgb};
    const Picture difference = heatmap(for_screen(mine, false), for_screen(theirs, false));
    write_picture(beside({for_screen(mine, gamma), for_screen(theirs, gamma), difference}, 4), path, {});
}

/// Returns the picture that averages with `one` to `average`.
Picture other_half(Picture average, const Picture& one) {
    for (std::size_t i = 0; i < average.values.size(); ++i) average.values[i] = 2 * average.values[i] - one.values[i];
    return average;
}

/// Returns "sheet.png" for one scene, "sheet-NAME.png" for one of several.
std::string sheet_path(const CrosscheckOptions& options, const std::string& scene) {
    if (options.scenes.size() == 1) return options.sheet;
    const fs::path path(options.sheet);
    return (path.parent_path() /
            (path.stem().string() + "-" + fs::path(scene).stem().string() + path.extension().string()))
        .string();
}

/// Says why two pictures disagree, or returns "".
std::string disagreement(const Verdict& verdict) {
    TextStream text;
    if (verdict.beyond_off_edges > 0)
        text << "largest difference off the edges at x " << verdict.x << ", y " << verdict.y;
    else if (verdict.beyond_on_edges * 1000 > verdict.pixels)
        text << "more than 1 pixel in 1000 differs on edges";
    else if (too_unsure(verdict))
        text << "POV-Ray is unsure of more than 1 pixel in 50, so that the pictures cannot be compared";
    if (verdict.in_areas > 0) text << "; " << verdict.in_areas << " of these pixels are in areas full of edges";
    return text.str();
}

void print_row(const std::string& path, const Verdict& verdict, double ours, double theirs) {
    const std::string scene = show(path.ends_with(".rt") ? path.substr(0, path.size() - 3) : path).text;
    std::printf("| %-36s | %7zu | %9d | %10zu | %8zu | %6zu | %8.3f | %9.3f |\n", scene.c_str(), verdict.pixels,
                verdict.worst_off_edges, verdict.beyond_off_edges, verdict.beyond_on_edges, verdict.unsure, ours,
                theirs);
    std::fflush(stdout);
}

/// Returns whether the two pictures agree.
bool check(const CrosscheckOptions& options, const std::string& path, const std::atomic<bool>* stop) {
    OpeningOptions opening = options.opening;
    opening.as_text = is_model(path);
    const OpenedScene opened = load_opened(path, opening, options.time);
    const Scene& scene = opened.scene;
    if (options.time) flight_for("--time", scene, path);
    Camera camera = camera_at(scene, options.time);
    if (has_lens(camera) && is_pov(path)) {
        std::cerr << show(path).text
                  << ": its camera has an aperture, whose rays POV-Ray chooses by chance; compare a copy without it\n";
        return false;
    }
    if (has_lens(camera)) std::cerr << show(path).text << ": compared through the middle of its lens\n";
    if (camera.shutter > 0)
        std::cerr << show(path).text << ": compared in the middle of the time its shutter is open\n";
    if (camera.stereo != Stereo::none) std::cerr << show(path).text << ": compared as seen from between its two eyes\n";
    camera.aperture = camera.shutter = 0, camera.stereo = Stereo::none;
    const View view{.camera = camera,
                    .width = options.opening.size.width,
                    .height = options.opening.size.height,
                    .depth = options.depth.value_or(scene.settings.max_trace_level),
                    .time = options.time.value_or(0)};
    PovFile file{.path = path,
                 .width = view.width,
                 .height = view.height,
                 .gamma = scene.settings.assumed_gamma,
                 .library = options.opening.library,
                 .clock = opened.clock};
    const PovRun theirs = is_pov(path) ? run_povray_file(file, options.threads, stop)
                                       : run_povray(without_tracks(scene, view.time),
                                                    {.title = fs::path(path).filename().string(),
                                                     .cameras = {view.camera},
                                                     .time = view.time,
                                                     .width = view.width,
                                                     .height = view.height,
                                                     .depth = view.depth},
                                                    options.threads, stop);
    Tracer tracer(scene, Precision::float64);
    const OurRun ours = trace(tracer, view, options.threads, stop);
    const Again again = [&](int number, const PicturePart& part) {
        file.moved = 1e-6 * (1 + .37 * number), file.by_tree = number % 2 == 0, file.part = part;
        return other_half(run_povray_file(file, options.threads, stop).picture, theirs.picture);
    };
    const Verdict verdict =
        judge(tracer, view, ours.frame, theirs.picture, stop, is_pov(path) && !options.time ? again : Again());
    print_row(path, verdict, ours.seconds, theirs.seconds);
    if (!theirs.warnings.empty() && !is_pov(path))
        std::cerr << show(path).text << ": povray warns:\n" << printable(theirs.warnings);
    const std::string reason = disagreement(verdict);
    if (!reason.empty()) std::cerr << show(path).text << ": " << reason << '\n';
    if (!options.sheet.empty())
        write_sheet(sheet_path(options, path), ours.frame, theirs.picture, scene.settings.assumed_gamma);
    return reason.empty();
}

}  // namespace

int crosscheck_command(const CrosscheckOptions& options, const std::atomic<bool>* stop) try {
    if (const std::string fault = options.sheet.empty() ? "" : format_fault(options.sheet, 0); !fault.empty())
        throw UsageError(fault);
    for (const std::string& scene : options.scenes) {
        if (options.sheet.empty()) break;
        const std::string sheet = sheet_path(options, scene);
        for (const std::string& other : options.scenes) {
            refuse_overwriting("--sheet", sheet, "a scene", other);
            if (&other < &scene)
                refuse_overwriting("--sheet", sheet, "that of another scene", sheet_path(options, other));
        }
    }
    // Differences are in steps of 1/65535; times are for tracing alone.
    std::printf(
        "| %-36s | %7s | %9s | %10s | %8s | %6s | %8s | %9s |\n|%s|\n", "scene", "pixels", "worst off", "beyond off",
        "on edges", "unsure", "strahl s", "povray s",
        "--------------------------------------|--------:|----------:|-----------:|---------:|-------:|---------:|"
        "----------:");
    bool agree = true;
    for (const std::string& scene : options.scenes) agree &= check(options, scene, stop);
    return agree ? 0 : 1;
} catch (const Stopped&) {
    std::cerr << "strahl: interrupted\n";
    return 130;
}

}  // namespace strahl
