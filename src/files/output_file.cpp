#include "files/output_file.h"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

#include "files/os/temporary_file.h"

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

/// Copies the bytes of one file to the current position of another, block by block. Returns an errno, or 0.
int copy(const os::OpenFile& from, os::OpenFile& to, std::uint64_t size, std::vector<char>& block) {
    for (std::uint64_t at = 0; at < size;) {
        std::size_t got = block.size();
        if (const int error = from.read(at, block.data(), got)) return error;
        if (got == 0) return EIO;
        if (const int error = to.append({block.data(), got})) return error;
        at += got;
    }
    return 0;
}

/// Overwrites in place a file that has several names, because a rename would leave the others with the older bytes. The
/// disk space is reserved first. `begun`: older bytes may be lost if it fails. Returns an errno, or 0.
int overwrite(const fs::path& target, const os::OpenFile& source, std::uint64_t old_size, bool& begun) {
    std::vector<char> block(1 << 20);  // before anything is changed: memory may run out
    const os::FileStatus status = source.status();
    if (status.error) return status.error;
    os::OpenFile file(target, os::OpenFile::OpenMode::overwrite);
    if (!file) return errno;
    int error = status.size > old_size ? file.reserve(old_size, status.size) : 0;
    begun = !error;
    if (!error) error = copy(source, file, status.size, block);
    if (const int cut = file.cut(begun ? status.size : old_size); !error) error = cut;
    if (!error) error = file.sync();
    const int closed = file.close();
    return error ? error : closed;
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
    os::FileStatus old{.error = ENOENT};
    os::OpenFile direct;  // standard output, a pipe or a device
    std::optional<os::Temporary> temporary;

    bool exists() const { return !old.error; }
    bool in_place() const { return exists() && old.names > 1; }
    os::OpenFile& file() { return direct ? direct : temporary->file(); }

    /// Finds the file that exists at the path, if any.
    void look_at(const std::string& own_path) {
        path = own_path;
        target = follow_links(path);
        old = os::status_of(target);
        if (old.error == ELOOP) fail(path, ELOOP);
        if (old.folder()) fail(path, EISDIR);
        // A rename would replace a read-only file, against the wish of its owner, or a device by a regular file.
        if (const int error = exists() ? os::writable(target) : 0) fail(path, error);
    }

    void open(const std::string& own_path, bool for_other) {
        if (own_path == "-") {
            path = own_path;
            direct = os::OpenFile::standard_output();
            return;
        }
        look_at(own_path);
        if (exists() && !old.regular()) {
            if (for_other) throw OutputError("cannot write '" + path + "': it is not a regular file");
            direct = os::OpenFile(target, os::OpenFile::OpenMode::overwrite);
            if (!direct) fail(path, errno);
            return;
        }
        os::remove_left(target.parent_path());
        temporary.emplace(target, in_place());
        if (!temporary->opened()) fail(path, errno);
        if (const int error = for_other ? temporary->give_name() : 0) fail(path, error);
        if (exists()) temporary->file().take_over(old);
    }

    /// Replaces the older file by the temporary one, which is on the disk.
    int replace() {
        if (!in_place()) {
            if (const int error = os::rename(temporary->path(), target)) return error;
            temporary->keep();
            return 0;
        }
        // From here on the copy may be all that a power cut leaves.
        if (const int error = os::sync_folder(target.parent_path())) return error;
        bool begun = false;
        const std::string copy = temporary->path().string();
        const int error = overwrite(target, temporary->file(), old.size, begun);
        if (error && begun) {
            temporary->keep();
            fail(path, error, "; all of it is in '" + copy + "'");
        }
        return error;
    }

    int finish() {
        if (direct) return direct.close();
        int error = temporary->file().sync();
        if (!error) error = temporary->give_name();
        if (!error) error = replace();
        return error ? error : os::sync_folder(target.parent_path());
    }
};

OutputFile::OutputFile(const std::string& path, Writer writer) : implementation(std::make_unique<Implementation>()) {
    implementation->open(path, writer == Writer::other_program);
}
OutputFile::~OutputFile() = default;

std::string OutputFile::name() const { return implementation->temporary->path().string(); }

void OutputFile::take_permissions(const std::string& of) {
    const os::FileStatus status = os::status_of(of);
    if (implementation->temporary && !status.error) implementation->temporary->file().take_over(status);
}

void OutputFile::append(std::string_view bytes) {
    const std::string& path = implementation->path;
    if (const int error = implementation->file().append(bytes)) fail(path == "-" ? "standard output" : path, error);
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
