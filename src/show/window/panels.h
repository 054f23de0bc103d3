// Which panels lie over the picture.
#pragma once
#include "show/session/session.h"
#include "show/window/timeline.h"
#include "show/work/pace.h"

namespace strahl {

class Panels {
  public:
    /// `no_text`: no panel is shown until the user asks for one.
    Panels(Pace& pace, bool no_text) : quiet(no_text), pace(pace) {}

    /// Shows or hides what the action names: help, info, timeline, or all text (Action::quiet).
    void toggle(Action action);

    /// Draws the timeline, if it is shown, and returns what the user did on it. To be called while ImGui makes a frame.
    TimelineInput draw_timeline(const Session& session);
    /// The height in pixels of what lies at the bottom of the window.
    float reserved() const { return timeline_shown() ? timeline.height() : 0; }
    /// Is the timeline open, even if all text is hidden?
    bool with_timeline() const { return timeline_open; }

    bool help = false, info = false, quiet;

  private:
    bool timeline_shown() const { return timeline_open && !quiet; }

    Pace& pace;
    bool timeline_open = false;
    Timeline timeline;
};

}  // namespace strahl
