// Remembers size and place of the window from one start to the next.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace strahl {

/// In units of the screen. Width and height are 0 for the default size.
struct WindowState {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const WindowState&) const = default;
};

/// Returns $XDG_STATE_HOME/strahl/window, by default ~/.local/state/strahl/window, see user_file().
std::string window_state_file();

/// Reads the text of such a file: x, y, width and height. Nothing if it is not valid.
std::optional<WindowState> window_state_in(std::string_view text);
/// Reads what was written last; nothing if there is no valid file.
std::optional<WindowState> read_window_state();
/// Errors are ignored: then the window opens as if for the first time.
void write_window_state(const WindowState& state);

}  // namespace strahl
