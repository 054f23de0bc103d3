// The panels of text over the picture, and the marks on it.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "show/session/framing.h"
#include "show/session/handles.h"
#include "show/session/light_marks.h"
#include "show/window/path_marks.h"
#include "show/work/notes.h"
#include "show/work/silhouette.h"
#include "show/work/stability_check.h"

namespace strahl {

struct Overlay {
    std::vector<std::pair<std::string, std::string>> info;  // names and values; if empty, no panel
    double share = 1;                                       // of the picture's passes that are done
    std::string fault_title, fault;                         // the error in the scene file, if any
    std::string quiet_key;                                  // hides it
    std::vector<Note> notes;                                // the oldest first
    bool notes_below = false;                               // they are at the lower edge
    struct Bar {
        std::string text;
        double share = 0;
    };
    std::vector<Bar> bars;      // of work in the background
    Stability marks;            // on pixels of the picture
    int width = 1, height = 1;  // of the picture, in its own pixels
    ScreenArea area;            // where the picture is on the screen
    struct Sides {
        int column = 0;                          // of the window, where the divider is
        std::string left, right;                 // what is seen there; may be empty
        std::optional<ScreenArea> other_view{};  // where another view is seen; around it the right is dark
    };
    std::optional<Sides> sides;
    std::vector<SilhouetteLine> silhouette;  // of the body that is chosen, in those pixels
    /// Marks of lights and the handles of what is chosen, in pixels of a picture as large as `area`.
    struct Tools {
        LightMarks marks;
        std::optional<LightPoint> chosen;
        std::vector<Handles::HandleLine> handles;
        std::optional<Handle> pointed;  // the one under the pointer
    };
    Tools tools;
    PathMarks path;  // in the same pixels
    // Pixels at the edges of the window that panels must leave free.
    float reserved = 0, reserved_left = 0, reserved_right = 0, reserved_top = 0;
};

/// To be called while ImGui makes a frame.
void draw_overlay(const Overlay& overlay);

}  // namespace strahl
