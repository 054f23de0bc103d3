// The least work for a picture that may be off by so much.
#pragma once
#include <optional>

#include "trace/tracer.h"

namespace strahl {

/// How to trace, and what that leaves out of the exact picture: of unlimited depth, in exact arithmetic, off the edges
/// (see edge.h). Values are per channel.
struct Accuracy {
    Precision precision = Precision::twice;
    int depth = 20;
    double dropped = 0;                // guaranteed: by rays that are too weak; the View's `error`
    double truncated = 0;              // guaranteed: by generations past `depth`, if there are rays in the last of them
                                       // (see Counts); infinite where no bound is known
    std::optional<double> rounding{};  // measured on a sample of the pixels; none if nothing depended on it
};

/// Everything, or with `error` only what is needed: dropped rays add up to half of it at most, and rounding is measured
/// by tracing about a thousand pixels in float and in double; float is chosen if that stays below a sixteenth of the
/// error, and double's is taken for float's scaled by the ratio of their last bits. The depth is the scene's, or less
/// if fewer generations are enough; if they are not, `truncated` says so: among bodies that lose no light no depth is
/// enough, and rays multiply without end. A `depth` or `precision` that is given stays.
Accuracy choose_accuracy(const Scene& scene, const View& view, double error, std::optional<Precision> precision,
                         std::optional<int> depth, ThreadPool& pool, Simd simd = Simd::automatic);

}  // namespace strahl
