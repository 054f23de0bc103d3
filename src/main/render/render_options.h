// The options of `render`, and checks of them.
#pragma once
#include <optional>
#include <string>

#include "image/film.h"
#include "image/frame_rate.h"
#include "image/picture.h"
#include "image/transfer.h"
#include "main/render/values.h"
#include "pov/open_scene.h"
#include "scene/layers.h"
#include "trace/tracer.h"

namespace strahl {

struct RenderOptions {
    std::string scene;       // a file, or "-" for standard input
    OpeningOptions opening;  // its size is that of the whole picture, even if only a crop of it is rendered
    std::string output;      // a file, "-" for standard output, or a film
    std::string format;      // "bmp", "png", "exr", "ppm" or "y4m", for standard output only
    int bits = 0;            // per channel; 0 is the format's default
    Compression compression = Compression::fast;
    Exposure exposure;            // of 8-bit files and films
    Layers layers;                // without the numbers that stand for names
    bool alpha_of_scene = false;  // the background is as opaque as an .ini file's scene says
    std::optional<Lattice> crop;
    bool fit = false;                    // widens the view of a camera with an aspectratio to that of the picture
    std::optional<int> depth;            // 1 to 256; by default the scene's max_trace_level
    std::optional<Precision> precision;  // by default double, or what `error` needs
    std::optional<double> error;         // largest error of the file's values; see --error
    Sampling sampling;                   // its error is `error`, if that is given
    Simd simd = Simd::automatic;
    int threads = 0;             // 0: all processors
    std::optional<double> time;  // seconds into the flythrough
    std::optional<FrameList> frames;
    FrameRate rate;
    std::optional<Share> share;  // of the frames, or of the bands of one picture
    bool resume = false;         // skips frames whose files are complete; continues an interrupted picture
    double checkpoint = 10;      // seconds between checkpoints
    std::string prove;           // a map of what is proved, .bmp or .png, or empty
    std::string stats;           // a JSON file, or empty
    bool quiet = false;

    /// Returns whether each frame has a file of its own.
    bool numbered() const { return frames && output != "-" && !is_film(output); }
};

/// Checks the options that do not depend on the scene. Returns the ending that chooses the format. This and the
/// following functions throw UsageError.
std::string check(const RenderOptions& options);

/// Refuses pictures that the format or the memory of this machine cannot hold, of scenes with few lights.
void check_size(const Lattice& part, const std::string& ending, const Layers& layers, bool to_pipe);

/// Refuses options by which one output would overwrite another, or the scene.
void require_different_files(const RenderOptions& options);

/// Throws OutputError if the file cannot be written, before hours of tracing rather than after them.
void require_writable(const std::string& path);

}  // namespace strahl
