// Draws the timeline with ImGui.
#include "show/window/timeline.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "scene/moving_scene.h"
#include "show/session/divider.h"
#include "show/session/track_keys.h"
#include "show/window/body_panel.h"
#include "text/blocks/blocks.h"

namespace strahl {
namespace {

constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize;
constexpr ImU32 line_color = IM_COL32(255, 255, 255, 70), text_color = IM_COL32(255, 255, 255, 150),
                key_color = IM_COL32(140, 204, 255, 255), here_color = IM_COL32(255, 190, 90, 255),
                sound_color = IM_COL32(120, 160, 120, 120), beat_color = IM_COL32(255, 255, 255, 26),
                curve_color = IM_COL32(150, 230, 150, 255);
constexpr float most_lanes = 4;                          // of tracks that are seen at once
constexpr float lane_lines = 2.4f, motion_lines = 1.2f;  // of text, the heights of lanes

/// Returns the seconds between marks, so that there are at most 20: 1, 2 or 5 times a power of ten.
double mark_interval(double range) {
    const double least = range / 20, ten = std::pow(10, std::floor(std::log10(least)));
    for (const double factor : {1., 2., 5.})
        if (factor * ten >= least) return factor * ten;
    return 10 * ten;
}

}  // namespace

TimelineInput Timeline::draw(const TimelineView& view) {
    TimelineInput input;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float edge = ImGui::GetFontSize() * 0.8f;
    ImGui::SetNextWindowPos({edge, size.y - edge}, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowSizeConstraints({size.x - 2 * edge, 0}, {size.x - 2 * edge, size.y});
    ImGui::Begin("timeline", nullptr, flags);
    if (known != view.scene) known = view.scene, followed = followed_tracks(*known), motions = motions_of(*known);
    // One of them is always chosen: the timeline must not grow between the clicks of a double click.
    if (!followed.empty() && std::ranges::find(followed, chosen) == followed.end()) chosen = followed[0];
    if (!ImGui::IsAnyItemActive()) value_held = false;
    buttons(view, input);
    show_range(view);
    bar(view, input);
    lanes(view, input);
    values(view, input);
    track_values(view, input);
    music(view, input);
    tall = ImGui::GetWindowHeight() + edge;
    ImGui::End();
    return input;
}

void Timeline::buttons(const TimelineView& view, TimelineInput& input) {
    const auto button = [&](const char* label, Command command) {
        if (ImGui::SmallButton(label)) input.command = command;
        ImGui::SameLine();
    };
    button("|<", {Action::rewind});
    button("<", {Action::to_key, -1});
    button(view.running ? "pause" : "play", {Action::pause});
    button(">", {Action::to_key, 1});
    button(">|", {Action::to_end});
    ImGui::Text(" %.3f of %g s ", view.time, view.duration);
    ImGui::SameLine();
    button("add", {Action::add_key});
    button("set", {Action::set_key});
    button("delete", {Action::delete_key});
    button("undo", {Action::undo});
    button("redo", {Action::redo});
    button("new", {Action::clear_path});
    button("write", {Action::write_path});
    button(view.outside ? "inside" : "outside", {Action::outside});
    button("both", {Action::second, int(SecondKind::flight)});
    if (const Flythrough& path = view.editor.path(); path.keys.size() >= 2) {
        if (ImGui::SmallButton(path.loop ? "no loop" : "loop")) input.path = {looped(path, 3), false};
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("closes the path, or ends it with its last key");
        ImGui::SameLine();
    }
    const char* const state = view.editor.changed() || view.keys_changed ? "not written" : "";
    if (ImGui::CalcTextSize(state).x > ImGui::GetContentRegionAvail().x) ImGui::NewLine();
    ImGui::TextUnformatted(state);
}

/// Finds what part of the flight and of the sound is shown.
void Timeline::show_range(const TimelineView& view) {
    const float font = ImGui::GetFontSize();
    left = ImGui::GetCursorScreenPos().x + font;
    length = std::max(ImGui::GetContentRegionAvail().x - 2 * font, 1.f);
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
    const double all = std::max({1.15 * view.duration, double(view.peaks.size()) / 100, 10.});
    range = all / zoomed;
    const bool moved = view.time != std::exchange(shown_time, view.time);
    if (moved && (view.time < from || view.time > from + range)) from = view.time - .1 * range;
    from = std::clamp(from, 0., all - range);
}

/// Follows the wheel over what was drawn last, around the pointer.
void Timeline::zoom() {
    const float notches = ImGui::GetIO().MouseWheel;
    if (notches == 0 || !ImGui::IsItemHovered()) return;
    const double at = time_at(ImGui::GetIO().MousePos.x), before = zoomed;
    zoomed = std::clamp(zoomed * std::pow(1.25, double(notches)), 1., 1000.);
    from = at - (at - from) * before / zoomed;
}

/// Draws the sound as far as it is shown.
void Timeline::draw_sound(const TimelineView& view, float top, float bottom) const {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float middle = (top + bottom) / 2;
    const auto count = double(view.peaks.size());
    for (float x = left; x < left + length; ++x) {
        const double begin = 100 * time_at(x), end = std::max(100 * time_at(x + 1), begin + 1);
        if (begin < 0 || begin >= count) continue;
        const auto first = view.peaks.begin() + std::ptrdiff_t(begin);
        const float peak = *std::max_element(first, view.peaks.begin() + std::ptrdiff_t(std::min(end, count - 1)) + 1);
        const float half = peak * (bottom - top) / 2;
        list.AddLine({x, middle - half}, {x, middle + half}, sound_color);
    }
}

/// Draws beats, every fourth one brighter, and rows, as far as there is room for them.
void Timeline::draw_grid(const Music& music, float top, float bottom) const {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto draw = [&](double seconds, float least, ImU32 color) {
        const double pixels = double(length) * seconds / range;
        if (!(pixels >= double(least))) return;
        const double first = std::max(std::ceil((from - music.offset) / seconds), 0.);
        for (double time = 0, i = first; (time = music.offset + i * seconds) <= from + range; ++i)
            list.AddLine({x_of(time), top}, {x_of(time), bottom}, color);
    };
    const double row = music.time_of(1) - music.offset;
    draw(row, 7, beat_color), draw(music.rows * row, 4, beat_color), draw(4 * music.rows * row, 4, line_color);
}

void Timeline::draw_moment(const TimelineView& view, float top, float bottom) const {
    const float x = x_of(view.time);
    if (x >= left && x <= left + length) ImGui::GetWindowDrawList()->AddLine({x, top}, {x, bottom}, here_color, 2);
}

void Timeline::bar(const TimelineView& view, TimelineInput& input) {
    const std::vector<Keyframe>& keys = view.editor.path().keys;
    const float font = ImGui::GetFontSize(), height = 2.4f * font;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("bar", {length + 2 * font, height});
    zoom();
    const bool held = ImGui::IsItemActive();
    const double pointed = time_at(ImGui::GetIO().MousePos.x);
    const double grip = double(font / 2 / length) * range;  // seconds beside a key that belong to it

    std::optional<std::size_t> near;  // the key under the pointer
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (std::abs(keys[i].time - pointed) < grip &&
            (!near || std::abs(keys[i].time - pointed) < std::abs(keys[*near].time - pointed)))
            near = i;
    if (near && ImGui::IsItemHovered()) {
        if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) input.go_to = keys[*near].time, ImGui::OpenPopup("key");
        if (!held) ImGui::SetTooltip("ease %g: the right button changes it", keys[*near].ease);
    }

    const float middle = corner.y + 0.7f * font;
    const bool has_path = keys.size() >= 2;
    if (ImGui::IsItemActivated()) {
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        // The end has its handle below the line, where that of the last key is not.
        end_dragged = has_path && mouse.y > middle && std::abs(mouse.x - x_of(view.editor.path().duration)) < font / 2;
        dragged = end_dragged ? std::nullopt : near, drag_began = false;
        if (dragged) input.go_to = keys[*dragged].time;
    }
    if (held && end_dragged && has_path && ImGui::IsMouseDragging(0, 3)) {
        Flythrough path = lasting(view.editor.path(), std::round(100 * std::clamp(pointed, 0., from + range)) / 100);
        if (path != view.editor.path()) input.path = {std::move(path), std::exchange(drag_began, true)};
    }
    if (held && !dragged && !end_dragged) input.go_to = std::clamp(pointed, 0., view.duration);
    if (held && dragged && *dragged < keys.size() && ImGui::IsMouseDragging(0, 3)) {
        Keyframe moved = keys[*dragged];
        moved.time = std::round(100 * std::clamp(pointed, 0., from + range)) / 100;
        if (moved.time != keys[*dragged].time) input.change = {*dragged, moved, std::exchange(drag_began, true)};
    }

    draw_sound(view, corner.y, corner.y + height);
    if (!followed.empty() || view.scene->music != Music{}) draw_grid(view.scene->music, corner.y, corner.y + height);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImGui::PushClipRect({left - font, corner.y}, {left + length + font, corner.y + height}, true);
    list.AddLine({x_of(0), middle}, {x_of(view.duration), middle}, line_color, 2);
    const double step = mark_interval(range);
    for (double i = std::ceil(from / step); i * step <= from + range; ++i) {
        const float x = x_of(i * step);
        list.AddLine({x, middle - font / 4}, {x, middle + font / 4}, line_color);
        char text[32];
        std::snprintf(text, sizeof text, "%g", i * step);
        list.AddText({x - ImGui::CalcTextSize(text).x / 2, middle + 0.6f * font}, text_color, text);
    }
    if (has_path) {
        const float end = x_of(view.editor.path().duration);
        list.AddTriangleFilled({end, middle}, {end + .35f * font, middle + .7f * font},
                               {end - .35f * font, middle + .7f * font}, key_color);
    }
    const auto here = key_at(view.editor.path(), view.time);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const float x = x_of(keys[i].time), r = 0.4f * font;
        const ImU32 color = here == i ? here_color : key_color;
        if (keys[i].ease == 0) {
            list.AddQuadFilled({x - r, middle}, {x, middle - r}, {x + r, middle}, {x, middle + r}, color);
            continue;
        }
        list.AddTriangleFilled({x - r, middle - r}, {x + r, middle - r}, {x, middle}, color);
        list.AddTriangleFilled({x + r, middle + r}, {x - r, middle + r}, {x, middle}, color);
    }
    draw_moment(view, corner.y, middle + 0.6f * font);
    ImGui::PopClipRect();
    key_menu(view, input);
}

