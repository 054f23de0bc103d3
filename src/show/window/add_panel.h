// The list of the bodies and lights that can be added to the scene.
#pragma once

#include "show/window/covered_area.h"
#include "text/new_block.h"

namespace strahl {

class AddPanel {
  public:
    /// To be called while ImGui makes a frame. Returns what the user has clicked, or null. Leaves free so many pixels
    /// at the bottom and at the left of the window.
    const NewBlock* draw(float reserved, float left);
    const CoveredArea& area() const { return own; }

  private:
    CoveredArea own;
};

}  // namespace strahl
