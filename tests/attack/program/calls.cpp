// The file calls of the preloaded library: they come to harm, or are recorded for a power cut.
#include "calls.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

namespace strahl::attack {
namespace {

int log_file = -1;

template <class... A>
long kernel(long call, A... arguments) {
    return ::syscall(call, arguments...);
}

/// One line of the log, and the bytes after it.
void record(const char* format, unsigned long inode, long a, long b, const char* path, const char* to = "") {
    if (log_file < 0) return;
    char line[600];
    const int length = std::snprintf(line, sizeof line, "%s %lu %ld %ld %s %s\n", format, inode, a, b, path, to);
    kernel(SYS_write, log_file, line, length);
}

unsigned long inode_of(int file) {
    struct stat status {};
    return ::fstat(file, &status) == 0 && (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode)) ? status.st_ino : 0;
}

/// Does what was ordered to this call, if it is its turn, and else the call; returns what the call would.
template <class Call, class Part>
long harmed(const char* name, Call call, Part part) {
    if (!struck(Watched::files, name)) return call();
    const Harm harm = orders()->harm;
    if (harm == Harm::kill_before) ::kill(::getpid(), SIGKILL);
    if (harm == Harm::error) return errno = orders()->error, -1;
    const long result = harm == Harm::cut ? part() : call();
    if (harm == Harm::kill_after) ::kill(::getpid(), SIGKILL);
    return result;
}

template <class Call>
long harmed(const char* name, Call call) {
    return harmed(name, call, call);
}

/// Makes a system call, unless harm is ordered to it.
template <class... A>
int watched(const char* name, long call, A... arguments) {
    return static_cast<int>(harmed(name, [&] { return kernel(call, arguments...); }));
}

bool writes(int flags) { return (flags & O_ACCMODE) != O_RDONLY; }

int opened(const char* name, int folder, const char* path, int flags, mode_t mode) {
    const auto call = [&] { return kernel(SYS_openat, folder, path, flags, mode); };
    if (!orders() || !writes(flags)) return static_cast<int>(call());
    if (orders()->only_named && (flags & O_TMPFILE) == O_TMPFILE) return errno = EOPNOTSUPP, -1;
    struct stat before {};
    const bool existed = ::fstatat(folder, path, &before, 0) == 0;
    const int file = static_cast<int>(harmed(name, call));
    if (file < 0) return file;
    if ((flags & O_TMPFILE) == O_TMPFILE)
        record("nameless", inode_of(file), 0, 0, "");
    else if (!existed)
        record("create", inode_of(file), 0, 0, path);
    else if (flags & O_TRUNC)
        record("truncate", inode_of(file), 0, 0, "");
    return file;
}

mode_t mode_in(int flags, va_list more) {
    return (flags & O_CREAT) || (flags & O_TMPFILE) == O_TMPFILE ? va_arg(more, mode_t) : 0;
}

/// A write of `count` bytes, half of which are written when it is cut off.
template <class Call>
ssize_t written(const char* name, int file, const void* bytes, std::size_t count, Call call) {
    if (!orders() || file == STDERR_FILENO) return call(count);
    const long at = ::lseek(file, 0, SEEK_CUR);
    const ssize_t done = harmed(
        name, [&] { return call(count); }, [&] { return call((count + 1) / 2); });
    if (done > 0 && log_file >= 0 && inode_of(file)) {
        record("write", inode_of(file), at, done, "");
        kernel(SYS_write, log_file, bytes, done);
    }
    return done;
}

ssize_t print(void*, const char* bytes, std::size_t count) { return ::write(STDOUT_FILENO, bytes, count); }

}  // namespace

void prepare_files() {
    if (const char* const path = ::getenv(log_variable))
        log_file = static_cast<int>(kernel(SYS_openat, AT_FDCWD, path, O_WRONLY | O_APPEND | O_CLOEXEC, 0));
    if (std::FILE* const watched = ::fopencookie(nullptr, "w", {nullptr, print, nullptr, nullptr})) stdout = watched;
}

}  // namespace strahl::attack

using namespace strahl::attack;