/// Draws the menu of the key of this moment, if it is open.
void Timeline::key_menu(const TimelineView& view, TimelineInput& input) {
    if (!ImGui::BeginPopup("key")) return;
    if (const auto here = key_at(view.editor.path(), view.time)) {
        Keyframe key = view.editor.path().keys[*here];
        const Parameter ease = ease_parameter(key.ease)[0];
        ImGui::AlignTextToFramePadding();
        ImGui::Text("key %d: %s", static_cast<int>(*here) + 1, ease.name.data());
        ImGui::SameLine();
        ImGui::SetNextItemWidth(10 * ImGui::GetFontSize());
        if (draw_share(key.ease)) input.change = {*here, key, std::exchange(value_held, true)};
        ImGui::TextDisabled("%s", ease.help);
    }
    ImGui::EndPopup();
}

/// Draws a lane for each track that something follows, and for each motion.
void Timeline::lanes(const TimelineView& view, TimelineInput& input) {
    if (followed.empty() && motions.empty()) return;
    const float font = ImGui::GetFontSize(), space = ImGui::GetStyle().ItemSpacing.y;
    const float all =
        float(followed.size()) * (lane_lines * font + space) + float(motions.size()) * (motion_lines * font + space);
    ImGui::BeginChild("lanes", {0, std::min(all, most_lanes * (lane_lines * font + space))}, false,
                      ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav);
    for (std::size_t i = 0; i < followed.size(); ++i) {
        const auto known_track = std::ranges::find(view.tracks, followed[i], &Track::name);
        ImGui::PushID(static_cast<int>(i));
        lane(view, known_track == view.tracks.end() ? Track{followed[i], {}} : *known_track, input);
        ImGui::PopID();
    }
    for (std::size_t i = 0; i < motions.size(); ++i) {
        ImGui::PushID(static_cast<int>(followed.size() + i));
        motion_lane(view, motions[i], input);
        ImGui::PopID();
    }
    ImGui::EndChild();
}

