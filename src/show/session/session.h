// The state that the user controls: camera, flight, path, depth. It knows neither windows nor threads.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "image/transfer.h"
#include "scene/scene.h"
#include "show/keys/key_map.h"
#include "show/session/camera_control.h"
#include "show/session/flight.h"
#include "show/session/path_editor.h"
#include "show/session/progressive.h"
#include "show/session/thinning.h"
#include "show/session/track_keys.h"

namespace strahl {

/// The answer to a command: a short note for the window and the log, and scene text for the clipboard and standard
/// output. Either may be empty.
struct Answer {
    std::string note, text;
};

class Session {
  public:
    /// `depth` is used instead of the scene's. All times named `now` are seconds of one steady clock.
    explicit Session(std::shared_ptr<const Scene> scene, std::optional<int> depth = {});

    /// To be called when the file has changed or, if `opened`, is another one. The camera stays unless it changed in
    /// the file. `picture`: see Loaded. Returns whether the file's path replaced one that was not written.
    bool replace(std::shared_ptr<const Scene> scene, bool opened, std::shared_ptr<const Scene> picture = {});
    /// To be called when the file was read again for another moment or another size of the picture. Where only the
    /// proportions or the angle of the file's camera differ, the camera stays where it is and takes these.
    void replace_reread(std::shared_ptr<const Scene> scene, std::shared_ptr<const Scene> picture = {});

    /// Commands that concern only the window (quit, still, full screen, panels) have no effect here.
    Answer perform(Command command, double now);

    /// Ends the flight, if there is one; the camera stays where it is.
    Answer end_flight(double now);
    /// Moves to a moment of the flight and pauses there. False if nothing moves; then only the moment is kept, for
    /// keys.
    bool go_to(double seconds, double now);

    /// Moves the camera. If the flight determines the camera, this ends the flight. `push` is in seconds at the current
    /// speed.
    Answer steer(const CameraInput& input, double now);
    /// Multiplies the speed of the flight, if that determines the camera, or else that of the camera.
    Answer change_speed(double factor, double now);
    /// Follows the mouse's wheel, upwards by so many notches: the camera comes nearer to what it looks at, which ends a
    /// flight, or, if `faster`, it or the flight gets faster.
    Answer turn_wheel(double notches, bool faster, double now);
    /// Adds the camera to the recording of a flight by hand, if one is under way. To be called before and after each
    /// step of the camera. If the recording has become too long, ends it and returns an answer.
    std::optional<Answer> observe(double now);
    bool recording() const { return recorded.has_value(); }
    /// Makes a path of the recording under way, if any, because the window closes or opens another scene.
    Answer end_recording(double now) { return recorded ? record(now) : Answer{}; }

    /// Gives a key of the path other values, if they make a camera that sees something, and goes to the key's time.
    /// `merged`: see Edit.
    Answer change_key(std::size_t number, const Keyframe& key, bool merged, double now);
    /// Takes the text of the file of tracks, which was read with the scene. Returns whether a change was lost.
    bool take_tracks(const std::string& text, bool opened);
    /// Gives a track other keys.
    void change_track(const Track& track, bool merged, double now);
    /// Replaces the path. `what`: see Edit.
    void change_path(Flythrough path, const std::string& what, bool merged, double now);
    /// Returns the number of the next change of the path or of tracks to be undone, or redone; see EditSteps::next.
    std::size_t next_step(bool back) const;
    /// Applies a change of the path to the flight that is under way.
    void path_changed(double now);
    /// Moves the camera along the flight to this moment. Returns an answer if the flight has ended.
    std::optional<Answer> follow(double now);

    /// Does the flight determine the camera?
    bool bound() const {
        return !outside && flight.flying() && (!flight.path()->keys.empty() || !scene->camera_follows.empty());
    }
    /// Returns the camera of the flight at a moment; that of the scene if there is no path.
    Camera flight_camera(double moment) const;
    Camera flight_camera() const { return flight_camera(time); }
    /// Returns what can be flown: the path as it is edited, or a path without keys if only bodies move. Unless it loops
    /// it lasts at least until the last key of motions and tracks. Nothing if nothing moves.
    std::optional<Flythrough> path_to_fly() const;

    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const Scene> pictured;  // gives the same picture as `scene`: what is traced goes on if it stays
    EditOrder edits;                        // of the path, the tracks and the text
    PathEditor editor;
    Flight flight;
    Camera camera;
    double time = 0;  // of moving bodies, in seconds: like `camera`, of the last moment followed
    bool orbiting = false;
    bool outside = false;  // the camera stays free while the flight goes on: it is seen from outside
    bool fill = false;     // the view is widened to fill the window: see framing.h
    /// If not null, instead of the scene's.
    std::shared_ptr<const std::vector<Track>> tracks;
    TrackKeys track_keys;
    KeyMap keys;                   // keys that messages name
    bool keys_elsewhere = false;   // an editor of tracks has the keys, and they cannot be changed here
    double speed = 1;              // units of the scene per second
    int finest = sharpened_level;  // level in motion
    Exposure exposure;             // of the picture and of stills
    /// The view that a window of this size shows now.
    View view(int window_width, int window_height) const;
    int depth() const { return own_depth.value_or(scene->settings.max_trace_level); }

  private:
    Answer play(double now);
    Answer pause(double now);
    Answer see_outside(double now);
    Answer step_to(double seconds, double now);
    Answer to_key(int step, double now);
    Answer undo(bool back, double now);
    Answer edit(Action action, double now);
    Answer add_key(double now);
    Answer record(double now);
    Answer expose(int step);
    std::shared_ptr<const std::vector<Shot>> moments(int window_width, int window_height) const;
    void show_tracks(double now);
    Answer recall(int number);

    /// All that the moments of an open shutter depend on.
    struct ShutterState {
        std::shared_ptr<const Scene> scene;
        std::shared_ptr<const std::vector<Track>> tracks;
        Camera camera;
        double time = 0;
        std::optional<Flythrough> path;  // on which the camera flies
        int width = 0, height = 0;
        bool fill = false;
        bool operator==(const ShutterState&) const = default;
    };
    mutable ShutterState shutter;  // of these moments
    mutable std::shared_ptr<const std::vector<Shot>> kept_moments;

    std::optional<int> own_depth;
    std::optional<std::vector<CameraMoment>> recorded;
    std::optional<double> motion_end;  // time of the last key of motions; none if nothing moves
    std::array<std::optional<Camera>, 9> cameras;
};

/// "1.77 s"
std::string seconds_text(double seconds);
/// "+0.5 stops"
std::string exposure_text(const Exposure& exposure);
/// "1/4 of the pixels", for a level.
std::string resolution_text(int level);

}  // namespace strahl
