// Temporary files, and functions for writing to files, pipes and devices. Functions that return int return an errno, or
// 0.
#pragma once
#include <sys/types.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <string_view>

namespace strahl {

/// While an object exists, writing past the limit of file sizes fails with EFBIG instead of ending the program.
class NoFileSizeSignal {
  public:
    NoFileSizeSignal();
    ~NoFileSizeSignal();
    NoFileSizeSignal(const NoFileSizeSignal&) = delete;

  private:
    sigset_t signal, before;
};

/// Writes all bytes. Pipes and devices may make it wait for ever. A signal ends that: they get small pieces, each of
/// which is written as a whole or not at all, so that the signal is noticed.
int write_all(int file, std::string_view bytes);

/// Waits until the file is on the disk. Succeeds on file systems that do not support this.
int synced(int file);

/// Waits until the folder is on the disk; before, a power cut could lose the names in it. Succeeds for folders that may
/// not be read, with which this is impossible.
int sync_folder(const std::filesystem::path& folder);

/// Removes temporary files that killed programs left in a folder, which are those that nobody has locked. Does not use
/// std::filesystem, which ends the program if memory runs out while it lists a folder.
void remove_left(const std::filesystem::path& folder);

/// A temporary file beside the final one. It has no name where the file system allows that, so that it is gone if the
/// program is killed. It is locked while the object exists, so that no other program takes it for one left by a killed
/// one.
class Temporary {
  public:
    /// If `stays`, its name has an ending that remove_left() does not remove.
    Temporary(const std::filesystem::path& beside, bool stays);
    ~Temporary();
    Temporary(const Temporary&) = delete;

    bool opened() const { return file >= 0; }  // errno says why not
    int descriptor() const { return file; }
    const std::filesystem::path& path() const { return name; }

    /// Gives it a name if it has none yet.
    int give_name();
    /// Leaves the file in place under its name, or the one that it was renamed to.
    void keep() { name.clear(); }

  private:
    std::string link() const { return "/proc/self/fd/" + std::to_string(file); }
    template <class Make>
    bool named(Make make);

    std::filesystem::path folder, name;
    const char* const ending;
    int file = -1;
};

}  // namespace strahl
