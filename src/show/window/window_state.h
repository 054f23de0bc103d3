// Size and place of the window, from one start to the next.
#pragma once
#include <optional>
#include <string>

namespace strahl {

/// In the units of the screen. Without width and height it had its default size.
struct WindowState {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const WindowState&) const = default;
};

/// $XDG_STATE_HOME/strahl/window, by default ~/.local/state/strahl/window (XDG Base Directory Specification 0.8); empty
/// if there is no such folder.
std::string window_state_file();

/// What was written last, if it makes sense.
std::optional<WindowState> read_window_state();
/// Where that is not possible the window opens as if for the first time.
void write_window_state(const WindowState& state);

}  // namespace strahl
