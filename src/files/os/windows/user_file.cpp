#include "files/os/user_file.h"

#include <cstdlib>
#include <filesystem>

namespace strahl::os {

std::string user_file(const char* variable, const char*, const char* name) {
    const char* folder = std::getenv(variable);
    if (!folder) folder = std::getenv("APPDATA");
    return folder ? (std::filesystem::path(folder) / name).string() : "";
}

}  // namespace strahl::os
