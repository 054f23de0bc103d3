// The timeline at the bottom of the window, in which the user drags the path's keys and types their values.
#pragma once
#include <optional>

#include "show/keys/commands.h"
#include "show/session/path_editor.h"

namespace strahl {

/// The state that the timeline shows.
struct TimelineView {
    const PathEditor& editor;
    Camera scene_camera;
    double time = 0, duration = 0;  // of the flight, in seconds
    bool running = false;
};

/// The user's actions on the timeline since the last picture.
struct TimelineInput {
    std::optional<Command> command;
    std::optional<double> go_to;  // seconds
    struct Change {
        std::size_t number;
        Keyframe key;
        bool merged;  // belongs to the same drag as the change before
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
    double range = 10;                   // seconds that the bar shows; constant during a drag
    std::optional<std::size_t> dragged;  // number of a key
    bool drag_began = false;             // the key has been moved
    Keyframe draft;                      // the key as it is being typed
    bool typing = false;
};

}  // namespace strahl
