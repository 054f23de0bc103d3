// Finds edges of a picture, where rounding may decide what is seen.
#pragma once
#include <atomic>
#include <span>
#include <vector>

#include "trace/tracer.h"

namespace strahl {

/// Returns for each of these pixels whether the picture jumps within `radius` pixels of its sampling point: to another
/// body, another shadow, another history of bounces. Eight lines from there are searched, and where the picture,
/// clamped to [0, 1], changes by more than `step`, they are halved until the change is gone or its place is known, 250
/// times at most. Light that varies fast is no edge. Once `stop` is true it returns at once, and the result means
/// nothing.
std::vector<bool> on_edges(Tracer& tracer, const View& view, ThreadPool& pool, std::span<const Pixel> pixels,
                           double radius, double step, const std::atomic<bool>* stop = nullptr);

/// Returns the same as on_edges for one pixel.
bool on_edge(Tracer& tracer, const View& view, ThreadPool& pool, Pixel pixel, double radius, double step,
             const std::atomic<bool>* stop = nullptr);

}  // namespace strahl
