// The effect of commands on the camera and its flight.
#include "show/session/session.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "num/decimal.h"
#include "num/vec_math.h"
#include "scene/moving_scene.h"
#include "text/write.h"

namespace strahl {
namespace {

std::optional<double> motion_end_of(const Scene& scene) {
    const Movers movers(scene);
    return movers.any() || !scene.camera_follows.empty() ? std::optional(movers.last_key) : std::nullopt;
}

}  // namespace

Session::Session(std::shared_ptr<const Scene> first_scene, std::optional<int> depth)
    : scene(std::move(first_scene)),
      editor(scene->flythrough),
      camera(scene->camera),
      speed(default_speed(camera)),
      own_depth(depth),
      motion_end(motion_end_of(*scene)) {}

void Session::replace(std::shared_ptr<const Scene> newer, bool opened) {
    const bool moved = opened || newer->camera != scene->camera;
    scene = std::move(newer);
    motion_end = motion_end_of(*scene);
    if (opened)
        tracks.reset(), path.reset(), recorded.reset(), editor = PathEditor(scene->flythrough), cameras = {},
                                                        clock = {}, time = 0;
    else
        editor.reload(scene->flythrough);
    if (path && !around) path = flight();
    if (moved && !path) camera = scene->camera, speed = default_speed(camera);
}

std::optional<Flythrough> Session::flight() const {
    const bool keys = editor.path().keys.size() >= 2;
    if (!keys && !motion_end) return std::nullopt;
    Flythrough all = keys ? editor.path() : Flythrough{};
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
        case Action::rewind:
            return step_to(0, now);
        case Action::to_end:
            return step_to(flight().value_or(Flythrough{}).duration, now);
        case Action::step:
            return step_to(flight_time(now) + command.number / 25., now);
        case Action::to_key:
            return to_key(command.number, now);
        case Action::add_key:
        case Action::set_key:
        case Action::delete_key:
        case Action::clear_path:
        case Action::undo:
        case Action::redo:
            return edit(command.action, now);
        case Action::record:
            return record(now);
        case Action::copy_path:
            if (editor.path().keys.size() < 2) return {"there is no path to copy", ""};
            return {"path copied", write_flythrough(editor.path())};
        case Action::change_style:
            orbiting = !orbiting;
            return {orbiting ? "orbiting" : "flying freely", ""};
        case Action::reset:
            stop(now);
            camera = scene->camera, speed = default_speed(camera);
            return {"the scene's camera", ""};
        case Action::deeper:
        case Action::shallower:
            own_depth = std::clamp(depth() + (command.action == Action::deeper ? 1 : -1), 1, 256);
            return {"depth " + std::to_string(depth()), ""};
        case Action::finer:
        case Action::coarser:
            finest = std::clamp(finest + (command.action == Action::finer ? 1 : -1), 0, finest_level);
            return {"in motion at most " + resolution_text(finest), ""};
        case Action::store:
            cameras[command.number - 1] = camera;
            return {"camera " + std::to_string(command.number) + " stored", ""};
        case Action::recall:
            stop(now);
            return recall(command.number);
        case Action::copy_camera:
            return {"camera copied", write_camera(camera)};
        default:
            return {};
    }
}

Answer Session::play(double now) {
    if (flying()) return stop(now), Answer{"flight ended", ""};
    path = flight();
    around = !path;
    const bool over = !path || (!path->loop && !driven && clock.at(now) >= path->duration);
    if (around) path = orbit_path(camera, scene->camera);
    clock.set(over ? 0 : flight_time(now), now);
    clock.run(now);
    follow(now);
    return {"flying from " + text_of(std::round(100 * clock.at(now)) / 100) + " s", ""};
}

Answer Session::pause(double now) {
    if (!flying()) return play(now);
    if (!clock.running()) return clock.run(now), Answer{"flight continues", ""};
    clock.hold(now);
    // To a moment that `render --time` can be given.
    follow(now);
    clock.set(rounded_time(time), now);
    follow(now);
    return {"paused at " + seconds_text(time), ""};
}

