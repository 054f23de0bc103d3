// The window: passes the user's commands to the session, its views to the tracing thread, and pictures to the screen.
#pragma once
#include <atomic>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <string>

#include "show/body_tools.h"
#include "show/keys/key_file.h"
#include "show/panels/leaving.h"
#include "show/panels/panels.h"
#include "show/playback.h"
#include "show/recordings.h"
#include "show/scene_chooser.h"
#include "show/session/session.h"
#include "show/session/view_options.h"
#include "show/side_by_side.h"
#include "show/window/input.h"
#include "show/window/overlay.h"
#include "show/window/screen.h"
#include "show/work/notes.h"
#include "show/work/pace.h"
#include "show/work/reload.h"
#include "show/work/watched_scene.h"
#include "show/work/window_picture.h"

namespace strahl {

/// Does an error in the scene end the program, because nobody can mend it?
inline bool error_is_final(const ViewOptions& options) { return options.scene == "-" || options.play; }

class Viewer : InputReceiver {
  public:
    /// `first` is the scene as far as `reload` has read it; `began` is when the user started the program. Throws
    /// WindowError, and leaves `reload` as it was then.
    Viewer(const ViewOptions& options, const Loaded& first, std::unique_ptr<Reload>& reload,
           Pace::Clock::time_point began);
    /// Runs until the user quits, or until `interrupted` becomes true, which asks for the same. Returns the exit
    /// status. Throws FileError for an error in a scene that nobody can mend.
    int run(const std::atomic<bool>& interrupted);

  private:
    void perform(Command command) override;
    void draw() override;
    bool browse(int key) override;
    void turn_wheel(double notches, bool with_control) override;
    void drop(const std::string& path) override;
    void click(glm::dvec2 point, bool with_shift) override;
    Hold points_at(glm::dvec2 point) override;
    void hold(glm::dvec2 point) override;
    void pull(Hold what, glm::dvec2 point, Snap snap) override;
    void let_go() override;

    void back();
    void write();
    void keep_view();
    bool unsaved() const;
    void leave(std::function<void()> go);
    void answer(Leaving::Decision given);
    void take_sound(const std::string& path);
    void take_music(const Music& music, bool merged);
    void apply(const TimelineInput& input);
    void apply(const BodyInput& input);
    void apply(const OutlinerInput& input);
    bool in_other_view(double x) const;
    glm::dvec2 in_picture(glm::dvec2 point) const;

    // The loop
    bool in_motion() const { return session.flight.under_way() || input.active(); }
    void move();
    void show_first_picture();
    double next_draw() const;
    void wait();
    void take_scene();

    std::string work_under_way() const;
    ToolbarView toolbar() const;
    Overlay overlay() const;
    void quit();
    void save_editors_tracks();
    void take_tracks(const std::string& text, bool opened);
    void print_paths();
    void end(const std::atomic<bool>& interrupted);

    const ViewOptions options;
    const KeysRead keys = user_keys();
    Pace pace;
    Notes notes;
    Session session;
    Screen screen;
    Panels panels;
    Input input;
    WindowPicture picture;
    Recordings recordings;
    WatchedScene file;
    BodyTools bodies;
    SideBySide side;
    SceneChooser chooser;
    Playback playback;
    Leaving leaving;
    bool ending = false;  // the program ends as soon as stills and the film are done
};

}  // namespace strahl
