// Folders that are made, filled and removed.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace strahl::os {

/// A new folder with a name of its own. It is removed with its content as far as possible.
class NewFolder {
  public:
    /// Makes a folder whose path begins with `start`, which nobody else can read. The files in it that are called as in
    /// `usual` are removed without needing memory. Throws std::system_error.
    explicit NewFolder(const std::string& start, std::vector<const char*> usual = {});
    ~NewFolder() { remove(); }
    NewFolder(const NewFolder&) = delete;

    const std::string& path() const { return own_path; }
    /// Renames it to `target` when all in it is on the disk, with the permissions of ordinary folders. A folder that is
    /// there takes its place here. Returns an errno, or 0.
    int become(const std::filesystem::path& target);
    /// Removes it with its content. Returns an errno, or 0.
    int remove();

  private:
    std::string own_path;
    std::vector<const char*> usual;
};

/// Like std::filesystem::is_empty, which ends the program when memory runs out.
bool is_empty_folder(const std::filesystem::path& path);

}  // namespace strahl::os
