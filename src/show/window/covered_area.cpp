#include "show/window/covered_area.h"

#include <imgui.h>

#include <algorithm>

namespace strahl {

void begin_panel(const char* name, float x, float y, float reserved, float left) {
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                       ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoNav |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                                       ImGuiWindowFlags_NoFocusOnAppearing;
    const float edge = ImGui::GetFontSize() * .8f;
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    const ImVec2 room{std::max(all.x - left - 2 * edge, 1.f), std::max(all.y - reserved - 2 * edge, 1.f)};
    ImGui::SetNextWindowPos({left + edge + x * room.x, edge + y * room.y}, ImGuiCond_Always, {x, y});
    ImGui::SetNextWindowSizeConstraints({0, 0}, room);
    ImGui::Begin(name, nullptr, flags);
}

CoveredArea end_panel() {
    const ImVec2 corner = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    ImGui::End();
    return {corner.x, corner.y, corner.x + size.x, corner.y + size.y};
}

}  // namespace strahl