Answer Session::step_to(double seconds, double now) {
    if (!go_to(seconds, now)) return {"there is no path, and nothing moves", ""};
    return {"at " + seconds_text(time), ""};
}

Answer Session::to_key(int step, double now) {
    const std::vector<Keyframe>& keys = editor.path().keys;
    const double from = flight_time(now);
    const Keyframe* found = nullptr;
    for (const Keyframe& key : keys) {
        if (step < 0 && key.time < from - 0.0005) found = &key;
        if (step > 0 && key.time > from + 0.0005 && !found) found = &key;
    }
    if (!found) return {step < 0 ? "there is no key before" : "there is no key after", ""};
    const double there = found->time;
    if (!go_to(there, now)) camera = camera_of(*found, scene->camera);  // a single key is no flight yet
    return {"key " + std::to_string(*key_at(editor.path(), there) + 1) + " at " + seconds_text(there), ""};
}

Answer Session::recall(int number) {
    const auto& stored = cameras[number - 1];
    if (!stored)
        return {"there is no camera " + std::to_string(number) + "; Shift+" + std::to_string(number) + " stores one",
                ""};
    camera = *stored;
    return {"camera " + std::to_string(number), ""};
}

double Session::flight_time(double now) const {
    const double seconds = clock.at(now);
    const bool loops = path && path->loop && path->duration > 0;
    return loops ? seconds - path->duration * std::floor(seconds / path->duration) : seconds;
}

void Session::stop(double now) {
    clock.set(flight_time(now), now), clock.hold(now);
    path.reset();
}

bool Session::go_to(double seconds, double now) {
    path = flight(), around = false;
    clock.hold(now);
    if (!path) return clock.set(std::max(seconds, 0.), now), false;
    clock.set(path->loop ? seconds : std::clamp(seconds, 0., driven ? seconds : path->duration), now);
    follow(now);
    return true;
}

Answer Session::steer(const CameraInput& input, double now) {
    std::string note;
    if (bound()) {
        if (clock.running()) note = "flight ended at " + seconds_text(time) + "; F continues";
        stop(now);
    }
    CameraInput scaled = input;
    // In orbit a push turns by a radian per second.
    scaled.push *= orbiting ? DVec3(speed / default_speed(scene->camera)) : DVec3(speed);
    camera = orbiting ? orbit(camera, scaled) : fly(camera, scaled);
    return {note, ""};
}

Answer Session::change_speed(double factor, double now) {
    char text[80];
    if (bound()) {
        clock.set_rate(std::clamp(clock.rate() * factor, 1e-3, 1e3), now);
        if (std::abs(clock.rate() - 1) < 1e-6) clock.set_rate(1, now);
        std::snprintf(text, sizeof text, "flight at %.3g times its speed", clock.rate());
    } else {
        speed *= factor;
        std::snprintf(text, sizeof text, "speed %.3g a second", speed);
    }
    return {text, ""};
}

std::optional<Answer> Session::follow(double now) {
    if (!path) return std::nullopt;
    const double seconds = time = flight_time(now);
    if (bound()) {
        camera = own_camera_at(*scene, seconds, tracks.get());
        if (!path->keys.empty()) camera = camera_at(*path, camera, seconds);
    }
    const bool over = !driven && (!path->loop || once) && clock.at(now) >= path->duration;
    if (!over || !clock.running()) return std::nullopt;
    stop(now);
    return Answer{"end of the flight", ""};
}

std::string seconds_text(double seconds) { return text_of(rounded_time(seconds)) + " s"; }

std::string resolution_text(int level) {
    if (level == averaged_level) return "anti-aliased";
    return level == finest_level ? "all pixels" : "1/" + std::to_string(1 << (finest_level - level)) + " of the pixels";
}

}  // namespace strahl
