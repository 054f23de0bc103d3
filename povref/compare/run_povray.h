// Runs POV-Ray.
#pragma once
#include <atomic>
#include <string>

#include "image/picture.h"
#include "povref/convert/pov_scene.h"

namespace strahl {

/// Thrown when `stop` became true.
struct Stopped {};

struct PovRun {
    Picture picture;       // values clamped, in 16 bits
    double seconds = 0;    // its "Trace Time"
    std::string warnings;  // its warnings, except about the keyword `refraction`
};

/// Renders the one camera of `request`, whose paths are ignored. `threads` 0 means all processors. Throws
/// std::runtime_error with advice if povray is not installed, or with its messages if it fails. When `stop` becomes
/// true it ends povray, removes its files, and throws Stopped.
PovRun run_povray(const Scene& scene, PovRequest request, int threads, const std::atomic<bool>* stop = nullptr);

}  // namespace strahl
