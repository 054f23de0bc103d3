// Replaces the window in builds without one.
#include "main/commands/command_view.h"

#include <stdexcept>

namespace strahl {

bool window_possible() { return false; }

int view_command(const ViewOptions&, const std::atomic<bool>*) {
    throw std::runtime_error(
        "strahl was built without the window (cmake -D STRAHL_WINDOW=ON includes it)\n"
        "To render without a window: strahl render SCENE -o picture.png");
}

}  // namespace strahl
