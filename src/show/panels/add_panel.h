// The list of the bodies and lights that can be added to the scene.
#pragma once

#include "show/panels/covered_area.h"
#include "text/new_block.h"

namespace strahl {

/// To be called while ImGui makes a frame. Sets what the panel covers. Returns what the user has clicked, or null.
const NewBlock* draw_add_panel(const Margins& margins, CoveredArea& covered);

}  // namespace strahl
