// Changes paths, with undo and redo.
#include "show/session/path_editor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "num/vec_math.h"

namespace strahl {
namespace {

constexpr double least_gap = 0.001;  // seconds between keys

/// Makes the path valid in the scene language: the duration reaches to the last key, and a key at the end of a path
/// that loops equals the first.
Flythrough checked(Flythrough path) {
    if (path.keys.empty()) return {};
    path.duration = std::max(path.duration, path.keys.back().time);
    if (path.loop && path.keys.back().time == path.duration) {
        path.keys.back() = path.keys.front();
        path.keys.back().time = path.duration;
    }
    return path;
}

}  // namespace

double rounded_time(double seconds) { return std::round(1000 * seconds) / 1000; }

Keyframe key_of(const Camera& camera, const Camera& scene_camera, double time) {
    const double distance = length(camera.look_at - camera.position);
    const double digit = std::pow(10, 5 - std::floor(std::log10(distance)));
    const auto rounded = [&](const DVec3& v) {
        return DVec3(std::round(v.x * digit) / digit, std::round(v.y * digit) / digit, std::round(v.z * digit) / digit);
    };
    Keyframe key{time, rounded(camera.position), rounded(camera.look_at), {}, {}};
    if (camera.fov != scene_camera.fov) key.fov = camera.fov;
    if (camera.up != scene_camera.up) key.up = camera.up;
    return key;
}

Flythrough with_key(Flythrough path, const Keyframe& key) {
    if (const auto there = key_at(path, key.time)) {
        const auto [time, ease] = std::pair(path.keys[*there].time, path.keys[*there].ease);
        path.keys[*there] = key;
        path.keys[*there].time = time, path.keys[*there].ease = ease;
    } else {
        path.keys.insert(std::ranges::upper_bound(path.keys, key.time, {}, &Keyframe::time), key);
    }
    return checked(std::move(path));
}

Flythrough continued(Flythrough path, Keyframe key, double seconds) {
    if (path.keys.empty()) return key.time = 0, checked({.keys = {key}});
    const Keyframe &first = path.keys.front(), &last = path.keys.back();
    key.time = last.time + seconds;
    if (path.loop && last.time < path.duration)  // the way back to the first key is part of it
        path.duration = std::max(path.duration, key.time + seconds);
    else
        path.loop = path.keys.size() > 1 && key.position == first.position && key.look_at == first.look_at,
        path.duration = std::max(path.duration, key.time);
    path.keys.push_back(key);
    return checked(std::move(path));
}

Flythrough without_key(Flythrough path, std::size_t number) {
    const bool at_end = path.keys[number].time == path.duration;
    path.keys.erase(path.keys.begin() + std::ptrdiff_t(number));
    if (at_end && !path.keys.empty()) path.duration = path.keys.back().time, path.loop = false;
    return checked(std::move(path));
}

Flythrough retimed(Flythrough path, std::size_t number, double time) {
    std::vector<Keyframe>& keys = path.keys;
    const bool at_end = keys[number].time == path.duration;
    const double after = number > 0 ? keys[number - 1].time + least_gap : 0;
    const bool last = number + 1 == keys.size();
    const double before = last ? (path.loop && !at_end ? path.duration : 1e9) : keys[number + 1].time;
    keys[number].time = rounded_time(std::max(std::min(time, before - least_gap), after));
    if (at_end) path.duration = keys[number].time;
    return checked(std::move(path));
}

Flythrough lasting(Flythrough path, double seconds) {
    if (path.keys.empty()) return path;
    path.duration = std::max(rounded_time(seconds), path.keys.back().time + (path.loop ? least_gap : 0));
    return path;
}

Flythrough looped(Flythrough path, double seconds) {
    if (path.keys.size() < 2) return path;
    const Keyframe &first = path.keys.front(), &last = path.keys.back();
    path.loop = !path.loop;
    if (!path.loop)
        path.duration = last.time;
    else if (path.duration == last.time && (last.position != first.position || last.look_at != first.look_at))
        path.duration += seconds;
    return checked(std::move(path));
}

std::optional<std::size_t> key_at(const Flythrough& path, double time) {
    for (std::size_t i = 0; i < path.keys.size(); ++i)
        if (std::abs(path.keys[i].time - time) < least_gap / 2) return i;
    return std::nullopt;
}

bool PathEditor::reload(const std::optional<Flythrough>& in_file, EditOrder& order) {
    Flythrough newer = in_file.value_or(Flythrough{});
    const bool other = newer != saved && newer != present, lost = other && changed();
    if (other) replace(newer, {order, "the file's path"});
    saved = std::move(newer);
    return lost;
}

void PathEditor::change(Flythrough newer, const Edit& edit) {
    if (newer == present) return;
    Flythrough before = std::exchange(present, std::move(newer));
    if (edit.merged && !steps.past.empty()) before = std::move(steps.past.back().change), steps.past.pop_back();
    steps.add(std::move(before), edit);
}

void PathEditor::replace(Flythrough newer, const Edit& edit) {
    if (changed() && newer != present && !present.keys.empty()) replaced.push_back(present);
    change(std::move(newer), edit);
}

std::vector<Flythrough> PathEditor::unwritten() const {
    std::vector<Flythrough> paths = replaced;
    std::erase_if(paths, [this](const Flythrough& path) { return path == saved || path == present; });
    if (changed() && !present.keys.empty()) paths.push_back(present);
    return paths;
}

std::optional<std::string> PathEditor::undo(bool back, EditOrder& order) {
    return steps.move(back, order, [this](Flythrough& path) { std::swap(present, path); });
}

}  // namespace strahl
