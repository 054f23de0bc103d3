// The user's work on bodies and lights: connects clicks, handles, the panel, the file and the silhouette.
#pragma once
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "show/body_handles.h"
#include "show/keys/commands.h"
#include "show/panels/body_panel.h"
#include "show/panels/hidden_bodies.h"
#include "show/panels/outliner.h"
#include "show/scene_moment.h"
#include "show/session/body_editor.h"
#include "show/session/drag.h"
#include "show/session/light_marks.h"
#include "show/session/session.h"
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
        : session(session), file(file), notes(notes), pace(pace), handles(bodies, session, pace), silhouette(notify) {}

    /// To be called when the session has taken over a scene that was read from the file.
    void loaded(const Loaded& scene);
    /// Chooses the light whose mark is at a point of the view's picture, in pixels, no further than `reach`; else the
    /// body there, with `adds` besides those chosen: see BodyEditor::click.
    void click(const View& view, const glm::dvec2& point, double reach, bool adds = false);
    /// Chooses the camera.
    void choose_camera();
    /// Makes the next click put this block where it meets a surface. end_adding() stops that and
    /// begin_focusing(), and returns false if there was nothing to stop.
    void begin_adding(const NewBlock& block);
    bool end_adding();
    /// Makes the next click choose the point that the camera's lens has in focus.
    void begin_focusing();
    bool focusing() const { return to_focus; }
    /// Returns the name of what the next click adds, or null.
    const char* adding() const { return to_add ? to_add->name : nullptr; }
    /// Does what the user asked for on the panel, except for commands.
    void apply(const BodyInput& input);
    /// Chooses, hides and shows what the user asked for in the outline.
    void apply(const OutlinerInput& input);
    /// The bodies that are hidden in the picture. Hiding does not change the text.
    const std::set<int>& hidden() const { return not_shown.numbers(); }
    /// Returns the session's scene, as far as the picture shows it, without these.
    std::shared_ptr<const Scene> scene_shown() { return not_shown.scene_without(session.pictured); }
    /// Changes the text elsewhere than in what is chosen. `what` and `merged`: see Edit. False if it cannot be changed
    /// here, as is the case of scenes without a text.
    bool change_text(const std::string& newer, const std::string& what, bool merged = false);
    /// Undoes or redoes a change of the text, if that comes next among those of the session. Else returns false.
    bool undo(bool back);
    /// Moves the camera to where the body chosen fills the picture, if it is bounded.
    void approach(const View& view);
    /// Opens the line of what is chosen, or that which a message names, "FILE:LINE: ...", in the user's editor.
    void open_text();
    void open_text(const Message& message);
    /// Chooses what handles do: `mode`, or what comes next.
    void change_handles(std::optional<HandleMode> mode);
    HandleMode handle_mode() const { return handles.handle_mode(); }
    /// Shows or hides the marks of lights.
    void toggle_lights();
    bool lights_shown() const { return marks.has_value(); }
    /// Copies what is chosen in the text and chooses the copy; or removes it, if it is seen. False if nothing is
    /// chosen.
    bool copy();
    bool remove();
    /// Undoes the last of what the tools show: what is to be added, what is chosen, the marks of lights. False if there
    /// is nothing of that.
    bool step_back();
    /// Shows the scene with changed numbers once that is read, moves what is being dragged, and orders the silhouette
    /// in this view, if it rests. `scale` is that of the window: 1 at a usual pixel density.
    void follow(const View& view, double scale);

    /// Is a handle at this point of the picture, or is one held?
    bool points_at(const glm::dvec2& point, double reach) { return handles.points_at(point, reach); }
    /// Begins to drag the handle at this point of the view's picture, if one is there. Goes on to another point. Lets
    /// go of it.
    void hold(const glm::dvec2& point, double reach);
    void pull(const glm::dvec2& to, Snap snap) { handles.pull(to, snap); }
    void let_go(const View& view);

    const BodyEditor& editor() const { return bodies; }
    const std::vector<SilhouetteLine>& lines() const { return silhouette.lines(); }
    /// Returns the handles and lights to be drawn, in pixels of the picture.
    Overlay::Tools drawn() const;
    /// Returns the name of the file in which the body chosen stands.
    std::string file_name() const;
    const ChangedText& changes() const { return bodies.edited.changes(); }
    /// To be called after each drawing: logs what the window shows now.
    void log_drawn();

  private:
    /// A body or a light to be chosen once the scene has it.
    struct NextChoice {
        TopBlock what;
        std::vector<int> numbers;
        std::optional<DVec3> added_at{};  // where it was added
    };
    /// Says what follows once the scene of a text with other bodies is read.
    struct Awaited {
        std::optional<NextChoice> next{};  // what to choose
        bool undone = false;               // finds the point chosen again, which may be elsewhere
        std::optional<bool> later{};       // copies (true) or removes what is chosen
    };
    const Scene& scene_seen(const View& view) { return moment.at(session.scene, view); }
    bool changing() const { return awaited || handles.held(); }
    bool follow_track(const BodyInput::NewTrack& track);
    void reload(const std::string& text);
    void note_editor();
    void show();
    void show_anew(std::optional<NextChoice> next = {}, bool undone = false);
    void add(const View& view, const glm::dvec2& point);
    void focus_on(const View& view, const glm::dvec2& point);
    void choose(const NextChoice& chosen);
    bool change_block(bool copies);
    void take_shown();
    void give_material(const MaterialPreset& preset);
    void place(const BodyInput::NewPlace& place);
    void drag_on(const View& view);
    std::optional<ChangedBody> changed_body() const;
    void log_choice();

    Session& session;
    WatchedScene& file;
    Notes& notes;
    Pace& pace;
    BodyEditor bodies;
    BodyHandles handles;
    Silhouette silhouette;
    HiddenBodies not_shown;
    std::optional<PlacedBodies> placed;  // the bodies that numbers move, as they were before
    DVec3 placed_about{0};               // the point about which these turn them
    SceneMoment moment;
    std::string good;                  // the last text that was shown
    std::optional<Awaited> awaited;    // while such a scene is read; until then nothing is changed
    const NewBlock* to_add = nullptr;  // block that the next click adds
    bool to_focus = false;             // the next click chooses what is sharp
    std::optional<LightMarks> marks;   // if lights are shown
    std::vector<std::string> to_log;   // lines to log after the next drawing
};

}  // namespace strahl
