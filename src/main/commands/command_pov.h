// strahl pov: converts a scene for POV-Ray.
#pragma once
#include <optional>
#include <string>

#include "image/frame_rate.h"
#include "pov/open_scene.h"

namespace strahl {

struct PovOptions {
    std::string scene;  // a file, or "-" for standard input
    OpeningOptions opening{};
    std::string output;            // the .pov file; the .ini is written beside it
    std::optional<double> time{};  // seconds into the flythrough
    bool animation = false;        // the whole flythrough as one scene
    FrameRate rate{};              // of its frames
    std::optional<int> depth{};    // 1 to 256; by default the scene's max_trace_level
    int bits = 16;                 // of POV-Ray's picture, 8 or 16
};

/// Returns the exit status. Throws FileError and UsageError.
int pov_command(const PovOptions& options);

}  // namespace strahl
