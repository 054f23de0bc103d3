// strahl pov: a scene becomes a POV-Ray scene.
#pragma once
#include <optional>
#include <string>

namespace strahl {

struct PovOptions {
    std::string scene;             // a file, or "-" for standard input
    std::string output;            // the .pov file; the .ini is written beside it
    std::optional<double> time{};  // seconds into the flythrough
    bool animation = false;        // all of the flythrough as one scene
    double fps = 25;               // its frames per second
    int width = 640, height = 480;
    std::optional<int> depth{};  // 1 to 256; the scene's max_trace_level if not given
    int bits = 16;               // of POV-Ray's picture, 8 or 16
};

/// Returns the exit status. Throws FileError for faults in files, and UsageError for options that make no
/// sense.
int pov_command(const PovOptions& options);

}  // namespace strahl
