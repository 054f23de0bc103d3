#include "files/os/folder.h"

#include <cerrno>
#include <system_error>
#include <utility>

#include "files/os/file.h"
#include "files/os/windows/win32.h"

namespace strahl::os {

namespace fs = std::filesystem;

NewFolder::NewFolder(const std::string& start, std::vector<const char*> own_usual) : usual(std::move(own_usual)) {
    for (int number = 0; own_path.empty(); ++number) {
        const std::string path = start + std::to_string(::GetCurrentProcessId()) + "-" + std::to_string(number);
        if (::CreateDirectoryW(fs::path(path).c_str(), nullptr))
            own_path = path;
        else if (const int error = error_of(FALSE); error != EEXIST)
            throw std::system_error(error, std::generic_category());
    }
}

int NewFolder::become(const fs::path& target) {
    if (!is_empty_folder(target)) return fs::exists(target) ? EEXIST : os::rename(own_path, target);
    return ::RemoveDirectoryW(target.c_str()) ? os::rename(own_path, target) : error_of(FALSE);
}

int NewFolder::remove() {
    std::error_code error;
    fs::remove_all(own_path, error);
    return error ? EIO : 0;
}

bool is_empty_folder(const fs::path& path) {
    std::error_code error;
    return fs::is_directory(path, error) && fs::is_empty(path, error);
}

}  // namespace strahl::os
