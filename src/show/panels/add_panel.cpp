#include "show/panels/add_panel.h"

#include <imgui.h>

namespace strahl {

const NewBlock* AddPanel::draw(const Margins& margins) {
    const NewBlock* chosen = nullptr;
    begin_panel("add", 0, .5f, margins);
    ImGui::TextUnformatted("Add");
    const float width = 8 * ImGui::GetFontSize();
    for (const NewBlock& block : new_blocks)
        if (ImGui::Button(block.name, {width, 0})) chosen = &block;
    own = end_panel();
    wide = own.right - own.left + .8f * ImGui::GetFontSize();
    return chosen;
}

}  // namespace strahl
