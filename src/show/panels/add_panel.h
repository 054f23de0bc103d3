// The list of the bodies and lights that can be added to the scene.
#pragma once

#include "show/panels/covered_area.h"
#include "text/new_block.h"

namespace strahl {

class AddPanel {
  public:
    /// To be called while ImGui makes a frame. Returns what the user has clicked, or null.
    const NewBlock* draw(const Margins& margins);
    /// Its width in pixels, with the space beside it.
    float width() const { return wide; }
    const CoveredArea& area() const { return own; }

  private:
    float wide = 0;
    CoveredArea own;
};

}  // namespace strahl
