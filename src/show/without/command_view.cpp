// In place of the window, in builds that leave it out.
#include "show/command_view.h"

#include <stdexcept>

namespace strahl {

int view_command(const ViewOptions&) {
    throw std::runtime_error(
        "this strahl was built without a window (cmake -D STRAHL_WINDOW=ON builds it in)\n"
        "Pictures need no window: strahl render SCENE -o picture.png");
}

}  // namespace strahl
