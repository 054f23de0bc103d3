// Files, as the system has them. Functions that return int return an errno, or 0.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "files/os/descriptor.h"

namespace strahl::os {

/// Differs between versions of a file, and between files; all zero if there is none.
struct FileStamp {
    std::uint64_t device = 0, number = 0;
    std::int64_t size = 0, seconds = 0, nanoseconds = 0;
    bool operator==(const FileStamp&) const = default;
};

/// Describes what stands at a path, or an open file.
struct FileStatus {
    int error = 0;  // the errno if nothing can be seen there
    std::filesystem::file_type type = std::filesystem::file_type::none;
    std::uint64_t size = 0, names = 0;  // names: how many it has
    std::uint32_t owner = 0, group = 0, permissions = 0;
    FileStamp stamp{};

    bool regular() const { return type == std::filesystem::file_type::regular; }
    bool folder() const { return type == std::filesystem::file_type::directory; }
};
/// Follows links.
FileStatus status_of(const std::filesystem::path& path);

/// Returns 0 if this program may write the file, or create files in the folder; else the errno.
int writable(const std::filesystem::path& path);

/// An open file.
class OpenFile {
  public:
    enum class OpenMode {
        read,       // does not wait for the writer of a pipe
        overwrite,  // from its start on
        create      // fails with EEXIST if there is such a file
    };
    OpenFile() = default;
    explicit OpenFile(Descriptor opened) : file(std::move(opened)) {}
    /// Opens the file, or leaves it closed with the reason in errno.
    OpenFile(const std::filesystem::path& path, OpenMode mode);
    static OpenFile standard_output();

    explicit operator bool() const { return bool(file); }
    int number() const { return file.number; }
    FileStatus status() const;

    /// Reads up to `count` bytes from `at` on; `count` becomes how many there were.
    int read(std::uint64_t at, char* to, std::size_t& count) const;
    /// Writes all bytes. Pipes and devices may make it wait for ever. A signal ends that: they get small pieces, each
    /// of which is written as a whole or not at all, so that the signal is noticed.
    int append(std::string_view bytes);
    /// Reserves disk space from one size to a larger one.
    int reserve(std::uint64_t from, std::uint64_t to);
    /// Cuts the file to this size, and appends from there on.
    int cut(std::uint64_t size);
    /// Waits until the file is on the disk. Succeeds on file systems that do not support this.
    int sync();
    /// Gives it the owner of an older file, as far as that is allowed, and its permissions without set-user-ID and
    /// set-group-ID, which were meant for the older bytes.
    void take_over(const FileStatus& old);
    /// Locks the file while it is open. Gives EWOULDBLOCK if another program has locked it.
    int lock();
    /// Returns an error of what was written before, too.
    int close();

  private:
    Descriptor file;
};

/// Renames a file, which takes the place of one of the new name.
int rename(const std::filesystem::path& from, const std::filesystem::path& to);

/// Waits until the folder is on the disk; before, a power cut could lose the names in it. Succeeds for folders that may
/// not be read, with which this is impossible.
int sync_folder(const std::filesystem::path& folder);

}  // namespace strahl::os
