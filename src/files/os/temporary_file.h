// Temporary files, of which none stays when a program is killed.
#pragma once
#include <filesystem>
#include <string>

#include "files/os/file.h"

namespace strahl::os {

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

    bool opened() const { return bool(own_file); }  // errno says why not
    OpenFile& file() { return own_file; }
    const std::filesystem::path& path() const { return name; }

    /// Gives it a name if it has none yet. Returns an errno, or 0.
    int give_name();
    /// Leaves the file in place under its name, or the one that it was renamed to.
    void keep() { name.clear(); }

  private:
    std::string link() const { return "/proc/self/fd/" + std::to_string(own_file.number()); }
    template <class Make>
    bool named(Make make);

    std::filesystem::path folder, name;
    const char* const ending;
    OpenFile own_file;
};

}  // namespace strahl::os
