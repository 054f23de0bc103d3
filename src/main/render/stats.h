// Times, rays and errors of a rendering, as a JSON file.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "main/render/values.h"
#include "trace/measure/picture_accuracy.h"
#include "trace/tracer.h"

namespace strahl {

/// The number of pixels of a picture that are proved.
struct ProofCounts {
    int bits = 8;                                             // of each value in the file
    std::int64_t proved = 0, in_extended = 0, undecided = 0;  // pixels; `in_extended` are among `proved`
    double median = 0;                                        // of the bounds on the errors of pixels
};

/// Seconds are wall time. For several frames, times and rays are sums; skipped frames do not count.
struct Stats {
    double parse_seconds = 0;  // reading and parsing the scene
    double build_seconds = 0;  // building worlds
    double trace_seconds = 0;  // tracing alone
    double write_seconds = 0;  // encoding and writing, and waiting for the picture library if it was not loaded yet
    Counts rays;
    PictureSize size;
    std::optional<Lattice> crop;
    int frames = 0, threads = 0, lanes = 0;
    double error = 0;  // allowed
    Sampling sampling;
    Sampled sampled;    // without a grid
    Accuracy accuracy;  // precision, depth and pruning chosen for it
    Simd simd = Simd::automatic;
    std::optional<ProofCounts> proved;
    bool finished = false;
};

std::string to_json(const Stats& stats);

}  // namespace strahl