/// Draws the keys of a motion. A click goes there, a double click adds a key, drags move keys in time, and the right
/// button removes one.
void Timeline::motion_lane(const TimelineView& view, const SceneMotion& motion, TimelineInput& input) {
    using Change = TimelineInput::MotionChange;
    const float font = ImGui::GetFontSize(), height = motion_lines * font, grip = .6f * font;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("motion", {std::max(left + length - corner.x, 1.f), height});
    zoom();
    const float pointed = ImGui::GetIO().MousePos.x;
    const double seconds = std::max(time_at(pointed), 0.);
    const auto distance = [&](std::size_t key) { return std::abs(x_of(motion.times[key]) - pointed); };
    std::size_t near = 0;
    for (std::size_t i = 1; i < motion.times.size(); ++i)
        if (distance(i) < distance(near)) near = i;
    const bool on_key = distance(near) < grip;
    if (ImGui::IsItemActivated()) {
        dragged = on_key ? std::optional(near) : std::nullopt, drag_began = false;
        input.go_to = on_key ? motion.times[near] : seconds;
        if (!on_key && view.text_open && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
            input.motion = {Change::add, motion, 0, seconds, false};
    }
    if (ImGui::IsItemActive() && dragged && view.text_open && ImGui::IsMouseDragging(0, 3))
        input.motion = {Change::move, motion, *dragged, seconds, std::exchange(drag_began, true)};
    if (ImGui::IsItemHovered() && on_key && view.text_open && ImGui::IsMouseClicked(ImGuiMouseButton_Right))
        input.motion = {Change::remove, motion, near, seconds, false};

    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float middle = corner.y + height / 2, r = .35f * font;
    list.AddRectFilled(corner, {left + length, corner.y + height}, beat_color);
    ImGui::PushClipRect({corner.x, corner.y}, {left + length + font, corner.y + height}, true);
    list.AddLine({x_of(motion.times.front()), middle}, {x_of(motion.times.back()), middle}, line_color, 2);
    for (const double time : motion.times)
        list.AddQuadFilled({x_of(time) - r, middle}, {x_of(time), middle - r}, {x_of(time) + r, middle},
                           {x_of(time), middle + r}, key_color);
    const ImVec2 at{left + .6f * font, corner.y + .1f * font}, size = ImGui::CalcTextSize(motion.name.c_str());
    list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, ImGui::GetColorU32(ImGuiCol_WindowBg));
    list.AddText(at, text_color, motion.name.c_str());
    draw_moment(view, corner.y, corner.y + height);
    ImGui::PopClipRect();
}

