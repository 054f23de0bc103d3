// Draws the timeline with ImGui.
#include "show/timeline/timeline.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "show/session/divider.h"
#include "text/blocks/blocks.h"

namespace strahl {
namespace {

constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize;

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
    lanes.look(view);
    fields.begin();
    if (!ImGui::IsAnyItemActive()) value_held = false;
    buttons(view, input);
    scale.show(view, lanes.names_width());
    bar(view, input);
    lanes.draw(view, scale, input);
    values(view, input);
    lanes.draw_values(view, input);
    music(view, input);
    if (std::exchange(delete_asked, false)) {
        if (lanes.key_clicked())
            lanes.remove_clicked(view, input);
        else
            input.command = {Action::delete_key};
        forget_click();
    }
    tall = ImGui::GetWindowHeight() + edge;
    ImGui::End();
    return input;
}

void Timeline::buttons(const TimelineView& view, TimelineInput& input) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowSize().x - style.WindowPadding.x;
    bool first = true;
    // Each part begins a new line if there is no room for it.
    const auto make_room = [&](const char* label) {
        const float width = ImGui::CalcTextSize(label).x + 2 * style.FramePadding.x + style.ItemSpacing.x;
        if (!std::exchange(first, false) && ImGui::GetItemRectMax().x + width <= right) ImGui::SameLine();
    };
    const auto pressed = [&](const char* label, bool on = false) {
        make_room(label);
        if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
        const bool result = ImGui::SmallButton(label);
        if (on) ImGui::PopStyleColor();
        return result;
    };
    const auto button = [&](const char* label, Command command, bool on = false) {
        if (pressed(label, on)) input.command = command;
    };
    button("|<", {Action::rewind});
    button("<", {Action::to_key, -1});
    button(view.running ? "pause###play" : "play###play", {Action::pause});
    button(">", {Action::to_key, 1});
    button(">|", {Action::to_end});
    char moment[64];
    std::snprintf(moment, sizeof moment, " %.3f of %g s ", view.time, view.duration);
    make_room(moment);
    ImGui::TextUnformatted(moment);
    button("add", {Action::add_key});
    button("set", {Action::set_key});
    button("delete", {Action::delete_key});
    button("undo", {Action::undo});
    button("redo", {Action::redo});
    button("new", {Action::clear_path});
    const bool changed = view.editor.changed() || view.keys_changed;
    ImGui::BeginDisabled(!changed);
    button("write", {Action::write_path}, changed);
    ImGui::EndDisabled();
    if (changed && ImGui::IsItemHovered()) ImGui::SetTooltip("the path or keys of tracks are not written");
    button("outside", {Action::outside}, view.outside);
    button("both", {Action::second, int(SecondKind::flight)}, view.both);
    const Flythrough& path = view.editor.path();
    ImGui::BeginDisabled(path.keys.size() < 2);
    if (pressed("loop", path.loop)) input.path = {looped(path, 3), path.loop ? "path opened" : "path closed", false};
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("closes the path, or ends it with its last key");
}

