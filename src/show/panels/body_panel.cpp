#include "show/panels/body_panel.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <utility>

namespace strahl {
namespace {

constexpr const char* digits = "%.4g";

/// Draws a button in a colour, which opens a list of colours. Its numbers may be above 1. Returns whether they have
/// changed.
bool draw_color(std::vector<double>& numbers) {
    std::array<float, 3> shown;
    for (std::size_t i = 0; i < 3; ++i) shown[i] = static_cast<float>(numbers[i]);
    const std::array<float, 3> before = shown;
    const ImVec4 color{shown[0], shown[1], shown[2], 1};
    const ImGuiColorEditFlags flags = ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR | ImGuiColorEditFlags_NoAlpha;
    if (ImGui::ColorButton("##color", color, flags)) ImGui::OpenPopup("colors");
    if (ImGui::BeginPopup("colors")) {
        ImGui::ColorPicker3("##picker", shown.data(), flags | ImGuiColorEditFlags_NoOptions);
        ImGui::EndPopup();
    }
    for (std::size_t i = 0; i < 3; ++i)
        if (shown[i] != before[i]) numbers[i] = std::round(1000. * static_cast<double>(shown[i])) / 1000;
    return shown != before;
}

void dim_text(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, {1, 1, 1, .6f});
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

/// Draws a button to the right of what was drawn last. Returns whether it was pressed.
bool button_beside(const char* label, const char* help) {
    ImGui::SameLine();
    const bool pressed = ImGui::SmallButton(label);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
    return pressed;
}

/// Draws the list of materials above the values of the body's own. Returns the one that was chosen, or nullptr.
const MaterialPreset* draw_presets() {
    const MaterialPreset* chosen = nullptr;
    ImGui::SetNextItemWidth(12 * ImGui::GetFontSize());
    if (ImGui::BeginCombo("##preset", "material: choose one")) {
        for (const MaterialPreset& preset : material_presets)
            if (ImGui::Selectable(preset.name)) chosen = &preset;
        ImGui::EndCombo();
    }
    return chosen;
}

std::string numbers_text(const std::vector<double>& numbers) {
    std::string text;
    for (const double number : numbers) {
        char digit[32];
        std::snprintf(digit, sizeof digit, digits, number);
        text.append(text.empty() ? "" : ", ").append(digit);
    }
    return text;
}

}  // namespace

BodyInput BodyPanel::draw(const BodyEditor& editor, const std::string& file, const Margins& margins, bool left,
                          CoveredArea& covered) {
    BodyInput input;
    begin_panel("body", left ? 0 : 1, 0, margins);
    const BodyText& body = editor.body();
    if (const auto& block = editor.block())
        ImGui::Text("%s: %s", *block == TopBlock::camera ? "camera" : "background", body.kind.c_str());
    else
        ImGui::Text("%s %d: %s", editor.light() ? "light" : "body", 1 + editor.number(), body.kind.c_str());
    const std::size_t count = editor.bodies().size();
    if (count > 1) dim_text("the last of " + std::to_string(count) + " bodies chosen");
    if (body.line > 0) dim_text(file + ", line " + std::to_string(body.line));
    if (const auto& chosen = editor.choice(); chosen && chosen->at.hit.t > 0) {
        // Lines of their own: a wider panel would move the fields below with each click.
        const auto& hit = chosen->at.hit;
        const auto line = [](const char* format, auto... values) {
            char text[120];
            std::snprintf(text, sizeof text, format, values...);
            dim_text(text);
        };
        line("face %d, %.5g away", hit.face + 1, hit.t);
        line("at <%.4g, %.4g, %.4g>", chosen->point.x, chosen->point.y, chosen->point.z);
        line("normal <%.3g, %.3g, %.3g>", hit.normal.x, hit.normal.y, hit.normal.z);
    }
    if (editor.read_only()) dim_text(editor.why_read_only());
    // Buttons keep their places: those that do nothing now are grey.
    const auto button = [](const char* label, bool open) {
        ImGui::BeginDisabled(!open);
        const bool pressed = ImGui::SmallButton(label);
        ImGui::EndDisabled();
        ImGui::SameLine();
        return pressed;
    };
    if (button("open text", body.line > 0)) input.command = {Action::open_text};
    if (button("write", editor.edited.changed())) input.command = {Action::write_path};
    if (button("close", true)) input.close = true;
    ImGui::NewLine();
    if (editor.block() == TopBlock::camera) {
        if (button("use this view", !editor.read_only())) input.command = {Action::keep_view};
        if (button("go there", true)) input.command = {Action::reset};
        if (button("focus by a click", true)) input.command = {Action::focus};
        ImGui::NewLine();
    }
    ImGui::Separator();
    fields.begin();
    const std::vector<BodyValue>& values = body.values;
    const auto material = std::size_t(std::ranges::find(values, "rgb", &BodyValue::name) - values.begin());
    // Values of the material that nothing in the text gives are folded away, and those that cannot be changed here.
    const auto folded = [&](std::size_t i) {
        return (i > material && values[i].source == no_source) || values[i].fixed == "from the file";
    };
    // Names have a column of their own.
    const float font = ImGui::GetFontSize();
    labels = 7 * font;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!folded(i)) labels = std::max(labels, ImGui::CalcTextSize(values[i].name.c_str()).x + 1.4f * font);
    std::string source;
    std::vector<std::size_t> more;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i == material && body.material && !editor.read_only()) input.preset = draw_presets();
        if (folded(i))
            more.push_back(i);
        else
            draw_value(editor, i, source, input);
    }
    if (editor.choice() && !editor.read_only()) draw_placing(editor, input);
    if (!more.empty() && ImGui::TreeNode("more")) {
        for (const std::size_t i : more) draw_value(editor, i, source, input);
        ImGui::TreePop();
    }
    if (!ImGui::IsAnyItemActive()) held = false;
    covered = end_panel();
    return input;
}

