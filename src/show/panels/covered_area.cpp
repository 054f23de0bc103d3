#include "show/panels/covered_area.h"

#include <imgui.h>

#include <algorithm>

namespace strahl {

void begin_panel(const char* name, float x, float y, const Margins& margins, bool scrolls) {
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                       ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoNav |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                                       ImGuiWindowFlags_NoFocusOnAppearing;
    const float edge = ImGui::GetFontSize() * .8f;
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    const ImVec2 room{std::max(all.x - margins.left - 2 * edge, 1.f),
                      std::max(all.y - margins.top - margins.bottom - 2 * edge, 1.f)};
    ImGui::SetNextWindowPos({margins.left + edge + x * room.x, margins.top + edge + y * room.y}, ImGuiCond_Always,
                            {x, y});
    ImGui::SetNextWindowSizeConstraints({0, 0}, room);
    ImGui::Begin(name, nullptr, scrolls ? flags : flags | ImGuiWindowFlags_NoScrollbar);
}

CoveredArea end_panel() {
    const ImVec2 corner = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    ImGui::End();
    return {corner.x, corner.y, corner.x + size.x, corner.y + size.y, size.x + .8f * ImGui::GetFontSize()};
}

}  // namespace strahl
