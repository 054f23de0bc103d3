#include "files/os/temporary_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <memory>

namespace strahl::os {

namespace fs = std::filesystem;

void remove_left(const fs::path& folder) {
    const std::unique_ptr<DIR, int (*)(DIR*)> list(::opendir(folder.empty() ? "." : folder.c_str()), ::closedir);
    if (!list) return;
    while (const dirent* entry = ::readdir(list.get())) {
        const std::string_view name = entry->d_name;
        if (!name.starts_with(".strahl-") || !name.ends_with(".tmp")) continue;
        const fs::path path = folder / name;
        const Descriptor file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (file && ::flock(file.number, LOCK_EX | LOCK_NB) == 0) ::unlink(path.c_str());
    }
}

template <class Make>
bool Temporary::named(Make make) {
    for (int i = 0; i < 1000; ++i) {
        name = folder / (".strahl-" + std::to_string(::getpid()) + "-" + std::to_string(i) + ending);
        if (make(name.c_str())) return true;
        if (errno != EEXIST) break;
    }
    const int error = errno;
    name.clear();
    errno = error;
    return false;
}

Temporary::Temporary(const fs::path& beside, bool stays)
    : folder(beside.parent_path()), ending(stays ? ".copy" : ".tmp") {
    const auto open = [&](const char* path, int how) {
        own_file = OpenFile(Descriptor(::open(path, O_RDWR | O_CLOEXEC | how, 0666)));
        if (own_file) own_file.lock();
        return opened();
    };
    // Without /proc it could get no name later.
    if (open(folder.empty() ? "." : folder.c_str(), O_TMPFILE) && ::access(link().c_str(), F_OK) == 0) return;
    named([&](const char* path) {
        if (!open(path, O_CREAT | O_EXCL)) return false;
        if (own_file.status().names > 0) return true;
        own_file = {};  // another program removed it before it was locked
        return errno = EEXIST, false;
    });
}
Temporary::~Temporary() {
    own_file.close();
    if (!name.empty()) ::unlink(name.c_str());
}

int Temporary::give_name() {
    if (!name.empty()) return 0;
    return named([&](const char* path) {
        return ::linkat(AT_FDCWD, link().c_str(), AT_FDCWD, path, AT_SYMLINK_FOLLOW) == 0;
    })
               ? 0
               : errno;
}

}  // namespace strahl::os
