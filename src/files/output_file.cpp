#include "files/output_file.h"

#include <fcntl.h>
#include <ftw.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "files/temporary_file.h"

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

/// Gives the file the owner of the older one, as far as that is allowed, and its permissions without set-user-ID and
/// set-group-ID, which were meant for the older bytes.
void take_over(int file, const struct stat& old) {
    if (::fchown(file, old.st_uid, old.st_gid) != 0) static_cast<void>(::fchown(file, uid_t(-1), old.st_gid));
    struct stat now {};
    mode_t mode = old.st_mode & 0777;
    // A group other than the older file's may not do more than others.
    if (::fstat(file, &now) != 0 || now.st_gid != old.st_gid) mode &= ~mode_t(070) | (mode & 07) << 3;
    static_cast<void>(::fchmod(file, mode));
}

/// Copies the bytes of one file to the current position of another, block by block. Returns an errno, or 0.
int copy(int from, int to, off_t size, std::vector<char>& block) {
    for (off_t at = 0; at < size;) {
        const ssize_t got = ::pread(from, block.data(), block.size(), at);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return got < 0 ? errno : EIO;
        if (const int error = write_all(to, {block.data(), static_cast<std::size_t>(got)})) return error;
        at += got;
    }
    return 0;
}

/// Overwrites in place a file that has several names, because a rename would leave the others with the older bytes. The
/// disk space is reserved first. `begun`: older bytes may be lost if it fails. Returns an errno, or 0.
int overwrite(const fs::path& target, int source, off_t old_size, bool& begun) {
    std::vector<char> block(1 << 20);  // before anything is changed: memory may run out
    struct stat status {};
    if (::fstat(source, &status) != 0) return errno;
    const int file = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) return errno;
    const off_t size = status.st_size;
    int error = 0;
    if (const NoFileSizeSignal guard; size > old_size) error = ::posix_fallocate(file, old_size, size - old_size);
    begun = !error;
    if (!error) error = copy(source, file, size, block);
    if (::ftruncate(file, begun ? size : old_size) != 0 && !error) error = errno;
    if (!error) error = synced(file);
    return ::close(file) == 0 || error ? error : errno;
}

/// The end of a chain of symbolic links, whether or not that exists.
fs::path follow_links(fs::path path) {
    std::error_code ignored;
    for (int links = 0; links < 40 && fs::is_symlink(path, ignored); ++links)
        path = path.parent_path() / fs::read_symlink(path, ignored);
    return path;
}

}  // namespace

struct OutputFile::Implementation {
    std::string path;
    fs::path target;
    struct stat old {};
    bool exists = false;
    int direct = -1;  // standard output, a pipe or a device
    std::optional<Temporary> temporary;

    ~Implementation() {
        if (direct > STDERR_FILENO) ::close(direct);
    }
    bool in_place() const { return exists && old.st_nlink > 1; }

    /// Finds the file that exists at the path, if any.
    void look_at(const std::string& own_path) {
        path = own_path;
        target = follow_links(path);
        exists = ::stat(target.c_str(), &old) == 0;
        if (!exists && errno == ELOOP) fail(path, ELOOP);
        if (exists && S_ISDIR(old.st_mode)) fail(path, EISDIR);
        // A rename would replace a read-only file, against the wish of its owner, or a device by a regular file.
        if (exists && ::access(target.c_str(), W_OK) != 0) fail(path, errno);
    }

    void open(const std::string& own_path, bool for_other) {
        if (own_path == "-") {
            path = own_path;
            std::fflush(stdout);
            direct = STDOUT_FILENO;
            return;
        }
        look_at(own_path);
        if (exists && !S_ISREG(old.st_mode)) {
            if (for_other) throw OutputError("cannot write '" + path + "': it is not a regular file");
            direct = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
            if (direct < 0) fail(path, errno);
            return;
        }
        remove_left(target.parent_path());
        temporary.emplace(target, in_place());
        if (!temporary->opened()) fail(path, errno);
        if (const int error = for_other ? temporary->give_name() : 0) fail(path, error);
        if (exists) take_over(temporary->descriptor(), old);
    }

    /// Replaces the older file by the temporary one, which is on the disk.
    int replace() {
        if (!in_place()) {
            if (std::rename(temporary->path().c_str(), target.c_str()) != 0) return errno;
            temporary->keep();
            return 0;
        }
        // From here on the copy may be all that a power cut leaves.
        if (const int error = sync_folder(target.parent_path())) return error;
        bool begun = false;
        const std::string copy = temporary->path().string();
        const int error = overwrite(target, temporary->descriptor(), old.st_size, begun);
        if (error && begun) {
            temporary->keep();
            fail(path, error, "; all of it is in '" + copy + "'");
        }
        return error;
    }

    int finish() {
        if (direct >= 0) return direct == STDOUT_FILENO || ::close(std::exchange(direct, -1)) == 0 ? 0 : errno;
        int error = synced(temporary->descriptor());
        if (!error) error = temporary->give_name();
        if (!error) error = replace();
        return error ? error : sync_folder(target.parent_path());
    }
};

OutputFile::OutputFile(const std::string& path, Writer writer) : implementation(std::make_unique<Implementation>()) {
    implementation->open(path, writer == Writer::other_program);
}
OutputFile::~OutputFile() = default;

std::string OutputFile::name() const { return implementation->temporary->path().string(); }

void OutputFile::take_permissions(const std::string& of) {
    struct stat status {};
    if (implementation->temporary && ::stat(of.c_str(), &status) == 0)
        take_over(implementation->temporary->descriptor(), status);
}

void OutputFile::append(std::string_view bytes) {
    const auto& [path, target, old, exists, direct, temporary] = *implementation;
    if (const int error = write_all(direct >= 0 ? direct : temporary->descriptor(), bytes))
        fail(path == "-" ? "standard output" : path, error);
}

void OutputFile::finish() {
    if (const int error = implementation->finish()) fail(implementation->path, error);
}

void OutputFile::finish_as(const std::string& path) {
    implementation->look_at(path);
    finish();
}

void write_file(const std::string& path, std::string_view bytes) {
    OutputFile file(path);
    file.append(bytes);
    file.finish();
}

// Not std::filesystem::remove_all, which ends the program if memory runs out.
bool remove_folder(const std::string& path) {
    const auto remove = [](const char* name, const struct stat*, int, FTW*) { return std::remove(name); };
    return ::nftw(path.c_str(), remove, 16, FTW_DEPTH | FTW_PHYS) == 0;
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
