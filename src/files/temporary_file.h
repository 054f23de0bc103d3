// What writing whole files is made of. Results are errnos, or 0.
#pragma once
#include <sys/types.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <string_view>

namespace strahl {

/// While it lives, writing past the limit of file sizes fails with EFBIG instead of ending the program.
class NoFileSizeSignal {
  public:
    NoFileSizeSignal();
    ~NoFileSizeSignal();
    NoFileSizeSignal(const NoFileSizeSignal&) = delete;

  private:
    sigset_t signal, before;
};

/// Writes everything, or says why not (an errno). Pipes and devices may keep it waiting for ever: a signal ends that,
/// and is noticed because they get pieces that are written as a whole or not at all.
int write_all(int file, std::string_view bytes);

/// Waits until the disk has it: an errno if it has not. File systems that know no such thing are left alone.
int synced(int file);

/// A name is lost in a power cut until its folder is on the disk. A folder that may not be read can't be asked for
/// that.
int sync_folder(const std::filesystem::path& folder);

/// Removes what killed programs left in a folder: temporary files that nobody has locked. The folder is not listed by
/// std::filesystem, which ends the program where memory runs out on the way.
void remove_left(const std::filesystem::path& folder);

/// Where the bytes are until they get their name. It has a name of its own only where that can't be helped: a file
/// without one is gone when the program is killed. It is locked while it lives, so that nobody takes it for one that
/// was left.
class Temporary {
  public:
    /// A file that is to stay whatever happens has an ending that nobody removes.
    Temporary(const std::filesystem::path& beside, bool stays);
    ~Temporary();
    Temporary(const Temporary&) = delete;

    bool opened() const { return file >= 0; }  // errno says why not
    int descriptor() const { return file; }
    const std::filesystem::path& path() const { return name; }

    /// Gives it a name if it has none yet.
    int give_name();
    /// The name stays, or has become another one.
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
