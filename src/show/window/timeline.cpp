// Draws the timeline with ImGui.
#include "show/window/timeline.h"

#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

namespace strahl {
namespace {

constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize;
constexpr ImU32 line_color = IM_COL32(255, 255, 255, 70), text_color = IM_COL32(255, 255, 255, 150),
                key_color = IM_COL32(140, 204, 255, 255), here_color = IM_COL32(255, 190, 90, 255);

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
    buttons(view, input);
    bar(view, input);
    values(view, input);
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
    const char* const state = view.editor.changed() ? "not written to the file yet" : "";
    if (ImGui::CalcTextSize(state).x > ImGui::GetContentRegionAvail().x) ImGui::NewLine();
    ImGui::TextUnformatted(state);
}

void Timeline::bar(const TimelineView& view, TimelineInput& input) {
    const std::vector<Keyframe>& keys = view.editor.path().keys;
    const float font = ImGui::GetFontSize(), height = 2.4f * font;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::GetContentRegionAvail().x, 1.f);
    ImGui::InvisibleButton("bar", {width, height});
    const bool held = ImGui::IsItemActive();
    if (!held) range = std::max(1.15 * view.duration, 10.);
    const float left = corner.x + font, length = width - 2 * font;
    const auto x_of = [&](double time) { return left + length * static_cast<float>(time / range); };
    const double pointed = (ImGui::GetIO().MousePos.x - left) / length * range;
    const double grip = font / 2 / length * range;  // seconds beside a key that belong to it

    if (ImGui::IsItemActivated()) {
        dragged.reset(), drag_began = false;
        for (std::size_t i = 0; i < keys.size(); ++i)
            if (std::abs(keys[i].time - pointed) < grip &&
                (!dragged || std::abs(keys[i].time - pointed) < std::abs(keys[*dragged].time - pointed)))
                dragged = i;
        if (dragged) input.go_to = keys[*dragged].time;
    }
    if (held && !dragged) input.go_to = std::clamp(pointed, 0., view.duration);
    if (held && dragged && *dragged < keys.size() && ImGui::IsMouseDragging(0, 3)) {
        Keyframe moved = keys[*dragged];
        moved.time = std::round(100 * std::clamp(pointed, 0., range)) / 100;
        if (moved.time != keys[*dragged].time) input.change = {*dragged, moved, std::exchange(drag_began, true)};
    }

    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float middle = corner.y + 0.7f * font;
    list.AddLine({x_of(0), middle}, {x_of(view.duration), middle}, line_color, 2);
    const double step = mark_interval(range);
    for (int i = 0; i * step <= range; ++i) {
        const float x = x_of(i * step);
        list.AddLine({x, middle - font / 4}, {x, middle + font / 4}, line_color);
        char text[32];
        std::snprintf(text, sizeof text, "%g", i * step);
        list.AddText({x - ImGui::CalcTextSize(text).x / 2, middle + 0.6f * font}, text_color, text);
    }
    const auto here = key_at(view.editor.path(), view.time);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const float x = x_of(keys[i].time), r = 0.4f * font;
        list.AddQuadFilled({x - r, middle}, {x, middle - r}, {x + r, middle}, {x, middle + r},
                           here == i ? here_color : key_color);
    }
    const float x = x_of(view.time);
    list.AddLine({x, corner.y}, {x, middle + 0.6f * font}, here_color, 2);
}

void Timeline::values(const TimelineView& view, TimelineInput& input) {
    const auto here = key_at(view.editor.path(), view.time);
    if (!here) {
        typing = false;
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

}  // namespace strahl
