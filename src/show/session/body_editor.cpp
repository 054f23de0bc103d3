#include "show/session/body_editor.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "num/vec_math.h"
#include "pov/literals.h"
#include "scene/overlap.h"
#include "show/session/handles.h"
#include "text/light_text.h"

namespace strahl {

Ray<double> ray_at(const View& view, double x, double y) {
    const CameraFrame frame = frame_of(view.camera, double(view.width) / view.height);
    const double across = 2 * x / view.width - 1, below = 2 * y / view.height - 1;
    const auto ray = camera_ray(view.camera, frame, across, below, eye_at(view.camera, across, below));
    return {view.camera.position + ray.start, normalize(ray.way), -1};
}

Camera approached(const Camera& camera, const Box& box, double aspect) {
    const CameraFrame frame = frame_of(camera, aspect);
    const double radius = 1.2 * length(box.high - box.low) / 2, half = std::min(frame.tan_x, frame.tan_y);
    double distance = radius / std::sin(angular(camera.projection) ? std::min(half, 1.) : std::atan(half));
    // The picture of an orthographic camera grows with the distance of look_at.
    if (camera.projection == Projection::orthographic)
        distance = std::max(radius, radius * length(camera.look_at - camera.position) / half);
    Camera moved = camera;
    moved.look_at = box.centre();
    moved.position = moved.look_at - distance * frame.forward;
    return moved;
}

namespace {

/// Returns the bodies along a ray that are not hidden.
std::vector<BodyHit> seen_along(const Scene& scene, const Ray<double>& ray, const std::set<int>& hidden) {
    std::vector<BodyHit> met = bodies_along(scene, ray);
    std::erase_if(met, [&](const BodyHit& hit) { return hidden.contains(hit.body); });
    return met;
}

}  // namespace

StandingPlace standing_place(const Scene& scene, const View& view, double x, double y, const std::set<int>& hidden) {
    const Ray<double> ray = ray_at(view, x, y);
    const CameraFrame frame = frame_of(view.camera, double(view.width) / view.height);
    const std::vector<BodyHit> met = seen_along(scene, ray, hidden);
    StandingPlace place{.normal = DVec3(0) - frame.down};
    double distance = length(view.camera.look_at - view.camera.position);
    if (!met.empty()) {
        const DVec3& normal = met[0].hit.normal;
        place.normal = dot_product(normal, ray.direction) > 0 ? DVec3(0) - normal : normal;
        distance = met[0].hit.t;
    }
    place.point = ray.origin + distance * ray.direction;
    double pixel = 2 * frame.tan_y / view.height;
    if (view.camera.projection != Projection::orthographic)
        pixel *= distance * std::abs(dot_product(ray.direction, frame.forward));
    place.size = round_length(pixel * view.height / 12), place.decimals = decimals_of(pixel);
    return place;
}

void BodyEditor::click(const Scene& now, const Scene& scene, const View& view, double x, double y,
                       const std::set<int>& hidden, bool adds) {
    const Ray<double> ray = ray_at(view, x, y), beside = ray_at(view, x + 1, y);
    if (adds) {
        const std::vector<BodyHit> met = seen_along(now, ray, hidden);
        if (!met.empty()) add(met[0].body, ray.origin + met[0].hit.t * ray.direction, scene);
        return;
    }
    const auto same_point = [&](DVec3 Ray<double>::*part) {
        return length(*clicked.*part - ray.*part) <= 3 * length(beside.*part - ray.*part);
    };
    const bool again = chosen && clicked && same_point(&Ray<double>::origin) && same_point(&Ray<double>::direction);
    const Ray<double> along = again ? *clicked : ray;
    const std::vector<BodyHit> met = seen_along(now, along, hidden);
    const int number = again ? chosen->behind + 1 : 0;
    close(), clicked = along, allowed.clear(), description = {};
    if (number >= std::ssize(met)) return;
    const BodyHit& at = met[std::size_t(number)];
    chosen = {at, number, along.origin + at.hit.t * along.direction};
    look(scene);
}

void BodyEditor::choose(const LightPoint& point, const Scene& scene) {
    close(), clicked.reset(), allowed.clear(), description = {};
    chosen_light = point;
    look(scene);
}

void BodyEditor::choose(int body, const DVec3& point, const Scene& scene, int leaf) {
    close(), clicked.reset(), allowed.clear(), description = {};
    chosen = {.at = {.body = body, .hit = {.leaf = leaf}}, .point = point};
    look(scene);
}

void BodyEditor::choose(TopBlock block, const Scene& scene) {
    close(), clicked.reset(), allowed.clear(), description = {};
    chosen_block = block;
    look(scene);
}

void BodyEditor::add(int body, const DVec3& point, const Scene& scene) {
    std::vector<int> before = bodies();
    if (std::erase(before, body) == 0) {
        choose(body, point, scene);
        others = std::move(before);
    } else if (before.empty()) {
        close();
    } else {
        const int last = before.back();
        const Box box = world_bounds(scene.primitives[std::size_t(last)]);
        choose(last, box.finite() ? box.centre() : point, scene);
        before.pop_back();
        others = std::move(before);
    }
}

std::vector<int> BodyEditor::bodies() const {
    std::vector<int> all = others;
    if (chosen) all.push_back(chosen->at.body);
    std::ranges::sort(all);
    return all;
}

void BodyEditor::choose_next(std::vector<int> numbers, const Scene& scene) {
    if (chosen) {
        chosen->at.body = numbers.back();
        numbers.pop_back();
        others = std::move(numbers);
    } else if (chosen_light) {
        chosen_light->light = numbers.back();
    }
    description = {};
    look(scene);
}

void BodyEditor::find_point(const Scene& scene) {
    if (!chosen || !clicked || chosen->at.body >= std::ssize(scene.primitives)) return;
    const auto hits = ray_hits(scene.primitives[std::size_t(chosen->at.body)], *clicked, 0);
    if (hits.empty()) return;
    chosen->at.hit.t = hits[0].t, chosen->point = clicked->origin + hits[0].t * clicked->direction;
}

void BodyEditor::look(const Scene& scene) {
    other_file.clear();
    static const std::string none;
    const std::string& text = povray || model ? none : edited.text();
    if (chosen_light) {
        if (chosen_light->light >= std::ssize(scene.lights)) return close();
        chosen_light->target &= scene.lights[std::size_t(chosen_light->light)].spot.has_value();
        description = light_text(text, scene, chosen_light->light);
        look_at_literals(lines.lights, chosen_light->light);
    }
    if (chosen_block)
        description = *chosen_block == TopBlock::camera ? camera_values(text, scene) : background_values(text, scene);
    if (!chosen) return;
    if (chosen->at.body >= std::ssize(scene.primitives)) return close();
    std::erase_if(others, [&](int body) { return body >= std::ssize(scene.primitives); });
    const std::string before = description.kind;
    description = body_text(text, scene, chosen->at.body, chosen->at.hit.leaf);
    look_at_literals(lines.bodies, chosen->at.body);
    const auto body = std::size_t(chosen->at.body);
    if (body < lines.names.size() && !lines.names[body].empty() && !description.kind.empty())
        description.kind += " '" + lines.names[body] + "'";
    if (description.kind.empty() || (!before.empty() && description.kind != before)) close();
}

/// Finds the line of the body or the light chosen in a text for POV-Ray, and its numbers in it, which come before those
/// of the scene. `places` are those of all bodies, or of all lights.
void BodyEditor::look_at_literals(const std::vector<pov::SourceLines::BlockLine>& places, int number) {
    if (!povray || std::size_t(number) >= places.size()) return;
    const pov::SourceLines::BlockLine& place = places[std::size_t(number)];
    description.line = place.number, other_file = lines.files[place.file];
    if (!place.at) return;
    // Until a changed text was read, what is behind its first change stands further along by what the text has grown.
    const std::string& text = edited.text();
    const auto same = std::ranges::mismatch(text, lines_text).in1 - text.begin();
    const std::size_t at = *place.at < std::size_t(same) ? *place.at : *place.at + text.size() - lines_text.size();
    std::vector<BodyValue> values = pov::literals_of(text, at);
    const auto makes = std::ranges::count(places, place.at, &pov::SourceLines::BlockLine::at);
    for (BodyValue& value : values)
        if (makes > 1 && value.source.empty())
            value.source = "line " + std::to_string(place.number) + ", which makes " + std::to_string(makes) +
                           (chosen ? " bodies" : " lights");
    description.values.insert(description.values.begin(), values.begin(), values.end());
}

bool BodyEditor::open_to_change(const BodyValue& value) const {
    if (!value.fixed.empty()) return false;
    return value.slices.empty() ? value.own_at > 0 : value.source.empty() || allowed.contains(value.source);
}

const char* BodyEditor::why_read_only() const {
    const bool open = std::ranges::any_of(description.values, [](const BodyValue& v) { return v.fixed.empty(); });
    return model                   ? "read only: a model is changed by the program that made it"
           : edited.text().empty() ? "read only: this text is changed in an editor"
           : open                  ? "numbers that stand in the text are changed here"
                                   : "read only: the text computes these numbers";
}

std::string BodyEditor::name() const {
    if (chosen_block) return *chosen_block == TopBlock::camera ? "the camera" : "the background";
    return description.kind.substr(0, description.kind.find_first_of(" ,(")) + " " + std::to_string(number() + 1);
}

std::string BodyEditor::names() const {
    return others.empty() ? name() : std::to_string(others.size() + 1) + " bodies";
}

bool BodyEditor::change(const BodyValue& value, std::span<const double> numbers, EditOrder& order, bool merged) {
    if (!open_to_change(value)) return false;
    std::vector<double> within(numbers.begin(), numbers.end());
    for (double& number : within) {
        if (!(number == number)) return false;
        number = std::clamp(number, value.range.low, value.range.high);
    }
    const std::string& before = edited.text();
    return edited.change(
        value.slices.empty() ? with_own_value(before, value, within) : with_numbers(before, value, within),
        {order, value.name + " of " + name(), merged});
}

bool BodyEditor::make_own(const BodyValue& value, EditOrder& order) {
    if (value.own_at == 0 || !value.fixed.empty()) return false;
    edited.change(with_own_value(edited.text(), value, value.numbers), {order, "own " + value.name + " of " + name()});
    return true;
}

}  // namespace strahl
