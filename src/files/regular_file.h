// Reads regular files at any place.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include "files/os/file.h"

namespace strahl {

class RegularFile {
  public:
    /// Opens the file, unless it is a folder, a pipe or a device: opening a pipe could wait for ever, and a device need
    /// have no end. Throws FileError.
    explicit RegularFile(const std::string& path);

    const std::string& path() const { return own_path; }
    std::uint64_t size() const { return own_size; }
    /// Reads `count` bytes from `at` on, fewer if the file ends before. Returns how many. Throws FileError.
    std::size_t read(std::uint64_t at, char* to, std::size_t count) const;
    /// Returns these bytes.
    std::string bytes(std::uint64_t at, std::size_t count) const;

  private:
    [[noreturn]] void fail(const std::string& why) const;

    std::string own_path;
    os::OpenFile file;
    std::uint64_t own_size = 0;
};

}  // namespace strahl
