// Running POV-Ray.
#pragma once
#include <atomic>
#include <string>

#include "image/picture.h"
#include "povref/pov_scene.h"

namespace strahl {

struct Stopped {};

struct PovRun {
    Picture picture;       // the computed values, clamped, in 16 bits
    double seconds = 0;    // its own "Trace Time"
    std::string warnings;  // what it had to say, but for the keyword `refraction`
};

/// Renders the one camera of `request`; paths in it are ignored. `threads` 0 takes all. Throws std::runtime_error,
/// with advice, if povray is not installed, and with its own words if it fails. When `stop` becomes true povray is
/// ended, its files go, and Stopped is thrown.
PovRun run_povray(const Scene& scene, PovRequest request, int threads, const std::atomic<bool>* stop = nullptr);

}  // namespace strahl
