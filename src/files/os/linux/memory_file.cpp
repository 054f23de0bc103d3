#include "files/os/memory_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <new>

namespace strahl::os {

MemoryFile::MemoryFile(std::string_view bytes) : file(::memfd_create("strahl", MFD_CLOEXEC)) {
    while (file && !bytes.empty()) {
        const ssize_t count = ::write(file.number, bytes.data(), bytes.size());
        if (count <= 0) throw std::bad_alloc();
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    if (!file) throw std::bad_alloc();
    own_path = "/proc/self/fd/" + std::to_string(file.number);
}

}  // namespace strahl::os
