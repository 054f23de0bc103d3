// Draws the timeline's lanes: of tracks that something follows, and of motions of bodies and lights.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "show/timeline/number_fields.h"
#include "show/timeline/time_scale.h"
#include "show/timeline/timeline_view.h"

namespace strahl {

class TrackLanes {
  public:
    /// To be called before the others: looks for what the scene has.
    void look(const TimelineView& view);
    bool any_tracks() const { return !followed.empty(); }
    /// The width in pixels of the column of their names; 0 if there are no lanes.
    float names_width() const;
    void draw(const TimelineView& view, TimeScale& scale, TimelineInput& input);
    /// Draws the values of the key of a track that is chosen.
    void draw_values(const TimelineView& view, TimelineInput& input);
    /// Was a key of a lane clicked last? forget_click() makes that false.
    bool key_clicked() const { return clicked != ClickedKey::none; }
    void forget_click() { clicked = ClickedKey::none; }
    /// Removes that key.
    void remove_clicked(const TimelineView& view, TimelineInput& input);

  private:
    void track_lane(const TimelineView& view, TimeScale& scale, const Track& track, TimelineInput& input);
    void motion_lane(const TimelineView& view, TimeScale& scale, const SceneMotion& motion, TimelineInput& input);

    std::shared_ptr<const Scene> known;  // the scene of these
    std::vector<std::string> followed;   // names of tracks
    std::vector<SceneMotion> motions;
    NumberFields fields;
    std::string chosen;  // one of the tracks
    int chosen_row = 0;  // row of the track's key, if it has one there
    enum class ClickedKey { none, track, motion } clicked = ClickedKey::none;
    SceneMotion clicked_motion;      // the motion that has the clicked key
    std::size_t clicked_number = 0;  // the number of the clicked key in it
    bool scrolls = false;            // should the lanes scroll to the chosen one?
    bool key_dragged = false;
    double low = 0, high = 1;            // the values that its lane shows; constant during a drag
    bool value_held = false;             // a value has been changed since the mouse button is down
    std::optional<std::size_t> dragged;  // number of a key of a motion
    bool drag_began = false;             // a key has been moved
};

}  // namespace strahl
