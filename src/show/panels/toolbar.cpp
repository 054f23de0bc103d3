#include "show/panels/toolbar.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "files/error.h"
#include "files/os/user_file.h"
#include "files/output_file.h"

namespace strahl {
namespace {

struct ToolbarButton {
    const char* name;
    Command command;
    bool on = false;
};

std::vector<ToolbarButton> buttons_of(const ToolbarView& view) {
    const auto handles = [&](HandleMode mode) { return Command{Action::handles, 1 + static_cast<int>(mode)}; };
    return {{"move", handles(HandleMode::move), view.handles == HandleMode::move},
            {"turn", handles(HandleMode::turn), view.handles == HandleMode::turn},
            {"scale", handles(HandleMode::scale), view.handles == HandleMode::scale},
            {"add", {Action::add_block}, view.adding},
            {"light", {Action::lights}, view.lights},
            {"camera", {Action::edit_camera}, view.camera},
            {"list", {Action::outline}},
            {"time", {Action::timeline}},
            {"key", {Action::add_key}},
            {"play", {view.playing ? Action::pause : Action::play}, view.playing},
            {"record", {Action::record}, view.recording},
            {"film", {Action::film}},
            {"undo", {Action::undo}},
            {"save", {Action::write_path}, view.unsaved},
            {"help", {Action::help}}};
}

/// Returns the help of a command, in the list of all.
const char* meaning_of(const Command& command) {
    const auto help = std::ranges::find_if(
        command_helps, [&](const CommandHelp& row) { return *row.word && row.command.action == command.action; });
    return help == command_helps.end() ? "" : help->meaning;
}

std::string hidden_file() { return os::user_file("XDG_STATE_HOME", ".local/state", "strahl/no_toolbar"); }

}  // namespace

std::optional<Command> Toolbar::draw(const KeyMap& keys, const ToolbarView& view) {
    std::optional<Command> clicked;
    const std::vector<ToolbarButton> buttons = buttons_of(view);
    const float font = ImGui::GetFontSize(), space = .2f * font, edge = .4f * font;
    const auto width = [&](const ToolbarButton& button) {
        const std::string key = keys.first_key(button.command.action);
        return std::max(ImGui::CalcTextSize(button.name).x, ImGui::CalcTextSize(key.c_str()).x) + .35f * font;
    };
    float all = 0;
    for (const ToolbarButton& button : buttons) all += width(button) + space;
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float tall = 2.2f * font, room = window.x - 2 * (font + edge);
    const float rows = std::ceil(all / std::max(room, 1.f));
    if (rows * (tall + space) > window.y / 7) return own = {}, clicked;

    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {edge, edge});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {space, space});
    begin_panel("toolbar", .5f, 0, {}, false);
    float x = 0;
    for (std::size_t i = 0; i < buttons.size(); ++i) {
        const ToolbarButton& button = buttons[i];
        const float wide = width(button);
        if (x > 0 && x + wide <= room) ImGui::SameLine(0, space);
        x = x > 0 && x + wide <= room ? x + wide + space : wide + space;
        ImGui::PushID(static_cast<int>(i));
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        if (button.on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
        if (ImGui::Button("##button", {wide, tall})) clicked = button.command;
        if (button.on) ImGui::PopStyleColor();
        if (ImGui::IsItemHovered()) {
            ImGui::SetNextWindowPos({corner.x, own.bottom + space});
            ImGui::SetTooltip("%s", meaning_of(button.command));
        }
        ImGui::PopID();
        const auto centred = [&](const std::string& text, float y, ImU32 color) {
            const float left = corner.x + (wide - ImGui::CalcTextSize(text.c_str()).x) / 2;
            ImGui::GetWindowDrawList()->AddText({left, corner.y + y}, color, text.c_str());
        };
        centred(button.name, 0, IM_COL32_WHITE);
        centred(keys.first_key(button.command.action), 1.05f * font,
                button.on ? IM_COL32_WHITE : IM_COL32(140, 204, 255, 255));
    }
    own = end_panel();
    ImGui::PopStyleVar(2);
    return clicked;
}

bool toolbar_hidden() {
    std::error_code error;
    return std::filesystem::exists(hidden_file(), error);
}

void hide_toolbar(bool hidden) {
    const std::filesystem::path file = hidden_file();
    if (file.empty()) return;
    std::error_code error;
    if (!hidden) return void(std::filesystem::remove(file, error));
    std::filesystem::create_directories(file.parent_path(), error);
    try {
        write_file(file.string(), "");
    } catch (const OutputError&) {
    }
}

}  // namespace strahl
