// The text over the picture.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "show/session/framing.h"
#include "show/work/stability_check.h"

namespace strahl {

struct Overlay {
    bool help = false;
    std::vector<std::pair<std::string, std::string>> info;  // names and values; if empty, no panel
    double share = 1;                                       // of the pixels that are traced
    std::string fault_title, fault;                         // message of the scene file's error
    std::vector<std::string> notes;                         // the oldest first
    struct Progress {
        std::string text;
        double share = 0;
    };
    std::vector<Progress> progress;  // of work in the background
    Stability marks;                 // of pixels, on the picture
    int width = 1, height = 1;       // of that picture
    ScreenArea area;                 // and where it is
    float reserved = 0;              // pixels at the bottom of the window that something else needs
};

/// To be called while ImGui makes a frame.
void draw_overlay(const Overlay& overlay);

}  // namespace strahl
