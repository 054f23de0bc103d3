#include "show/welcome/recent_files.h"

#include <filesystem>

#include "files/os/user_file.h"
#include "files/output_file.h"
#include "files/regular_file.h"

namespace strahl {

std::string recent_files_file() { return os::user_file("XDG_STATE_HOME", ".local/state", "strahl/recent"); }

std::vector<std::string> recent_files_in(std::string_view text) {
    std::vector<std::string> recent;
    while (!text.empty() && recent.size() < most_recent_files) {
        const std::string_view line = text.substr(0, text.find('\n'));
        if (std::filesystem::path(line).is_absolute() && line.find('\0') == line.npos) recent.emplace_back(line);
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    return recent;
}

std::vector<std::string> with_recent(std::vector<std::string> recent, const std::vector<std::string>& opened) {
    for (const std::string& path : opened) {
        std::error_code error;
        const std::string whole = std::filesystem::absolute(path, error).lexically_normal().string();
        if (path == "-" || error || whole.find('\n') != whole.npos) continue;
        std::erase(recent, whole);
        recent.insert(recent.begin(), whole);
    }
    recent.resize(std::min(recent.size(), most_recent_files));
    return recent;
}

std::vector<std::string> read_recent_files() try {
    return recent_files_in(RegularFile(recent_files_file()).bytes(0, 1 << 16));
} catch (const FileError&) {
    return {};
}

void remember_recent_files(const std::vector<std::string>& opened) {
    const std::filesystem::path file = recent_files_file();
    if (file.empty() || opened.empty()) return;
    std::string text;
    for (const std::string& path : with_recent(read_recent_files(), opened)) text += path + '\n';
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    try {
        write_file(file.string(), text);
    } catch (const OutputError&) {
    }
}

}  // namespace strahl
