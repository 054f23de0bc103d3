// Finds edges of a picture, where rounding may decide what is seen.
#pragma once
#include <atomic>

#include "trace/tracer.h"

namespace strahl {

/// Returns whether the picture jumps within `radius` pixels of this pixel's sampling point: to another body, another
/// shadow, another history of bounces. Eight lines from there are searched, and where the picture, clamped to [0, 1],
/// changes by more than `step`, they are halved until the change is gone or its place is known, 250 times at most.
/// Light that varies fast is no edge. Once `stop` is true it returns at once, and the result means nothing.
bool on_edge(Tracer& tracer, const View& view, ThreadPool& pool, int x, int y, double radius, double step,
             const std::atomic<bool>* stop = nullptr);

}  // namespace strahl
