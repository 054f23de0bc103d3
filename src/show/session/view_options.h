// The options of `strahl view` and `strahl play`.
#pragma once
#include <optional>
#include <string>

namespace strahl {

/// In pixels; 0x0 if not given.
struct PixelSize {
    int width = 0, height = 0;
};

struct ViewOptions {
    std::string scene;         // a file, or "-" for standard input
    PixelSize size;            // of the window; by default 960 wide, with the aspect ratio of the scene's camera
    PixelSize still_size;      // of stills; by default that of the picture in the window
    std::string still_folder;  // by default the one that the program was started in
    std::string still_ending = ".bmp";  // or ".png"
    bool full_screen = false;
    std::optional<int> depth;    // 1 to 256; by default the scene's max_trace_level
    int threads = 0;             // 0: all processors
    std::optional<double> time;  // seconds into the flythrough
    bool fly = false;
    double fps = 60;            // requested pictures per second in motion, above 0
    std::optional<int> rocket;  // the port at which an editor of tracks listens, if it is to be asked
    bool verbose = false;
    // strahl play: the flight alone, from its start to its end, without panels; the window can only be closed or
    // paused.
    bool play = false;
    bool loop = false;       // again and again
    bool benchmark = false;  // figures on standard output
    std::string stats;       // and as JSON in this file, if given
};

}  // namespace strahl
