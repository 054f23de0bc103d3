// Draws the panels of the overlay with ImGui.
#include "show/window/overlay.h"

#include <imgui.h>

#include <algorithm>
#include <sstream>

#include "show/session/keys.h"

namespace strahl {
namespace {

const ImVec4 accent{0.55f, 0.80f, 1, 1}, quiet{1, 1, 1, 0.60f}, alarm{1, 0.45f, 0.38f, 1};
constexpr ImGuiWindowFlags plain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                   ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;

/// Draws a panel at (x, y) of the window above what is reserved: 0 is left or top, 1 right or bottom.
template <class Content>
void panel(const char* name, float x, float y, float reserved, Content content) {
    const ImVec2 all = ImGui::GetIO().DisplaySize, size{all.x, std::max(all.y - reserved, 1.f)};
    const float edge = ImGui::GetFontSize() * 0.8f;
    ImGui::SetNextWindowPos({edge + (size.x - 2 * edge) * x, edge + (size.y - 2 * edge) * y}, ImGuiCond_Always, {x, y});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {size.x - 2 * edge, size.y - 2 * edge});
    ImGui::Begin(name, nullptr, plain);
    content();
    ImGui::End();
}

void cell(const ImVec4& color, const char* text) {
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
}

void draw_key_table() {
    for (const KeyHelp& line : key_help) {
        ImGui::TableNextRow();
        const bool heading = line.meaning[0] == 0;
        cell(heading ? quiet : accent, line.keys);
        cell(ImGui::GetStyleColorVec4(ImGuiCol_Text), line.meaning);
    }
    ImGui::EndTable();
}

void draw_help(const Overlay& overlay) {
    panel("help", 1, 0.5f, overlay.reserved, [] {
        ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {ImGui::GetStyle().CellPadding.x, 1});  // many lines
        if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) draw_key_table();
        ImGui::PopStyleVar();
    });
}

void draw_info(const Overlay& overlay) {
    panel("info", 0, 0, overlay.reserved, [&] {
        if (!ImGui::BeginTable("values", 2, ImGuiTableFlags_SizingFixedFit)) return;
        for (const auto& [name, value] : overlay.info) {
            ImGui::TableNextRow();
            cell(quiet, name.c_str());
            cell(ImGui::GetStyleColorVec4(ImGuiCol_Text), value.c_str());
        }
        ImGui::EndTable();
        ImGui::ProgressBar(static_cast<float>(overlay.share), {-1, ImGui::GetFontSize() * 0.3f}, "");
    });
}

/// Draws the error on at most half of the window; the log has the rest.
void draw_fault(const Overlay& overlay) {
    panel("fault", 0.5f, 1, overlay.reserved, [&] {
        const float font = ImGui::GetFontSize(), wide = ImGui::GetIO().DisplaySize.x - 4 * font;
        const float lowest = ImGui::GetIO().DisplaySize.y / 2;
        ImGui::PushTextWrapPos(wide);
        ImGui::PushStyleColor(ImGuiCol_Text, alarm);
        ImGui::TextUnformatted(overlay.fault_title.c_str());
        ImGui::PopStyleColor();
        ImGui::Spacing();
        std::istringstream lines(overlay.fault);
        for (std::string line; std::getline(lines, line);) {
            const float height = ImGui::CalcTextSize(line.c_str(), nullptr, false, wide).y;
            if (ImGui::GetCursorPosY() + height + 3 * font > lowest) {
                ImGui::TextUnformatted("... and more on standard output (N hides this)");
                break;
            }
            ImGui::TextUnformatted(line.c_str());
        }
        ImGui::PopTextWrapPos();
    });
}

void draw_notes(const Overlay& overlay) {
    panel("notes", 1, 0, overlay.reserved, [&] {
        ImGui::PushTextWrapPos(ImGui::GetIO().DisplaySize.x - 4 * ImGui::GetFontSize());
        for (const std::string& note : overlay.notes) ImGui::TextUnformatted(note.c_str());
        for (const Overlay::Bar& bar : overlay.bars) {
            ImGui::TextUnformatted(bar.text.c_str());
            ImGui::ProgressBar(static_cast<float>(bar.share), {ImGui::GetFontSize() * 18, ImGui::GetFontSize() * 0.4f},
                               "");
        }
        ImGui::PopTextWrapPos();
    });
}

/// Draws pixels that are not proved in blue, and small crosses, because single pixels are hard to see: orange where
/// only float differs, red where double does too.
void draw_marks(const Overlay& overlay) {
    const float reach = ImGui::GetFontSize() / 5;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const auto place = [&](double x, double y) {
        return ImVec2{static_cast<float>(overlay.area.x + overlay.area.width * x / overlay.width),
                      static_cast<float>(overlay.area.y + overlay.area.height * y / overlay.height)};
    };
    for (const auto& [x, y, columns] : overlay.marks.undecided)
        list.AddRectFilled(place(x, y), place(x + columns, y + 1), IM_COL32(60, 100, 255, 160));
    for (const Mark& mark : overlay.marks.marks) {
        const ImVec2 at = place(mark.x + .5, mark.y + .5);
        const ImU32 color = mark.in_double ? IM_COL32(255, 0, 25, 255) : IM_COL32(255, 153, 0, 255);
        list.AddLine({at.x - reach, at.y}, {at.x + reach, at.y}, color, 1.5f);
        list.AddLine({at.x, at.y - reach}, {at.x, at.y + reach}, color, 1.5f);
    }
}

}  // namespace

void draw_overlay(const Overlay& overlay) {
    draw_marks(overlay);
    if (!overlay.info.empty()) draw_info(overlay);
    if (!overlay.fault.empty()) draw_fault(overlay);
    if (!overlay.notes.empty() || !overlay.bars.empty()) draw_notes(overlay);
    if (overlay.help) draw_help(overlay);
}

}  // namespace strahl
