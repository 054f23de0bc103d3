// Whole files out: temporary file, then rename.
#include "text/file.h"

#include <dirent.h>
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
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace strahl {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, int error, const std::string& more = "") {
    std::string why = std::generic_category().message(error);
    if (error == ENOENT) why = "its folder does not exist; make that first";
    if (error == EISDIR) why = "it is a folder; name a file in it";
    std::string told = "cannot write '";
    told += path + "': " + why + more;
    if (error == EINTR) throw Interrupted(told);
    throw OutputError(told);
}

/// While it lives, writing past the limit of file sizes fails with EFBIG instead of ending the program.
class NoFileSizeSignal {
  public:
    NoFileSizeSignal() {
        ::sigemptyset(&signal);
        ::sigaddset(&signal, SIGXFSZ);
        ::pthread_sigmask(SIG_BLOCK, &signal, &before);
    }
    ~NoFileSizeSignal() {
        // The signal goes to the thread that wrote. Unblocked while it waits, it would end the program after all.
        if (const timespec now{}; !::sigismember(&before, SIGXFSZ))
            while (::sigtimedwait(&signal, nullptr, &now) < 0 && errno == EINTR) continue;
        ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    }
    NoFileSizeSignal(const NoFileSizeSignal&) = delete;

  private:
    sigset_t signal, before;
};

/// Writes everything, or says why not (an errno). Pipes and devices may keep it waiting for ever: a signal ends that,
/// and is noticed because they get pieces that are written as a whole or not at all.
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

/// Waits until the disk has it: an errno if it has not. File systems that know no such thing are left alone.
int synced(int file) {
    while (::fsync(file) != 0)
        if (errno != EINTR) return errno == EINVAL || errno == ENOTSUP ? 0 : errno;
    return 0;
}

int write_and_close(int file, std::string_view bytes) {
    const int error = write_all(file, bytes);
    return ::close(file) == 0 || error ? error : errno;
}

/// A name is lost in a power cut until its folder is on the disk. A folder that may not be read can't be asked for
/// that.
int sync_folder(const fs::path& folder) {
    const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return 0;
    const int error = synced(file);
    ::close(file);
    return error;
}

/// Removes what killed programs left in a folder: temporary files that nobody has locked. The folder is not listed by
/// std::filesystem, which ends the program where memory runs out on the way.
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

/// Where the bytes are until they get their name. It has a name of its own only where that can't be helped: a file
/// without one is gone when the program is killed. It is locked while it lives, so that nobody takes it for one that
/// was left.
class Temporary {
  public:
    /// A file that is to stay whatever happens has an ending that nobody removes.
    Temporary(const fs::path& beside, bool stays) : folder(beside.parent_path()), ending(stays ? ".copy" : ".tmp") {
        file = ::open(folder.empty() ? "." : folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
        if (file >= 0 && ::access(link().c_str(), F_OK) == 0) {  // without /proc it could get no name later
            ::flock(file, LOCK_EX | LOCK_NB);
            return;
        }
        if (file >= 0) ::close(file);
        named([&](const char* path) {
            file = ::open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
            if (file < 0) return false;
            struct stat status {};
            ::flock(file, LOCK_EX | LOCK_NB);
            if (::fstat(file, &status) == 0 && status.st_nlink > 0) return true;
            ::close(file);  // somebody was faster and took it for one that was left
            return file = -1, errno = EEXIST, false;
        });
    }
    ~Temporary() {
        if (file >= 0) ::close(file);
        if (!name.empty()) ::unlink(name.c_str());
    }
    Temporary(const Temporary&) = delete;

    bool opened() const { return file >= 0; }
    int descriptor() const { return file; }
    const fs::path& path() const { return name; }

    /// Gives it a name if it has none yet; an errno, or 0.
    int give_name() {
        if (!name.empty()) return 0;
        return named([&](const char* path) {
            return ::linkat(AT_FDCWD, link().c_str(), AT_FDCWD, path, AT_SYMLINK_FOLLOW) == 0;
        })
                   ? 0
                   : errno;
    }
    /// The name stays, or has become another one.
    void keep() { name.clear(); }

  private:
    std::string link() const { return "/proc/self/fd/" + std::to_string(file); }

    template <class Make>
    bool named(Make make) {
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

    fs::path folder, name;
    const char* const ending;
    int file = -1;
};

/// The older file's owner as far as we may, and its permissions without set-user-ID and set-group-ID: these were given
/// to the bytes that were there.
void take_over(int file, const struct stat& old) {
    if (::fchown(file, old.st_uid, old.st_gid) != 0) static_cast<void>(::fchown(file, uid_t(-1), old.st_gid));
    struct stat now {};
    mode_t mode = old.st_mode & 0777;
    // Of a group that is not the older file's, nobody may do more than others.
    if (::fstat(file, &now) != 0 || now.st_gid != old.st_gid) mode &= ~mode_t(070) | (mode & 07) << 3;
    static_cast<void>(::fchmod(file, mode));
}

/// Overwrites in place a file that has several names: a rename would leave the others with the older bytes. Room is
/// found first; `begun` says whether older bytes may be lost if it fails after all.
int overwrite(const fs::path& target, std::string_view bytes, off_t old_size, bool& begun) {
    const int file = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) return errno;
    const auto size = static_cast<off_t>(bytes.size());
    int error = 0;
    if (const NoFileSizeSignal guard; size > old_size) error = ::posix_fallocate(file, old_size, size - old_size);
    begun = !error;
    if (!error) error = write_all(file, bytes);
    if (::ftruncate(file, begun ? size : old_size) != 0 && !error) error = errno;
    if (!error) error = synced(file);
    return ::close(file) == 0 || error ? error : errno;
}

/// Where a chain of symbolic links ends, whether or not something is there.
fs::path follow_links(fs::path path) {
    std::error_code ignored;
    for (int links = 0; links < 40 && fs::is_symlink(path, ignored); ++links)
        path = path.parent_path() / fs::read_symlink(path, ignored);
    return path;
}

}  // namespace

