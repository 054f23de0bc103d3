// The effect of commands on the camera and its flight.
#include "show/session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "num/decimal.h"
#include "scene/motion.h"
#include "text/write.h"

namespace strahl {
namespace {

constexpr double seconds_per_key = 3;  // of recorded paths

}  // namespace

Session::Session(std::shared_ptr<const Scene> first_scene, std::optional<int> depth)
    : scene(std::move(first_scene)), camera(scene->camera), speed(default_speed(camera)), own_depth(depth) {}

void Session::replace(std::shared_ptr<const Scene> newer, bool opened) {
    const bool moved = opened || newer->camera != scene->camera;
    const bool on_scene_path = path && path == flight_of(*scene);
    if (newer->flythrough != scene->flythrough) recorded = {};  // probably pasted into the file
    scene = std::move(newer);
    if (on_scene_path || opened) path = opened ? std::nullopt : flight_of(*scene);
    if (opened) recorded = {}, cameras = {}, clock = {}, time = 0;
    if (moved && !path) camera = scene->camera, speed = default_speed(camera);
}

Answer Session::perform(Command command, double now) {
    switch (command.action) {
        case Action::play:
            return play(now);
        case Action::pause:
            return pause(now);
        case Action::record:
            return record();
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
        case Action::print_camera:
            return {"camera printed", write_camera(camera)};
        default:
            return {};
    }
}

Answer Session::play(double now) {
    if (flying()) return stop(now), Answer{"flight ended", ""};
    path = recorded.keys.size() >= 2 ? recorded : flight_of(*scene);
    if (!path) path = orbit_path(camera, scene->camera), clock.set(0, now);
    if (!path->loop && clock.at(now) >= path->duration) clock.set(0, now);
    clock.run(now);
    follow(now);
    return {"flying from " + text_of(std::round(100 * clock.at(now)) / 100) + " s", ""};
}

Answer Session::pause(double now) {
    if (!flying()) return play(now);
    if (!clock.running()) return clock.run(now), Answer{"flight continues", ""};
    clock.hold(now);
    follow(now);
    double seconds = clock.at(now);
    if (path->loop && path->duration > 0) seconds -= path->duration * std::floor(seconds / path->duration);
    seconds = std::round(1000 * seconds) / 1000;  // so that `render --time` can be given the same moment
    clock.set(seconds, now);
    follow(now);
    return {"paused at " + text_of(seconds) + " s", ""};
}

Answer Session::record() {
    recorded = with_key(std::move(recorded), camera, scene->camera, seconds_per_key);
    const std::size_t keys = recorded.keys.size();
    return {"key " + std::to_string(keys) + " added" + (keys < 2 ? "; a path needs two" : ""),
            keys < 2 ? "" : write_flythrough(recorded)};
}

Answer Session::recall(int number) {
    const auto& stored = cameras[number - 1];
    if (!stored)
        return {"there is no camera " + std::to_string(number) + "; Shift+" + std::to_string(number) + " stores one",
                ""};
    camera = *stored;
    return {"camera " + std::to_string(number), ""};
}

void Session::stop(double now) {
    clock.hold(now);
    path.reset();
}

bool Session::go_to(double seconds, double now) {
    path = flight_of(*scene);
    if (!path) return false;
    clock.hold(now);
    clock.set(seconds, now);
    follow(now);
    return true;
}

void Session::steer(const CameraInput& input, double now) {
    if (!path || !path->keys.empty()) stop(now);
    CameraInput scaled = input;
    // In orbit a push turns by a radian per second.
    scaled.push *= orbiting ? DVec3(speed / default_speed(scene->camera)) : DVec3(speed);
    camera = orbiting ? orbit(camera, scaled) : fly(camera, scaled);
}

std::optional<Answer> Session::follow(double now) {
    if (!path) return std::nullopt;
    const double seconds = clock.at(now);
    time = seconds;
    if (!path->keys.empty()) camera = camera_at(*path, scene->camera, seconds);
    if (path->loop || seconds < path->duration || !clock.running()) return std::nullopt;
    stop(now);
    return Answer{"end of the flight", ""};
}

std::string resolution_text(int level) {
    if (level == averaged_level) return "anti-aliased";
    return level == finest_level ? "all pixels" : "1/" + std::to_string(1 << (finest_level - level)) + " of the pixels";
}

}  // namespace strahl
