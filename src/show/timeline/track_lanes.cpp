#include "show/timeline/track_lanes.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/moving_scene.h"
#include "show/session/track_keys.h"
#include "text/blocks/blocks.h"

namespace strahl {
namespace {

constexpr ImU32 curve_color = IM_COL32(150, 230, 150, 255);
constexpr float least_lanes = 2, most_lanes = 4;         // of tracks that are seen at once
constexpr float lane_lines = 2.4f, motion_lines = 1.2f;  // of text, the heights of lanes

/// Draws the name of a lane in the column before it.
void draw_name(const ImVec2& corner, const TimeScale& scale, const std::string& name) {
    const float font = ImGui::GetFontSize();
    ImGui::PushClipRect(corner, {scale.first_x() - .6f * font, corner.y + 2 * font}, true);
    ImGui::GetWindowDrawList()->AddText({corner.x + .3f * font, corner.y}, text_color, name.c_str());
    ImGui::PopClipRect();
}

}  // namespace

float TrackLanes::names_width() const {
    float width = 0;
    for (const std::string& name : followed) width = std::max(width, ImGui::CalcTextSize(name.c_str()).x);
    for (const SceneMotion& motion : motions) width = std::max(width, ImGui::CalcTextSize(motion.name.c_str()).x);
    return std::min(width, 10 * ImGui::GetFontSize());
}

void TrackLanes::look(const TimelineView& view) {
    if (known != view.scene) {
        const std::vector<std::string> before = std::exchange(followed, followed_tracks(*view.scene));
        const bool same_file = std::exchange(known, view.scene) != nullptr && !before.empty();
        motions = motions_of(*known);
        for (const std::string& name : followed)  // one that a number has just been made to follow
            if (same_file && std::ranges::find(before, name) == before.end())
                chosen = name, chosen_row = 0, scrolls = true;
    }
    // A track is always chosen: the timeline must not grow between the clicks of a double click.
    if (!followed.empty() && std::ranges::find(followed, chosen) == followed.end()) chosen = followed[0];
    if (!ImGui::IsAnyItemActive()) value_held = false;
}

void TrackLanes::draw(const TimelineView& view, TimeScale& scale, TimelineInput& input) {
    if (followed.empty() && motions.empty()) return;
    const float font = ImGui::GetFontSize(), space = ImGui::GetStyle().ItemSpacing.y;
    const float all =
        float(followed.size()) * (lane_lines * font + space) + float(motions.size()) * (motion_lines * font + space);
    // In a low window the lanes leave room for the picture and for panels: with 11 lines of other parts, the timeline
    // takes half of the window.
    const float lane = lane_lines * font + space, room = ImGui::GetIO().DisplaySize.y / 2 - 11 * font;
    ImGui::BeginChild("lanes", {0, std::min(all, std::clamp(room, least_lanes * lane, most_lanes * lane))}, false,
                      ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav);
    for (std::size_t i = 0; i < followed.size(); ++i) {
        const auto known_track = std::ranges::find(view.tracks, followed[i], &Track::name);
        ImGui::PushID(static_cast<int>(i));
        track_lane(view, scale, known_track == view.tracks.end() ? Track{followed[i], {}} : *known_track, input);
        ImGui::PopID();
    }
    for (std::size_t i = 0; i < motions.size(); ++i) {
        ImGui::PushID(static_cast<int>(followed.size() + i));
        motion_lane(view, scale, motions[i], input);
        ImGui::PopID();
    }
    ImGui::EndChild();
}

/// Draws the keys of a motion. A click goes there, a double click adds a key, drags move keys in time, and the right
/// button removes one.
void TrackLanes::motion_lane(const TimelineView& view, TimeScale& scale, const SceneMotion& motion,
                             TimelineInput& input) {
    using Change = TimelineInput::MotionChange;
    const float font = ImGui::GetFontSize(), height = motion_lines * font, grip = .6f * font;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("motion", {std::max(scale.last_x() - corner.x, 1.f), height});
    scale.zoom();
    const float pointed = ImGui::GetIO().MousePos.x;
    const double seconds = std::max(scale.time_at(pointed), 0.);
    const auto distance = [&](std::size_t key) { return std::abs(scale.x_of(motion.times[key]) - pointed); };
    std::size_t near = 0;
    for (std::size_t i = 1; i < motion.times.size(); ++i)
        if (distance(i) < distance(near)) near = i;
    const bool on_key = distance(near) < grip;
    if (ImGui::IsItemActivated()) {
        dragged = on_key ? std::optional(near) : std::nullopt, drag_began = false;
        clicked = on_key ? ClickedKey::motion : ClickedKey::none, clicked_motion = motion, clicked_number = near;
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
    list.AddRectFilled(corner, {scale.last_x(), corner.y + height}, beat_color);
    ImGui::PushClipRect({corner.x, corner.y}, {scale.last_x() + font, corner.y + height}, true);
    list.AddLine({scale.x_of(motion.times.front()), middle}, {scale.x_of(motion.times.back()), middle}, line_color, 2);
    for (const double time : motion.times)
        list.AddQuadFilled({scale.x_of(time) - r, middle}, {scale.x_of(time), middle - r},
                           {scale.x_of(time) + r, middle}, {scale.x_of(time), middle + r}, key_color);
    scale.draw_moment(view, corner.y, corner.y + height);
    ImGui::PopClipRect();
    draw_name(corner, scale, motion.name);
}

/// Draws a track as a curve with its keys. A click chooses it and goes there, a double click adds a key there, and the
/// right button removes one.
void TrackLanes::track_lane(const TimelineView& view, TimeScale& scale, const Track& track, TimelineInput& input) {
    const Music& music = view.scene->music;
    const std::vector<TrackKey>& keys = track.keys;
    const float font = ImGui::GetFontSize(), height = lane_lines * font, grip = .6f * font;
    const ImVec2 corner = ImGui::GetCursorScreenPos(), mouse = ImGui::GetIO().MousePos;
    ImGui::InvisibleButton("lane", {std::max(scale.last_x() - corner.x, 1.f), height});
    if (chosen == track.name && std::exchange(scrolls, false)) ImGui::SetScrollHereY(1);
    scale.zoom();
    const bool hovered = ImGui::IsItemHovered(), held = ImGui::IsItemActive(), own = chosen == track.name;
    double least = 0, most = 1;
    if (held && own && !ImGui::IsItemActivated()) {
        least = low, most = high;
    } else {
        for (const TrackKey& key : keys) least = std::min(least, key.value), most = std::max(most, key.value);
    }
    const float top = corner.y + .4f * font, tall_part = height - .8f * font;
    const auto y_of = [&](double value) { return top + tall_part * float((most - value) / (most - least)); };
    const double step = std::pow(10, std::floor(std::log10((most - least) / 50)));
    const double pointed_value =
        std::round((most - double((mouse.y - top) / tall_part) * (most - least)) / step) * step;
    const int row = static_cast<int>(std::clamp(std::round(music.row_at(scale.time_at(mouse.x))), 0., 1e9));
    const TrackKey* near = nullptr;
    for (const TrackKey& key : keys) {
        const float x = scale.x_of(music.time_of(key.row)), y = y_of(key.value);
        if (std::abs(x - mouse.x) < grip && std::abs(y - mouse.y) < grip &&
            (!near || std::abs(x - mouse.x) < std::abs(scale.x_of(music.time_of(near->row)) - mouse.x)))
            near = &key;
    }
    Track changed = track;
    if (ImGui::IsItemActivated()) {
        chosen = track.name, chosen_row = near ? near->row : row;
        key_dragged = near != nullptr, drag_began = false, low = least, high = most;
        clicked = near ? ClickedKey::track : ClickedKey::none;
        input.go_to = music.time_of(chosen_row);
        if (!near && view.keys_open && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
            set_key(changed,
                    {row, std::clamp(pointed_value, coordinates.low, coordinates.high), Interpolation::linear});
            input.track = {changed, false}, key_dragged = true, clicked = ClickedKey::track;
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
    list.AddRectFilled(corner, {scale.last_x(), corner.y + height}, own ? IM_COL32(255, 255, 255, 22) : beat_color);
    ImGui::PushClipRect({corner.x, corner.y}, {scale.last_x() + font, corner.y + height}, true);
    scale.draw_grid(music, corner.y, corner.y + height);
    if (!keys.empty()) {
        ImVec2 last{scale.first_x(), y_of(value_at(track, music.row_at(scale.time_at(scale.first_x()))))};
        for (float x = scale.first_x() + 2; x <= scale.last_x(); x += 2) {
            const ImVec2 next{x, y_of(value_at(track, music.row_at(scale.time_at(x))))};
            list.AddLine(last, next, curve_color);
            last = next;
        }
    }
    for (const TrackKey& key : keys) {
        const float x = scale.x_of(music.time_of(key.row)), y = y_of(key.value), r = .25f * font;
        if (x < scale.first_x() - font || x > scale.last_x() + font) continue;
        list.AddRectFilled({x - r, y - r}, {x + r, y + r}, own && key.row == chosen_row ? here_color : curve_color);
    }
    scale.draw_moment(view, corner.y, corner.y + height);
    ImGui::PopClipRect();
    draw_name(corner, scale, track.name);
}

void TrackLanes::remove_clicked(const TimelineView& view, TimelineInput& input) {
    const auto track = std::ranges::find(view.tracks, chosen, &Track::name);
    if (clicked == ClickedKey::track && view.keys_open && track != view.tracks.end()) {
        Track changed = *track;
        delete_key(changed, chosen_row);
        input.track = {changed, false};
    }
    if (clicked == ClickedKey::motion && view.text_open)
        input.motion = {TimelineInput::MotionChange::remove, clicked_motion, clicked_number, 0, false};
    forget_click();
}

void TrackLanes::draw_values(const TimelineView& view, TimelineInput& input) {
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
        fields.begin();
        const auto changed = fields.draw("value", {&key.value, 1}, coordinates, 6 * font);
        if (!fields.reason().empty()) input.refused = "the value " + fields.reason();
        if (changed == NumberFields::FieldEdit::typed) value_held = false;
        if (changed != NumberFields::FieldEdit::none) change(std::exchange(value_held, true));
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
    const auto replaced = std::ranges::count_if(track.keys, [&](const TrackKey& key) {
        return key.row >= int(music.rows) && key.row < music.row_at(view.duration);
    });
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip(
            "repeats the keys of the first beat in all beats of the flight;\ndeletes the %d keys behind it",
            static_cast<int>(replaced));
}

}  // namespace strahl
