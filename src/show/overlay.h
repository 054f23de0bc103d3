// The text over the picture.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "show/stability_check.h"

namespace strahl {

struct Overlay {
    bool help = false;
    std::vector<std::pair<std::string, std::string>> info;  // names and values; if empty, no panel
    double share = 1;                                       // of the pixels that are traced
    std::string fault;                                      // message of the scene file's error
    std::vector<std::string> notes;                         // the oldest first
    double still_share = -1;                                // of the still being rendered, or negative
    std::string still_text;
    std::vector<Mark> marks;    // of pixels, on the picture
    int width = 1, height = 1;  // of that picture

    bool empty() const {
        return !help && info.empty() && fault.empty() && notes.empty() && still_share < 0 && marks.empty();
    }
};

/// To be called while ImGui makes a frame.
void draw_overlay(const Overlay& overlay);

}  // namespace strahl
