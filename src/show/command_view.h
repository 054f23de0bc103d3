// strahl view: the window.
#pragma once
#include <optional>
#include <string>

namespace strahl {

/// In pixels; 0x0 where nothing was asked for.
struct PixelSize {
    int width = 0, height = 0;
};

struct ViewOptions {
    std::string scene;     // a file, or "-" for standard input
    PixelSize size;        // of the window; without it 960 wide, in the shape that the scene's camera wants
    PixelSize still_size;  // of stills; without it the window's
    bool full_screen = false;
    std::optional<int> depth;    // 1 to 256; the scene's max_trace_level if not given
    int threads = 0;             // 0 takes all
    std::optional<double> time;  // seconds into the flythrough
    bool fly = false;
    double fps = 60;  // pictures per second to aim at while moving, above 0
    bool verbose = false;
};

/// Returns the exit status. Throws FileError for the scene, UsageError for options that do not suit it, and
/// std::runtime_error with advice if no window can be opened.
int view_command(const ViewOptions& options);

}  // namespace strahl
