#include "files/os/file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <ctime>

namespace strahl::os {
namespace {

namespace fs = std::filesystem;

/// While an object exists, writing past the limit of file sizes fails with EFBIG instead of ending the program.
class NoFileSizeSignal {
  public:
    NoFileSizeSignal() {
        ::sigemptyset(&signal);
        ::sigaddset(&signal, SIGXFSZ);
        ::pthread_sigmask(SIG_BLOCK, &signal, &before);
    }
    ~NoFileSizeSignal() {
        // The signal is pending for the thread that wrote. Once unblocked it would end the program, so it is taken.
        if (const timespec now{}; !::sigismember(&before, SIGXFSZ))
            while (::sigtimedwait(&signal, nullptr, &now) < 0 && errno == EINTR) continue;
        ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    }
    NoFileSizeSignal(const NoFileSizeSignal&) = delete;

  private:
    sigset_t signal, before;
};

fs::file_type type_of(mode_t mode) {
    return S_ISREG(mode) ? fs::file_type::regular : S_ISDIR(mode) ? fs::file_type::directory : fs::file_type::unknown;
}

FileStatus file_status(int result, const struct stat& s) {
    if (result != 0) return {.error = errno};
    return {.type = type_of(s.st_mode),
            .size = std::uint64_t(s.st_size),
            .names = s.st_nlink,
            .owner = s.st_uid,
            .group = s.st_gid,
            .permissions = s.st_mode & 0777,
            .stamp = {s.st_dev, s.st_ino, s.st_size, s.st_mtim.tv_sec, s.st_mtim.tv_nsec}};
}

int error_of(int result) { return result == 0 ? 0 : errno; }

int flags_of(OpenFile::OpenMode mode) {
    if (mode == OpenFile::OpenMode::read) return O_RDONLY | O_NONBLOCK | O_CLOEXEC;
    return O_WRONLY | O_CLOEXEC | (mode == OpenFile::OpenMode::create ? O_CREAT | O_EXCL : 0);
}

}  // namespace

Descriptor::~Descriptor() {
    if (number > STDERR_FILENO) ::close(number);
}

FileStatus status_of(const fs::path& path) {
    struct stat status {};
    return file_status(::stat(path.c_str(), &status), status);
}

int writable(const fs::path& path) {
    return error_of(::access(path.c_str(), status_of(path).folder() ? W_OK | X_OK : W_OK));
}

OpenFile::OpenFile(const fs::path& path, OpenMode mode) : file(::open(path.c_str(), flags_of(mode), 0666)) {}

OpenFile OpenFile::standard_output() {
    std::fflush(stdout);
    return OpenFile(Descriptor(STDOUT_FILENO));
}

FileStatus OpenFile::status() const {
    struct stat status {};
    return file_status(::fstat(file.number, &status), status);
}

int OpenFile::read(std::uint64_t at, char* to, std::size_t& count) const {
    std::size_t done = 0;
    while (done < count) {
        const ssize_t got = ::pread(file.number, to + done, count - done, static_cast<off_t>(at + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return errno;
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    count = done;
    return 0;
}

int OpenFile::append(std::string_view bytes) {
    const NoFileSizeSignal guard;
    const bool is_file = status().regular();
    while (!bytes.empty()) {
        const std::size_t piece = is_file ? bytes.size() : std::min<std::size_t>(bytes.size(), PIPE_BUF);
        const ssize_t written = ::write(file.number, bytes.data(), piece);
        if (written < 0 && !(is_file && errno == EINTR)) return errno;
        if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

int OpenFile::reserve(std::uint64_t from, std::uint64_t to) {
    const NoFileSizeSignal guard;
    return ::posix_fallocate(file.number, static_cast<off_t>(from), static_cast<off_t>(to - from));
}

int OpenFile::cut(std::uint64_t size) {
    return error_of(::ftruncate(file.number, static_cast<off_t>(size)) != 0 || ::lseek(file.number, 0, SEEK_END) < 0);
}

int OpenFile::sync() {
    while (::fsync(file.number) != 0)
        if (errno != EINTR) return errno == EINVAL || errno == ENOTSUP ? 0 : errno;
    return 0;
}

void OpenFile::take_over(const FileStatus& old) {
    if (::fchown(file.number, old.owner, old.group) != 0)
        static_cast<void>(::fchown(file.number, uid_t(-1), old.group));
    const FileStatus now = status();
    mode_t mode = old.permissions;
    // A group other than the older file's may not do more than others.
    if (now.error || now.group != old.group) mode &= ~mode_t(070) | (mode & 07) << 3;
    static_cast<void>(::fchmod(file.number, mode));
}

int OpenFile::lock() { return error_of(::flock(file.number, LOCK_EX | LOCK_NB)); }

int OpenFile::close() {
    const int number = std::exchange(file.number, -1);
    return number == STDOUT_FILENO ? 0 : error_of(::close(number));
}

int rename(const fs::path& from, const fs::path& to) { return error_of(::rename(from.c_str(), to.c_str())); }

int sync_folder(const fs::path& folder) {
    OpenFile opened(Descriptor(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)));
    return opened ? opened.sync() : 0;
}

}  // namespace strahl::os
