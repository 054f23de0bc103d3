// Which of the open panels have room beside each other: those opened last.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace strahl {

/// The timeline lies at the bottom of the window, the others beside each other above it.
enum class Panel { timeline, outline, add, info, body };
inline constexpr int panel_count = 5;

class PanelRoom {
  public:
    /// Opens a panel, or has one that is open be the one opened last.
    void open(Panel panel);
    void close(Panel panel);
    bool is_open(Panel panel) const;
    /// Is it open, and does it have room? Those that have none stay open, and are shown again once there is room.
    bool shown(Panel panel) const { return fits[std::size_t(panel)]; }
    /// Returns those that are open, in the order in which they were opened.
    const std::vector<Panel>& opened() const { return order; }

    /// The window below the toolbar, in pixels; the room that a panel needs above the timeline; the height of the
    /// timeline; and the widths of the others with the space beside them, 0 if that is not known yet.
    struct RoomSizes {
        float width = 0, height = 0, least = 0, timeline = 0;
        std::array<float, panel_count> widths{};
    };
    /// Finds out which panels have room, from that opened last to the first.
    void arrange(const RoomSizes& sizes);

  private:
    std::vector<Panel> order;  // those that are open, the one opened last at the end
    std::array<bool, panel_count> fits{};
};

}  // namespace strahl
