// The effect of commands on the path.
#include <cmath>
#include <cstdio>
#include <utility>

#include "num/vec_math.h"
#include "show/session/session.h"
#include "text/reading/parameter.h"

namespace strahl {
namespace {

constexpr double seconds_per_key = 3;      // of keys that are added
constexpr std::size_t most_moments = 7200;  // of a recorded flight: 2 minutes at 60 pictures per second

}  // namespace

Answer Session::edit(Action action, double now) {
    const double moment = rounded_time(flight_time(now));
    const auto there = key_at(editor.path(), moment);
    std::string note;
    switch (action) {
        case Action::undo:
            note = editor.undo() ? "undone" : "there is nothing to undo";
            break;
        case Action::redo:
            note = editor.redo() ? "redone" : "there is nothing to redo";
            break;
        case Action::clear_path:
            editor.change({}), clock.set(0, now);
            note = "a new path";
            break;
        case Action::set_key:
            editor.change(with_key(editor.path(), key_of(camera, scene->camera, moment)));
            note = "key at " + seconds_text(moment) + (there ? " changed" : " set");
            break;
        case Action::delete_key:
            if (!there) return {"there is no key at " + seconds_text(moment) + "; PgUp and PgDn go to keys", ""};
            editor.change(without_key(editor.path(), *there));
            note = "key at " + seconds_text(moment) + " deleted";
            break;
        default:
            return add_key(now);
    }
    path_changed(now);
    return {note, ""};
}

Answer Session::add_key(double now) {
    editor.change(continued(editor.path(), key_of(camera, scene->camera, 0), seconds_per_key));
    const std::vector<Keyframe>& keys = editor.path().keys;
    stop(now), clock.set(keys.back().time, now);
    return {"key " + std::to_string(keys.size()) + " added at " + seconds_text(keys.back().time) +
                (keys.size() < 2 ? "; a path needs two" : ""),
            ""};
}

Answer Session::change_key(std::size_t number, const Keyframe& key, bool merged, double now) {
    const Camera there = camera_of(key, scene->camera);
    const auto within = [](double v) { return coordinates.contains(v); };
    bool sound = there.fov > 0 && there.fov < 90 && within(key.time);
    for (int i = 0; i < 3; ++i) sound &= within(there.position[i]) && within(there.look_at[i]);
    if (!sound) return {"a camera can't be like this", ""};
    if (const char* const why = degenerate(there)) return {std::string("the camera sees nothing there: ") + why, ""};
    Flythrough newer = editor.path();
    const double time = newer.keys[number].time;
    newer.keys[number] = key, newer.keys[number].time = time;
    newer = retimed(std::move(newer), number, key.time);
    const double moment = newer.keys[number].time;
    editor.change(std::move(newer), merged);
    go_to(moment, now);
    return {};
}

std::optional<Answer> Session::observe(double now) {
    if (!recorded || (!recorded->empty() && now <= recorded->back().time)) return std::nullopt;
    // What comes before the first movement is not part of it.
    if (recorded->size() == 1 && recorded->front().camera == camera) recorded->clear();
    recorded->push_back({now, camera});
    if (recorded->size() < most_moments) return std::nullopt;
    return record(now);
}

Answer Session::record(double now) {
    if (!recorded) {
        recorded.emplace();
        observe(now);
        return {"recording: fly by hand, K ends it", ""};
    }
    const auto moments = *std::exchange(recorded, std::nullopt);
    if (moments.size() < 2) return {"nothing moved, nothing is recorded", ""};
    const double tolerance = length(scene->camera.look_at - scene->camera.position) / 100;
    const Thinned flown = thinned(moments, scene->camera, tolerance);
    editor.change(flown.path);
    stop(now), clock.set(0, now);
    char text[120];
    std::snprintf(text, sizeof text, "recorded %.1f s: %zu keys, nowhere farther than %.2g from the flight",
                  flown.path.duration, flown.path.keys.size(), flown.error);
    return {text, ""};
}

void Session::path_changed(double now) {
    if (!path || around) return;
    path = flight();
    follow(now);
}

}  // namespace strahl
