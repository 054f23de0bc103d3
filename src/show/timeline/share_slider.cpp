#include "show/timeline/share_slider.h"

#include <imgui.h>

#include <utility>

#include "text/blocks/blocks.h"

namespace strahl {

bool draw_share(double& share) {
    // ImGui lets sliders be typed into with Ctrl only, and other numbers after a double click as well.
    bool& control = ImGui::GetIO().KeyCtrl;
    const bool held = std::exchange(control, control || ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left));
    const bool changed = ImGui::SliderScalar("##share", ImGuiDataType_Double, &share, &shares.low, &shares.high, "%.3f",
                                             ImGuiSliderFlags_AlwaysClamp);
    control = held;
    return changed;
}

}  // namespace strahl
