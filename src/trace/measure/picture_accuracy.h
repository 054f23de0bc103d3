// The least work for a picture that may be off by so much.
#pragma once
#include <optional>

#include "trace/tracer.h"

namespace strahl {

/// How to trace, and what that leaves out of the exact picture, off the edges (see edge_pixels.h). Values are per channel.
/// Generations past `depth` are left out too; how much light they could have brought is known when the picture is
/// traced (Counts::past).
struct Accuracy {
    Precision precision = Precision::float64;
    int depth = 20;
    double dropped = 0;                // most that weak rays add up to which are not traced; the View's `error`
    std::optional<double> rounding{};  // measured on a sample of the pixels; none if nothing depended on it
};

/// Everything, or with `error` only what is needed: dropped rays add up to half of it at most, and rounding is measured
/// by tracing about a thousand pixels in float and in double; float is chosen if that stays below a sixteenth of the
/// error, and double's is taken for float's scaled by the ratio of their last bits. The depth is the scene's, since
/// among bodies that lose no light no depth is enough, and rays multiply without end. A `depth` or `precision` that is
/// given stays.
Accuracy choose_accuracy(const Scene& scene, const View& view, double error, std::optional<Precision> precision,
                         std::optional<int> depth, ThreadPool& pool, Simd simd = Simd::automatic);

}  // namespace strahl