/// Draws fields that move, turn and scale what is chosen by numbers, folded away.
void BodyPanel::draw_placing(const BodyEditor& editor, BodyInput& input) {
    if (!ImGui::IsAnyItemActive()) moves = turns = {}, scales = {1, 1, 1}, scales_all = 1;
    if (!ImGui::TreeNode("move, turn, scale by numbers")) return;
    const auto row = [&](const char* name, std::span<double> numbers, const NumberRange& range, const char* help,
                         const auto& placing) {
        const std::vector<double> before(numbers.begin(), numbers.end());
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(name);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
        ImGui::SameLine(7 * ImGui::GetFontSize());
        const auto change = fields.draw(name, numbers, range, 12 * ImGui::GetFontSize());
        if (!fields.reason().empty() && input.refused.empty()) input.refused = name + (" " + fields.reason());
        if (change == NumberFields::FieldEdit::none) return;
        const auto changed = std::ranges::mismatch(numbers, before).in1 - numbers.begin();
        const bool typed = change == NumberFields::FieldEdit::typed;
        if (typed) held = false;
        input.place = {placing(static_cast<int>(changed)), std::exchange(held, !typed)};
        if (typed) std::ranges::copy(before, numbers.begin());  // the next one begins anew
    };
    row("move by", moves, coordinates, "along the axes of the world",
        [&](int) { return MoveBy{DVec3(moves[0], moves[1], moves[2])}; });
    row("turn by", turns, anything, "degrees about the axes of the world, through its middle", [&](int i) {
        DVec3 axis(0);
        axis[i] = 1;
        return TurnBy{axis, turns[std::size_t(i)]};
    });
    constexpr NumberRange factors{1e-3, 1e3, "from 0.001 to 1000"};
    row("scale by", {&scales_all, 1}, factors, "the factor of its size",
        [&](int) { return ScaleBy{DVec3(scales_all)}; });
    if (editor.bodies().size() == 1)
        row("... along", scales, factors, "factors along its own axes",
            [&](int) { return ScaleBy{DVec3(scales[0], scales[1], scales[2])}; });
    ImGui::TreePop();
}

