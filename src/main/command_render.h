// strahl render: a scene becomes a picture file, a flythrough a sequence of them.
#pragma once
#include <optional>
#include <string>

#include "main/values.h"
#include "trace/tracer.h"

namespace strahl {

struct RenderOptions {
    std::string scene;   // a file, or "-" for standard input
    std::string output;  // a file, or "-" for standard output
    std::string format;  // "bmp", "png" or "exr", for standard output only
    int bits = 0;        // per channel; 0 is the format's default
    Size size;           // of the whole picture, even if only a crop of it is rendered
    std::optional<Lattice> crop;
    std::optional<int> depth;            // 1 to 256; by default the scene's max_trace_level, or what `error` needs
    std::optional<Precision> precision;  // by default double, or what `error` needs
    std::optional<double> error;         // largest error of the file's values; see --error
    Sampling sampling;                   // its error is `error`, if that is given
    Simd simd = Simd::automatic;
    int threads = 0;             // 0: all processors
    std::optional<double> time;  // seconds into the flythrough
    std::optional<FrameRange> frames;
    double fps = 25;
    bool resume = false;  // skips frames whose files exist, and whole
    std::string stats;    // a JSON file, or empty
    bool quiet = false;
};

/// Returns the exit status: done or interrupted. Throws FileError, UsageError or OutputError.
int render_command(const RenderOptions& options);

}  // namespace strahl
