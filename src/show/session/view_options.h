// The options of `strahl view` and `strahl play`.
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "image/transfer.h"
#include "pov/open_scene.h"

namespace strahl {

/// Returns how large a window is at first that shows pictures of this width / height.
inline PictureSize first_window_size(double aspect) {
    constexpr int width = 960;
    return {width, static_cast<int>(std::lround(std::clamp(width / aspect, 240., 960.)))};
}

struct ViewOptions {
    std::string scene;  // a file, or "-" for standard input
    OpeningOptions opening{};
    std::optional<PictureSize> size;  // of the window; by default 960 wide, with the aspect ratio of the scene's camera
    std::optional<PictureSize> still_size;  // of stills; by default that of the picture in the window
    std::string still_folder;               // by default the current folder
    std::string still_ending = ".bmp";      // or ".png"
    bool full_screen = false;
    std::optional<int> depth;    // 1 to 256; by default the scene's max_trace_level
    int threads = 0;             // 0: all processors
    std::optional<double> time;  // seconds into the flythrough
    bool fly = false;
    Exposure exposure;          // at the start
    double fps = 60;            // requested pictures per second in motion, above 0
    std::optional<int> rocket;  // the port of an editor of tracks, if one is to be used
    bool verbose = false;
    bool list_keys = false;  // prints the keys instead
    // strahl play: shows only the flight, without panels; the user can only pause it and close the window.
    bool play = false;
    bool loop = false;       // starts the flight again at its end
    bool benchmark = false;  // prints figures at the end
    std::string stats;       // the file for these figures as JSON, if given
};

}  // namespace strahl
