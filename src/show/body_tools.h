// The user's work on bodies and lights: connects clicks, handles, the panel, the file and the silhouette.
#pragma once
#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "show/keys/commands.h"
#include "show/session/body_editor.h"
#include "show/session/drag.h"
#include "show/session/handles.h"
#include "show/session/light_marks.h"
#include "show/session/session.h"
#include "show/window/body_panel.h"
#include "show/window/outliner.h"
#include "show/window/overlay.h"
#include "show/work/notes.h"
#include "show/work/pace.h"
#include "show/work/reload.h"
#include "show/work/silhouette.h"
#include "show/work/watched_scene.h"
#include "text/new_block.h"
#include "trace/world/view.h"

namespace strahl {

class BodyTools {
  public:
    /// `notify` is called from another thread when there is something to take.
    BodyTools(Session& session, WatchedScene& file, Notes& notes, Pace& pace, const std::function<void()>& notify)
        : session(session), file(file), notes(notes), pace(pace), silhouette(notify) {}

    /// To be called when the session has taken over a scene that was read from the file.
    void loaded(const Loaded& scene);
    /// Chooses the light whose mark is at a point of the view's picture, in pixels, no further than `reach`; else the
    /// body there.
    void click(const View& view, const glm::dvec2& point, double reach);
    /// Makes the next click put this block where it meets a surface. end_adding() stops that, and returns false if
    /// there was nothing to stop.
    void begin_adding(const NewBlock& block);
    bool end_adding();
    /// Returns the name of what the next click adds, or null.
    const char* adding() const { return to_add ? to_add->name : nullptr; }
    /// Does what the user asked for on the panel, except for commands.
    void apply(const BodyInput& input);
    /// Chooses, hides and shows what the user asked for in the outline.
    void apply(const OutlinerInput& input);
    /// The bodies that are hidden in the picture. Hiding does not change the text.
    const std::set<int>& hidden() const { return not_shown; }
    /// Returns the session's scene without these.
    std::shared_ptr<const Scene> scene_shown();
    /// Changes the text elsewhere than in what is chosen. `merged`: see EditedText::change. False if it cannot be
    /// changed here, as is the case of scenes without a text.
    bool change_text(const std::string& newer, bool merged);
    /// Undoes or redoes a change, if that is what comes next. Else returns false.
    bool undo(Action action);
    /// Moves the camera to where the body chosen fills the picture, if it is bounded.
    void approach(const View& view);
    /// Opens the line of what is chosen, or that which a message names, "FILE:LINE: ...", in the user's editor.
    void open_text();
    void open_text(const std::string& message);
    /// Chooses what handles do; or shows or hides the marks of lights.
    void toggle(Action action);
    /// Copies what is chosen in the text and chooses the copy; or removes it. False if nothing is chosen.
    bool copy();
    bool remove();
    /// Shows the scene with changed numbers once that is read, moves what is being dragged, and orders the silhouette
    /// in this view, if it rests. `scale` is that of the window: 1 at a usual pixel density.
    void follow(const View& view, double scale);

    /// Is a handle at this point of the picture, or is one held?
    bool points_at(const glm::dvec2& point, double reach);
    /// Begins to drag the handle at this point of the view's picture, if one is there. Goes on to another point. Lets
    /// go of it.
    void hold(const glm::dvec2& point, double reach);
    void pull(const glm::dvec2& to, bool steps);
    void let_go();

    const BodyEditor& editor() const { return bodies; }
    const std::vector<SilhouetteLine>& lines() const { return silhouette.lines(); }
    /// Returns the handles and lights to be drawn, in pixels of the picture.
    Overlay::Tools drawn() const;
    /// Returns the name of the file in which the body chosen stands.
    std::string file_name() const;
    const ChangedText& changes() const { return bodies.edited.changes(); }
    /// Returns true if there are changes that are not written and about which the user was not asked yet.
    bool asks();
    /// To be called after each drawing: logs what the window shows now.
    void log_drawn();
    /// Prints the lines that would be lost now.
    void print_unwritten() const;

  private:
    /// A body or a light to be chosen once the scene has it.
    struct NextChoice {
        TopBlock what;
        int number;
        std::optional<DVec3> added_at{};  // where it was added
    };
    std::size_t others() const { return session.editor.steps() + session.track_keys.steps(); }
    const Scene& scene_seen(const View& view);
    bool follow_track(const BodyInput::NewTrack& track);
    void show();
    void show_anew();
    void show_all() { not_shown.clear(), whole = shown = nullptr; }
    void add(const View& view, const glm::dvec2& point);
    void choose(const NextChoice& chosen);
    bool change_block(bool copies);
    void take_shown();
    void place_handles(const View& view, double scale);
    void drag_on();
    std::optional<ChangedBody> changed_body() const;
    bool spot_chosen() const;
    std::array<DVec3, 3> own_axes();
    void find_pointed();
    int number() const;
    void log_choice();

    Session& session;
    std::vector<std::string> to_log;  // after the next drawing
    WatchedScene& file;
    Notes& notes;
    Pace& pace;
    BodyEditor bodies;
    Silhouette silhouette;
    std::string good;                    // the last text that was shown
    std::string asked_about;             // a text
    bool awaited = false;                // the scene of a text with other bodies; until then nothing is changed
    bool undone = false;        // what was chosen may be elsewhere then
    std::optional<bool> later;  // what is chosen is copied or removed then
    std::optional<NextChoice> next;
    const NewBlock* to_add = nullptr;    // by the next click
    std::shared_ptr<const Scene> still;  // a scene, if nothing moves in it
    /// A moment of a scene.
    struct SceneMoment {
        std::shared_ptr<const Scene> scene;
        double time = 0;
        std::shared_ptr<const std::vector<Track>> tracks;
        bool operator==(const SceneMoment&) const = default;
    };
    std::set<int> not_shown;                   // bodies
    std::shared_ptr<const Scene> whole, shown;  // the scene of these, and what it is without them
    SceneMoment moment;  // the one of `now`
    Scene now;

    std::array<DVec3, 3> axes{};  // of this body, along which it is scaled
    std::shared_ptr<const Scene> axes_scene;
    int axes_body = -1;

    HandleMode mode = HandleMode::move;
    bool lights_shown = false;
    LightMarks marks;
    std::optional<Handles> handles;  // of what is chosen
    std::optional<Handle> pointed;   // the one under the pointer
    glm::dvec2 pointer{-1};
    double pointer_reach = 0;
    std::optional<Drag> drag;
    struct DragPoint {
        glm::dvec2 place{0};
        bool steps = false;
    };
    std::optional<DragPoint> dragged_to;  // not yet applied
    bool dragged = false;                 // this drag has changed the text
    DVec3 clicked{0};                     // the point that was clicked, when it began
};

}  // namespace strahl
