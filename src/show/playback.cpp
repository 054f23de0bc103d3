#include "show/playback.h"

#include <utility>

#include "files/error.h"
#include "scene/moving_scene.h"
#include "text/reading/tracks_file.h"

namespace strahl {

void check_options(const ViewOptions& options, const Scene& scene) {
    if (options.time) flight_for("--time", scene, options.scene);
    if (options.rocket && followed_tracks(scene).empty())
        throw UsageError("--rocket needs a scene with a track, and " + options.scene + " has none");
}

Playback::Playback(const ViewOptions& options, Session& session, Notes& notes, Pace& pace, std::function<void()> notify)
    : tracks(options.rocket, session, notes, pace, notify),
      sound(notes, pace),
      options(options),
      session(session),
      notes(notes),
      pace(pace),
      notify(std::move(notify)) {}

void Playback::start_scene() {
    tell_unfollowed();
    try {
        check_options(options, *session.scene);
    } catch (const UsageError& error) {
        notes.fail(error.what());
    }
    tracks.ask();
    const double now = pace.now();
    if (tracks.wanted()) return static_cast<void>(session.go_to(options.time.value_or(0), now));
    if (options.play) return start_playing();
    if (options.time) session.go_to(*options.time, now);
    if (options.fly) log_line(session.perform({session.flight.flying() ? Action::pause : Action::play}, now).note);
}

/// Pauses at the start of the flight until the first picture is there.
void Playback::start_playing() {
    session.flight.once = !options.loop, started = false;
    if (session.go_to(options.time.value_or(0), pace.now())) return;
    session.perform({Action::play}, 0), session.perform({Action::pause}, 0);
}

void Playback::scene_changed(const std::vector<std::string>& unfollowed) {
    if (unfollowed_tracks(*session.scene) != unfollowed) tell_unfollowed();
    tracks.ask();
}

/// Tells the user about tracks that have no effect.
void Playback::tell_unfollowed() {
    for (const std::string& message : unfollowed_tracks(*session.scene)) notes.fail(message);
}

void Playback::follow_sound(const std::string& scene_path) {
    sound.load(session.scene, scene_path, notify);
    sound.follow(session);
}

void Playback::picture_shown() {
    if (options.play && !tracks.wanted() && !sound.loading() && !std::exchange(started, true))
        session.perform({Action::pause}, pace.now());
}

bool Playback::flight_ended(const Answer& answer) {
    if (options.play && !options.loop) return true;
    if (options.play)
        start_playing();
    else
        notes.tell(answer);
    return false;
}

}  // namespace strahl
