#include "show/window/path_marks.h"

#include "num/vec_math.h"
#include "show/session/handles.h"

namespace strahl {

PathMarks path_marks(const Flythrough& path, const Camera& scene_camera, std::optional<double> time, const View& view) {
    constexpr int steps = 400;
    constexpr double look = .15;  // of the way to look_at
    PathMarks marks;
    // Leaves out what is around the eye: it would cover the picture.
    const double nearest = length(view.camera.look_at - view.camera.position) / 20;
    const auto place = [&](const DVec3& point) {
        return length(point - view.camera.position) < nearest ? std::nullopt : place_in(view, point);
    };
    const auto mark = [&](const Camera& camera) {
        const auto at = place(camera.position);
        const auto to = place_in(view, camera.position + look * (camera.look_at - camera.position));
        if (at && to) marks.looks.push_back({*at, *to});
        return at;
    };
    for (const Keyframe& key : path.keys)
        if (const auto at = mark(camera_of(key, scene_camera))) marks.keys.push_back(*at);
    if (path.keys.size() < 2) return marks;
    bool seen = false;
    for (int i = 0; i <= steps; ++i) {
        const double moment = path.duration * i / steps;
        const auto at = place(camera_at(path, scene_camera, moment).position);
        if (at && !seen) marks.lines.emplace_back();
        if (at) marks.lines.back().push_back(*at);
        seen = at.has_value();
    }
    if (time) marks.now = mark(camera_at(path, scene_camera, *time));
    return marks;
}

}  // namespace strahl
