#include "files/temporary_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <memory>

namespace strahl {

namespace fs = std::filesystem;

NoFileSizeSignal::NoFileSizeSignal() {
    ::sigemptyset(&signal);
    ::sigaddset(&signal, SIGXFSZ);
    ::pthread_sigmask(SIG_BLOCK, &signal, &before);
}
NoFileSizeSignal::~NoFileSizeSignal() {
    // The signal is pending for the thread that wrote. Once unblocked it would end the program, so it is taken first.
    if (const timespec now{}; !::sigismember(&before, SIGXFSZ))
        while (::sigtimedwait(&signal, nullptr, &now) < 0 && errno == EINTR) continue;
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

int write_all(int file, std::string_view bytes) {
    const NoFileSizeSignal guard;
    struct stat status {};
    const bool is_file = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
    while (!bytes.empty()) {
        const ssize_t written =
            ::write(file, bytes.data(), is_file ? bytes.size() : std::min<size_t>(bytes.size(), PIPE_BUF));
        if (written < 0 && !(is_file && errno == EINTR)) return errno;
        if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

int synced(int file) {
    while (::fsync(file) != 0)
        if (errno != EINTR) return errno == EINVAL || errno == ENOTSUP ? 0 : errno;
    return 0;
}

int sync_folder(const fs::path& folder) {
    const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return 0;
    const int error = synced(file);
    ::close(file);
    return error;
}

void remove_left(const fs::path& folder) {
    const std::unique_ptr<DIR, int (*)(DIR*)> list(::opendir(folder.empty() ? "." : folder.c_str()), ::closedir);
    if (!list) return;
    while (const dirent* entry = ::readdir(list.get())) {
        const std::string_view name = entry->d_name;
        if (!name.starts_with(".strahl-") || !name.ends_with(".tmp")) continue;
        const fs::path path = folder / name;
        const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (file < 0) continue;
        if (::flock(file, LOCK_EX | LOCK_NB) == 0) ::unlink(path.c_str());
        ::close(file);
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
    file = ::open(folder.empty() ? "." : folder.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0666);
    if (file >= 0 && ::access(link().c_str(), F_OK) == 0) {  // without /proc it could get no name later
        ::flock(file, LOCK_EX | LOCK_NB);
        return;
    }
    if (file >= 0) ::close(file);
    named([&](const char* path) {
        file = ::open(path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file < 0) return false;
        struct stat status {};
        ::flock(file, LOCK_EX | LOCK_NB);
        if (::fstat(file, &status) == 0 && status.st_nlink > 0) return true;
        ::close(file);  // another program removed it before it was locked
        return file = -1, errno = EEXIST, false;
    });
}
Temporary::~Temporary() {
    if (file >= 0) ::close(file);
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

}  // namespace strahl
