#include "files/os/memory.h"

#include <malloc.h>

#include <limits>
#include <new>

#include "files/os/windows/win32.h"

namespace strahl::os {

void* allocate(std::size_t bytes) {
    void* const block = ::_aligned_malloc(bytes + 1, 64);
    if (!block) throw std::bad_alloc();
    return block;
}
void release(void* block) { ::_aligned_free(block); }

void trim_memory() { ::_heapmin(); }

double available_memory() {
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof status;
    return ::GlobalMemoryStatusEx(&status) ? double(status.ullAvailPhys) : std::numeric_limits<double>::infinity();
}

}  // namespace strahl::os
