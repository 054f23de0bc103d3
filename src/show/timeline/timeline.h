// The timeline at the bottom of the window, in which the user drags the keys of the path and of tracks, types their
// values, and chooses the music.
#pragma once
#include <array>
#include <optional>

#include "show/timeline/number_fields.h"
#include "show/timeline/time_scale.h"
#include "show/timeline/timeline_view.h"
#include "show/timeline/track_lanes.h"

namespace strahl {

class Timeline {
  public:
    /// To be called while ImGui makes a frame.
    TimelineInput draw(const TimelineView& view);
    /// Was a key clicked here last? forget_click() makes that false, and delete_clicked() has the next drawing ask for
    /// the end of that key.
    bool key_clicked() const { return path_key_clicked || lanes.key_clicked(); }
    void forget_click() { path_key_clicked = false, lanes.forget_click(); }
    void delete_clicked() { delete_asked = true; }
    /// Its height in pixels, with the space below it.
    float height() const { return tall; }

  private:
    void buttons(const TimelineView& view, TimelineInput& input);
    void bar(const TimelineView& view, TimelineInput& input);
    void key_menu(const TimelineView& view, TimelineInput& input);
    void values(const TimelineView& view, TimelineInput& input);
    void music(const TimelineView& view, TimelineInput& input);

    float tall = 0;
    TimeScale scale;
    TrackLanes lanes;
    NumberFields fields;
    std::optional<std::size_t> dragged;  // number of a key of the path
    bool end_dragged = false;            // the end of the path
    bool path_key_clicked = false, delete_asked = false;
    bool drag_began = false;  // a key has been moved
    bool value_held = false;  // a value has been changed since the mouse button is down
    Keyframe draft;           // the key as it is being typed
    bool typing = false;
    Music draft_music;
    std::array<char, 256> draft_sound{};
    bool typing_music = false;
};

}  // namespace strahl
