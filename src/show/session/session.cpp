// Applies commands to the camera, its flight and its path.
#include "show/session/session.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "image/frame_rate.h"
#include "image/picture.h"
#include "num/decimal.h"
#include "num/vec_math.h"
#include "scene/moving_scene.h"
#include "show/session/framing.h"
#include "text/reading/parameter.h"
#include "trace/shutter.h"

namespace strahl {
namespace {

constexpr double seconds_per_key = 3;       // between keys that are added
constexpr std::size_t most_moments = 7200;  // of a recorded flight: 2 minutes at 60 pictures per second

/// Returns the path in the file that can be edited: a scene by POV-Ray's clock has a flight without keys, too.
std::optional<Flythrough> path_in(const Scene& scene) {
    return scene.flythrough && !scene.flythrough->keys.empty() ? scene.flythrough : std::nullopt;
}

std::optional<double> motion_end_of(const Scene& scene) {
    const Movers movers(scene);
    if (scene.flythrough && scene.flythrough->keys.empty())
        return std::max(scene.flythrough->duration, movers.last_key);
    return movers.any() || !scene.camera_follows.empty() ? std::optional(movers.last_key) : std::nullopt;
}

/// Gives a camera the lens and the shutter of another one.
Camera with_lens(Camera camera, const Camera& other) {
    camera.aperture = other.aperture, camera.blades = other.blades, camera.shutter = other.shutter;
    camera.shutter_in_frames = other.shutter_in_frames;
    camera.focus = other.focus, camera.focus_on = other.focus_on;
    return camera;
}

}  // namespace

Session::Session(std::shared_ptr<const Scene> first_scene, std::optional<int> depth)
    : scene(std::move(first_scene)),
      pictured(scene),
      editor(path_in(*scene)),
      camera(scene->camera),
      speed(default_speed(camera)),
      own_depth(depth),
      motion_end(motion_end_of(*scene)) {}

bool Session::replace(std::shared_ptr<const Scene> newer, bool opened, std::shared_ptr<const Scene> picture) {
    const bool moved = opened || newer->camera != with_lens(scene->camera, newer->camera);
    scene = std::move(newer);
    const bool same = picture && !opened && (tracks || picture->tracks == scene->tracks);
    pictured = same ? std::move(picture) : scene;
    motion_end = motion_end_of(*scene);
    bool lost = false;
    if (opened)
        tracks.reset(), flight.reset(), outside = false, recorded.reset(), editor = PathEditor(path_in(*scene)),
                                        cameras = {}, time = 0;
    else
        lost = editor.reload(path_in(*scene), edits);
    flight.change(path_to_fly());
    if (!bound()) camera = moved ? scene->camera : with_lens(camera, scene->camera);
    if (moved && !bound()) speed = default_speed(camera);
    return lost;
}

void Session::replace_reread(std::shared_ptr<const Scene> newer, std::shared_ptr<const Scene> picture) {
    Camera same = scene->camera;
    same.fov = newer->camera.fov, same.aspectratio = newer->camera.aspectratio;
    const bool reshaped = newer->camera == same && same != scene->camera && !bound();
    Camera kept = camera;
    const double kept_speed = speed;
    const bool own_lens = camera != with_lens(camera, scene->camera);  // by a click
    replace(std::move(newer), false, std::move(picture));
    if (own_lens && !bound()) camera = with_lens(camera, kept);
    if (reshaped) kept.fov = same.fov, kept.aspectratio = same.aspectratio, camera = kept, speed = kept_speed;
}

std::optional<Flythrough> Session::path_to_fly() const {
    const bool keys = editor.path().keys.size() >= 2;
    if (!keys && !motion_end) return std::nullopt;
    const bool clocked = scene->flythrough && scene->flythrough->keys.empty();
    Flythrough all = keys ? editor.path() : clocked ? *scene->flythrough : Flythrough{};
    if (all.loop) return all;
    all.duration = std::max(all.duration, motion_end.value_or(0));
    if (!tracks) return all;
    for (const Track& track : *tracks)
        if (!track.keys.empty()) all.duration = std::max(all.duration, scene->music.time_of(track.keys.back().row));
    return all;
}

Answer Session::perform(Command command, double now) {
    switch (command.action) {
        case Action::play:
            return play(now);
        case Action::pause:
            return pause(now);
        case Action::outside:
            return see_outside(now);
        case Action::rewind:
            return step_to(0, now);
        case Action::to_end:
            return step_to(path_to_fly().value_or(Flythrough{}).duration, now);
        case Action::step:
            return step_to(flight.time(now) + command.number / 25., now);
        case Action::to_key:
            return to_key(command.number, now);
        case Action::add_key:
        case Action::set_key:
        case Action::delete_key:
        case Action::clear_path:
            return edit(command.action, now);
        case Action::undo:
        case Action::redo:
            return undo(command.action == Action::undo, now);
        case Action::record:
            return record(now);
        case Action::copy_path:
            if (editor.path().keys.size() < 2) return {"there is no path to copy", ""};
            return {"path copied", write_flythrough(editor.path(), editor.words)};
        case Action::change_style:
            orbiting = !orbiting;
            return {orbiting ? "orbiting" : "flying freely", ""};
        case Action::reset:
            flight.stop(now);
            camera = scene->camera, speed = default_speed(camera);
            return {"the scene's camera", ""};
        case Action::turn_view:
            flight.stop(now);
            camera = seen_from(camera, command.number);
            return {};
        case Action::deeper:
        case Action::shallower:
            own_depth = std::clamp(depth() + (command.action == Action::deeper ? 1 : -1), 1, 256);
            return {"depth " + std::to_string(depth()), ""};
        case Action::finer:
        case Action::coarser:
            finest = std::clamp(finest + (command.action == Action::finer ? 1 : -1), 0, sharpened_level);
            return {"motion quality: " + (finest == sharpened_level ? "sharpened"
                                          : finest == finest_level  ? "equal distances"
                                                                    : "at most " + resolution_text(finest)),
                    ""};
        case Action::expose:
            return expose(command.number);
        case Action::fill:
            fill = !fill;
            return {!camera.aspectratio ? "this camera has no aspectratio and always fills the window"
                    : fill              ? "the view is widened to fill the window"
                                        : "the camera's own proportions",
                    ""};
        case Action::store:
            cameras[command.number - 1] = camera;
            return {"camera " + std::to_string(command.number) + " stored", ""};
        case Action::recall:
            flight.stop(now);
            return recall(command.number);
        case Action::copy_camera:
            return {"camera copied", write_camera(camera, {}, editor.words)};
        default:
            return {};
    }
}

Answer Session::play(double now) {
    if (flight.under_way())
        return {
            "the flight is played; " + keys.name(Action::pause) + " pauses it, " + keys.name(Action::back) + " ends it",
            ""};
    if (flight.circling())
        flight.run(now);
    else if (auto path = path_to_fly())
        flight.begin(*std::move(path), now);
    else
        flight.circle(orbit_path(camera, scene->camera), now);
    follow(now);
    return {"flying from " + text_of(std::round(100 * flight.time(now)) / 100) + " s", ""};
}

Answer Session::end_flight(double now) {
    if (!flight.flying()) return {};
    flight.stop(now);
    return {"flight ended at " + seconds_text(time), ""};
}

Answer Session::pause(double now) {
    if (!flight.flying()) return play(now);
    if (flight.paused()) return flight.run(now), Answer{"flight continues", ""};
    flight.hold(now);
    // Rounded, so that `render --time` can be given the same moment.
    follow(now);
    flight.set(rounded_time(time), now);
    follow(now);
    return {"paused at " + seconds_text(time), ""};
}

Answer Session::see_outside(double now) {
    outside = !outside;
    follow(now);
    return {outside ? "the flight is seen from outside; " + keys.name(Action::outside) + " goes back"
                    : "the camera of the flight",
            ""};
}

Answer Session::step_to(double seconds, double now) {
    if (!go_to(seconds, now)) return {"there is no path and no motion", ""};
    return {"at " + seconds_text(time), ""};
}

Answer Session::to_key(int step, double now) {
    const std::vector<Keyframe>& keys = editor.path().keys;
    const double from = flight.time(now);
    const Keyframe* found = nullptr;
    for (const Keyframe& key : keys) {
        if (step < 0 && key.time < from - 0.0005) found = &key;
        if (step > 0 && key.time > from + 0.0005 && !found) found = &key;
    }
    if (!found) return {step < 0 ? "no key before this moment" : "no key after this moment", ""};
    const double there = found->time;
    if (!go_to(there, now)) camera = camera_of(*found, scene->camera);  // a single key is no flight yet
    return {"key " + std::to_string(*key_at(editor.path(), there) + 1) + " at " + seconds_text(there), ""};
}

/// Makes the picture brighter or darker by half a stop; with 0 shows light as it is.
Answer Session::expose(int step) {
    if (step == 0) return exposure.reset(), Answer{"light as it is", ""};
    exposure = std::clamp(exposure.value_or(0) + step / 2., -most_exposure, most_exposure);
    return {"exposure " + exposure_text(exposure) + "; " + keys.name(Action::expose) + " shows light as it is", ""};
}

Answer Session::recall(int number) {
    const auto& stored = cameras[number - 1];
    if (!stored)
        return {"no camera is stored as " + std::to_string(number) + "; " + keys.name(Action::store, number) +
                    " stores one",
                ""};
    camera = *stored;
    return {"camera " + std::to_string(number), ""};
}

Answer Session::edit(Action action, double now) {
    const double moment = rounded_time(flight.time(now));
    const auto there = key_at(editor.path(), moment);
    std::string note;
    switch (action) {
        case Action::clear_path:
            note = "new path";
            editor.replace({}, {edits, note}), flight.set(0, now);
            break;
        case Action::set_key:
            note = "key at " + seconds_text(moment) + (there ? " changed" : " set");
            editor.change(with_key(editor.path(), key_of(camera, scene->camera, moment)), {edits, note});
            break;
        case Action::delete_key:
            if (!there)
                return {"no key at " + seconds_text(moment) + "; the nearest are found by " + keys.name(Action::to_key),
                        ""};
            note = "key at " + seconds_text(moment) + " deleted";
            editor.change(without_key(editor.path(), *there), {edits, note});
            break;
        default:
            return add_key(now);
    }
    path_changed(now);
    return {note, ""};
}

Answer Session::add_key(double now) {
    Flythrough longer = continued(editor.path(), key_of(camera, scene->camera, 0), seconds_per_key);
    const std::size_t count = longer.keys.size();
    const double time = longer.keys.back().time;
    const std::string note = "key " + std::to_string(count) + " added at " + seconds_text(time);
    editor.change(std::move(longer), {edits, note});
    flight.stop(now), flight.set(time, now);
    return {note + (count < 2 ? "; a path needs two keys" : ""), ""};
}

std::size_t Session::next_step(bool back) const {
    return std::max(editor.next_step(back, edits), track_keys.next_step(back, edits));
}

/// Takes back the last change of the path or of tracks, or makes it again.
Answer Session::undo(bool back, double now) {
    const bool of_tracks = track_keys.next_step(back, edits) > editor.next_step(back, edits);
    const auto what = of_tracks ? track_keys.undo(back, edits) : editor.undo(back, edits);
    if (!what) return {back ? "nothing to undo" : "nothing to redo", ""};
    of_tracks ? show_tracks(now) : path_changed(now);
    return {(back ? "undone: " : "redone: ") + *what, ""};
}

Answer Session::change_key(std::size_t number, const Keyframe& key, bool merged, double now) {
    const Camera there = camera_of(key, scene->camera);
    const auto within = [](double v) { return coordinates.contains(v); };
    bool sound =
        there.fov > 0 && (there.fov < 90 || angular(there.projection)) && within(key.time) && shares.contains(key.ease);
    for (int i = 0; i < 3; ++i) sound &= within(there.position[i]) && within(there.look_at[i]);
    if (!sound) return {"these values make no camera", ""};
    if (const char* const why = degenerate(there)) return {std::string("the camera sees nothing there: ") + why, ""};
    Flythrough newer = editor.path();
    const double time = newer.keys[number].time;
    newer.keys[number] = key, newer.keys[number].time = time;
    newer = retimed(std::move(newer), number, key.time);
    const double moment = newer.keys[number].time;
    editor.change(std::move(newer), {edits, "key " + std::to_string(number + 1) + " of the path", merged});
    go_to(moment, now);
    return {};
}

bool Session::take_tracks(const std::string& text, bool opened) {
    bool lost = false;
    if (opened)
        track_keys.open(text);
    else
        lost = track_keys.reload(text);
    if (keys_elsewhere) return lost;
    // Once changed they stay instead of the scene's, though these may be the same: what is traced goes on.
    if (opened)
        tracks.reset();
    else if ((tracks || track_keys.changed()) && (!tracks || *tracks != track_keys.tracks()))
        tracks = std::make_shared<const std::vector<Track>>(track_keys.tracks());
    return lost;
}

void Session::change_track(const Track& track, bool merged, double now) {
    track_keys.change(track, {edits, "keys of the track " + track.name, merged});
    show_tracks(now);
}

/// Shows the tracks as they are edited.
void Session::show_tracks(double now) {
    tracks = std::make_shared<const std::vector<Track>>(track_keys.tracks());
    path_changed(now);
}

std::optional<Answer> Session::observe(double now) {
    if (!recorded || (!recorded->empty() && now <= recorded->back().time)) return std::nullopt;
    // The time before the first movement is not part of the recording.
    if (recorded->size() == 1 && recorded->front().camera == camera) recorded->clear();
    recorded->push_back({now, camera});
    if (recorded->size() < most_moments) return std::nullopt;
    return record(now);
}

Answer Session::record(double now) {
    if (!recorded) {
        recorded.emplace();
        observe(now);
        return {"recording: fly by hand, " + keys.name(Action::record) + " ends it", ""};
    }
    const auto moments = *std::exchange(recorded, std::nullopt);
    if (moments.size() < 2) return {"nothing was recorded, because nothing moved", ""};
    const double tolerance = length(scene->camera.look_at - scene->camera.position) / 100;
    const Thinned flown = thinned(moments, scene->camera, tolerance);
    editor.replace(flown.path, {edits, "recorded flight"});
    flight.stop(now), flight.set(0, now);
    char text[120];
    std::snprintf(text, sizeof text, "recorded %.1f s as %zu keys, at most %.2g from the flight", flown.path.duration,
                  flown.path.keys.size(), flown.error);
    return {text, ""};
}

void Session::change_path(Flythrough path, const std::string& what, bool merged, double now) {
    editor.change(std::move(path), {edits, what, merged});
    path_changed(now);
}

void Session::path_changed(double now) {
    if (!flight.flying() || flight.circling()) return;
    flight.change(path_to_fly());
    follow(now);
}

View Session::view(int window_width, int window_height) const {
    const Framing frame = framing(camera, window_width, window_height, fill);
    return {.camera = frame.camera,
            .width = frame.area.width,
            .height = frame.area.height,
            .depth = depth(),
            .error = half_step({.bits = 8, .gamma = scene->settings.assumed_gamma, .exposure = exposure}),
            .time = time,
            .tracks = tracks,
            .moments = moments(window_width, window_height)};
}

/// Returns the moments of an open shutter: the same ones until the camera, the time or the scene changes.
std::shared_ptr<const std::vector<Shot>> Session::moments(int window_width, int window_height) const {
    if (!(camera.shutter > 0)) return nullptr;
    ShutterState now{scene, tracks, camera, time, {}, window_width, window_height, fill};
    if (bound()) now.path = flight.path();
    if (now == shutter) return kept_moments;
    const auto camera_of = [&](double moment) {
        return framing(bound() ? flight_camera(moment) : camera, window_width, window_height, fill).camera;
    };
    kept_moments = shutter_moments(*scene, time, shutter_seconds(camera, FrameRate{}.per_second()), camera_of);
    shutter = std::move(now);
    return kept_moments;
}

bool Session::go_to(double seconds, double now) {
    flight.go_to(seconds, path_to_fly(), now);
    follow(now);
    return flight.flying();
}

Answer Session::steer(const CameraInput& input, double now) {
    std::string note;
    if (bound()) {
        if (flight.under_way())
            note = "flight ended at " + seconds_text(time) + "; " + keys.name(Action::play) + " continues";
        flight.stop(now);
    }
    CameraInput scaled = input;
    // In orbit a push turns by a radian per second.
    const bool around = orbiting || input.around;
    scaled.push *= around ? DVec3(speed / default_speed(scene->camera)) : DVec3(speed);
    scaled.pan = glm::dvec2(0);
    camera = around ? orbit(camera, scaled) : fly(camera, scaled);
    if (input.pan != glm::dvec2(0)) camera = pan(camera, input.pan);
    return {note, ""};
}

Answer Session::change_speed(double factor, double now) {
    char text[80];
    if (bound()) {
        flight.set_rate(std::clamp(flight.rate() * factor, 1e-3, 1e3), now);
        if (std::abs(flight.rate() - 1) < 1e-6) flight.set_rate(1, now);
        std::snprintf(text, sizeof text, "flight at %.3g times its speed", flight.rate());
    } else {
        speed *= factor;
        std::snprintf(text, sizeof text, "speed %.3g a second", speed);
    }
    return {text, ""};
}

Answer Session::turn_wheel(double notches, bool faster, double now) {
    if (faster) return change_speed(std::pow(1.25, notches), now);
    const Answer ended = steer({}, now);
    camera = orbit(camera, {.push = {0, 0, .15 * notches}});
    return ended;
}

Camera Session::flight_camera(double moment) const {
    const Camera own = own_camera_at(*scene, moment, tracks.get());
    const Flythrough& path = flight.flying() ? *flight.path() : editor.path();
    return path.keys.empty() ? own : camera_at(path, own, moment);
}

std::optional<Answer> Session::follow(double now) {
    if (!flight.flying()) return std::nullopt;
    time = flight.time(now);
    if (bound()) camera = flight_camera();
    if (!flight.over(now)) return std::nullopt;
    flight.stop(now);
    return Answer{"end of the flight", ""};
}

std::string seconds_text(double seconds) { return text_of(rounded_time(seconds)) + " s"; }

std::string exposure_text(const Exposure& exposure) {
    if (!exposure) return "";
    return (*exposure > 0 ? "+" : "") + text_of(*exposure) + (std::abs(*exposure) == 1 ? " stop" : " stops");
}

std::string resolution_text(int level) {
    if (level == averaged_level) return "anti-aliased";
    return level == finest_level ? "all pixels" : "1/" + std::to_string(steps_of(level).area()) + " of the pixels";
}

}  // namespace strahl
