// Checks the options of `render` before anything is traced.
#include "main/render/render_options.h"

#include <algorithm>
#include <filesystem>

#include "files/os/file.h"
#include "files/os/memory.h"
#include "files/output_file.h"
#include "image/encoder.h"
#include "image/picture.h"

namespace strahl {
namespace {

/// Returns whether one of the pictures would overwrite `path`.
bool is_picture(const RenderOptions& options, const std::string& path) {
    if (!options.numbered()) return same_file(options.output, path);
    const auto digit = [&](std::size_t i) { return path[i] >= '0' && path[i] <= '9'; };
    // Only the numbers in the name can be frames that have this name.
    for (std::size_t start = 0; start < path.size(); ++start) {
        std::int64_t frame = 0;
        for (std::size_t i = start; i < path.size() && digit(i) && frame < 1'000'000'000; ++i) {
            frame = 10 * frame + (path[i] - '0');
            if (frame < 1'000'000'000 && options.frames->has(static_cast<int>(frame)) &&
                same_file(numbered(options.output, static_cast<int>(frame)), path))
                return true;
        }
    }
    return false;
}

void check_film(const RenderOptions& options) {
    if (options.resume || options.share)
        throw UsageError("--resume and --part need a file for each frame; ffmpeg makes a film of them later: -o '" +
                         std::filesystem::path(options.output).replace_extension().string() +
                         "-%04d.png' --frames LIST");
    if (options.time) throw UsageError("a film shows many moments, and --time is one");
    if (options.bits != 0 && options.bits != 8) throw UsageError("a film has 8 bits per channel");
    const Lattice part = options.crop.value_or(Lattice{0, 0, options.opening.size.width, options.opening.size.height});
    if (part.columns % 2 || part.rows % 2)
        throw UsageError("width and height of a film must be even, and not " + size_text(part.columns, part.rows) +
                         "; choose another --size or --crop");
}

/// Refuses formats that cannot hold the layers.
void check_layers(const RenderOptions& options, const std::string& ending) {
    const Layers& layers = options.layers;
    if (!layers.any()) return;
    if (!options.prove.empty()) throw UsageError("--prove proves light alone; leave --alpha and --layers out");
    if (is_film(options.output))
        throw UsageError("films hold no alpha and no layers; numbered pictures do: -o '" +
                         std::filesystem::path(options.output).replace_extension().string() +
                         "-%04d.exr' --frames LIST, with alpha alone also .png");
    if ((layers.geometry() || layers.light) && ending != ".exr")
        throw UsageError("--layers is for .exr files, and this is a " + ending + "; alpha alone is in .png as well");
    if (ending != ".exr" && ending != ".png") throw UsageError("a " + ending + " holds no alpha; choose .png or .exr");
}

void check_proof(const RenderOptions& options) {
    if (!proves())
        throw UsageError("this program was built without what --prove needs; build it with -DSTRAHL_LEVELS=host");
    if (options.precision && *options.precision != Precision::float64)
        throw UsageError(
            "--prove traces in double, and undecided pixels again in extended precision; leave --precision out");
    const Sampling& asked = options.sampling;
    if (asked.grid > 1 || asked.centre)
        throw UsageError("--prove traces one ray in each pixel; leave --samples out, or give it 1");
    if (options.exposure) throw UsageError("--prove proves light as it is, without --exposure");
    if (options.frames || options.share || options.resume || is_film(options.output))
        throw UsageError(
            "--prove proves one picture, without --frames, --part and --resume; --time chooses its moment");
    const std::string ending = ending_of(options.prove);
    if (ending != ".png" && ending != ".bmp")
        throw UsageError("the map of --prove is a .png or .bmp file, and not '" + options.prove + "'");
}

}  // namespace

std::string check(const RenderOptions& options) {
    if (options.output.empty()) throw UsageError("no output file. Add -o FILE, which ends in .bmp, .png or .exr");
    const bool to_stdout = options.output == "-";
    if (to_stdout && options.format.empty())
        throw UsageError(
            "-o - writes the picture to standard output and needs its format: --format bmp, png, exr, ppm or y4m");
    if (!to_stdout && !options.format.empty())
        throw UsageError("--format is for standard output (-o -); otherwise the file's ending chooses its format");
    if (to_stdout && options.frames && options.format != "ppm" && options.format != "y4m")
        throw UsageError(
            "--frames writes numbered files, for which -o needs a name such as film-%04d.png, or a stream to standard "
            "output: -o - --format ppm or y4m");
    if (to_stdout && options.stats == "-")
        throw UsageError("picture and statistics cannot both go to standard output; write one of them to a file");
    if (options.frames && options.time) throw UsageError("--frames and --time exclude each other");
    if (to_stdout && (options.resume || options.share))
        throw UsageError("--resume and --part need a file; standard output keeps nothing");
    const bool to_film = is_film(options.output);
    const std::string ending = to_film     ? ".y4m"
                               : to_stdout ? "." + options.format
                                           : std::filesystem::path(options.output).extension().string();
    if (to_film)
        check_film(options);
    else if (!to_stdout && (ending_of(ending) == ".ppm" || ending_of(ending) == ".y4m"))
        throw UsageError("a " + ending + " can only go to standard output: -o - --format " + ending.substr(1));
    else if (const std::string fault = format_fault(to_stdout ? ending : options.output, options.bits); !fault.empty())
        throw UsageError(format_fault(ending, 0).empty() ? fault : fault + ", or films one of .mp4, .mkv and .webm");
    if (options.exposure && bits_of(ending_of(ending), options.bits) != 8)
        throw UsageError(
            "--exposure is for pictures of 8 bits per channel; .exr files and those of 16 bits hold light "
            "as it is");
    if (!options.prove.empty()) check_proof(options);
    check_layers(options, ending_of(ending));
    if (!supported(options.simd)) {
        const char* const lacks =
            built(options.simd) ? "this processor does not support " : "this program was built without ";
        throw UsageError(lacks + std::string(name(options.simd)) + "; --simd auto uses " + name(best_simd()));
    }
    if (options.crop) require_within(*options.crop, options.opening.size);
    return ending;
}

void check_size(const Lattice& part, const std::string& ending, const Layers& layers, bool to_pipe) {
    const std::string size = size_text(part.columns, part.rows);
    const double pixels = double(part.columns) * part.rows;
    if (ending == ".bmp" && 3 * pixels + 4. * part.rows > 2e9)
        throw UsageError(size + " pixels are too many for a .bmp file (2 GB); choose .png or .exr");
    // Memory holds some bands, each as traced, filtered and packed, and the whole file if it goes to a pipe.
    const double channels = static_cast<double>(channels_of(layers, 1).size());
    const double row = (ending == ".exr" ? 4 : 2) * channels * part.columns,
                 band = row * std::min(part.rows, band_rows);
    const double needed = 12 * band + (to_pipe ? row * part.rows : 0), available = os::available_memory();
    if (needed > available)
        throw UsageError("a picture of " + size + " pixels needs " + bytes_in_words(needed) + " of memory, and " +
                         bytes_in_words(available) + " are free; choose a smaller --size, " +
                         (to_pipe ? "or write it to a file" : "or render it in parts with --crop"));
}

void require_writable(const std::string& path) {
    namespace fs = std::filesystem;
    if (path == "-") return;
    std::error_code error;
    const fs::path folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : fs::path(".");
    const auto fail = [&](const std::string& why) { throw OutputError("cannot write '" + path + "': " + why); };
    if (fs::is_directory(path, error)) fail("it is a folder; name a file in it");
    if (!fs::exists(folder, error)) fail("its folder does not exist; make that first");
    if (!fs::is_directory(folder, error)) fail("'" + folder.string() + "' is not a folder");
    if (os::writable(folder)) fail("no permission to write to its folder");
}

void require_different_files(const RenderOptions& options) {
    if (is_picture(options, options.scene))
        throw UsageError("-o would overwrite the scene '" + options.scene + "'; give it another name");
    refuse_overwriting_scene("--stats", options.stats, options.scene, options.opening);
    refuse_overwriting_scene("--prove", options.prove, options.scene, options.opening);
    if (is_picture(options, options.prove))
        throw UsageError("--prove '" + options.prove + "' would overwrite the picture; give it another name");
    if (is_picture(options, options.stats))
        throw UsageError("--stats '" + options.stats + "' would overwrite the picture; give it another name");
}

}  // namespace strahl