/// Draws a value's name and a field to change it, below the name of its block unless the value above is of the same
/// one. `source` says where the value above comes from, and then where this one does.
void BodyPanel::draw_value(const BodyEditor& editor, std::size_t number, std::string& source, BodyInput& input) {
    const BodyValue& value = editor.body().values[number];
    const float font = ImGui::GetFontSize();
    const bool open = editor.open_to_change(value), elsewhere = !value.source.empty() && value.source != no_source;
    ImGui::PushID(static_cast<int>(number));
    // Values from the same block stand together below its name.
    if (std::exchange(source, value.source) != value.source && elsewhere) {
        dim_text("from " + value.source);
        if (!open && value.fixed.empty() && button_beside("change", "changes values there, for all that have them"))
            input.allow = value.source;
    }
    if (elsewhere) ImGui::Indent(font / 2);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(value.name.c_str());
    if (ImGui::IsItemHovered() && !value.help.empty()) ImGui::SetTooltip("%s", value.help.c_str());
    ImGui::SameLine(std::max(labels, ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + font / 2));
    std::vector<double> numbers = value.numbers;
    if (open) {
        const bool color = value.color && numbers.size() == 3;
        const float button = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x;
        const auto change = fields.draw("numbers", numbers, value.range, 12 * font - (color ? button : 0));
        if (!fields.reason().empty() && input.refused.empty()) input.refused = value.name + " " + fields.reason();
        if (color) ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
        if (change == NumberFields::FieldEdit::typed)
            input.change = {number, numbers, held = false};
        else if ((color && draw_color(numbers)) || change == NumberFields::FieldEdit::dragged)
            input.change = {number, numbers, std::exchange(held, true)};
        if (value.follows) draw_track(editor, number, input);
        if (value.source == no_source) ImGui::SameLine(), dim_text(value.source);
    } else {
        if (value.fixed != "a pattern") ImGui::TextUnformatted(numbers_text(numbers).c_str()), ImGui::SameLine();
        if (value.tracks.empty()) dim_text(value.fixed);
    }
    if (!value.tracks.empty()) {
        draw_track(editor, number, input);
        // Below, since names of three tracks are wider than the panel's other lines.
        ImGui::SetCursorPosX(labels);
        ImGui::PushTextWrapPos(labels + 13 * font);
        dim_text(value.fixed);
        ImGui::PopTextWrapPos();
    }
    if (elsewhere && value.fixed.empty() && value.own_at > 0 &&
        button_beside("own", "gives this body a value of its own"))
        input.own = number;
    if (elsewhere) ImGui::Unindent(font / 2);
    ImGui::PopID();
}

/// Draws what has numbers of a value follow a track, or none.
void BodyPanel::draw_track(const BodyEditor& editor, std::size_t number, BodyInput& input) {
    const BodyText& body = editor.body();
    const BodyValue& value = body.values[number];
    const std::size_t count = value.slices.empty() ? value.numbers.size() : value.slices.size();
    if (!value.tracks.empty() && button_beside("free", "follows no track any more")) input.free = number;
    if ((count == 1 && !value.tracks.empty()) || count == 2) return;
    if (button_beside("~", "follows a track, whose keys are on the timeline")) {
        const std::string what = editor.block() == TopBlock::camera ? "camera"
                                 : editor.block()
                                     ? "background"
                                     : body.kind.substr(0, body.kind.find(' ')) + std::to_string(1 + editor.number());
        const std::string name = what + ":" + value.name;
        std::snprintf(track_name.data(), track_name.size(), "%s", name.c_str());
        ImGui::OpenPopup("track");
    }
    if (!ImGui::BeginPopup("track")) return;
    ImGui::TextUnformatted("the name of the track");
    ImGui::SetNextItemWidth(14 * ImGui::GetFontSize());
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::InputText("##name", track_name.data(), track_name.size(), ImGuiInputTextFlags_AutoSelectAll);
    const auto button = [&](const char* label, int component) {
        if (ImGui::Button(label)) input.track = {number, component, track_name.data()}, ImGui::CloseCurrentPopup();
    };
    if (count == 1) {
        button("follow", 0);
    } else {
        for (int i = 0; i < 3; ++i) {
            button(value.color ? std::array{"red", "green", "blue"}[std::size_t(i)]
                               : std::array{"x", "y", "z"}[std::size_t(i)],
                   i);
            ImGui::SameLine();
        }
        button("each", -1);
    }
    ImGui::EndPopup();
}

}  // namespace strahl