/// Draws a track as a curve with its keys. A click chooses it and goes there, a double click adds a key there, and the
/// right button removes one.
void Timeline::lane(const TimelineView& view, const Track& track, TimelineInput& input) {
    const Music& music = view.scene->music;
    const std::vector<TrackKey>& keys = track.keys;
    const float font = ImGui::GetFontSize(), height = lane_lines * font, grip = .6f * font;
    const ImVec2 corner = ImGui::GetCursorScreenPos(), mouse = ImGui::GetIO().MousePos;
    ImGui::InvisibleButton("lane", {std::max(left + length - corner.x, 1.f), height});
    zoom();
    const bool hovered = ImGui::IsItemHovered(), held = ImGui::IsItemActive(), own = chosen == track.name;
    double least = 0, most = 1;
    if (held && own) {
        least = low, most = high;
    } else {
        for (const TrackKey& key : keys) least = std::min(least, key.value), most = std::max(most, key.value);
    }
    const float top = corner.y + .4f * font, tall_part = height - .8f * font;
    const auto y_of = [&](double value) { return top + tall_part * float((most - value) / (most - least)); };
    const double step = std::pow(10, std::floor(std::log10((most - least) / 50)));
    const double pointed_value =
        std::round((most - double((mouse.y - top) / tall_part) * (most - least)) / step) * step;
    const int row = static_cast<int>(std::clamp(std::round(music.row_at(time_at(mouse.x))), 0., 1e9));
    const TrackKey* near = nullptr;
    for (const TrackKey& key : keys) {
        const float x = x_of(music.time_of(key.row)), y = y_of(key.value);
        if (std::abs(x - mouse.x) < grip && std::abs(y - mouse.y) < grip &&
            (!near || std::abs(x - mouse.x) < std::abs(x_of(music.time_of(near->row)) - mouse.x)))
            near = &key;
    }
    Track changed = track;
    if (ImGui::IsItemActivated()) {
        chosen = track.name, chosen_row = near ? near->row : row;
        key_dragged = near != nullptr, drag_began = false, low = least, high = most;
        input.go_to = music.time_of(chosen_row);
        if (!near && view.keys_open && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
            set_key(changed,
                    {row, std::clamp(pointed_value, coordinates.low, coordinates.high), Interpolation::linear});
            input.track = {changed, false}, key_dragged = true;
        }
    }
    const auto at = std::ranges::find(keys, chosen_row, &TrackKey::row);
    if (held && own && key_dragged && view.keys_open && at != keys.end() && ImGui::IsMouseDragging(0, 3)) {
        TrackKey moved = *at;
        if (row == moved.row || std::ranges::find(keys, row, &TrackKey::row) == keys.end()) moved.row = row;
        moved.value = std::clamp(pointed_value, coordinates.low, coordinates.high);
        if (moved != *at) {
            delete_key(changed, at->row), set_key(changed, moved);
            chosen_row = moved.row, input.track = {changed, std::exchange(drag_began, true)};
        }
    }
    if (hovered && near && view.keys_open && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
        delete_key(changed, near->row);
        input.track = {changed, false};
    }

    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(corner, {left + length, corner.y + height}, own ? IM_COL32(255, 255, 255, 22) : beat_color);
    ImGui::PushClipRect({corner.x, corner.y}, {left + length + font, corner.y + height}, true);
    draw_grid(music, corner.y, corner.y + height);
    if (!keys.empty()) {
        ImVec2 last{left, y_of(value_at(track, music.row_at(time_at(left))))};
        for (float x = left + 2; x <= left + length; x += 2) {
            const ImVec2 next{x, y_of(value_at(track, music.row_at(time_at(x))))};
            list.AddLine(last, next, curve_color);
            last = next;
        }
    }
    for (const TrackKey& key : keys) {
        const float x = x_of(music.time_of(key.row)), y = y_of(key.value), r = .25f * font;
        if (x < left - font || x > left + length + font) continue;
        list.AddRectFilled({x - r, y - r}, {x + r, y + r}, own && key.row == chosen_row ? here_color : curve_color);
    }
    list.AddText({corner.x + .3f * font, corner.y}, text_color, track.name.c_str());
    draw_moment(view, corner.y, corner.y + height);
    ImGui::PopClipRect();
}

