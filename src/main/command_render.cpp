// strahl render: parses, traces and writes, frame by frame; keeps the finished part when interrupted.
#include "main/command_render.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <future>
#include <iostream>
#include <utility>

#include "image/memory.h"
#include "image/picture.h"
#include "image/pixels.h"
#include "image/transfer.h"
#include "main/exit_status.h"
#include "main/interrupt.h"
#include "main/progress.h"
#include "main/stats.h"
#include "scene/motion.h"
#include "text/file.h"
#include "text/parse.h"
#include "text/utf8.h"
#include "trace/accuracy.h"
#include "trace/cell_picture.h"
#include "trace/thread_pool.h"

namespace strahl {
namespace {

class Stopwatch {
  public:
    /// Seconds since the last call.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last, now)).count();
    }

  private:
    std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();
};

/// Fails before tracing rather than after hours of it.
void require_writable(const std::string& path) {
    namespace fs = std::filesystem;
    if (path == "-") return;
    std::error_code error;
    const fs::path folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : fs::path(".");
    const auto fail = [&](const std::string& why) { throw OutputError("cannot write '" + path + "': " + why); };
    if (fs::is_directory(path, error)) fail("it is a folder; name a file in it");
    if (!fs::exists(folder, error)) fail("its folder does not exist; make that first");
    if (!fs::is_directory(folder, error)) fail("'" + folder.string() + "' is not a folder");
    if (access(folder.c_str(), W_OK) != 0) fail("no permission to write to its folder");
}

/// Would `path` be overwritten by one of the pictures?
bool is_picture(const RenderOptions& options, const std::string& path) {
    if (!options.frames) return same_file(options.output, path);
    const auto [first, last] = *options.frames;
    const auto digit = [&](std::size_t i) { return path[i] >= '0' && path[i] <= '9'; };
    // Only a number that is in the name can be its frame's.
    for (std::size_t start = 0; start < path.size(); ++start) {
        std::int64_t frame = 0;
        for (std::size_t i = start; i < path.size() && digit(i) && frame <= last; ++i) {
            frame = 10 * frame + (path[i] - '0');
            if (frame < first || frame > last) continue;
            if (same_file(numbered(options.output, static_cast<int>(frame)), path)) return true;
        }
    }
    return false;
}

/// Nothing that was asked for, and not the scene, may be overwritten by something else.
void require_different_files(const RenderOptions& options) {
    if (is_picture(options, options.scene))
        throw UsageError("-o would overwrite the scene '" + options.scene + "'; give it another name");
    refuse_overwriting("--stats", options.stats, "the scene", options.scene);
    if (is_picture(options, options.stats))
        throw UsageError("--stats '" + options.stats + "' would overwrite the picture; give it another name");
}

/// Checks the options that do not depend on the scene. Returns the ending that chooses the format.
std::string check(const RenderOptions& options) {
    if (options.output.empty()) throw UsageError("no output file. Add -o FILE, which ends in .bmp, .png or .exr");
    const bool to_stdout = options.output == "-";
    if (to_stdout && options.format.empty())
        throw UsageError("-o - writes the picture to standard output and needs its format: --format bmp, png or exr");
    if (!to_stdout && !options.format.empty())
        throw UsageError("--format is for standard output (-o -); otherwise the file's ending chooses its format");
    if (to_stdout && options.frames)
        throw UsageError("--frames writes numbered files; -o needs a file name such as film-%04d.png");
    if (to_stdout && options.stats == "-")
        throw UsageError("picture and statistics can't both go to standard output; write one of them to a file");
    if (options.frames && options.time) throw UsageError("--frames and --time exclude each other");
    if (options.resume && !options.frames) throw UsageError("--resume goes with --frames");
    const std::string ending =
        to_stdout ? "." + options.format : std::filesystem::path(options.output).extension().string();
    if (const std::string fault = format_fault(to_stdout ? ending : options.output, options.bits); !fault.empty())
        throw UsageError(fault);
    if (!supported(options.simd))
        throw UsageError("this processor does not support " + std::string(name(options.simd)) + "; --simd auto uses " +
                         name(best_simd()));
    if (options.crop) require_within(*options.crop, options.size);
    return ending;
}

/// Refuses pictures that the format or the memory of this machine can't hold.
void check_size(const Lattice& part, const std::string& ending) {
    const std::string size = std::to_string(part.columns) + "x" + std::to_string(part.rows);
    const double pixels = double(part.columns) * part.rows;
    if (ending == ".bmp" && 3 * pixels + 4. * part.rows > 2e9)
        throw UsageError(size + " pixels are too many for a .bmp file (2 GB); choose .png or .exr");
    // The values in double, the same in float, and the encoded file.
    const double needed = 48 * pixels, available = available_memory();
    if (needed > available)
        throw UsageError("a picture of " + size + " pixels needs " + bytes_in_words(needed) + " of memory, and " +
                         bytes_in_words(available) +
                         " are free; choose a smaller --size, or render it in parts with --crop");
}

/// A moment of the scene.
struct Shot {
    Camera camera;
    double time;
};
Shot shot_of(const Scene& scene, std::optional<double> time) { return {camera_at(scene, time), time.value_or(0)}; }

class Renderer {
  public:
    Renderer(const RenderOptions& o, Scene scene, const Shot& first, const Lattice& lattice, FileFormat file_format,
             Stats& sums)
        : options(o),
          format(file_format),
          part(lattice),
          stats(sums),
          pool(o.threads),
          loading(preload_picture_library(Interrupt::ask)),
          accuracy(choose(scene, first)),
          tracer(std::move(scene), accuracy.precision, o.simd) {
        stats.accuracy = accuracy;
        stats.threads = pool.size();
        stats.simd = tracer.simd();
        stats.lanes = lanes(tracer.precision(), tracer.simd());
        stats.build_seconds = watch.lap();
    }

