// strahl render: parses, and renders frame by frame.
#include "main/commands/command_render.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string_view>
#include <utility>

#include "files/os/system.h"
#include "files/output_file.h"
#include "files/read_file.h"
#include "files/utf8.h"
#include "image/pixels.h"
#include "main/commands/scene_file.h"
#include "main/process/exit_status.h"
#include "main/render/checkpoint.h"
#include "main/render/layer_names.h"
#include "main/render/renderer.h"
#include "num/decimal.h"
#include "scene/moving_scene.h"
#include "text/reading/tracks_file.h"

namespace strahl {
namespace {

/// Returns whether a file holds the whole picture, and then removes its checkpoint, which stays if a run was killed
/// after writing the picture. A file that was cut off is reported, and made again. Throws UsageError for a picture of
/// another size, which belongs to another film.
bool is_finished(const std::string& path, const Lattice& part, bool alpha) {
    if (!std::filesystem::exists(path)) return false;
    try {
        const int channels = alpha ? 4 : 3;
        const Picture picture = read_picture(path, 4 * std::uint64_t(part.columns) * part.rows);
        if (picture.width == part.columns && picture.height == part.rows && picture.channels != channels)
            throw UsageError("'" + path + "' is a picture with" + (alpha ? "out" : "") +
                             " alpha; give --resume the options that the film was begun with, or another -o");
        if (picture.width == part.columns && picture.height == part.rows) {
            remove_checkpoint(path);
            return true;
        }
        throw UsageError("'" + path + "' is a picture of " + size_text(picture.width, picture.height) +
                         " pixels and not " + size_text(part.columns, part.rows) +
                         "; give --resume the size that the film was begun with, or another -o");
    } catch (const FileError& error) {
        std::cerr << "strahl: " << printable(error.what()) << "; this frame is made again\n";
        return false;
    }
}

/// Reads the scene as it is at a time, with its layers. Throws Interrupted once the flag is true.
using SceneAt = std::function<std::pair<Scene, NamedLayers>(double time, const std::atomic<bool>* stop)>;

/// Renders the frames, or those of the share, to a file each or to a stream. Returns whether all are finished.
bool render_frames(const RenderOptions& options, const Lattice& part, Renderer& renderer, const std::string& ending,
                   const SceneAt& scene_at, const Encoder::Append& stream = {}) {
    const Share share = options.share.value_or(Share{});
    if (stream) stream(stream_head(ending, {part.columns, part.rows}, options.rate));
    int count = 0, all = 0;
    for (const FrameRange& range : options.frames->ranges) all += (range.last - range.first) / range.step + 1;
    return options.frames->each([&](int frame) {
        if (count++ % share.parts != share.part - 1) return true;
        const Destination destination{stream ? options.output : numbered(options.output, frame), ending, stream};
        if (options.resume && !renderer.interrupted() && is_finished(destination.path, part, options.layers.alpha))
            return true;
        const std::string label = "frame " + std::to_string(count) + " of " + std::to_string(all) + " ";
        const double time = options.rate.moment(frame);
        if (scene_at && !renderer.interrupted()) try {
                auto [scene, layers] = scene_at(time, renderer.interrupt_flag());
                renderer.replace(std::move(scene), std::move(layers));
            } catch (const Interrupted&) {  // the flag is true, which the renderer tells
            }
        return renderer.render(shot_of(renderer.scene(), time), destination, label);
    });
}

/// Returns the scene's sound for a film whose frames follow each other; for others a message says that there is none.
std::optional<FilmSound> sound_of(const RenderOptions& options, const Scene& scene) {
    if (scene.music.sound.empty()) return std::nullopt;
    const FrameList& frames = *options.frames;
    if (frames.ranges.size() == 1 && (frames.ranges[0].step == 1 || frames.first() == frames.last()))
        return FilmSound{path_beside(options.scene, scene.music.sound), options.rate.moment(frames.first())};
    std::cerr << "strahl: frames that do not follow each other make a film without sound\n";
    return std::nullopt;
}

/// Renders frames one after the other, to standard output or a film. `stats` counts the finished ones. Returns whether
/// that is all of them.
bool render_stream(const RenderOptions& options, const Lattice& part, Renderer& renderer, const std::string& ending,
                   const std::string& ffmpeg, const Stats& stats, const SceneAt& scene_at) {
    OutputFile standard_output("-");
    std::optional<Film> film;
    if (is_film(options.output))
        film.emplace(ffmpeg, options.output, options.rate, sound_of(options, renderer.scene()));
    const bool whole = render_frames(options, part, renderer, ending, scene_at, [&](std::string_view bytes) {
        film ? film->append(bytes) : standard_output.append(bytes);
    });
    if (whole && film) film->finish();
    if (whole) return true;
    std::string said = "interrupted before the first frame was finished";
    if (stats.frames > 0) {
        int last = 0, count = 0;
        options.frames->each([&](int frame) { return last = frame, ++count < stats.frames; });
        said = "interrupted; " + (film ? "'" + printable(film->finish_part()) + "'" : "the stream") +
               " ends with frame " + std::to_string(last) + " of " + std::to_string(options.frames->last());
    }
    std::cerr << "strahl: " << said << '\n';
    return false;
}

/// Returns all frames of a flight.
FrameList frames_of(const Flythrough& flight, const FrameRate& rate) {
    const double count = rate.frames_in(flight.duration);
    if (count > 1e9) throw UsageError("the flight has more than a billion frames; choose some with --frames");
    return {{{0, static_cast<int>(count) - 1, 1}}};
}

/// A scene with a hash of its text, its pictures, its included files and its tracks.
struct HashedScene {
    OpenedScene opened;
    std::string hash;
};
HashedScene read_and_hash(const std::string& path, const OpeningOptions& opening) {
    const std::hash<std::string_view> hash_of;
    std::size_t hash = 0;
    const auto read = [&](const std::string& file) {
        FilePixels pixels = read_pixels(file);
        for (const std::vector<float>* const own : {&pixels.values, &pixels.opacity})
            hash = 31 * hash + hash_of({reinterpret_cast<const char*>(own->data()), own->size() * sizeof(float)});
        hash += unsigned(pixels.width);
        return pixels;
    };
    const std::string text = read_scene_text(path);
    OpenedScene opened = open_scene(text, path, opening, read);
    tell_notes(opened, false);
    const Scene& scene = opened.scene;
    for (std::size_t i = 1; i < opened.files.size(); ++i) hash = 31 * hash + hash_of(read_text(opened.files[i]));
    if (!scene.tracks.empty()) hash = 31 * hash + hash_of(write_tracks(scene.tracks));
    const std::string clock = opening.clock ? text_of(*opening.clock) : "";
    return {std::move(opened), std::to_string(31 * hash + hash_of(text + clock))};
}

/// Warns of a camera whose aspectratio is not that of the picture.
void check_aspect(const RenderOptions& options, const Scene& scene) {
    const double picture = double(options.opening.size.width) / options.opening.size.height;
    const double own = scene.camera.aspectratio.value_or(picture);
    if (options.fit || (picture < 1.01 * own && own < 1.01 * picture)) return;
    char said[200];
    std::snprintf(said, sizeof said,
                  "strahl: warning: the camera's aspectratio is %.4g and that of the picture %.4g, which %s what it "
                  "shows; with --fit it shows more instead\n",
                  own, picture, picture > own ? "widens" : "narrows");
    std::cerr << said;
}

/// Throws UsageError if two eyes cannot share the picture.
void check_eyes(const PictureSize& size, const Camera& camera) {
    const bool beside = camera.stereo == Stereo::side_by_side;
    if (camera.stereo == Stereo::none || (beside ? size.width : size.height) % 2 == 0) return;
    throw UsageError(std::string("the camera's two eyes need an even ") + (beside ? "width" : "height") +
                     " of the picture");
}

/// Warns of averages over pixels whose error was measured and is above the one aimed at.
void check_error(const Stats& stats) {
    const double aimed = std::max(stats.sampling.error, least_sampling_error), measured = stats.sampled.error();
    if (stats.sampling.grid > 0 || measured <= aimed) return;
    char said[200];
    std::snprintf(said, sizeof said,
                  "strahl: warning: the error of averages over pixels is about %.2g, above the %.2g aimed at; a "
                  "smaller --error brings it down\n",
                  measured, aimed);
    std::cerr << said;
}

/// Tells a person at a terminal what was written: "a.bmp: 640x480, 1.2 s".
void tell_written(const RenderOptions& options, const Lattice& part, const Stats& stats, double seconds) {
    if (options.quiet || options.output == "-" || !os::is_terminal(stderr)) return;
    const std::string frames = options.frames ? std::to_string(stats.frames) + " frames of " : "";
    std::fprintf(stderr, "%s: %s%dx%d, %.1f s\n", show(options.output).text.c_str(), frames.c_str(), part.columns,
                 part.rows, seconds);
}

}  // namespace

int render_command(const RenderOptions& asked) {
    const auto start = std::chrono::steady_clock::now();
    RenderOptions options = asked;
    const std::string ending = check(options);
    const std::string ffmpeg = is_film(options.output) ? find_ffmpeg("'" + options.output + "'") : "";
    const Lattice part = options.crop.value_or(Lattice{0, 0, options.opening.size.width, options.opening.size.height});
    check_size(part, ending, options.layers, options.output == "-" || !ffmpeg.empty());
    require_writable(options.numbered() ? numbered(options.output, options.frames->first()) : options.output);
    if (!options.stats.empty()) require_writable(options.stats);
    if (!options.prove.empty()) require_writable(options.prove), options.sampling = {.grid = 1};
    require_different_files(options);

    Stats stats;
    stats.sampling = options.sampling;
    if (options.error) stats.sampling.error = *options.error;
    stats.sampling.error /= gain_of(options.exposure);
    stats.size = options.opening.size;
    stats.crop = options.crop;
    Stopwatch watch;
    options.opening.time = options.time, options.opening.alpha = options.layers.alpha;
    auto [opened, hash] = read_and_hash(options.scene, options.opening);
    if (options.alpha_of_scene) options.layers.background = opened.background_opacity;
    NamedLayers layers = named(options.layers, opened);
    Scene scene = std::move(opened.scene);
    stats.parse_seconds = watch.lap();
    if (!options.prove.empty() && !in_perspective(scene.camera))
        throw UsageError(
            "--prove knows the rays of perspective cameras with one eye only, and this scene has another one");
    if (!options.prove.empty() && has_lens(scene.camera))
        throw UsageError("--prove knows the rays of pinholes only, and this scene's camera has an aperture");
    if (!options.prove.empty() && scene.camera.shutter > 0)
        std::cerr << "strahl: --prove proves the picture in the middle of the time that the camera's shutter is open\n";
    check_aspect(options, scene);
    check_eyes(options.opening.size, scene.camera);
    if (options.compression != Compression::fast && ending_of(ending) != ".png")
        std::cerr << "strahl: warning: --compression is for .png files; this picture is written without it\n";
    if (options.time || options.frames || !ffmpeg.empty()) {
        const char* const option = options.time ? "--time" : options.frames ? "--frames" : "a film";
        const Flythrough flight = flight_for(option, scene, options.scene);
        if (!options.frames && !options.time) options.frames = frames_of(flight, options.rate);
        if (opened.frames && !ffmpeg.empty() && !asked.frames && options.rate.per_second() == 25)
            options.frames = FrameList{{{opened.frames->first, opened.frames->second, 1}}};
    } else if (opened.frames && options.opening.ini && opened.frames->first < opened.frames->second) {
        const std::string range = std::to_string(opened.frames->first) + "-" + std::to_string(opened.frames->second);
        std::cerr << "strahl: the .ini file asks for more than this picture: --frames " << range
                  << " makes all frames\n";
    }

    const FileFormat format{bits_of(ending_of(ending), options.bits), scene.settings.assumed_gamma, options.compression,
                            options.exposure};
    const Shot first =
        shot_of(scene, options.frames ? std::optional(options.rate.moment(options.frames->first())) : options.time);
    if (!options.prove.empty() && !options.time) scene = at(scene, 0);  // proofs need a scene in which nothing moves
    Renderer renderer(options, std::move(scene), std::move(hash), first, part, format, std::move(layers), stats);
    // A scene that uses POV-Ray's clock is another one in each frame.
    SceneAt scene_at;
    if (opened.changes)
        scene_at = [&, text = read_scene_text(options.scene)](double time, const std::atomic<bool>* stop) {
            OpeningOptions opening = options.opening;
            opening.time = time, opening.stop = stop;
            OpenedScene own = open_scene(text, options.scene, opening, read_pixels);
            NamedLayers own_layers = named(options.layers, own);
            return std::pair(std::move(own.scene), std::move(own_layers));
        };
    stats.finished = options.numbered() ? render_frames(options, part, renderer, ending, scene_at)
                     : options.frames   ? render_stream(options, part, renderer, ending, ffmpeg, stats, scene_at)
                                        : renderer.render(first, {options.output, ending, {}}, "", options.share);
    if (!options.stats.empty()) write_file(options.stats, to_json(stats)), check_error(stats);
    if (stats.finished)
        tell_written(options, part, stats,
                     std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    return stats.finished ? exit_status::done : exit_status::interrupted;
}

}  // namespace strahl
