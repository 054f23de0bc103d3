#include "show/welcome/help_panel.h"

#include <imgui.h>

#include <algorithm>

#include "show/keys/key_file.h"

namespace strahl {

void draw_help(const KeyMap& keys, const std::string& typed) {
    const auto all = help_rows(keys, ""), rows = help_rows(keys, typed);
    const float font = ImGui::GetFontSize(), edge = font * .8f;
    const ImVec2 window = ImGui::GetIO().DisplaySize, room{window.x - 2 * edge, window.y - 2 * edge};
    const ImVec2 inner{room.x - 2 * edge, room.y - 2 * edge};
    // The page keeps its layout while it is searched.
    float name = 0, meaning = 0;
    for (const HelpRow& row : all) {
        if (!row.meaning.empty()) name = std::max(name, ImGui::CalcTextSize(row.keys.c_str()).x);
        meaning = std::max(meaning, ImGui::CalcTextSize(row.meaning.c_str()).x);
    }
    name += font, meaning += font;
    const float line = 1.13f * font;
    int columns = 1, lines = 1;
    float scale = .1f;  // at least, in windows where nobody can read it
    for (const int count : {1, 2, 3, 4}) {
        // Each column but the last may lack a line: a heading that would end it.
        const int high = (static_cast<int>(all.size()) + 2 * (count - 1)) / count;
        const float fits = std::min(inner.x / (static_cast<float>(count) * (name + meaning)),
                                    inner.y / (static_cast<float>(high + 2) * line));
        if (std::min(fits, 1.f) > scale) scale = std::min(fits, 1.f), columns = count, lines = high;
    }
    const ImVec2 size{static_cast<float>(columns) * (name + meaning) * scale + 2 * edge,
                      static_cast<float>(lines + 2) * line * scale + 2 * edge};
    ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {.5f, .5f});
    ImGui::SetNextWindowSize(size);
    ImGui::SetNextWindowBgAlpha(.94f);
    ImGui::Begin("help", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::SetWindowFontScale(scale);
    const auto put = [&](float x, float y, const ImVec4& color, const std::string& text) {
        ImGui::SetCursorPos({edge + x * scale, edge + y * line * scale});
        ImGui::TextColored(color, "%s", text.c_str());
    };
    const ImVec4 accent{.55f, .8f, 1, 1}, quiet{1, 1, 1, .6f}, plain{1, 1, 1, 1};
    put(0, 0, quiet, typed.empty() ? "Type to search; Esc or a click closes this" : "Search: " + typed + "_");
    if (rows.empty()) put(0, 2, plain, "Nothing has this word");
    int at = 0;
    for (const HelpRow& row : rows) {
        const bool heading = row.meaning.empty();
        if (heading && at % lines == lines - 1) ++at;  // no column ends with a heading
        const float x = static_cast<float>(at / lines) * (name + meaning), y = static_cast<float>(at % lines + 2);
        put(x, y, heading ? quiet : accent, row.keys);
        if (!heading) put(x + name, y, plain, row.meaning);
        ++at;
    }
    ImGui::SetWindowFontScale(1);
    ImGui::End();
}

}  // namespace strahl