extern "C" {

#define STRAHL_OPEN(name, ...)                \
    va_list more;                             \
    va_start(more, flags);                    \
    const mode_t mode = mode_in(flags, more); \
    va_end(more);                             \
    return opened(name, __VA_ARGS__, path, flags, mode)

int open(const char* path, int flags, ...) { STRAHL_OPEN("open", AT_FDCWD); }
int open64(const char* path, int flags, ...) { STRAHL_OPEN("open", AT_FDCWD); }
int openat(int folder, const char* path, int flags, ...) { STRAHL_OPEN("openat", folder); }
int openat64(int folder, const char* path, int flags, ...) { STRAHL_OPEN("openat", folder); }
int creat(const char* path, mode_t mode) { return opened("creat", AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, mode); }

ssize_t write(int file, const void* bytes, std::size_t count) {
    return written("write", file, bytes, count, [&](std::size_t n) { return kernel(SYS_write, file, bytes, n); });
}
ssize_t pwrite(int file, const void* bytes, std::size_t count, off_t at) {
    return written("pwrite", file, bytes, count,
                   [&](std::size_t n) { return kernel(SYS_pwrite64, file, bytes, n, at); });
}
ssize_t writev(int file, const iovec* parts, int count) {
    const auto call = [&] { return kernel(SYS_writev, file, parts, count); };
    return file == STDERR_FILENO ? call() : harmed("writev", call);
}

int fsync(int file) {
    const auto call = [&] { return orders() ? 0 : kernel(SYS_fsync, file); };  // it is slow, and nothing depends on it
    const int result = static_cast<int>(harmed("fsync", call));
    if (result == 0) record("sync", inode_of(file), 0, 0, "");
    return result;
}
int fdatasync(int file) { return fsync(file); }
int syncfs(int file) noexcept {
    const auto call = [&] { return orders() ? 0 : kernel(SYS_syncfs, file); };
    return static_cast<int>(harmed("syncfs", call));
}

int rename(const char* from, const char* to) noexcept {
    const int result = watched("rename", SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
    if (result == 0) record("rename", 0, 0, 0, from, to);
    return result;
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept {
    return watched("renameat2", SYS_renameat2, from_folder, from, to_folder, to, flags);
}
int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept {
    const int result = watched("linkat", SYS_linkat, from_folder, from, to_folder, to, flags);
    struct stat status {};
    if (result == 0 && ::fstatat(to_folder, to, &status, 0) == 0) record("link", status.st_ino, 0, 0, to);
    return result;
}
int link(const char* from, const char* to) noexcept { return linkat(AT_FDCWD, from, AT_FDCWD, to, 0); }
int unlink(const char* path) noexcept {
    const int result = watched("unlink", SYS_unlinkat, AT_FDCWD, path, 0);
    if (result == 0) record("unlink", 0, 0, 0, path);
    return result;
}
int mkdir(const char* path, mode_t mode) noexcept { return watched("mkdir", SYS_mkdirat, AT_FDCWD, path, mode); }

int ftruncate(int file, off_t size) noexcept {
    const int result = watched("ftruncate", SYS_ftruncate, file, size);
    if (result == 0) record("truncate", inode_of(file), size, 0, "");
    return result;
}
int posix_fallocate(int file, off_t from, off_t count) {
    const auto call = [&] { return kernel(SYS_fallocate, file, 0, from, count); };
    if (harmed("posix_fallocate", call) < 0) return errno;
    record("truncate", inode_of(file), from + count, 0, "");
    return 0;
}

int close(int file) {
    const int mode = ::fcntl(file, F_GETFL);
    const auto call = [&] { return kernel(SYS_close, file); };
    if (!orders() || mode < 0 || !writes(mode)) return static_cast<int>(call());
    // The file is closed even if the call fails, as on Linux.
    bool is_closed = false;
    const long result = harmed("close", [&] { return is_closed = true, call(); });
    const int error = errno;
    if (!is_closed) call();
    return errno = error, static_cast<int>(result);
}
int fchmod(int file, mode_t mode) noexcept { return watched("fchmod", SYS_fchmod, file, mode); }
int fchown(int file, uid_t owner, gid_t group) noexcept { return watched("fchown", SYS_fchown, file, owner, group); }

}  // extern "C"
