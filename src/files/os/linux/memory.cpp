#include "files/os/memory.h"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <new>
#include <string>

namespace strahl::os {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

double available_to_all() {
    std::ifstream file("/proc/meminfo");
    std::string word;
    while (file >> word)
        if (double kilobytes; word == "MemAvailable:" && file >> kilobytes) return 1024 * kilobytes;
    return unknown;
}

/// The file holds "max" where there is no limit.
double container_limit() {
    std::ifstream file("/sys/fs/cgroup/memory.max");
    double bytes;
    return file >> bytes ? bytes : unknown;
}

double address_space_limit() {
    rlimit limit{};
    return ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? static_cast<double>(limit.rlim_cur)
                                                                                  : unknown;
}

}  // namespace

void* allocate(std::size_t bytes) {
    constexpr std::size_t page = std::size_t(1) << 21;
    const std::size_t unit = bytes < page ? 64 : page;
    void* const block = std::aligned_alloc(unit, (bytes / unit + 1) * unit);
    if (!block) throw std::bad_alloc();
    if (unit == page) ::madvise(block, bytes / page * page, MADV_HUGEPAGE);  // none that would be partly empty
    return block;
}
void release(void* block) { std::free(block); }

void trim_memory() {
#if defined(__GLIBC__)
    ::malloc_trim(0);
#endif
}

double available_memory() { return std::min({available_to_all(), container_limit(), address_space_limit()}); }

}  // namespace strahl::os
