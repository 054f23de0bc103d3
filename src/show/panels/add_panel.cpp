#include "show/panels/add_panel.h"

#include <imgui.h>

namespace strahl {

const NewBlock* draw_add_panel(const Margins& margins, CoveredArea& covered) {
    const NewBlock* chosen = nullptr;
    begin_panel("add", 0, .5f, margins);
    ImGui::TextUnformatted("Add");
    const float width = 8 * ImGui::GetFontSize();
    for (const NewBlock& block : new_blocks)
        if (ImGui::Button(block.name, {width, 0})) chosen = &block;
    covered = end_panel();
    return chosen;
}

}  // namespace strahl
