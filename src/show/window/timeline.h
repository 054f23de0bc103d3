// The timeline at the bottom of the window, in which the user drags the keys of the path and of tracks, types their
// values, and chooses the music.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "show/keys/commands.h"
#include "show/session/path_editor.h"
#include "text/motion_text.h"

namespace strahl {

/// The state that the timeline shows.
struct TimelineView {
    const PathEditor& editor;
    Camera scene_camera;
    double time = 0, duration = 0;  // of the flight, in seconds
    bool running = false, outside = false;
    std::shared_ptr<const Scene> scene{};
    const std::vector<Track>& tracks;
    const std::vector<float>& peaks;  // of the sound, see Sound::peaks
    bool text_open = false;           // music can be changed
    bool keys_open = false;           // keys of tracks can be changed
    bool keys_changed = false;        // keys of tracks are not written yet
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
    struct NewPath {
        Flythrough path;
        bool merged;
    };
    std::optional<NewPath> path;
    struct NewKeys {
        Track track;
        bool merged;
    };
    std::optional<NewKeys> track;
    struct NewMusic {
        Music music;
        bool merged;
    };
    std::optional<NewMusic> music;
    bool choose_sound = false;  // by a dialog
    /// A key of a motion to be moved to other seconds, to be added there, or to be removed.
    struct MotionChange {
        enum What { move, add, remove } what;
        SceneMotion motion;
        std::size_t key;
        double seconds;
        bool merged;
    };
    std::optional<MotionChange> motion;
};

class Timeline {
  public:
    /// To be called while ImGui makes a frame.
    TimelineInput draw(const TimelineView& view);
    /// Its height in pixels, with the space below it.
    float height() const { return tall; }

  private:
    void buttons(const TimelineView& view, TimelineInput& input);
    void show_range(const TimelineView& view);
    void bar(const TimelineView& view, TimelineInput& input);
    void draw_sound(const TimelineView& view, float top, float bottom) const;
    void draw_grid(const Music& music, float top, float bottom) const;
    void draw_moment(const TimelineView& view, float top, float bottom) const;
    void zoom();
    void key_menu(const TimelineView& view, TimelineInput& input);
    void lanes(const TimelineView& view, TimelineInput& input);
    void lane(const TimelineView& view, const Track& track, TimelineInput& input);
    void motion_lane(const TimelineView& view, const SceneMotion& motion, TimelineInput& input);
    void values(const TimelineView& view, TimelineInput& input);
    void track_values(const TimelineView& view, TimelineInput& input);
    void music(const TimelineView& view, TimelineInput& input);
    float x_of(double time) const { return left + length * static_cast<float>((time - from) / range); }
    double time_at(float x) const { return from + static_cast<double>((x - left) / length) * range; }

    float tall = 0;
    double from = 0, range = 10, zoomed = 1;  // the seconds that the bar shows; constant during a drag
    double shown_time = 0;
    float left = 0, length = 1;          // where it shows them, in pixels
    std::optional<std::size_t> dragged;  // number of a key of the path
    bool end_dragged = false;            // the end of the path
    bool drag_began = false;             // a key has been moved
    Keyframe draft;                      // the key as it is being typed
    bool typing = false;

    std::shared_ptr<const Scene> known;  // the scene of these
    std::vector<std::string> followed;   // names of tracks
    std::vector<SceneMotion> motions;
    std::string chosen;                  // one of these
    int chosen_row = 0;                  // of its key, if it has one there
    bool key_dragged = false;
    double low = 0, high = 1;  // the values that the lane of the track chosen shows; constant during a drag
    bool value_held = false;   // a value has been changed since the mouse button is down
    Music draft_music;
    std::array<char, 256> draft_sound{};
    bool typing_music = false;
};

}  // namespace strahl
