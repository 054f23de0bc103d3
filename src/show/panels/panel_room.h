// Which of the open panels have room beside each other: those opened last.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "show/keys/commands.h"
#include "show/panels/covered_area.h"

namespace strahl {

/// The timeline lies at the bottom of the window, the others beside each other above it.
enum class Panel { timeline, outline, add, info, body };
/// The actions that show and hide them, in their order. The panel of the body, the last one, has none.
inline constexpr std::array panel_actions{Action::timeline, Action::outline, Action::add_block, Action::info};
inline constexpr std::size_t panel_count = panel_actions.size() + 1;

class PanelRoom {
  public:
    /// Opens a panel, or has one that is open be the one opened last.
    void open(Panel panel);
    void close(Panel panel);
    bool is_open(Panel panel) const;
    /// Is it open, and does it have room? Panels without room stay open, and are shown again once there is room.
    bool shown(Panel panel) const { return fits[std::size_t(panel)]; }
    /// Returns the open panels, in the order in which they were opened.
    const std::vector<Panel>& opened() const { return order; }

    /// Returns what a panel covered when it was drawn last; nothing before that.
    CoveredArea& area(Panel panel) { return areas[std::size_t(panel)]; }
    const CoveredArea& area(Panel panel) const { return areas[std::size_t(panel)]; }

    /// The window below the toolbar, in pixels; the room that a panel needs above the timeline; the height of the
    /// timeline.
    struct RoomSizes {
        float width = 0, height = 0, least = 0, timeline = 0;
    };
    /// Finds out which panels have room, from that opened last to the first.
    void arrange(const RoomSizes& sizes);

  private:
    std::array<CoveredArea, panel_count> areas;
    std::vector<Panel> order;  // those that are open, the one opened last at the end
    std::array<bool, panel_count> fits{};
};

}  // namespace strahl
