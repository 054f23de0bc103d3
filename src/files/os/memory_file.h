// A file in memory, for libraries that read only files.
#pragma once
#include <string>
#include <string_view>

#include "files/os/descriptor.h"

namespace strahl::os {

class MemoryFile {
  public:
    /// Makes a file that holds these bytes while the object lives. Throws std::bad_alloc if there is no memory for it.
    explicit MemoryFile(std::string_view bytes);
    /// Returns the path at which this process can read it.
    const std::string& path() const { return own_path; }

  private:
    Descriptor file;
    std::string own_path;
};

}  // namespace strahl::os
