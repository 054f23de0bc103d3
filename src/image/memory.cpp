// Available memory, as Linux tells it.
#include "image/memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace strahl {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

double kernel_says() {
    std::ifstream file("/proc/meminfo");
    std::string word;
    while (file >> word)
        if (double kilobytes; word == "MemAvailable:" && file >> kilobytes) return 1024 * kilobytes;
    return unknown;
}

/// The file holds "max" where there is no limit.
double container_says() {
    std::ifstream file("/sys/fs/cgroup/memory.max");
    double bytes;
    return file >> bytes ? bytes : unknown;
}

double limit_says() {
    rlimit limit{};
    return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? static_cast<double>(limit.rlim_cur)
                                                                                : unknown;
}

}  // namespace

double available_memory() { return std::min({kernel_says(), container_says(), limit_says()}); }

}  // namespace strahl
