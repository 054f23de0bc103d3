// strahl render: parses, and renders frame by frame.
#include "main/command_render.h"

#include <filesystem>
#include <functional>
#include <iostream>
#include <string_view>
#include <utility>

#include "image/pixels.h"
#include "main/exit_status.h"
#include "main/renderer.h"
#include "text/file.h"
#include "text/parse.h"
#include "text/tracks_file.h"
#include "text/utf8.h"

namespace strahl {
namespace {

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

/// Those of the share, if there is one.
bool render_frames(const RenderOptions& options, const Lattice& part, Renderer& renderer, const std::string& ending) {
    const Share share = options.share.value_or(Share{});
    const bool stream = options.output == "-";
    if (stream) write_file("-", stream_head(ending, {part.columns, part.rows}, options.fps));
    int count = 0;
    return options.frames->each([&](int frame) {
        if (count++ % share.parts != share.part - 1) return true;
        const std::string path = stream ? "-" : numbered(options.output, frame);
        if (options.resume && !renderer.interrupted() && is_finished(path, part)) return true;
        const std::string last = std::to_string(options.frames->last());
        const std::string label = "frame " + std::to_string(frame) + " of " + last + " ";
        return renderer.render(shot_of(renderer.scene(), frame / options.fps), path, ending, label);
    });
}

/// A scene, and a hash of its text, its pictures and its tracks.
std::pair<Scene, std::string> read_scene(const std::string& path) {
    const std::hash<std::string_view> hash_of;
    std::size_t hash = 0;
    const auto read = [&](const std::string& file) {
        Pixels pixels = read_pixels(file);
        const std::size_t bytes = pixels.values.size() * sizeof(float);
        const std::string_view all(reinterpret_cast<const char*>(pixels.values.data()), bytes);
        hash = 31 * hash + hash_of(all) + unsigned(pixels.width);
        return pixels;
    };
    const std::string text = read_text(path);
    Scene scene = parse_scene(text, path == "-" ? "standard input" : path, {}, read);
    if (!scene.tracks.empty()) hash = 31 * hash + hash_of(write_tracks(scene.tracks));
    return {std::move(scene), std::to_string(31 * hash + hash_of(text))};
}

}  // namespace

int render_command(const RenderOptions& options) {
    const std::string ending = check(options);
    const Lattice part = options.crop.value_or(Lattice{0, 0, options.size.width, options.size.height});
    check_size(part, ending, options.output == "-");
    require_writable(options.frames && options.output != "-" ? numbered(options.output, options.frames->first())
                                                              : options.output);
    if (!options.stats.empty()) require_writable(options.stats);
    require_different_files(options);

    Stats stats;
    stats.sampling = options.sampling;
    if (options.error) stats.sampling.error = *options.error;
    stats.size = options.size;
    stats.crop = options.crop;
    Stopwatch watch;
    auto [scene, hash] = read_scene(options.scene);
    stats.parse_seconds = watch.lap();
    if (options.time || options.frames)
        flight_for(options.time ? "--time" : "--frames", scene, options.scene);

    const FileFormat format{bits_of(ending_of(ending), options.bits), scene.settings.linear, options.compression};
    const Shot first =
        shot_of(scene, options.frames ? std::optional(options.frames->first() / options.fps) : options.time);
    Renderer renderer(options, std::move(scene), std::move(hash), first, part, format, stats);
    stats.finished = options.frames ? render_frames(options, part, renderer, ending)
                                    : renderer.render(first, options.output, ending, "", options.share);
    if (!options.stats.empty()) write_file(options.stats, to_json(stats));
    return stats.finished ? exit_status::done : exit_status::interrupted;
}

}  // namespace strahl
