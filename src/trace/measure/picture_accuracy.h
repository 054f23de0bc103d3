// Chooses how to trace with the least work a picture that may be off by a given error.
#pragma once
#include <optional>

#include "trace/tracer.h"

namespace strahl {

/// Settings for tracing, and the errors off edges (see edge_pixels.h) that they lead to, per channel. Generations past
/// `depth` are left out too; how much light they could have brought is known when the picture is traced (Counts::past).
struct Accuracy {
    Precision precision = Precision::float64;
    int depth = 20;
    double dropped = 0;                // most that weak rays add up to which are not traced; the View's `error`
    std::optional<double> rounding{};  // measured on a sample of the pixels; none if nothing depended on it or if
                                       // rounding decides what is seen even in double
};

/// Chooses settings for an error; if it is 0 nothing is left out. Dropped rays add up to half of the error at most.
/// Rounding is measured by tracing about a thousand pixels in float and in double: float is chosen if its rounding
/// stays below a sixteenth of the error, and that of double is taken for float's, scaled by the ratio of their last
/// bits. If rounding decides what is seen in many pixels, as it does if the eye is exactly on a surface, double is
/// compared with extended precision in the same way. The depth is the scene's, because among bodies that lose no light
/// no depth is enough, and rays multiply without end. A `depth` or `precision` that is given stays.
Accuracy choose_accuracy(const Scene& scene, const View& view, double error, std::optional<Precision> precision,
                         std::optional<int> depth, ThreadPool& pool, Simd simd = Simd::automatic);

}  // namespace strahl
