#include "files/os/user_file.h"

#include <cstdlib>
#include <filesystem>

namespace strahl::os {

std::string user_file(const char* variable, const char* usual, const char* name) {
    const auto absolute = [](const char* of) {
        const char* const value = std::getenv(of);
        return std::filesystem::path(value && value[0] == '/' ? value : "");
    };
    std::filesystem::path folder = absolute(variable);
    if (folder.empty() && !absolute("HOME").empty()) folder = absolute("HOME") / usual;
    return folder.empty() ? "" : (folder / name).string();
}

}  // namespace strahl::os
