// The user's work on bodies: connects clicks, the panel, the file and the silhouette.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "show/session/body_editor.h"
#include "show/session/keys.h"
#include "show/session/session.h"
#include "show/window/body_panel.h"
#include "show/work/notes.h"
#include "show/work/pace.h"
#include "show/work/reload.h"
#include "show/work/silhouette.h"
#include "show/work/watched_scene.h"
#include "trace/world/view.h"

namespace strahl {

class BodyTools {
  public:
    /// `notify` is called from another thread when there is something to take.
    BodyTools(Session& session, WatchedScene& file, Notes& notes, Pace& pace, const std::function<void()>& notify)
        : session(session), file(file), notes(notes), pace(pace), silhouette(notify) {}

    /// To be called when the session has taken over a scene that was read from the file.
    void loaded(const Loaded& scene);
    /// Chooses the body at a point of the view's picture, in pixels.
    void click(const View& view, double x, double y);
    /// Does what the user asked for on the panel, except for commands.
    void apply(const BodyInput& input);
    /// Undoes or redoes a change of a number, if that is what comes next. Else returns false.
    bool undo(Action action);
    /// Moves the camera to where the body chosen fills the picture, if it is bounded.
    void approach(const View& view);
    /// Opens the line of the body chosen in the user's editor.
    void open_text();
    /// Shows the scene with changed numbers once that is read, and orders the silhouette in this view, if it rests.
    void follow(const View& view);

    const BodyEditor& editor() const { return bodies; }
    const std::vector<SilhouetteLine>& lines() const { return silhouette.lines(); }
    /// The name of the file in which the body chosen stands.
    std::string file_name() const;
    ChangedText changes() const { return {bodies.edited.in_file(), bodies.edited.text()}; }
    /// Are there changes that are not written, and was this not asked about them before?
    bool asks();
    /// Prints the lines that would be lost now.
    void print_unwritten() const;

  private:
    Scene scene_seen(const View& view) const;
    void show();

    Session& session;
    WatchedScene& file;
    Notes& notes;
    Pace& pace;
    BodyEditor bodies;
    Silhouette silhouette;
    std::string good;         // the last text that was shown
    std::string asked_about;  // a text
};

}  // namespace strahl
