// Traces pixels again that proofs left undecided.
#pragma once
#include <functional>
#include <span>

#include "trace/tracer.h"

namespace strahl {

/// Traces pixels again with bounds. `decides`, called from any thread, gets them one by one in place of the job's sink
/// and tells whether that decides it. A sample of the pixels comes first: if it decides hardly any, the others are
/// left, because what proofs do not know is unknown in every precision.
Counts prove_again(Tracer& tracer, Job job, std::span<const Pixel> pixels,
                   const std::function<bool(const Tile&)>& decides);

}  // namespace strahl
