// Lists what the timeline shows, and what the user does there.
#pragma once
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
    double time = 0, duration = 0;                        // of the flight, in seconds
    bool running = false, outside = false, both = false;  // both: the flight is seen beside the view from outside
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
        const char* what;  // has changed, for the user
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
    bool choose_sound = false;  // did the user ask for a dialog to choose the sound?
    std::string refused;        // why a number that was typed is not taken, or ""
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

}  // namespace strahl