void Timeline::values(const TimelineView& view, TimelineInput& input) {
    const auto here = key_at(view.editor.path(), view.time);
    if (!here) {
        typing = false;
        ImGui::AlignTextToFramePadding();
        ImGui::TextDisabled("no key at this moment; 'set' adds one");
        return;
    }
    const Keyframe& key = view.editor.path().keys[*here];
    if (!typing) draft = key;
    typing = false;
    bool typed = false;
    ImGui::AlignTextToFramePadding();
    ImGui::Text("key %d:", static_cast<int>(*here) + 1);
    const ImGuiStyle& style = ImGui::GetStyle();
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowSize().x - style.WindowPadding.x;
    // Each field is as wide as its longest number, and begins a new line if there is no room for it.
    const auto field = [&](const char* name, double* values, int count) {
        const char* const form = "%.6g";
        float column = ImGui::CalcTextSize("-0.0000").x;
        for (int i = 0; i < count; ++i) {
            char text[32];
            std::snprintf(text, sizeof text, form, values[i]);
            column = std::max(column, ImGui::CalcTextSize(text).x);
        }
        column += 2 * style.FramePadding.x + 2;
        const float width = static_cast<float>(count) * (column + style.ItemInnerSpacing.x);
        const float all = ImGui::CalcTextSize(name).x + 2 * style.ItemSpacing.x + width;
        if (ImGui::GetItemRectMax().x + all <= right) ImGui::SameLine();
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(name);
        ImGui::SameLine();
        ImGui::SetNextItemWidth(width);
        const std::string id = std::string("##") + name;
        ImGui::InputScalarN(id.c_str(), ImGuiDataType_Double, values, count, nullptr, nullptr, form);
        typing |= ImGui::IsItemActive();
        typed |= ImGui::IsItemDeactivatedAfterEdit();
    };
    field("time", &draft.time, 1);
    field("position", &draft.position.x, 3);
    field("look_at", &draft.look_at.x, 3);
    const double times = view.editor.words.angle ? 2 : 1;  // the angle is twice the fov
    double fov = times * draft.fov.value_or(view.scene_camera.fov);
    const double before = fov;
    field(view.editor.words.angle ? "angle" : "fov", &fov, 1);
    if (fov != before) draft.fov = fov / times;
    if (typed && draft != key) input.change = {*here, draft, false};
    typing &= !typed;
}

