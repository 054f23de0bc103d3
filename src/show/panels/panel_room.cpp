#include "show/panels/panel_room.h"

#include <algorithm>
#include <cstddef>

namespace strahl {

void PanelRoom::open(Panel panel) {
    std::erase(order, panel);
    order.push_back(panel);
    fits[std::size_t(panel)] = true;
}

void PanelRoom::close(Panel panel) {
    std::erase(order, panel);
    fits[std::size_t(panel)] = false;
}

bool PanelRoom::is_open(Panel panel) const { return std::ranges::count(order, panel) > 0; }

void PanelRoom::arrange(const RoomSizes& sizes) {
    fits = {};
    float used = 0;  // of the width, by those above the timeline
    const bool together = sizes.height - sizes.timeline >= sizes.least;
    for (auto panel = order.rbegin(); panel != order.rend(); ++panel) {
        bool& room = fits[std::size_t(*panel)];
        const float width = area(*panel).wide;
        if (*panel == Panel::timeline) {
            room = used == 0 || together;
        } else if ((used == 0 || used + width <= sizes.width) && (!shown(Panel::timeline) || together)) {
            room = true;
            used += width;
        }
    }
}

}  // namespace strahl
