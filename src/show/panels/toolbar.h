// The toolbar at the upper edge of the window: buttons for what a new user looks for first, each with its key.
#pragma once
#include <optional>

#include "show/keys/key_map.h"
#include "show/panels/covered_area.h"
#include "show/session/handles.h"

namespace strahl {

/// Says which of the toolbar's buttons are shown as on.
struct ToolbarView {
    std::optional<HandleMode> handles;  // of what is chosen
    bool adding = false, lights = false, camera = false, playing = false, recording = false, unsaved = false;
};

class Toolbar {
  public:
    /// To be called while ImGui makes a frame. Returns what was clicked. Draws nothing where it would take more than a
    /// seventh of the window's height.
    std::optional<Command> draw(const KeyMap& keys, const ToolbarView& view);
    const CoveredArea& area() const { return own; }
    /// The pixels that it takes at the top of the window.
    float height() const { return own.bottom; }

  private:
    CoveredArea own;
};

/// Returns whether the user has hidden the toolbar, also at an earlier time.
bool toolbar_hidden();
/// Keeps that for the next start; errors are ignored.
void hide_toolbar(bool hidden);

}  // namespace strahl
