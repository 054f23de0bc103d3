// Reads and writes the file with the window's size and place.
#include "show/window/window_state.h"

#include <filesystem>

#include "files/error.h"
#include "files/os/user_file.h"
#include "files/output_file.h"
#include "files/regular_file.h"
#include "files/streams.h"
#include "files/utf8.h"

namespace strahl {

std::string window_state_file() { return os::user_file("XDG_STATE_HOME", ".local/state", "strahl/window"); }

std::optional<WindowState> window_state_in(std::string_view text) try {
    WordStream words{std::string(utf8_text(text, "window"))};
    WindowState s;
    words >> s.x >> s.y >> s.width >> s.height;
    const auto sound = [](int size) { return size >= 64 && size <= 16384; };
    const bool either = (s.width == 0 && s.height == 0) || (sound(s.width) && sound(s.height));
    return words && either ? std::optional(s) : std::nullopt;
} catch (const FileError&) {
    return std::nullopt;
}

std::optional<WindowState> read_window_state() try {
    return window_state_in(RegularFile(window_state_file()).bytes(0, 1000));
} catch (const FileError&) {
    return std::nullopt;
}

void write_window_state(const WindowState& s) {
    const std::filesystem::path file = window_state_file();
    if (file.empty()) return;
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    const auto number = [](int value) { return std::to_string(value) + " "; };
    try {
        write_file(file.string(), number(s.x) + number(s.y) + number(s.width) + std::to_string(s.height) + "\n");
    } catch (const OutputError&) {
    }
}

}  // namespace strahl
