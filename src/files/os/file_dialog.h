// Asks the user for a file by the dialog of the desktop.
#pragma once
#include <atomic>
#include <string>

namespace strahl::os {

/// Says what a dialog asks for.
struct FileQuestion {
    std::string title;
    std::string folder;         // the one that is shown first, with a slash at its end
    std::string new_name;       // of a file that is to be written, or "" to choose one that exists
    std::string kind, pattern;  // which files are shown: "Scenes" and "*.rt *.pov"
};

/// Waits until the user has chosen a file, and returns its path, or "" if none was chosen. Closes the dialog when
/// `stop` becomes true, where the system can do that. Throws std::runtime_error where there is no dialog.
std::string ask_for_file(const FileQuestion& question, const std::atomic<bool>& stop);

}  // namespace strahl::os