    const Scene& scene() const { return tracer.scene(); }
    bool interrupted() const { return *interrupt.flag(); }

    /// Traces and writes one picture. If interrupted, writes the finished part to a file of its own and returns
    /// false.
    bool render(const Shot& shot, const std::string& path, const std::string& ending, const std::string& label) {
        Picture picture{part.columns, part.rows, 3, std::vector<double>(3 * pixels())};
        watch.lap();
        tracer.prepare(view(shot, accuracy.depth, accuracy.dropped), pool);
        stats.build_seconds += watch.lap();
        const std::uint64_t done = trace(shot, picture, label);
        stats.trace_seconds += watch.lap();
        const bool whole = done == pixels();
        using namespace std::chrono_literals;
        // Without the library nothing of it could be written. It was asked once before: then all is well.
        if (!whole && loading.valid() && loading.wait_for(0s) == std::future_status::ready) loading.get();
        if (done == 0) {
            std::cerr << "strahl: interrupted before anything of '" << printable(path) << "' was finished\n";
            return false;
        }
        const std::string file = whole || path == "-" ? path : before_ending(path, ".part");
        write_picture(picture, file, format, ending);
        stats.write_seconds += watch.lap();
        stats.frames += whole;
        if (!whole)
            std::cerr << "strahl: interrupted; the finished part (" << 100 * done / pixels() << " %) is in "
                      << (file == "-" ? "standard output" : std::string("'").append(printable(file)).append("'"))
                      << '\n';
        return whole;
    }

  private:
    /// Without --error only light that the file can't show is pruned, and depth and precision are the defaults.
    Accuracy choose(const Scene& scene, const Shot& shot) {
        const double unseen = half_step(format);
        // The curve that encodes linear light enlarges errors where it is steep.
        const double steepest = format.linear && format.bits != 32 ? steepest_srgb : 1;
        if (!options.error) {
            stats.error = unseen * steepest;
            return {.precision = options.precision.value_or(Precision::float64),
                    .depth = options.depth.value_or(scene.settings.max_trace_level),
                    .dropped = unseen};
        }
        stats.error = *options.error;
        return choose_accuracy(scene, view(shot, 1, 0), *options.error / steepest, options.precision, options.depth,
                               pool, options.simd);
    }
    View view(const Shot& shot, int depth, double dropped) const {
        return {.camera = shot.camera,
                .width = options.size.width,
                .height = options.size.height,
                .depth = depth,
                .error = dropped,
                .time = shot.time};
    }
    std::uint64_t pixels() const { return std::uint64_t(part.columns) * part.rows; }

