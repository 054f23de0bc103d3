// The timeline at the bottom of the window: the keys of the path, where they are dragged and typed.
#pragma once
#include <optional>

#include "show/session/keys.h"
#include "show/session/path_editor.h"

namespace strahl {

/// What it shows.
struct TimelineView {
    const PathEditor& editor;
    Camera scene_camera;
    double time = 0, duration = 0;  // of the flight, in seconds
    bool running = false;
};

/// What a hand asked for.
struct TimelineInput {
    std::optional<Command> command;
    std::optional<double> go_to;  // seconds
    struct Change {
        std::size_t number;
        Keyframe key;
        bool merged;  // part of the drag that the change before belongs to
    };
    std::optional<Change> change;
};

class Timeline {
  public:
    /// To be called while ImGui makes a frame.
    TimelineInput draw(const TimelineView& view);
    /// Its height in pixels, with the space below it.
    float height() const { return tall; }

  private:
    void buttons(const TimelineView& view, TimelineInput& input);
    void bar(const TimelineView& view, TimelineInput& input);
    void values(const TimelineView& view, TimelineInput& input);

    float tall = 0;
    double range = 10;                  // seconds that the bar shows; stays while something is dragged
    std::optional<std::size_t> dragged;  // key
    bool drag_began = false;            // and has been moved
    Keyframe draft;                     // of the values, while they are typed
    bool typing = false;
};

}  // namespace strahl
