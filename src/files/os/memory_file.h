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
    std::string path() const;

  private:
    Descriptor file;
};

}  // namespace strahl::os