void write_file(const std::string& path, std::string_view bytes) {
    if (path == "-") {
        std::fflush(stdout);
        if (const int error = write_all(STDOUT_FILENO, bytes)) fail("standard output", error);
        return;
    }
    const fs::path target = follow_links(path);
    struct stat old {};
    const bool exists = ::stat(target.c_str(), &old) == 0;
    if (!exists && errno == ELOOP) fail(path, ELOOP);
    if (exists && S_ISDIR(old.st_mode)) fail(path, EISDIR);
    // A rename would replace a read-only file, which its owner did not mean, or a device by a plain file.
    if (exists && ::access(target.c_str(), W_OK) != 0) fail(path, errno);
    if (exists && !S_ISREG(old.st_mode)) {
        const int file = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
        if (const int error = file < 0 ? errno : write_and_close(file, bytes)) fail(path, error);
        return;
    }
    const bool in_place = exists && old.st_nlink > 1;
    remove_left(target.parent_path());
    Temporary temporary(target, in_place);
    if (!temporary.opened()) fail(path, errno);
    if (exists) take_over(temporary.descriptor(), old);
    int error = write_all(temporary.descriptor(), bytes);
    if (!error) error = synced(temporary.descriptor());
    if (!error) error = temporary.give_name();
    if (!error && in_place) {
        bool begun = false;
        // From here on the copy may be all that a power cut leaves.
        error = sync_folder(target.parent_path());
        if (!error) error = overwrite(target, bytes, old.st_size, begun);
        if (error && begun) {
            const std::string copy = temporary.path().string();
            temporary.keep();
            fail(path, error, "; all of it is in '" + copy + "'");
        }
    } else if (!error) {
        if (std::rename(temporary.path().c_str(), target.c_str()) != 0)
            error = errno;
        else
            temporary.keep();
    }
    if (!error) error = sync_folder(target.parent_path());
    if (error) fail(path, error);
}

bool same_file(const std::string& a, const std::string& b) {
    if (a.empty() || b.empty() || a == "-" || b == "-") return false;
    std::error_code error;
    const fs::path target_a = follow_links(a), target_b = follow_links(b);
    if (fs::exists(target_a, error) && fs::exists(target_b, error))
        return fs::equivalent(target_a, target_b, error) && fs::is_regular_file(target_a, error);
    const auto canonical = [&](const fs::path& path) { return fs::weakly_canonical(fs::absolute(path, error), error); };
    return canonical(target_a) == canonical(target_b);
}

void refuse_overwriting(const std::string& option, const std::string& written, const std::string& what,
                        const std::string& kept) {
    if (same_file(written, kept))
        throw UsageError(option + " '" + written + "' would overwrite " + what + "; give it another name");
}

}  // namespace strahl
