// Whole files out: temporary file, then rename.
#include "text/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace strahl {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, int error) {
    std::string why = std::generic_category().message(error);
    if (error == ENOENT) why = "its folder does not exist; make that first";
    if (error == EISDIR) why = "it is a folder; name a file in it";
    throw OutputError("cannot write '" + path + "': " + why);
}

/// Writes everything, or says why not (an errno).
int write_all(int file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file, bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR) return errno;
        if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

int write_and_close(int file, std::string_view bytes) {
    const int error = write_all(file, bytes);
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
    fs::path temporary;
    int file = -1;
    for (int i = 0; i == 0 || (file < 0 && errno == EEXIST && i < 1000); ++i) {
        temporary = target.parent_path() / (".strahl-" + std::to_string(::getpid()) + "-" + std::to_string(i) + ".tmp");
        file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    }
    if (file < 0) fail(path, errno);
    if (exists) static_cast<void>(::fchmod(file, old.st_mode & 07777));
    int error = write_and_close(file, bytes);
    if (!error && std::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
    if (!error) return;
    ::unlink(temporary.c_str());
    fail(path, error);
}

}  // namespace strahl
