// Windows has no files in memory: these are temporary ones, which it keeps in memory while there is enough.
#include "files/os/memory_file.h"

#include <new>

#include "files/os/windows/win32.h"

namespace strahl::os {

MemoryFile::MemoryFile(std::string_view bytes) {
    std::wstring path;
    file = scratch_file(path);
    if (!file || !write_all(file, bytes)) throw std::bad_alloc();
    own_path = utf8(path);
}

}  // namespace strahl::os
