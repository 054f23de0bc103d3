// strahl render: a scene becomes a picture file, or a flythrough a row of them.
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
    Size size;           // of the whole picture, also if a crop of it is made
    std::optional<Lattice> crop;
    std::optional<int> depth;            // 1 to 256; if not given the scene's max_trace_level, or what `error` needs
    std::optional<Precision> precision;  // if not given, double, or what `error` needs
    std::optional<double> error;         // that the file's values may have; half a step of an 8-bit file if not given
    Simd simd = Simd::automatic;
    int threads = 0;             // 0 takes all
    std::optional<double> time;  // seconds into the flythrough
    std::optional<FrameRange> frames;
    double fps = 25;
    bool resume = false;  // leaves out frames whose file is there, and whole
    std::string stats;    // a JSON file, or empty
    bool quiet = false;
};

/// Returns the exit status: done or interrupted. Throws FileError, UsageError or OutputError.
int render_command(const RenderOptions& options);

}  // namespace strahl