    /// Returns the number of finished pixels; the others stay black.
    std::uint64_t trace(const Shot& shot, Picture& picture, const std::string& label) {
        Progress progress(options.quiet, label);
        std::atomic<std::uint64_t> done = 0;
        const auto keep = [&](const Tile& tile) {
            place(tile, part, picture.values);
            const std::uint64_t size = std::uint64_t(tile.lattice.columns) * tile.lattice.rows;
            progress.advance(done.fetch_add(size) + size, pixels());
        };
        const View seen = view(shot, accuracy.depth, accuracy.dropped);
        if (stats.sampling.grid > 0) {
            stats.rays += tracer.trace(seen, stats.sampling, part, pool, keep, interrupt.flag());
        } else {
            CellPicture cells(tracer.scene(), seen, part, stats.sampling.error);
            stats.rays += tracer.trace(seen, cells, 0, pool, keep, interrupt.flag());
            stats.sampled += cells.sampled();
        }
        return done;
    }

    const RenderOptions& options;
    const FileFormat format;
    const Lattice part;
    Stats& stats;
    Stopwatch watch;
    ThreadPool pool;
    // After the pool: starting a thread waits until the library has loaded.
    std::future<void> loading;
    const Accuracy accuracy;
    Tracer tracer;
    Interrupt interrupt;
};

/// Is there a file that holds the whole picture? One that was cut off is told and made again; one of another film is
/// not ours to overwrite.
bool is_finished(const std::string& path, const Lattice& part) {
    if (!std::filesystem::exists(path)) return false;
    try {
        const Picture picture = read_picture(path, 3 * std::uint64_t(part.columns) * part.rows);
        if (picture.width == part.columns && picture.height == part.rows) return true;
        const auto size = [](int width, int height) { return std::to_string(width) + "x" + std::to_string(height); };
        throw UsageError("'" + path + "' is a picture of " + size(picture.width, picture.height) + " pixels and not " +
                         size(part.columns, part.rows) +
                         "; give --resume the size that the film was begun with, or another -o");
    } catch (const FileError& error) {
        std::cerr << "strahl: " << printable(error.what()) << "; this frame is made again\n";
        return false;
    }
}

bool render_frames(const RenderOptions& options, const Lattice& part, Renderer& renderer, const std::string& ending) {
    const auto [first, last] = *options.frames;
    for (int frame = first; frame <= last; ++frame) {
        const std::string path = numbered(options.output, frame);
        if (options.resume && !renderer.interrupted() && is_finished(path, part)) continue;
        const std::string label = "frame " + std::to_string(frame) + " of " + std::to_string(last) + " ";
        if (!renderer.render(shot_of(renderer.scene(), frame / options.fps), path, ending, label)) {
            std::cerr << "strahl: the same command with --resume continues from there\n";
            return false;
        }
    }
    return true;
}

}  // namespace

int render_command(const RenderOptions& options) {
    const std::string ending = check(options);
    const Lattice part = options.crop.value_or(Lattice{0, 0, options.size.width, options.size.height});
    check_size(part, ending);
    require_writable(options.frames ? numbered(options.output, options.frames->first) : options.output);
    if (!options.stats.empty()) require_writable(options.stats);
    require_different_files(options);

    Stats stats;
    stats.sampling = options.sampling;
    if (options.error) stats.sampling.error = *options.error;
    stats.size = options.size;
    stats.crop = options.crop;
    Stopwatch watch;
    Scene scene = parse_scene(read_text(options.scene), options.scene == "-" ? "standard input" : options.scene, {},
                              read_pixels);
    stats.parse_seconds = watch.lap();
    if (options.time || options.frames)
        flight_for(options.time ? "--time" : "--frames", scene, options.scene);

    const FileFormat format{options.bits ? options.bits : ending == ".exr" ? 32 : 8, scene.settings.linear};
    const Shot first =
        shot_of(scene, options.frames ? std::optional(options.frames->first / options.fps) : options.time);
    Renderer renderer(options, std::move(scene), first, part, format, stats);
    stats.finished = options.frames ? render_frames(options, part, renderer, ending)
                                    : renderer.render(first, options.output, ending, "");
    if (!options.stats.empty()) write_file(options.stats, to_json(stats));
    return stats.finished ? exit_status::done : exit_status::interrupted;
}

}  // namespace strahl