/// Draws the values of the key of a track that is chosen.
void Timeline::track_values(const TimelineView& view, TimelineInput& input) {
    if (followed.empty()) return;
    const auto known_track = std::ranges::find(view.tracks, chosen, &Track::name);
    Track track = known_track == view.tracks.end() ? Track{chosen, {}} : *known_track;
    const auto at = std::ranges::find(track.keys, chosen_row, &TrackKey::row);
    const Music& music = view.scene->music;
    const float font = ImGui::GetFontSize();
    ImGui::AlignTextToFramePadding();
    ImGui::Text("%s, row %d, beat %g:", chosen.c_str(), chosen_row, chosen_row / music.rows);
    const float behind = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + font;
    ImGui::SameLine(std::max(18 * font, behind));
    if (!view.keys_open) return ImGui::TextDisabled("its keys are changed in the editor of tracks, or in the text");
    if (at == track.keys.end()) {
        if (ImGui::SmallButton("set key")) {
            set_key(track, {chosen_row, track.keys.empty() ? 0 : value_at(track, chosen_row), Interpolation::linear});
            input.track = {track, false};
        }
    } else {
        TrackKey key = *at;
        const auto change = [&](bool merged) {
            *at = key;
            input.track = {track, merged};
        };
        ImGui::SetNextItemWidth(6 * font);
        const double speed = std::max(std::abs(key.value), .1) / 100;
        if (ImGui::DragScalar("##value", ImGuiDataType_Double, &key.value, float(speed), &coordinates.low,
                              &coordinates.high, "%.4g", ImGuiSliderFlags_AlwaysClamp))
            change(std::exchange(value_held, true));
        ImGui::SameLine();
        ImGui::SetNextItemWidth(6 * font);
        int way = static_cast<int>(key.way);
        if (ImGui::Combo("##way", &way, "step\0linear\0smooth\0ramp\0"))
            key.way = static_cast<Interpolation>(way), change(false);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("how the value goes to that of the next key");
        ImGui::SameLine();
        if (ImGui::SmallButton("remove key")) delete_key(track, chosen_row), input.track = {track, false};
    }
    ImGui::SameLine();
    if (!track.keys.empty() && ImGui::SmallButton("in each beat")) {
        const double end = std::min(music.row_at(view.duration) + 1e-6, 1e5);
        input.track = {repeated(track, int(music.rows), int(end)), false};
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("repeats the keys of the first beat in all beats of the flight");
}

/// Draws the music: beats per minute, rows per beat, and the sound.
void Timeline::music(const TimelineView& view, TimelineInput& input) {
    if (!view.text_open) return;
    const float font = ImGui::GetFontSize();
    if (!typing_music) {
        draft_music = view.scene->music;
        std::snprintf(draft_sound.data(), draft_sound.size(), "%s", draft_music.sound.c_str());
    }
    typing_music = false;
    const auto number = [&](const char* name, const char* id, double& value, double least, double most, float speed,
                            const char* form) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(name);
        ImGui::SameLine();
        ImGui::SetNextItemWidth(4.5f * font);
        if (ImGui::DragScalar(id, ImGuiDataType_Double, &value, speed, &least, &most, form,
                              ImGuiSliderFlags_AlwaysClamp) &&
            value >= least)
            input.music = {draft_music, std::exchange(value_held, true)};
        typing_music |= ImGui::IsItemActive();
        ImGui::SameLine();
    };
    number("music: beats per minute", "##bpm", draft_music.bpm, 1, 1000, .5f, "%.5g");
    number("rows per beat", "##rows", draft_music.rows, 1, 256, .05f, "%.0f");
    number("first beat at", "##offset", draft_music.offset, 0, seconds.high, .01f, "%.5g s");
    const ImGuiStyle& style = ImGui::GetStyle();
    const float beside = ImGui::CalcTextSize("soundchoose").x + 2 * (style.ItemSpacing.x + style.FramePadding.x);
    if (ImGui::GetContentRegionAvail().x < 8 * font + beside) ImGui::NewLine();
    const float left_over = ImGui::GetContentRegionAvail().x - beside;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("sound");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(std::clamp(left_over, 8 * font, 15 * font));
    if (ImGui::InputTextWithHint("##sound", "an .ogg file beside the scene", draft_sound.data(), draft_sound.size(),
                                 ImGuiInputTextFlags_EnterReturnsTrue)) {
        draft_music.sound = draft_sound.data();
        input.music = {draft_music, false};
    }
    typing_music |= ImGui::IsItemActive();
    ImGui::SameLine();
    input.choose_sound |= ImGui::SmallButton("choose");
}

}  // namespace strahl
