#include "files/os/temporary_file.h"

#include <cerrno>
#include <system_error>

#include "files/os/windows/win32.h"

namespace strahl::os {

namespace fs = std::filesystem;

namespace {

/// Opens a file, which others may meanwhile open, rename and remove.
OpenFile open_shared(const fs::path& path, DWORD access, DWORD how) {
    return OpenFile(
        descriptor_of(::CreateFileW(path.c_str(), access, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                                    nullptr, how, FILE_ATTRIBUTE_NORMAL, nullptr)));
}

}  // namespace

void remove_left(const fs::path& folder) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(".strahl-") || !name.ends_with(".tmp")) continue;
        OpenFile file = open_shared(entry.path(), GENERIC_READ, OPEN_EXISTING);
        if (file && file.lock() == 0) ::DeleteFileW(entry.path().c_str());
    }
}

Temporary::Temporary(const fs::path& beside, bool stays)
    : folder(beside.parent_path()), ending(stays ? ".copy" : ".tmp") {
    for (int i = 0; i < 1000 && !opened(); ++i) {
        name = folder / (".strahl-" + std::to_string(::GetCurrentProcessId()) + "-" + std::to_string(i) + ending);
        own_file = open_shared(name, GENERIC_READ | GENERIC_WRITE, CREATE_NEW);
        if (!opened() && errno != EEXIST) break;
    }
    opened() ? void(own_file.lock()) : name.clear();
}

Temporary::~Temporary() {
    own_file.close();
    if (!name.empty()) ::DeleteFileW(name.c_str());
}

int Temporary::give_name() { return 0; }  // it has one from the beginning

}  // namespace strahl::os
