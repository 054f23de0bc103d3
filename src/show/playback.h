// Plays the flight of a scene: with its sound, as an editor of tracks asks, and for `strahl play`.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "show/session/session.h"
#include "show/session/view_options.h"
#include "show/window/scene_sound.h"
#include "show/work/notes.h"
#include "show/work/pace.h"
#include "show/work/track_editor.h"

namespace strahl {

/// Throws UsageError if the scene lacks what the options need.
void check_options(const ViewOptions& options, const Scene& scene);

class Playback {
  public:
    /// `notify` is called from another thread when there is something to follow.
    Playback(const ViewOptions& options, Session& session, Notes& notes, Pace& pace, std::function<void()> notify);

    /// Does with a scene that is shown for the first time what the options ask for.
    void start_scene();
    /// To be called when a scene has changed whose tracks without an effect were `unfollowed`.
    void scene_changed(const std::vector<std::string>& unfollowed);
    /// Keeps the flight where the sound is.
    void follow_sound(const std::string& scene_path);
    /// To be called after each drawing, with a picture of the scene on the screen: `strahl play` begins with the first.
    void picture_shown();
    /// To be called when a flight ends. Returns true if the program ends with it.
    bool flight_ended(const Answer& answer);

    TrackEditor tracks;
    SceneSound sound;

  private:
    void start_playing();
    void tell_unfollowed();

    const ViewOptions& options;
    Session& session;
    Notes& notes;
    Pace& pace;
    const std::function<void()> notify;
    bool started = false;  // the flight of `strahl play`
};

}  // namespace strahl