void Timeline::bar(const TimelineView& view, TimelineInput& input) {
    const std::vector<Keyframe>& keys = view.editor.path().keys;
    const float font = ImGui::GetFontSize(), height = 2.4f * font;
    const ImVec2 corner{scale.first_x() - font, ImGui::GetCursorScreenPos().y};
    ImGui::SetCursorScreenPos(corner);
    ImGui::InvisibleButton("bar", {scale.last_x() - scale.first_x() + 2 * font, height});
    scale.zoom();
    const bool held = ImGui::IsItemActive();
    const double pointed = scale.time_at(ImGui::GetIO().MousePos.x);
    const double grip = scale.seconds_of(font / 2);  // seconds beside a key that belong to it

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
        end_dragged =
            has_path && mouse.y > middle && std::abs(mouse.x - scale.x_of(view.editor.path().duration)) < font / 2;
        dragged = end_dragged ? std::nullopt : near, drag_began = false;
        if (dragged) input.go_to = keys[*dragged].time;
        lanes.forget_click(), path_key_clicked = dragged.has_value();
    }
    if (held && end_dragged && has_path && ImGui::IsMouseDragging(0, 3)) {
        Flythrough path = lasting(view.editor.path(), std::round(100 * std::clamp(pointed, 0., scale.last())) / 100);
        if (path != view.editor.path())
            input.path = {std::move(path), "end of the path", std::exchange(drag_began, true)};
    }
    if (held && !dragged && !end_dragged) input.go_to = std::clamp(pointed, 0., view.duration);
    if (held && dragged && *dragged < keys.size() && ImGui::IsMouseDragging(0, 3)) {
        Keyframe moved = keys[*dragged];
        moved.time = std::round(100 * std::clamp(pointed, 0., scale.last())) / 100;
        if (moved.time != keys[*dragged].time) input.change = {*dragged, moved, std::exchange(drag_began, true)};
    }

    scale.draw_sound(view, corner.y, corner.y + height);
    if (lanes.any_tracks() || view.scene->music != Music{})
        scale.draw_grid(view.scene->music, corner.y, corner.y + height);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImGui::PushClipRect({scale.first_x() - font, corner.y}, {scale.last_x() + font, corner.y + height}, true);
    list.AddLine({scale.x_of(0), middle}, {scale.x_of(view.duration), middle}, line_color, 2);
    const double step = mark_interval(scale.last() - scale.first());
    for (double i = std::ceil(scale.first() / step); i * step <= scale.last(); ++i) {
        const float x = scale.x_of(i * step);
        list.AddLine({x, middle - font / 4}, {x, middle + font / 4}, line_color);
        char text[32];
        std::snprintf(text, sizeof text, "%g", i * step);
        list.AddText({x - ImGui::CalcTextSize(text).x / 2, middle + 0.6f * font}, text_color, text);
    }
    if (has_path) {
        const float end = scale.x_of(view.editor.path().duration);
        list.AddTriangleFilled({end, middle}, {end + .35f * font, middle + .7f * font},
                               {end - .35f * font, middle + .7f * font}, key_color);
    }
    const auto here = key_at(view.editor.path(), view.time);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const float x = scale.x_of(keys[i].time), r = 0.4f * font;
        const ImU32 color = here == i ? here_color : key_color;
        if (keys[i].ease == 0) {
            list.AddQuadFilled({x - r, middle}, {x, middle - r}, {x + r, middle}, {x, middle + r}, color);
            continue;
        }
        list.AddTriangleFilled({x - r, middle - r}, {x + r, middle - r}, {x, middle}, color);
        list.AddTriangleFilled({x + r, middle + r}, {x - r, middle + r}, {x, middle}, color);
    }
    scale.draw_moment(view, corner.y, middle + 0.6f * font);
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
        const auto change = fields.draw("ease", {&key.ease, 1}, shares, 10 * ImGui::GetFontSize());
        if (change == NumberFields::FieldEdit::typed) value_held = false;
        if (change != NumberFields::FieldEdit::none) input.change = {*here, key, std::exchange(value_held, true)};
        ImGui::TextDisabled("%s", ease.help);
    }
    ImGui::EndPopup();
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

/// Draws the music: beats per minute, rows per beat, and the sound.
void Timeline::music(const TimelineView& view, TimelineInput& input) {
    if (!view.text_open) return;
    const float font = ImGui::GetFontSize();
    if (!typing_music) {
        draft_music = view.scene->music;
        std::snprintf(draft_sound.data(), draft_sound.size(), "%s", draft_music.sound.c_str());
    }
    typing_music = false;
    const auto number = [&](const char* name, double& value, const NumberRange& range, const char* form) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(name);
        ImGui::SameLine();
        const auto change = fields.draw(name, {&value, 1}, range, 4.5f * font, form);
        if (!fields.reason().empty() && input.refused.empty()) input.refused = name + (" " + fields.reason());
        if (change == NumberFields::FieldEdit::typed) value_held = false;
        if (change != NumberFields::FieldEdit::none) input.music = {draft_music, std::exchange(value_held, true)};
        typing_music |= ImGui::IsItemActive();
        ImGui::SameLine();
    };
    number("music: beats per minute", draft_music.bpm, {1, 1000, "from 1 to 1000"}, "%.5g");
    number("rows per beat", draft_music.rows, {1, 256, "from 1 to 256", true}, "%.0f");
    number("first beat at", draft_music.offset, seconds, "%.5g s");
    const ImGuiStyle& style = ImGui::GetStyle();
    const float beside = ImGui::CalcTextSize("soundchoose").x + 2 * (style.ItemSpacing.x + style.FramePadding.x);
    if (ImGui::GetContentRegionAvail().x < 8 * font + beside) ImGui::NewLine();
    const float left_over = ImGui::GetContentRegionAvail().x - beside;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("sound");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(std::clamp(left_over, 8 * font, 15 * font));
    if (ImGui::InputTextWithHint("##sound", "an .ogg file", draft_sound.data(), draft_sound.size(),
                                 ImGuiInputTextFlags_EnterReturnsTrue)) {
        draft_music.sound = draft_sound.data();
        input.music = {draft_music, false};
    }
    typing_music |= ImGui::IsItemActive();
    ImGui::SameLine();
    input.choose_sound |= ImGui::SmallButton("choose");
}

}  // namespace strahl
